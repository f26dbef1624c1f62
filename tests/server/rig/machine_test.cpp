// Leader and followers by hand: what is shown when, who is waited for, who leads.
#include "server/rig/machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "server/rig/seal.h"
#include "tests/server/rig/fake_link.h"

namespace skyig::server::tests {
namespace {

using ::testing::HasSubstr;
constexpr std::int64_t kMs = 1'000'000;
constexpr rig::Key kKey{1, 2};

/// A machine with all that it needs.
struct Node {
    Node(FakeNetwork& network, const std::string& name, std::vector<std::string> leaders,
         const std::string& build = "build", std::uint64_t settings = 7, rig::Key own_key = kKey,
         std::uint64_t session = 1)
        : key(own_key),
          link(network.join()),
          log(network.clock, [this](Severity, std::string_view line) { lines += std::string(line) + "\n"; }),
          machine({.self = {name, session, build, settings},
                   .leaders = std::move(leaders),
                   .nodes = {"lead", "left", "right"},
                   .wait_ns = 10 * kMs},
                  key, coder, link, network.clock, log) {}

    /// One frame as a node has it: prepares all, draws the newest. \return whether it drew
    bool draw() {
        machine.follower().listen();
        if (machine.follower().waiting() == 0) return false;
        frame = machine.follower().newest().scene.frame_number;
        time_s = machine.follower().newest().scene.time_s;
        machine.follower().clear();
        machine.follower().tell_drawn(frame, kMs);
        return true;
    }
    rig::Follower::Word await_word(std::uint64_t number) {
        return machine.await_word(number, [this] { return give_up(); });
    }
    bool give_up() { return ++idles < 20'000; }

    rig::Key key;
    rig::FrameCoder coder;
    FakeLink& link;
    std::string lines;
    Log log;
    rig::Machine machine;
    std::uint64_t frame = 0;
    double time_s = 0.0;
    int idles = 0;
};

rig::FrameState state_of(std::uint64_t frame) {
    rig::FrameState state;
    state.scene.frame_number = frame;
    state.scene.time_s = static_cast<double>(frame) / 30.0;
    return state;
}

class RigMachines : public ::testing::Test {
  protected:
    RigMachines() {
        EXPECT_TRUE(lead.machine.await_work([this] { return lead.give_up(); }));
        lead.link.meanwhile = [this] {
            left.draw();
            right.draw();
        };
    }
    /// \return whether both nodes show that frame
    std::int64_t frame(std::uint64_t number) {
        lead.machine.leader().tell(state_of(number));
        const std::int64_t waited_ns = lead.machine.leader().await(number);
        lead.machine.leader().tell_show(number);
        return waited_ns;
    }

