#include "clients/skyig/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "protocol/recording/capture_reader.h"
#include "protocol/transport/udp.h"
#include "server/recorder.h"
#include "server/replay.h"
#include "server/stop_signal.h"

namespace skyig::clients {

namespace recording = protocol::recording;
namespace transport = protocol::transport;

namespace {

/// How long a signal may wait to be seen.
constexpr std::int64_t kLookEvery_ns = 100'000'000;
constexpr double kSecond_ns = 1e9;
/// Each is a socket; more senders than that share one.
constexpr std::size_t kMostSenders = 64;

struct ReplayResult {
    std::uint64_t datagrams = 0;
    std::uint64_t bytes = 0;
    std::uint64_t failed = 0;
    std::uint64_t marks = 0;
    std::uint64_t can_frames = 0;
    std::uint64_t other_ports = 0;
    double recorded_s = 0.0;
    double elapsed_s = 0.0;
    bool complete = false;
};

std::string to_text(const ReplayOptions& options, const ReplayResult& result) {
    std::string text = fmt::format(
        "sent            {} datagrams, {} bytes to {} in {:.1f} s ({:.1f} s of {})\n", result.datagrams,
        result.bytes, options.to, result.elapsed_s, result.recorded_s, options.path);
    text += fmt::format("left out        {} frame marks, {} CAN frames, {} datagrams to other ports\n",
                        result.marks, result.can_frames, result.other_ports);
    if (result.failed > 0) text += fmt::format("not sent        {} datagrams\n", result.failed);
    return text;
}

std::string to_json(const ReplayOptions& options, const ReplayResult& result) {
    nlohmann::ordered_json json;
    json["file"] = options.path;
    json["to"] = options.to;
    json["datagrams"] = result.datagrams;
    json["bytes"] = result.bytes;
    json["failed"] = result.failed;
    json["recorded_s"] = result.recorded_s;
    json["elapsed_s"] = result.elapsed_s;
    json["complete"] = result.complete;
    json["left_out"] = {{"frame_marks", result.marks},
                        {"can_frames", result.can_frames},
                        {"other_ports", result.other_ports}};
    return json.dump(2) + '\n';
}

template <class T>
T value_or_throw(protocol::Result<T, std::string> result) {
    if (!result) throw std::runtime_error(result.error());
    return std::move(result).value();
}

/// One capture from its first packet to its last.
class ReplayRun {
  public:
    ReplayRun(const ReplayOptions& options, server::Clock& clock, std::istream& steps)
        : options_(options),
          clock_(clock),
          steps_(steps),
          reader_(value_or_throw(recording::CaptureReader::open(options.path))),
          to_(value_or_throw(transport::parse_endpoint(options.to))),
          has_marks_(reader_.section_comment().starts_with(server::kRecordingTitle)) {
        // Who steps by hand waits for standard input, which a blocked signal could not end.
        if (!options.step) stop_.emplace();
    }

    ReplayResult send_all() {
        const std::int64_t start_ns = clock_.monotonic_ns();
        while (const recording::CapturedPacket* packet = reader_.next()) {
            if (!first_ns_) first_ns_ = packet->time_ns;
            result_.recorded_s = static_cast<double>(packet->time_ns - *first_ns_) / kSecond_ns;
            if (stopped() || !take(*packet, start_ns)) break;
        }
        result_.complete = reader_.end() != recording::CaptureReader::End::kNotYet &&
                           reader_.end() != recording::CaptureReader::End::kDamaged;
        result_.elapsed_s = static_cast<double>(clock_.monotonic_ns() - start_ns) / kSecond_ns;
        return result_;
    }

    [[nodiscard]] const std::string& trouble() const noexcept { return reader_.trouble(); }

  private:
    [[nodiscard]] bool stopped() { return stop_ && stop_->requested(); }

    /// False when nothing more is to be sent.
    bool take(const recording::CapturedPacket& packet, std::int64_t start_ns) {
        if (packet.kind == recording::CapturedPacket::Kind::kCan) {
            ++result_.can_frames;
            return true;
        }
        if (has_marks_ && server::Replay::mark_of(packet)) {
            ++result_.marks;
            return !options_.step || next_step();
        }
        const auto& ports = options_.ports;
        if (!ports.empty() && std::find(ports.begin(), ports.end(), packet.to.port) == ports.end()) {
            ++result_.other_ports;
            return true;
        }
        if (options_.step) {
            if (!has_marks_ && !next_step()) return false;
        } else if (!wait_for_its_time(start_ns)) {
            return false;
        }
        send(packet);
        return true;
    }

    bool next_step() {
        std::string line;
        return static_cast<bool>(std::getline(steps_, line));
    }

    /// False when a signal came first.
    bool wait_for_its_time(std::int64_t start_ns) {
        if (options_.speed == 0.0) return true;
        const std::int64_t due_ns = start_ns + std::llround(result_.recorded_s / options_.speed * kSecond_ns);
        for (std::int64_t now_ns = clock_.monotonic_ns(); now_ns < due_ns; now_ns = clock_.monotonic_ns()) {
            clock_.sleep_until_ns(std::min(due_ns, now_ns + kLookEvery_ns));
            if (stopped()) return false;
        }
        return true;
    }

    void send(const recording::CapturedPacket& packet) {
        transport::UdpSender& sender = sender_of(packet.from);
        if (sender.send(to_, packet.payload)) {
            ++result_.datagrams;
            result_.bytes += packet.payload.size();
        } else {
            ++result_.failed;
        }
    }

    transport::UdpSender& sender_of(const transport::Endpoint& from) {
        const std::pair key{from.address, from.port};
        if (const auto known = senders_.find(key); known != senders_.end()) return known->second;
        if (senders_.size() == kMostSenders) return senders_.begin()->second;
        return senders_.emplace(key, value_or_throw(transport::UdpSender::open())).first->second;
    }

    const ReplayOptions& options_;
    server::Clock& clock_;
    std::istream& steps_;
    std::optional<server::StopSignal> stop_;
    recording::CaptureReader reader_;
    transport::Endpoint to_;
    bool has_marks_;
    std::optional<std::int64_t> first_ns_;
    std::map<std::pair<transport::Ipv4, std::uint16_t>, transport::UdpSender> senders_;
    ReplayResult result_;
};

}  // namespace

int run_replay(const ReplayOptions& options) {
    server::SystemClock clock;
    return run_replay(options, clock, std::cin);
}

int run_replay(const ReplayOptions& options, server::Clock& clock, std::istream& steps) {
    constexpr int kDone = 0;
    constexpr int kFailed = 1;
    const auto say = [](std::string_view line) { fmt::print(stderr, "skyig replay: {}\n", line); };
    try {
        ReplayRun run(options, clock, steps);
        const ReplayResult result = run.send_all();
        fmt::print("{}", options.json ? to_json(options, result) : to_text(options, result));
        if (!run.trouble().empty()) say(run.trouble());
        if (result.complete && result.datagrams > 0 && result.failed == 0) return kDone;
        if (result.failed > 0) {
            say(fmt::format("the system did not take {} datagrams for {}", result.failed, options.to));
        } else if (result.complete) {
            say(fmt::format("{}: holds no UDP datagram that was to be sent", options.path));
        } else if (run.trouble().empty()) {
            // Who steps by hand ends it where it pleases.
            if (options.step) return kDone;
            say(fmt::format("interrupted after {:.1f} s of the recording", result.recorded_s));
        }
        return kFailed;
    } catch (const std::exception& error) {
        say(error.what());
        return kFailed;
    }
}

}  // namespace skyig::clients
