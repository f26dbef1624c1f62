#include "clients/skyig/decode.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "clients/skyig/decode_can.h"
#include "clients/skyig/decode_cigi.h"
#include "protocol/transport/udp.h"
#include "server/stop_signal.h"

namespace skyig::clients {

namespace cigi = protocol::cigi;
namespace transport = protocol::transport;

namespace {

constexpr transport::Ipv4 kLoopback = 0x7F000001;
/// How long a signal may wait to be seen.
constexpr std::chrono::milliseconds kPatience{200};

class CigiPrinter {
  public:
    CigiPrinter(const DecodeOptions& options, std::ostream& out)
        : sender_(options.from_ig ? cigi::Sender::kImageGenerator : cigi::Sender::kHost),
          json_(options.json),
          out_(out) {}

    void print(std::span<const std::byte> bytes) {
        const CigiDatagram datagram = decode_cigi(bytes, sender_);
        if (json_) {
            out_ << to_json(datagram) << '\n';
        } else {
            out_ << (printed_ > 0 ? "\n" : "") << to_text(datagram);
        }
        ++printed_;
    }
    /// False, and told on stderr, if `hex` is none. \param place  "argument 2"
    [[nodiscard]] bool print_hex(std::string_view hex, const std::string& place) {
        HexError error;
        if (const auto bytes = parse_hex(hex, error)) {
            print(*bytes);
            return true;
        }
        out_.flush();
        fmt::print(stderr, "skyig decode: {}, column {}: {}\n", place, error.column, error.text);
        return false;
    }

    [[nodiscard]] std::uint64_t printed() const noexcept { return printed_; }

  private:
    cigi::Sender sender_;
    bool json_;
    std::ostream& out_;
    std::uint64_t printed_ = 0;
};

int decode_text(const DecodeOptions& options, std::istream& in, std::ostream& out) {
    CigiPrinter printer(options, out);
    bool good = true;
    if (!options.cigi.empty() && options.cigi != std::vector<std::string>{"-"}) {
        for (std::size_t i = 0; i < options.cigi.size(); ++i)
            good = printer.print_hex(options.cigi[i], fmt::format("argument {}", i + 1)) && good;
        return good ? 0 : 1;
    }
    std::string line;
    for (std::size_t number = 1; std::getline(in, line); ++number)
        good = printer.print_hex(line, fmt::format("line {}", number)) && good;
    return good ? 0 : 1;
}

int decode_live(const DecodeOptions& options, std::ostream& out) {
    server::StopSignal stop;
    auto opened = transport::UdpReceiver::open({.listen = {kLoopback, *options.live_port}});
    if (!opened) throw std::runtime_error(opened.error());
    transport::UdpReceiver receiver = std::move(opened).value();
    fmt::print(stderr, "skyig decode: listening on {}\n", transport::to_string(receiver.local()));
    CigiPrinter printer(options, out);
    const auto done = [&] { return options.count && printer.printed() >= *options.count; };
    while (!done() && !stop.requested()) {
        if (!receiver.wait(kPatience)) continue;
        receiver.drain([&](const transport::Datagram& datagram) {
            if (!done()) printer.print(datagram.bytes);
        });
        out.flush();
    }
    return 0;
}

}  // namespace

int run_decode(const DecodeOptions& options, std::istream& in, std::ostream& out) {
    try {
        return options.live_port ? decode_live(options, out) : decode_text(options, in, out);
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig decode: {}\n", error.what());
        return 1;
    }
}

int run_decode(const DecodeOptions& options) {
    return options.can_path.empty() ? run_decode(options, std::cin, std::cout) : run_decode_can(options);
}

}  // namespace skyig::clients
