// What recording takes of a processor at the pace of a busy cockpit: processor time of both threads, not of
// the clock, so that other work on the machine does not count.
#include <gtest/gtest.h>

#include <cstdio>
#include <ctime>
#include <deque>
#include <vector>

#include "server/clock.h"
#include "server/recorder.h"
#include "tests/server/loop/recording_fixture.h"
#include "tests/support/cockpit_traffic.h"

namespace skyig::server {
namespace {

using namespace tests;
using skyig::tests::CockpitTraffic;

constexpr std::size_t kHostSource = 0;
constexpr std::size_t kBusSource = 2;

double cpu_s(clockid_t clock) {
    std::timespec time{};
    ::clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The arrivals of one frame, as often as they are asked for.
class FrameOfTraffic final : public Wire {
  public:
    void fetch(std::int64_t until_utc_ns) {
        arrivals_.clear();
        messages_.clear();
        for (; next_->utc_ns < until_utc_ns; next_ = &traffic_.next()) {
            if (!next_->is_can) messages_.emplace_back(next_->message.begin(), next_->message.end());
            arrivals_.push_back(*next_);
            if (!next_->is_can) arrivals_.back().message = messages_.back();
        }
        fetched += arrivals_.size();
    }

    void open_frame(const FrameMark& /*mark*/, std::span<const std::byte> /*message*/) override {}
    void drain(ArrivalTaker& taker) override {
        for (const CockpitTraffic::Arrival& arrival : arrivals_) {
            if (arrival.is_can) {
                taker.take(kBusSource, arrival.frame);
            } else {
                taker.take(kHostSource, {kHost, arrival.utc_ns, arrival.message});
            }
        }
    }
    bool send(std::size_t, const protocol::transport::Endpoint&, std::span<const std::byte>) override {
        return true;
    }
    [[nodiscard]] protocol::transport::UdpCounters counters() const override { return {}; }

    std::uint64_t fetched = 0;

  private:
    CockpitTraffic traffic_{kStartNs};
    const CockpitTraffic::Arrival* next_ = &traffic_.next();
    std::vector<CockpitTraffic::Arrival> arrivals_;
    std::deque<std::vector<std::byte>> messages_;
};

struct Nobody final : ArrivalTaker {
    void take(std::size_t, const protocol::transport::Datagram&) override {}
    void take(std::size_t, const protocol::CanFrame&) override {}
};

TEST(RecordingCost, StaysUnderTwoPercentOfAProcessor) {
    constexpr std::int64_t kFrames = 120;
    constexpr std::int64_t kFrame_ns = CockpitTraffic::kHostStep_ns;
    const Scratch scratch;
    const config::Config config = rig();
    SystemClock clock;
    FrameOfTraffic inner;
    Nobody nobody;
    double plain_s = 0.0;
    double recorded_s = 0.0;
    const double process_before_s = cpu_s(CLOCK_PROCESS_CPUTIME_ID);
    const double caller_before_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
    Recorder recorder(scratch.file("a.pcapng"), config, facts(config));
    RecordingWire wire(inner, recorder);
    const std::vector<std::byte> start_of_frame(24);
    const std::int64_t start_ns = clock.monotonic_ns();
    for (std::int64_t i = 1; i <= kFrames; ++i) {
        inner.fetch(kStartNs + i * kFrame_ns);
        const double begin_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
        inner.drain(nobody);
        const double between_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
        wire.open_frame({static_cast<std::uint64_t>(i), 1, 0, kStartNs + i * kFrame_ns}, start_of_frame);
        wire.drain(nobody);
        const double end_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
        plain_s += between_s - begin_s;
        recorded_s += end_s - between_s;
        clock.sleep_until_ns(start_ns + i * kFrame_ns);
    }
    const double elapsed_s = static_cast<double>(clock.monotonic_ns() - start_ns) * 1e-9;
    recorder.finish();
    // There are two threads: what is not the caller's is the writer's.
    const double writer_s = cpu_s(CLOCK_PROCESS_CPUTIME_ID) - process_before_s -
                            (cpu_s(CLOCK_THREAD_CPUTIME_ID) - caller_before_s);
    const double tap_pct = 100.0 * (recorded_s - plain_s) / elapsed_s;
    const double writer_pct = 100.0 * writer_s / elapsed_s;
    std::printf("%.0f packets a second: the frame loop %.3f %%, the writer %.3f %% of a processor\n",
                static_cast<double>(inner.fetched + kFrames) / elapsed_s, tap_pct, writer_pct);
    RecordProperty("tap_pct", std::to_string(tap_pct));
    RecordProperty("writer_pct", std::to_string(writer_pct));
    EXPECT_EQ(recorder.counts().written, inner.fetched + kFrames);
    EXPECT_GT(writer_s, 0.0);
    EXPECT_LT(tap_pct + writer_pct, 2.0);
}

}  // namespace
}  // namespace skyig::server
