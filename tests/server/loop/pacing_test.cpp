// The frame loop in step with its host, thinned when it is too slow, and its delays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "tests/server/loop/loop_fixture.h"

namespace skyig::server {
namespace {

using namespace tests;
using status::LateCause;
using ::testing::HasSubstr;

class LockStepLoop : public FrameLoopTest {
  protected:
    LockStepLoop() {
        config_.daemon.pacing = config::Pacing::kHost;
        config_.daemon.rate_hz = 100.0;
        link_.on_wait = [this](std::int64_t most_ns) {
            ++waits_;
            const std::int64_t comes_ns = sent_ns_ + answers_after_ns_;
            const std::int64_t now_ns = clock_.monotonic_ns();
            if (answers_after_ns_ < 0 || comes_ns - now_ns > most_ns) {
                clock_.advance_ns(most_ns);
                return false;
            }
            clock_.sleep_until_ns(comes_ns);
            answer();
            return true;
        };
        link_.on_send = [this] { sent_ns_ = clock_.monotonic_ns(); };
    }

    /// The host answers the Start of Frame that it has seen last, further on in latitude each time.
    void answer() {
        const std::uint32_t frame = world_->session().ig_frame_number() - behind_;
        link_.put(kHost, Message(cigi::Version::k33, cigi::IgMode::kOperate, ++host_frame_, frame)
                             .at(0.01 * frame)
                             .bytes());
    }

