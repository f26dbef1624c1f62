// A rig's frames as the frame loop has them: what is drawn of them where, and how a stand-in goes on.
#include "server/rig/frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "server/rig/seal.h"
#include "tests/server/rig/fake_link.h"

namespace skyig::server::tests {
namespace {

constexpr double kPeriod_s = 1.0 / 30.0;

/// Remembers what it was given.
class NotingPainter final : public Painter {
  public:
    void thin(render::Thinned now) override { thinned = now; }
    void adapt_as(const render::eye::Adaptation& now) override {
        luminances.push_back(now.luminance_cd_m2());
    }
    void prepare(const render::Scene& scene) override { prepared.push_back(scene.frame_number); }
    void draw(std::size_t channel) override { drawn.push_back(channel); }
    bool present() override { return ++presented > 0; }
    void read_back(std::size_t /*channel*/, std::span<std::byte> /*rgba*/) override {}
    std::uint64_t gl_errors() const override { return 0; }
    double adaptation_cd_m2() const override { return 1.0; }
    std::size_t passes(std::span<status::PassState> /*rows*/) const override { return 0; }
    std::string description() const override { return "noting"; }

    render::Thinned thinned;
    std::vector<double> luminances;
    std::vector<std::uint64_t> prepared;
    std::vector<std::size_t> drawn;
    int presented = 0;
};

/// A stand-in, and a leader that is spoken for by hand.
class RigFrames : public ::testing::Test {
  protected:
    RigFrames() {
        leader_link.meanwhile = [] {};
    }

    void tell(std::uint64_t frame, double time_s) {
        rig::FrameState state;
        state.scene.frame_number = frame;
        state.scene.time_s = time_s;
        state.thinned.set(2);
        state.eyes.update(static_cast<double>(frame) + 10.0, time_s, false, {});
        state.world_utc_ns = 1'750'000'000'000'000'000 + std::llround(time_s * 1e9);
        leader.tell(state);
    }
    /// One frame of the loop, as far as a rig has to do with it.
    std::optional<FramePacer::Slot> run_frame() {
        const auto slot = pace.next();
        if (!slot) return slot;
        painter.thin(render::Thinned(slot->thinned));
        world.advance(static_cast<double>(slot->slots) * kPeriod_s);
        scene = {};
        scene.frame_number = slot->told_number;
        painter.settle(scene);
        painter.prepare(scene);
        for (std::size_t i = 0; i < 3; ++i)
            painter.draw(i);
        painter.present();
        return slot;
    }

    FakeNetwork network;
    FakeLink& leader_link = network.join();
    FakeLink& link = network.join();
    Log log{network.clock, [](Severity, std::string_view) {}};
    rig::Key key{5, 6};
    rig::FrameCoder coder;
    rig::Leader leader{{.self = {"lead", 1, "build", 7}, .rank = 2, .nodes = {"left"}},
                       key,
                       coder,
                       leader_link,
                       network.clock,
                       log};
    rig::Machine machine{
        {.self = {"left", 1, "build", 7}, .leaders = {"lead", "left"}, .nodes = {"lead", "left"}},
        key,
        coder,
        link,
        network.clock,
        log};
    config::Config config = config::default_config();
    world::World world{config, *ephemeris::parse_utc("2026-06-21T12:00:00Z"), log};
    NotingPainter inner;
    int idles = 0;
    rig::Machine::Idle idle = [this] { return ++idles < 10'000; };
    ClockPace own_pace{network.clock, 1.0 / kPeriod_s};
    rig::RigPace pace{machine, own_pace, idle};
    rig::RigPainter painter{machine, inner, pace, world, {false, true, false}, idle};
    render::Scene scene;
};

TEST_F(RigFrames, AMachineDrawsItsOwnChannelsOfWhatTheLeaderSays) {
    tell(41, 2.0);
    link.meanwhile = [this] { leader.tell_show(41); };
    const auto slot = run_frame();
    ASSERT_TRUE(slot);
    EXPECT_EQ(slot->told_number, 41U);
    EXPECT_EQ(scene.frame_number, 41U);
    EXPECT_EQ(inner.drawn, std::vector<std::size_t>{1});
    EXPECT_EQ(inner.presented, 1);
    EXPECT_TRUE(painter.showed());
    EXPECT_TRUE(inner.thinned.test(2));
    EXPECT_EQ(inner.luminances, std::vector<double>{51.0});
    EXPECT_DOUBLE_EQ(world.time_s(), 2.0);
    EXPECT_EQ(world.session().ig_frame_number(), 41U);
}

TEST_F(RigFrames, WhatItHasMissedIsPreparedButNotDrawn) {
    for (std::uint64_t i = 41; i <= 44; ++i)
        tell(i, static_cast<double>(i) * kPeriod_s);
    leader.tell_show(44);
    ASSERT_TRUE(run_frame());
    EXPECT_EQ(inner.prepared, (std::vector<std::uint64_t>{41, 42, 43, 44}));
    EXPECT_EQ(inner.luminances.back(), 54.0);
    EXPECT_EQ(inner.drawn.size(), 1U);
    EXPECT_EQ(scene.frame_number, 44U);
}

TEST_F(RigFrames, AFrameThatTheLeaderHasLeftBehindIsNotShown) {
    tell(41, 1.0);
    link.meanwhile = [this] {
        leader.tell_show(42);
        tell(43, 1.1);
    };
    ASSERT_TRUE(run_frame());
    EXPECT_FALSE(painter.showed());
    EXPECT_EQ(inner.presented, 0);
    EXPECT_EQ(machine.follower().counts().repeats, 1U);
}

TEST_F(RigFrames, AStandInCarriesTheTimeOnWithoutAJump) {
    double last_s = 0.0;
    std::int64_t last_ns = 0;
    for (std::uint64_t i = 1; i <= 30; ++i) {
        last_s = 500.0 + static_cast<double>(i) * kPeriod_s;
        tell(i, last_s);
        leader.tell_show(i);
        ASSERT_TRUE(run_frame());
        last_ns = network.clock.monotonic_ns();
        network.clock.advance_s(kPeriod_s);
    }
    // Nobody speaks any more.
    const auto slot = run_frame();
    ASSERT_TRUE(slot);
    ASSERT_TRUE(machine.leads());
    EXPECT_EQ(slot->told_number, 0U);
    const double elapsed_s = static_cast<double>(network.clock.monotonic_ns() - last_ns) * 1e-9;
    EXPECT_GT(elapsed_s, 0.5);
    EXPECT_NEAR(world.time_s() - last_s, elapsed_s, kPeriod_s);
    EXPECT_EQ(world.session().ig_frame_number(), 30U);
    // From there on as any other.
    const double before_s = world.time_s();
    const auto next = run_frame();
    ASSERT_TRUE(next);
    EXPECT_EQ(next->slots, 1U);
    EXPECT_NEAR(world.time_s() - before_s, kPeriod_s, 1e-9);
}

}  // namespace
}  // namespace skyig::server::tests
