#include "clients/skyig/latency/latency.h"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "clients/skyig/latency/latency_host.h"
#include "protocol/transport/udp.h"
#include "server/clock.h"
#include "server/frame_pacer.h"
#include "server/stop_signal.h"

namespace skyig::clients {

namespace cigi = protocol::cigi;
namespace transport = protocol::transport;

namespace {

struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <class Failure, class T>
T value_or_throw(protocol::Result<T, std::string> result) {
    if (!result) throw Failure(result.error());
    return std::move(result).value();
}

/// Frames of the image generator, by the stamps in its Start of Frame.
class FrameTimes {
  public:
    void add(const cigi::StartOfFrame& start_of_frame) noexcept {
        if (count_ == 0) first_ = start_of_frame;
        last_ = start_of_frame;
        ++count_;
    }
    [[nodiscard]] double mean_ms() const noexcept {
        constexpr double kTick_ms = 0.01;
        const std::uint32_t frames = last_.ig_frame_number - first_.ig_frame_number;
        return frames == 0 ? 0.0 : kTick_ms * (last_.timestamp - first_.timestamp) / frames;
    }

  private:
    cigi::StartOfFrame first_;
    cigi::StartOfFrame last_;
    std::uint64_t count_ = 0;
};

class LatencyRun {
  public:
    LatencyRun(const LatencyOptions& options, server::Clock& clock)
        : options_(options),
          clock_(clock),
          to_(value_or_throw<UsageError>(transport::parse_endpoint(options.to))),
          receiver_(open_receiver()),
          sender_(value_or_throw<std::runtime_error>(receiver_.make_sender())),
          host_(static_cast<int>(options.settle_s * options.rate_hz), options.flips),
          pacer_(options.rate_hz) {}

    void run(server::StopSignal& stop) {
        const std::int64_t begin_ns = clock_.monotonic_ns();
        while (!host_.done()) {
            if (stop.requested()) throw std::runtime_error("stopped before all flips were done");
            clock_.sleep_until_ns(pacer_.next(clock_.monotonic_ns()).start_ns);
            receiver_.drain([this](const transport::Datagram& datagram) { take(datagram); });
            (void)sender_.send(to_, host_.next());
            const double waited_s = static_cast<double>(clock_.monotonic_ns() - begin_ns) * 1e-9;
            if (!host_.operating() && waited_s > options_.wait_s) {
                throw std::runtime_error(fmt::format(
                    "{} does not go to Operate in {:g} s: is skyigd running there, does it answer to "
                    "{}, does another host own it?",
                    options_.to, options_.wait_s, options_.listen));
            }
        }
    }

    [[nodiscard]] std::span<const LatencyFigures> figures() const noexcept { return host_.figures(); }
    [[nodiscard]] double frame_ms() const noexcept { return frames_.mean_ms(); }

  private:
    transport::UdpReceiver open_receiver() const {
        transport::UdpOptions udp;
        udp.listen = value_or_throw<UsageError>(transport::parse_endpoint(options_.listen));
        udp.allowed = {{to_.address, 0}};
        return value_or_throw<std::runtime_error>(transport::UdpReceiver::open(udp));
    }

    struct Heard {
        LatencyRun& run;
        void operator()(const cigi::StartOfFrame& start_of_frame) {
            run.host_.answered(start_of_frame);
            run.frames_.add(start_of_frame);
        }
        void operator()(const cigi::EventNotification& event) { run.host_.told(event); }
    };

    void take(const transport::Datagram& datagram) {
        cigi::decode_ig_message(datagram.bytes, Heard{*this}, counters_);
    }

