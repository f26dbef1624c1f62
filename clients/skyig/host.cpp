#include "clients/skyig/host.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "clients/skyig/answer_statistics.h"
#include "clients/skyig/flight.h"
#include "clients/skyig/host_messages.h"
#include "clients/skyig/host_result.h"
#include "protocol/cigi/session.h"
#include "protocol/transport/udp.h"
#include "server/clock.h"
#include "server/frame_pacer.h"
#include "server/kernel_stamps.h"
#include "server/stop_signal.h"

namespace skyig::clients {

namespace cigi = protocol::cigi;
namespace transport = protocol::transport;

namespace {

/// An image generator that says nothing for so long once it has answered is gone.
constexpr double kSilent_s = 5.0;

/// Wrong usage that only shows when the text is read: exit status 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <class Failure, class T>
T value_or_throw(protocol::Result<T, std::string> result, std::string_view option = {}) {
    if (!result) throw Failure(fmt::format("{}{}{}", option, option.empty() ? "" : ": ", result.error()));
    return std::move(result).value();
}

Flight open_flight(const std::string& path) {
    std::string error;
    std::optional<Flight> flight = load_flight(path, error);
    if (!flight) throw std::runtime_error(error);
    return std::move(*flight);
}

double start_of(const HostOptions& options, const Flight& flight) {
    const double first_s = flight.first_time_s(), last_s = flight.last_time_s();
    const double start_s = options.start_s.value_or(first_s);
    if (start_s >= first_s && start_s <= last_s) return start_s;
    throw UsageError(
        fmt::format("--start-s: {} is outside the flight, which goes from second {} to second {}", start_s,
                    first_s, last_s));
}

HostSettings host_settings(const HostOptions& options) {
    HostSettings settings;
    settings.version = options.cigi == "4.0" ? cigi::Version::k40 : cigi::Version::k33;
    settings.order = options.big_endian ? cigi::ByteOrder::kBig : cigi::ByteOrder::kLittle;
    const auto utc = server::ephemeris::parse_utc(options.utc);
    if (!utc)
        throw UsageError(
            fmt::format("--utc: '{}' is no UTC time; write it as 2026-06-21T19:30:00Z", options.utc));
    settings.utc = *utc;
    settings.visibility_m = options.visibility_m;
    settings.view_yaw_deg = options.view_yaw_deg;
    settings.view_id = options.view_id;
    return settings;
}

/// One flight from the first message to the last.
class HostRun {
  public:
    HostRun(const HostOptions& options, server::Clock& clock)
        : options_(options),
          clock_(clock),
          stamps_(clock),
          flight_(open_flight(options.flight_path)),
          start_s_(start_of(options, flight_)),
          duration_s_(options.duration_s.value_or(flight_.last_time_s() - start_s_)),
          to_(value_or_throw<UsageError>(transport::parse_endpoint(options.to), "--to")),
          receiver_(open_receiver()),
          sender_(value_or_throw<std::runtime_error>(receiver_.make_sender())),
          messages_(host_settings(options)),
          pacer_(options.rate_hz) {}

    HostResult fly(server::StopSignal& stop) {
        while (!complete() && !stop.requested())
            step();
        if (!flying_) throw std::runtime_error("stopped before the flight began");
        return result();
    }

  private:
    [[nodiscard]] bool complete() const noexcept { return flying_ && flown_s_ >= duration_s_; }

    transport::UdpReceiver open_receiver() const {
        transport::UdpOptions udp;
        udp.listen = value_or_throw<UsageError>(transport::parse_endpoint(options_.listen), "--listen");
        udp.allowed = {{to_.address, 0}};
        return value_or_throw<std::runtime_error>(transport::UdpReceiver::open(udp));
    }

    void step() {
        const server::FramePacer::Slot slot = pacer_.next(clock_.monotonic_ns());
        clock_.sleep_until_ns(slot.start_ns);
        late_ += slot.late ? 1 : 0;
        take_answers();
        const double step_s = static_cast<double>(slot.slots) * pacer_.period_s();
        check_alive();
        if (flying_) {
            flown_s_ += step_s;
        } else {
            waited_s_ += step_s;
            flying_ = messages_.operating();
            if (!flying_) check_patience();
        }
        const auto bytes = messages_.next(flight_.at(start_s_ + flown_s_), flown_s_, clock_.monotonic_ns());
        const std::int64_t sent_ns = clock_.steady_utc_ns();
        // What the system does not take shows as a missing answer.
        (void)sender_.send(to_, bytes);
        statistics_.sent(messages_.frame_number(), sent_ns);
    }