    FakeNetwork network;
    Node lead{network, "lead", {"lead", "left"}};
    Node left{network, "left", {"lead", "left"}};
    Node right{network, "right", {"lead", "left"}};
};

using Word = rig::Follower::Word;

TEST_F(RigMachines, TheLeaderLeadsOnceItHasListened) {
    EXPECT_TRUE(lead.machine.leads());
    EXPECT_GE(network.clock.monotonic_ns(), 2000 * kMs);
    EXPECT_THAT(lead.lines, HasSubstr("lead leads"));
}

TEST_F(RigMachines, AFrameIsShownWhenAllHaveDrawnIt) {
    // Who has drawn nothing yet is not waited for.
    frame(1);
    left.draw();
    right.draw();
    lead.machine.leader().tell(state_of(2));
    ASSERT_TRUE(left.draw());
    ASSERT_TRUE(right.draw());
    left.link.meanwhile = [this] {
        EXPECT_LT(lead.machine.leader().await(2), 2 * kMs);
        lead.machine.leader().tell_show(2);
    };
    EXPECT_EQ(left.await_word(2), Word::kShow);
    EXPECT_NE(right.await_word(2), Word::kRepeat);
    EXPECT_EQ(lead.machine.leader().counts().incomplete, 0U);
    EXPECT_EQ(lead.machine.leader().members()[0].drawn_frame, 2U);
}

TEST_F(RigMachines, ALateNodeIsWaitedForSoLongThenCountedAndNamed) {
    frame(1);
    left.draw();
    right.draw();
    lead.link.meanwhile = [this] { left.draw(); };
    EXPECT_GE(frame(2), 10 * kMs);
    EXPECT_EQ(lead.machine.leader().counts().incomplete, 1U);
    EXPECT_EQ(lead.machine.leader().members()[1].left_out, 1U);
    EXPECT_THAT(lead.lines, HasSubstr("frame 2 is shown without node right"));
    // It draws it at last, in that frame's own time.
    ASSERT_TRUE(right.draw());
    EXPECT_EQ(right.await_word(2), Word::kLate);
    // The next it draws when the leader has gone on.
    lead.machine.leader().tell(state_of(3));
    ASSERT_TRUE(right.draw());
    lead.machine.leader().tell_show(3);
    lead.machine.leader().tell(state_of(4));
    EXPECT_EQ(right.await_word(3), Word::kLate);
    lead.machine.leader().tell_show(4);
    lead.machine.leader().tell(state_of(5));
    EXPECT_EQ(right.await_word(3), Word::kRepeat);
    EXPECT_EQ(right.machine.follower().counts().repeats, 1U);
    EXPECT_EQ(right.machine.follower().counts().late, 2U);
}

TEST_F(RigMachines, FramesThatWaitAreAllPreparedInTheirOrder) {
    for (std::uint64_t i = 1; i <= 3; ++i)
        lead.machine.leader().tell(state_of(i));
    rig::Follower& follower = left.machine.follower();
    follower.listen();
    ASSERT_EQ(follower.waiting(), 3U);
    EXPECT_EQ(follower.frame(0).scene.frame_number, 1U);
    EXPECT_EQ(follower.newest().scene.frame_number, 3U);
    EXPECT_EQ(follower.counts().missed, 0U);
}

TEST_F(RigMachines, AFrameThatComesTwiceOrTooLateIsNotDrawn) {
    lead.machine.leader().tell(state_of(5));
    ASSERT_TRUE(left.draw());
    lead.machine.leader().tell(state_of(4));
    lead.machine.leader().tell(state_of(5));
    EXPECT_FALSE(left.draw());
    EXPECT_EQ(left.machine.follower().counts().stale, 2U);
    lead.machine.leader().tell(state_of(8));
    ASSERT_TRUE(left.draw());
    EXPECT_EQ(left.machine.follower().counts().missed, 2U);
}

TEST_F(RigMachines, ANodeThatFallsSilentIsLostAndThatItIsBackIsSaid) {
    frame(1);
    left.draw();
    right.draw();
    frame(2);
    right.link.cut = true;
    network.clock.advance_ns(1100 * kMs);
    left.machine.follower().tell_alive();
    EXPECT_LT(frame(3), 2 * kMs);
    EXPECT_THAT(lead.lines, HasSubstr("node right is lost"));
    EXPECT_EQ(lead.machine.leader().members()[1].losses, 1U);
    right.link.cut = false;
    frame(4);
    right.draw();
    frame(5);
    EXPECT_THAT(lead.lines, HasSubstr("node right is back"));
    EXPECT_EQ(right.frame, 5U);
}

TEST_F(RigMachines, AnotherBuildOrOtherSettingsAreRefusedByBothWithBothNamed) {
    Node odd(network, "right", {"lead", "left"}, "other build", 7, kKey, 2);
    Node unlike(network, "left", {"lead", "left"}, "build", 8, kKey, 2);
    frame(1);
    EXPECT_FALSE(odd.draw());
    EXPECT_FALSE(unlike.draw());
    EXPECT_EQ(odd.machine.follower().counts().refused, 1U);
    EXPECT_THAT(odd.lines,
                HasSubstr("lead leads with build and settings 0000000000000007; this is other build"));
    odd.machine.follower().tell_alive();
    unlike.machine.follower().tell_alive();
    lead.machine.leader().listen();
    EXPECT_THAT(lead.lines, HasSubstr("node right is other build"));
    EXPECT_EQ(lead.machine.leader().members()[0].state, rig::NodeState::kRefuses);
}

TEST_F(RigMachines, WhoLacksTheKeyNeitherLeadsNorPassesForANode) {
    Node stranger(network, "lead", {"lead", "left"}, "build", 7, rig::Key{3, 4}, 9);
    stranger.machine.leader().tell(state_of(100));
    stranger.machine.leader().tell_show(100);
    EXPECT_FALSE(left.draw());
    EXPECT_EQ(left.machine.follower().counts().unsealed, 2U);
    stranger.machine.follower().tell_alive();
    lead.machine.leader().listen();
    EXPECT_EQ(lead.machine.leader().counts().unsealed, 1U);
    EXPECT_FALSE(lead.machine.leader().members()[0].here);
    // With the key, but no leader by the settings.
    Node other(network, "right", {"right"}, "build", 7, kKey, 9);
    other.machine.leader().tell(state_of(100));
    EXPECT_FALSE(left.draw());
    EXPECT_EQ(left.machine.follower().counts().strangers, 1U);
}

TEST_F(RigMachines, AStandInGoesOnFromTheLastFrameWhenTheLeaderIsSilent) {
    frame(1);
    left.draw();
    right.draw();
    frame(2);
    // Nothing more comes of the leader.
    ASSERT_TRUE(left.machine.await_work([this] { return left.give_up(); }));
    EXPECT_TRUE(left.machine.leads());
    EXPECT_GT(left.machine.follower().counts().leaders, 0U);
    EXPECT_THAT(left.lines, HasSubstr("lead is silent since frame 2: left leads from here on"));
    left.machine.leader().tell(state_of(3));
    ASSERT_TRUE(right.draw());
    EXPECT_EQ(right.frame, 3U);
    EXPECT_EQ(right.machine.follower().leader(), "left");
    // The leader starts anew and finds it led.
    Node again(network, "lead", {"lead", "left"}, "build", 7, kKey, 2);
    left.machine.leader().tell(state_of(4));
    ASSERT_TRUE(again.machine.await_work([&again] { return again.give_up(); }));
    EXPECT_FALSE(again.machine.leads());
    EXPECT_EQ(again.machine.follower().leader(), "left");
}

TEST_F(RigMachines, WhatALeaderOnceSaidCountsOnceWhoeverSendsItAgain) {
    FakeLink& ear = network.join();
    frame(1);
    left.draw();
    right.draw();
    frame(2);
    const std::deque<rig::FrameMessage> recorded = ear.frames;
    ASSERT_EQ(recorded.size(), 2U);
    // The leader is gone, its stand-in leads; a stranger who has no key sends what it has recorded.
    lead.link.cut = true;
    ASSERT_TRUE(left.machine.await_work([this] { return left.give_up(); }));
    ASSERT_TRUE(left.machine.leads());
    left.machine.leader().tell(state_of(3));
    ASSERT_TRUE(right.draw());
    ASSERT_EQ(right.machine.follower().leader(), "left");
    for (const rig::FrameMessage& message : recorded)
        ear.send(message);
    EXPECT_FALSE(right.draw());
    EXPECT_EQ(right.machine.follower().leader(), "left");
    EXPECT_EQ(right.machine.follower().counts().stale, 2U);
    ASSERT_TRUE(left.machine.await_work([this] { return left.give_up(); }));
    EXPECT_TRUE(left.machine.leads());
}

TEST_F(RigMachines, ALeadersEarlierRunIsNotFollowedAndNamed) {
    frame(1);
    right.draw();
    Node past(network, "lead", {"lead", "left"}, "build", 7, kKey, 0);
    past.machine.leader().tell(state_of(5));
    EXPECT_FALSE(right.draw());
    EXPECT_EQ(right.machine.follower().counts().stale, 1U);
    EXPECT_THAT(right.lines, HasSubstr("has its clock gone back?"));
}

TEST_F(RigMachines, ANodeWhoseClockWentBackIsHeardOnceItsFormerRunIsSilent) {
    frame(1);
    left.draw();
    right.draw();
    frame(2);
    const auto here = [this] { return lead.machine.leader().members()[1].here; };
    ASSERT_TRUE(here());
    right.link.cut = true;
    lead.link.meanwhile = [this] { left.draw(); };
    Node again(network, "right", {"lead", "left"}, "build", 7, kKey, 0);
    again.machine.follower().tell_alive();
    lead.machine.leader().listen();
    EXPECT_EQ(lead.machine.leader().counts().strangers, 1U);
    network.clock.advance_ns(2000 * kMs);
    frame(3);
    ASSERT_FALSE(here());
    again.machine.follower().tell_alive();
    lead.machine.leader().listen();
    EXPECT_TRUE(here());
}

TEST(RigReplay, WaitsForANodeThatDrawsForSeconds) {
    FakeNetwork network;
    Node right{network, "right", {"lead"}};
    FakeLink& link = network.join();
    const rig::FrameCoder coder;
    Log log(network.clock, [](Severity, std::string_view) {});
    rig::Machine lead(
        {.self = {"lead", 1, "build", 7}, .leaders = {"lead"}, .nodes = {"lead", "right"}, .replays = true},
        kKey, coder, link, network.clock, log);
    link.meanwhile = [&right] { right.machine.follower().tell_alive(); };
    ASSERT_TRUE(lead.await_work([] { return true; }));
    lead.leader().tell(state_of(1));
    const std::int64_t start_ns = network.clock.monotonic_ns();
    link.meanwhile = [&] {
        if (network.clock.monotonic_ns() - start_ns > 5000 * kMs) right.draw();
    };
    EXPECT_GE(lead.leader().await(1), 5000 * kMs);
    EXPECT_EQ(lead.leader().counts().incomplete, 0U);
}

TEST_F(RigMachines, OfTwoThatLeadTheFirstOfTheSettingsGoesOn) {
    frame(1);
    left.draw();
    left.link.cut = true;
    ASSERT_TRUE(left.machine.await_work([this] { return left.give_up(); }));
    ASSERT_TRUE(left.machine.leads());
    left.link.cut = false;
    // Each hears the other.
    lead.machine.leader().tell(state_of(20));
    left.machine.leader().tell(state_of(21));
    ASSERT_TRUE(lead.machine.await_work([this] { return lead.give_up(); }));
    EXPECT_TRUE(lead.machine.leads());
    ASSERT_TRUE(left.machine.await_work([this] { return left.give_up(); }));
    EXPECT_FALSE(left.machine.leads());
    EXPECT_EQ(left.machine.follower().leader(), "lead");
    right.draw();
    EXPECT_EQ(right.machine.follower().leader(), "lead");
}

}  // namespace
}  // namespace skyig::server::tests
