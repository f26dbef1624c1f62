#include "clients/skyig/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "protocol/recording/pcapng_writer.h"
#include "protocol/transport/can_socket.h"
#include "protocol/transport/udp.h"
#include "server/clock.h"
#include "server/kernel_stamps.h"
#include "server/stop_signal.h"

namespace skyig::clients {

namespace recording = protocol::recording;
namespace transport = protocol::transport;

namespace {

/// How much a crash may lose, and how late a signal is seen.
constexpr std::int64_t kRound_ns = 20'000'000;

template <class T>
T value_or_throw(protocol::Result<T, std::string> result) {
    if (!result) throw std::runtime_error(result.error());
    return std::move(result).value();
}

struct CloseFile {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

File open_file(const std::string& path) {
    File file(std::fopen(path.c_str(), "wb"));
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be made: {}", path, std::strerror(errno)));
    return file;
}

std::vector<transport::UdpReceiver> open_ports(const RecordOptions& options) {
    transport::UdpOptions udp;
    for (const std::string& sender : options.from)
        udp.allowed.push_back({value_or_throw(transport::parse_ipv4(sender)), 0});
    std::vector<transport::UdpReceiver> ports;
    for (const std::string& listen : options.listen) {
        udp.listen = value_or_throw(transport::parse_endpoint(listen));
        ports.push_back(value_or_throw(transport::UdpReceiver::open(udp)));
    }
    return ports;
}

std::vector<transport::CanReceiver> open_buses(const RecordOptions& options) {
    std::vector<transport::CanReceiver> buses;
    for (const std::string& interface : options.can) {
        transport::CanOptions can;
        can.interface = interface;
        can.bus = static_cast<std::uint8_t>(buses.size());
        buses.push_back(value_or_throw(transport::CanReceiver::open(can)));
    }
    return buses;
}

/// Takes what has come, every round, and writes it in the order of its time stamps.
class RecordRun {
  public:
    RecordRun(const RecordOptions& options, server::Clock& clock)
        : options_(options),
          clock_(clock),
          stamps_(clock),
          ports_(open_ports(options)),
          buses_(open_buses(options)),
          file_(open_file(options.out_path)),
          writer_(begin()) {}

    void run() {
        std::string heard;
        for (const transport::UdpReceiver& port : ports_)
            heard += fmt::format("{}udp {}", heard.empty() ? "" : ", ", transport::to_string(port.local()));
        for (const transport::CanReceiver& bus : buses_)
            heard += fmt::format("{}{} ({})", heard.empty() ? "" : ", ", bus.interface(),
                                 transport::to_text(bus.state()));
        fmt::print(stderr, "skyig record: {} into {}\n", heard, options_.out_path);
        const std::int64_t start_ns = clock_.monotonic_ns();
        const std::int64_t end_ns =
            start_ns + static_cast<std::int64_t>(options_.duration_s.value_or(0) * 1e9);
        for (std::int64_t now_ns = start_ns; !stop_.requested(); now_ns = clock_.monotonic_ns()) {
            if (options_.duration_s && now_ns >= end_ns) break;
            clock_.sleep_until_ns(now_ns + kRound_ns);
            round();
        }
        round();
        elapsed_s_ = static_cast<double>(clock_.monotonic_ns() - start_ns) * 1e-9;
    }

    [[nodiscard]] std::string result() const {
        std::uint64_t not_allowed = 0;
        std::uint64_t lost = 0;
        for (const transport::UdpReceiver& port : ports_) {
            not_allowed += port.counters().not_allowed;
            lost += port.counters().ring_full + port.counters().queue_full;
        }
        for (const transport::CanReceiver& bus : buses_)
            lost += bus.counters().ring_full + bus.counters().dropped;
        if (!options_.json) {
            return fmt::format(
                "recorded        {} datagrams, {} CAN frames in {:.1f} s: {}, {} bytes\n"
                "not recorded    {} of senders not in --from, {} that came too fast\n",
                datagrams_, can_frames_, elapsed_s_, options_.out_path, writer_.written_bytes(), not_allowed,
                lost);
        }
        const nlohmann::ordered_json json{{"file", options_.out_path},  {"datagrams", datagrams_},
                                          {"can_frames", can_frames_},  {"elapsed_s", elapsed_s_},
                                          {"not_allowed", not_allowed}, {"lost", lost}};
        return json.dump(2) + '\n';
    }

  private:
    struct Arrival {
        std::int64_t time_ns = 0;
        bool is_can = false;
        transport::Endpoint from;
        transport::Endpoint to;
        std::size_t begin = 0;
        std::size_t size = 0;
        protocol::CanFrame can;
    };

    recording::PcapngWriter begin() {
        recording::RecordingHead head;
        head.comment = "skyig record: what came, without a daemon";
        head.program = "skyig " SKYIG_VERSION;
        head.can_names = options_.can;
        return value_or_throw(recording::PcapngWriter::begin(
            [file = file_.get()](std::span<const std::byte> blocks) {
                return std::fwrite(blocks.data(), 1, blocks.size(), file) == blocks.size();
            },
            head));
    }

    void round() {
        arrivals_.clear();
        bytes_.clear();
        stamps_.look();
        for (transport::UdpReceiver& port : ports_) {
            port.drain([this, to = port.local()](const transport::Datagram& datagram) {
                arrivals_.push_back({stamps_.steady_ns(datagram.arrival_ns),
                                     false,
                                     datagram.from,
                                     to,
                                     bytes_.size(),
                                     datagram.bytes.size(),
                                     {}});
                bytes_.insert(bytes_.end(), datagram.bytes.begin(), datagram.bytes.end());
            });
        }
        for (transport::CanReceiver& bus : buses_) {
            bus.drain([this](protocol::CanFrame frame) {
                frame.received_ns = stamps_.steady_ns(frame.received_ns);
                arrivals_.push_back({frame.received_ns, true, {}, {}, 0, 0, frame});
            });
        }
        std::stable_sort(arrivals_.begin(), arrivals_.end(),
                         [](const Arrival& a, const Arrival& b) { return a.time_ns < b.time_ns; });
        for (const Arrival& arrival : arrivals_)
            write(arrival);
        if (std::fflush(file_.get()) != 0) fail();
    }

    void write(const Arrival& arrival) {
        if (arrival.is_can ? writer_.write_can(arrival.can)
                           : writer_.write_udp(arrival.time_ns, arrival.from, arrival.to,
                                               std::span(bytes_).subspan(arrival.begin, arrival.size))) {
            ++(arrival.is_can ? can_frames_ : datagrams_);
        } else {
            fail();
        }
    }

    [[noreturn]] void fail() const {
        throw std::runtime_error(
            fmt::format("{}: cannot be written: {}", options_.out_path, std::strerror(errno)));
    }

    /// Before any thread starts.
    server::StopSignal stop_;
    const RecordOptions& options_;
    server::Clock& clock_;
    server::KernelStamps stamps_;
    std::vector<transport::UdpReceiver> ports_;
    std::vector<transport::CanReceiver> buses_;
    File file_;
    recording::PcapngWriter writer_;
    std::vector<Arrival> arrivals_;
    std::vector<std::byte> bytes_;
    std::uint64_t datagrams_ = 0;
    std::uint64_t can_frames_ = 0;
    double elapsed_s_ = 0.0;
};

}  // namespace

int run_record(const RecordOptions& options) {
    server::SystemClock clock;
    return run_record(options, clock);
}

int run_record(const RecordOptions& options, server::Clock& clock) {
    try {
        RecordRun record(options, clock);
        record.run();
        fmt::print("{}", record.result());
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig record: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