    std::int64_t sent_ns_ = 0;
    std::int64_t answers_after_ns_ = 3 * kMs;
    std::uint32_t behind_ = 0;
    std::uint32_t host_frame_ = 0;
    int waits_ = 0;
};

TEST_F(LockStepLoop, DrawsEachFrameFromTheAnswerToItsOwnStartOfFrame) {
    loop().run_frame();
    EXPECT_EQ(waits_, 0) << "there is no host yet";
    answer();
    for (int i = 0; i < 100; ++i) {
        loop_->run_frame();
        EXPECT_NEAR(painter_.last_scene.eye.latitude_deg, 0.01 * world_->session().ig_frame_number(), 1e-9);
    }
    const RunReport report = loop_->report();
    EXPECT_EQ(report.host_timeouts, 0U);
    EXPECT_EQ(report.late_frames, 0U);
    EXPECT_EQ(report.host_frames_behind_median, 0U);
}

TEST_F(LockStepLoop, GoesOnWithoutAHostThatIsSilentAndCountsIt) {
    config_.daemon.host_wait_ms = 12.0;
    loop().run_frame();
    answer();
    loop_->run_frame();
    answers_after_ns_ = -1;
    for (int i = 0; i < 10; ++i)
        loop_->run_frame();
    const RunReport report = loop_->report();
    EXPECT_EQ(report.host_timeouts, 10U);
    // 12 ms of waiting on a grid of 10 ms.
    EXPECT_GE(report.late_frames, 9U);
    for (const NamedCount& cause : report.late_by_cause)
        EXPECT_EQ(cause.count, cause.name == "host" ? report.late_frames : 0U) << cause.name;
    // Once its link is lost nobody waits for it.
    for (int i = 0; i < 200; ++i)
        loop_->run_frame();
    const int waits = waits_;
    loop_->run_frame();
    EXPECT_EQ(waits_, waits);
}

TEST_F(LockStepLoop, DrawsFromTheAnswerBeforeWhereTheSettingsAllowIt) {
    config_.daemon.host_frames_behind = 1;
    behind_ = 1;
    loop().run_frame();
    loop_->run_frame();
    answer();
    for (int i = 0; i < 50; ++i) {
        loop_->run_frame();
        EXPECT_GE(painter_.last_scene.eye.latitude_deg,
                  0.01 * (world_->session().ig_frame_number() - 1) - 1e-9);
    }
    EXPECT_EQ(loop_->report().host_timeouts, 0U);
}

class OverloadLoop : public FrameLoopTest {
  protected:
    OverloadLoop() {
        config_.overload.order = {config::Thinning::kCloudTones, config::Thinning::kGlare};
        painter_.would_help.set();
        painter_.saved_ns = 3 * kMs / 2;
    }
    void run(int frames) {
        for (int i = 0; i < frames; ++i)
            loop_->run_frame();
    }
};

TEST_F(OverloadLoop, TheRateHoldsByLeavingThingsOutAndTheyComeBack) {
    painter_.prepare_ns = 9 * kMs;
    loop();
    run(300);
    const std::uint64_t late_at_first = loop_->report().late_frames;
    EXPECT_EQ(loop_->report().thinned, (std::vector<std::string>{"cloud-tones", "glare"}));
    run(500);
    EXPECT_EQ(loop_->report().late_frames, late_at_first) << "a frame takes 8 of 10 ms";
    EXPECT_EQ(loop_->report().times_returned, 0U);
    painter_.prepare_ns = 4 * kMs;
    run(1000);
    const RunReport report = loop_->report();
    EXPECT_TRUE(report.thinned.empty());
    EXPECT_EQ(report.times_thinned, 2U);
    EXPECT_EQ(report.times_returned, 2U);
    EXPECT_EQ(link_.last_mark.thinned, 0U);
    EXPECT_THAT(lines_,
                ::testing::Contains(HasSubstr("leaves out cloud-tones: a frame takes 11.0 of 10.0 ms")));
    EXPECT_THAT(lines_, ::testing::Contains(HasSubstr("glare is back")));
    std::printf("late until the rate held: %llu frames\n", static_cast<unsigned long long>(late_at_first));
    EXPECT_LE(late_at_first, 120U);
}

TEST_F(OverloadLoop, MarksOfFramesTellWhatTheyLeaveOut) {
    painter_.prepare_ns = 8 * kMs;
    loop();
    run(300);
    EXPECT_EQ(link_.last_mark.thinned, 1U << static_cast<unsigned>(render::Thin::kCloudTones));
    EXPECT_EQ(painter_.thinned.to_ullong(), link_.last_mark.thinned);
}

TEST_F(OverloadLoop, WithoutAnOrderNothingIsLeftOut) {
    config_.overload.order.clear();
    painter_.prepare_ns = 20 * kMs;
    loop();
    run(500);
    EXPECT_TRUE(painter_.thinned.none());
}

class DelayLoop : public FrameLoopTest {
  protected:
    DelayLoop() { link_.is_live = true; }
};

TEST_F(DelayLoop, TellsTheTimeFromArrivalToThePictureOfEachChannel) {
    config_.channels.push_back(config_.channels.front());
    config_.channels.back().name = "right";
    loop();
    for (std::uint32_t i = 1; i <= 50; ++i) {
        // 2 ms before the frame begins.
        link_.arrival_ns = clock_.utc_ns() + (i > 1 ? 5 : 0) * kMs - 2 * kMs;
        link_.put(kHost, Message(cigi::Version::k33, cigi::IgMode::kOperate, i, i).at(45.0).bytes());
        loop_->run_frame();
    }
    const RunReport report = loop_->report();
    ASSERT_EQ(report.delays.size(), 5U);
    EXPECT_EQ(report.delays[0].count, 50U);
    EXPECT_NEAR(report.delays[0].median_ms, 2.0 + 1.0 + 2.0, 0.05);
    EXPECT_NEAR(report.delays[1].p99_ms, 2.0 + 1.0 + 4.0, 0.05);
    EXPECT_EQ(report.delays[2].name, "shown");
}

TEST_F(DelayLoop, DelaysDoNotNoticeThatTheClockIsSet) {
    loop();
    for (std::uint32_t i = 1; i <= 50; ++i) {
        if (i % 20 == 0) clock_.step_utc_ns((i == 20 ? 1 : -2) * 3'600'000 * kMs);
        link_.arrival_ns = clock_.steady_utc_ns() + (i > 1 ? 7 : 0) * kMs - 2 * kMs;
        link_.put(kHost, Message(cigi::Version::k33, cigi::IgMode::kOperate, i, i).at(45.0).bytes());
        loop_->run_frame();
    }
    const RunReport report = loop_->report();
    EXPECT_EQ(report.delays[0].count, 50U);
    EXPECT_NEAR(report.delays[0].median_ms, 2.0 + 1.0 + 2.0, 0.05);
    EXPECT_NEAR(report.delays[0].largest_ms, 2.0 + 1.0 + 2.0, 0.05);
    EXPECT_EQ(report.delays[2].name, "host interval");
    EXPECT_NEAR(report.delays[2].largest_ms, 10.0, 0.05);
    EXPECT_EQ(link_.last_mark.utc_ns, clock_.steady_utc_ns() - 3 * kMs);
}

TEST_F(DelayLoop, ARecordingHasNoDelays) {
    link_.is_live = false;
    loop();
    link_.put(kHost, Message(cigi::Version::k33, cigi::IgMode::kOperate, 1).at(45.0).bytes());
    loop_->run_frame();
    EXPECT_EQ(loop_->report().delays[0].count, 0U);
}

TEST_F(DelayLoop, APictureThatIsCrossedOutShowsNoMessage) {
    painter_.channel_health.failed = true;
    loop();
    link_.arrival_ns = clock_.utc_ns() - 2 * kMs;
    link_.put(kHost, Message(cigi::Version::k33, cigi::IgMode::kOperate, 1).at(45.0).bytes());
    loop_->run_frame();
    EXPECT_EQ(loop_->report().delays[0].count, 0U);
}

TEST_F(DelayLoop, AHostThatAsksIsToldWhenItsFrameWasFinished) {
    loop();
    std::array<std::byte, 256> buffer{};
    cigi::MessageWriter writer(buffer, cigi::Version::k33, cigi::ByteOrder::kBig);
    cigi::IgControl control;
    control.minor_version = 3;
    control.ig_mode = cigi::IgMode::kOperate;
    control.host_frame_number = 77;
    cigi::ComponentControl ask;
    ask.component_class = cigi::ComponentClass::kEvent;
    ask.instance_id = static_cast<std::uint16_t>(world::Event::kFrameFinished);
    ask.component_state = 1;
    ASSERT_TRUE(writer.add(control) && writer.add(ask));
    link_.arrival_ns = clock_.utc_ns() - kMs;
    link_.put(kHost, writer.bytes());
    loop_->run_frame();
    loop_->run_frame();
    struct {
        std::vector<cigi::EventNotification> events;
        void operator()(const cigi::EventNotification& event) { events.push_back(event); }
    } heard;
    cigi::Counters counters;
    cigi::decode_ig_message(link_.last(), heard, counters);
    ASSERT_EQ(heard.events.size(), 1U);
    EXPECT_EQ(heard.events[0].event_id, 4U);
    EXPECT_EQ(heard.events[0].data_1, 77U);
    EXPECT_EQ(heard.events[0].data_2, 4000U) << "microseconds";
}

/// A level turn at 3 degrees a second, told at 100 Hz with stamps.
TEST_F(DelayLoop, TheOwnshipIsDrawnWhereItWillBeWhenItIsSeen) {
    config_.daemon.rate_hz = 100.0;
    for (const double delay_ms : {0.0, 15.0, 40.0}) {
        config_.daemon.display_delay_ms = delay_ms;
        loop();
        for (std::uint32_t i = 1; i <= 100; ++i) {
            std::array<std::byte, 256> buffer{};
            cigi::MessageWriter writer(buffer, cigi::Version::k33, cigi::ByteOrder::kBig);
            cigi::IgControl control;
            control.minor_version = 3;
            control.ig_mode = cigi::IgMode::kOperate;
            control.host_frame_number = i;
            control.timestamp_valid = true;
            control.extrapolation_enable = true;
            control.timestamp = i * 1000;
            cigi::EntityControl ownship;
            ownship.entity_state = cigi::EntityState::kActive;
            ownship.extrapolation_enable = true;
            ownship.yaw = static_cast<float>(0.03 * i);
            ownship.alt_z = 500.0;
            ASSERT_TRUE(writer.add(control) && writer.add(ownship));
            link_.put(kHost, writer.bytes());
            loop_->run_frame();
        }
        EXPECT_NEAR(world_->ownship().yaw_deg, 3.0 + 3e-3 * delay_ms, 1e-3) << delay_ms;
    }
}

TEST_F(FrameLoopTest, FramesThatTheMachineHeldUpAreNotOurs) {
    painter_.processor = true;
    painter_.draw_ns = 14 * kMs;
    loop(100).run([] { return false; });
    for (const NamedCount& cause : loop_->report().late_by_cause)
        EXPECT_EQ(cause.count, cause.name == "machine" ? 99U : 0U) << cause.name;
}

}  // namespace
}  // namespace skyig::server