    void take_answers() {
        stamps_.look();
        receiver_.drain([this](const transport::Datagram& datagram) {
            const std::int64_t arrival_ns = stamps_.steady_ns(datagram.arrival_ns);
            const auto on_start_of_frame = [&](const cigi::StartOfFrame& start_of_frame,
                                               const cigi::PacketInfo& info) {
                statistics_.received(start_of_frame, info.version, arrival_ns);
                messages_.answered(start_of_frame);
                heard_at_ns_ = clock_.monotonic_ns();
            };
            cigi::decode_ig_message(datagram.bytes, on_start_of_frame, counters_);
        });
    }

    void check_patience() const {
        if (waited_s_ < options_.wait_s) return;
        if (statistics_.count() == 0) {
            throw std::runtime_error(
                fmt::format("no answer from {} in {:g} s: is skyigd running there, and does it answer to {}?",
                            options_.to, options_.wait_s, transport::to_string(receiver_.local())));
        }
        throw std::runtime_error(
            fmt::format("{} answers, but is in mode {} after {:g} s: does another host own it?", options_.to,
                        cigi::mode_name(statistics_.last().ig_mode), options_.wait_s));
    }

    void check_alive() const {
        if (statistics_.count() == 0) return;
        const double silent_s = static_cast<double>(clock_.monotonic_ns() - heard_at_ns_) * 1e-9;
        if (silent_s < kSilent_s) return;
        throw std::runtime_error(
            fmt::format("{} stopped answering {:.1f} s ago, {:.1f} s of the flight are flown", options_.to,
                        silent_s, flown_s_));
    }

    HostResult result() const {
        HostResult result;
        result.flight = options_.flight_path;
        result.to = options_.to;
        result.flown_s = flown_s_;
        result.asked_s = duration_s_;
        result.complete = complete();
        result.rate_hz = options_.rate_hz;
        result.messages = messages_.frame_number();
        result.late_messages = late_;
        result.version = statistics_.version() == cigi::Version::k40 ? "4.0" : "3.3";
        result.mode = cigi::mode_name(statistics_.last().ig_mode);
        result.database_number = statistics_.last().database_number;
        result.answers = statistics_.count();
        result.answers_lost = statistics_.lost();
        result.restarts = statistics_.restarts();
        result.answer_rate_hz = statistics_.rate_hz();
        result.round_trip_frames_p50 = statistics_.frames_behind().quantile(0.5);
        result.round_trip_frames_p99 = statistics_.frames_behind().quantile(0.99);
        result.round_trip_p50_ms = statistics_.round_trip().quantile_ms(0.5);
        result.round_trip_p99_ms = statistics_.round_trip().quantile_ms(0.99);
        return result;
    }

    const HostOptions& options_;
    server::Clock& clock_;
    server::KernelStamps stamps_;
    Flight flight_;
    double start_s_;
    double duration_s_;
    transport::Endpoint to_;
    transport::UdpReceiver receiver_;
    transport::UdpSender sender_;
    HostMessages messages_;
    AnswerStatistics statistics_;
    cigi::Counters counters_;
    server::FramePacer pacer_;
    std::int64_t heard_at_ns_ = 0;
    double waited_s_ = 0.0;
    double flown_s_ = 0.0;
    bool flying_ = false;
    std::uint64_t late_ = 0;
};

}  // namespace

int run_host(const HostOptions& options) {
    server::SystemClock clock;
    return run_host(options, clock);
}

int run_host(const HostOptions& options, server::Clock& clock) {
    constexpr int kFailed = 1;
    constexpr int kWrongUsage = 2;
    try {
        server::StopSignal stop;
        const HostResult result = HostRun(options, clock).fly(stop);
        fmt::print("{}", options.json ? to_json(result) : to_text(result));
        if (result.complete) return 0;
        fmt::print(stderr, "skyig host: interrupted after {:.1f} s of {:.1f} s\n", result.flown_s,
                   result.asked_s);
        return kFailed;
    } catch (const UsageError& error) {
        fmt::print(stderr, "skyig host: {}\n", error.what());
        return kWrongUsage;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig host: {}\n", error.what());
        return kFailed;
    }
}

}  // namespace skyig::clients