    const LatencyOptions& options_;
    server::Clock& clock_;
    transport::Endpoint to_;
    transport::UdpReceiver receiver_;
    transport::UdpSender sender_;
    LatencyHost host_;
    FrameTimes frames_;
    cigi::Counters counters_;
    server::FramePacer pacer_;
};

void print_text(const LatencyRun& run) {
    const double frame_ms = run.frame_ms();
    fmt::print("a frame of the image generator: {:.2f} ms\n", frame_ms);
    fmt::print("{:<8}{:>7}{:>7} {:>30} {:>24} {:>16}\n", "", "", "", "until the last channel, ms",
               "in frame times", "the first, ms");
    fmt::print("{:<8}{:>7}{:>7} {:>10}{:>10}{:>10} {:>8}{:>8}{:>8} {:>8}{:>8}\n", "scene", "flips", "untold",
               "median", "p99", "largest", "median", "p99", "largest", "median", "p99");
    for (std::size_t i = 0; i < run.figures().size(); ++i) {
        const LatencyFigures& figures = run.figures()[i];
        const server::TimeHistogram& last = figures.last_channel;
        fmt::print("{:<8}{:>7}{:>7} {:>10.2f}{:>10.2f}{:>10.2f} {:>8.2f}{:>8.2f}{:>8.2f} {:>8.2f}{:>8.2f}\n",
                   latency_scenes()[i].name, figures.flips, figures.untold, last.quantile_ms(0.5),
                   last.quantile_ms(0.99), last.largest_ms(), last.quantile_ms(0.5) / frame_ms,
                   last.quantile_ms(0.99) / frame_ms, last.largest_ms() / frame_ms,
                   figures.first_channel.quantile_ms(0.5), figures.first_channel.quantile_ms(0.99));
    }
}

void print_json(const LatencyRun& run) {
    nlohmann::ordered_json json;
    json["frame_ms"] = run.frame_ms();
    json["scenes"] = nlohmann::ordered_json::array();
    const auto times = [](const server::TimeHistogram& all) -> nlohmann::ordered_json {
        return {{"median_ms", all.quantile_ms(0.5)},
                {"p99_ms", all.quantile_ms(0.99)},
                {"largest_ms", all.largest_ms()}};
    };
    for (std::size_t i = 0; i < run.figures().size(); ++i) {
        const LatencyFigures& figures = run.figures()[i];
        json["scenes"].push_back({{"scene", latency_scenes()[i].name},
                                  {"flips", figures.flips},
                                  {"untold", figures.untold},
                                  {"last_channel", times(figures.last_channel)},
                                  {"first_channel", times(figures.first_channel)},
                                  {"p99_frames", figures.last_channel.quantile_ms(0.99) / run.frame_ms()}});
    }
    fmt::print("{}\n", json.dump(2));
}

/// The line that says what is too much; empty where nothing is.
std::string fault(const LatencyOptions& options, const LatencyRun& run) {
    for (std::size_t i = 0; i < run.figures().size(); ++i) {
        const LatencyFigures& figures = run.figures()[i];
        const std::string_view name = latency_scenes()[i].name;
        if (figures.last_channel.count() == 0)
            return fmt::format("{}: the image generator told of no flip; is it skyigd?", name);
        const double frames = figures.last_channel.quantile_ms(0.99) / run.frame_ms();
        if (options.at_most_frames && frames > *options.at_most_frames)
            return fmt::format("{}: p99 is {:.2f} frame times, more than {:g}", name, frames,
                               *options.at_most_frames);
    }
    return {};
}

}  // namespace

int run_latency(const LatencyOptions& options) {
    constexpr int kFailed = 1;
    constexpr int kWrongUsage = 2;
    try {
        server::SystemClock clock;
        server::StopSignal stop;
        LatencyRun run(options, clock);
        run.run(stop);
        options.json ? print_json(run) : print_text(run);
        const std::string line = fault(options, run);
        if (line.empty()) return 0;
        fmt::print(stderr, "skyig latency: {}\n", line);
    } catch (const UsageError& error) {
        fmt::print(stderr, "skyig latency: {}\n", error.what());
        return kWrongUsage;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig latency: {}\n", error.what());
    }
    return kFailed;
}

}  // namespace skyig::clients
