// What a machine of a rig tells of itself and of the others.
#include "server/rig/rig_status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "tests/server/rig/fake_link.h"

namespace skyig::server::tests {
namespace {

using status::RigCount;
using status::RigNodeState;
using ::testing::HasSubstr;
constexpr std::int64_t kFrameNs = 33'000'000;

/// One machine of a rig of three, of which "lead" leads.
struct Part {
    Part(FakeNetwork& network, const std::string& name, std::uint64_t settings = 7)
        : link(network.join()),
          log(network.clock, [](Severity, std::string_view) {}),
          machine({.self = {name, 1, "skyigd 1", settings},
                   .leaders = {"lead"},
                   .nodes = {"lead", "left", "right"}},
                  key, coder, link, network.clock, log) {}

    void draw() {
        machine.follower().listen();
        if (machine.follower().waiting() == 0) return;
        const std::uint64_t frame = machine.follower().newest().scene.frame_number;
        machine.follower().clear();
        machine.follower().tell_drawn(frame, 5'000'000);
    }

    rig::Key key{1, 2};
    rig::FrameCoder coder;
    FakeLink& link;
    Log log;
    rig::Machine machine;
};

class RigStatus : public ::testing::Test {
  protected:
    RigStatus() {
        left.machine.follower().note_gl("4.5 llvmpipe", 2);
        EXPECT_TRUE(lead.machine.await_work([] { return true; }));
        lead.link.meanwhile = [this] { left.draw(); };
    }
    void frame(std::uint64_t number) {
        rig::FrameState told_state;
        told_state.scene.frame_number = number;
        lead.machine.leader().tell(told_state);
        lead.machine.leader().await(number);
        lead.machine.leader().tell_show(number);
        last = number;
    }
    [[nodiscard]] status::RigState& told(const Part& part) {
        rig::fill_status(part.machine, last, *state);
        return *state;
    }

    FakeNetwork network;
    Part lead{network, "lead"};
    Part left{network, "left"};
    std::uint64_t last = 0;
    std::unique_ptr<status::RigState> state = std::make_unique<status::RigState>();
};

TEST_F(RigStatus, OfALeaderNamesEveryNodeAndHowItKeepsUp) {
    frame(1);
    left.draw();
    frame(2);
    const status::RigState& now = told(lead);
    EXPECT_EQ(now.role, status::RigRole::kLeads);
    EXPECT_EQ(now.self.get(), "lead");
    EXPECT_EQ(now.leader.get(), "lead");
    EXPECT_EQ(now.frame, 2U);
    EXPECT_EQ(now.wait.count, 2U);
    ASSERT_EQ(now.node_count, 2U);
    EXPECT_EQ(now.nodes[0].name.get(), "left");
    EXPECT_EQ(now.nodes[0].state, RigNodeState::kReady);
    EXPECT_EQ(now.nodes[0].frame, 2U);
    EXPECT_EQ(now.nodes[0].lag, 0U);
    EXPECT_DOUBLE_EQ(now.nodes[0].frame_ms, 5.0);
    EXPECT_EQ(now.nodes[0].gl.get(), "4.5 llvmpipe");
    EXPECT_EQ(now.nodes[0].gl_errors, 2U);
    EXPECT_EQ(now.nodes[0].build.get(), "skyigd 1");
    EXPECT_EQ(now.nodes[1].name.get(), "right");
    EXPECT_EQ(now.nodes[1].state, RigNodeState::kUnheard);
}

TEST_F(RigStatus, OfALeaderTellsALateNodeAndThenALostOne) {
    frame(1);
    left.draw();
    lead.link.meanwhile = nullptr;
    frame(2);
    EXPECT_EQ(told(lead).nodes[0].state, RigNodeState::kLate);
    EXPECT_EQ(state->nodes[0].lag, 1U);
    EXPECT_EQ(state->nodes[0].left_out, 1U);
    EXPECT_EQ((*state)[RigCount::kIncomplete], 1U);
    for (std::uint64_t number = 3; number < 40; ++number) {
        network.clock.advance_ns(kFrameNs);
        frame(number);
    }
    EXPECT_EQ(told(lead).nodes[0].state, RigNodeState::kLost);
    EXPECT_EQ(state->nodes[0].losses, 1U);
    EXPECT_GT(state->nodes[0].silent_s, 1.0);
}

TEST_F(RigStatus, OfALeaderSaysWhyANodeIsRefused) {
    const auto unlike = std::make_unique<Part>(network, "right", 8);
    unlike->machine.follower().tell_alive();
    frame(1);
    EXPECT_EQ(told(lead).nodes[1].state, RigNodeState::kRefused);
    EXPECT_EQ(state->nodes[1].why.get(), "its settings are 0000000000000008, the leader's 0000000000000007");
}

TEST_F(RigStatus, OfANodeNamesItsLeaderUntilThatIsSilent) {
    EXPECT_EQ(told(left).role, status::RigRole::kLooks);
    EXPECT_EQ(state->leader.get(), "");
    frame(1);
    left.draw();
    EXPECT_EQ(told(left).role, status::RigRole::kFollows);
    EXPECT_EQ(state->leader.get(), "lead");
    EXPECT_EQ(state->node_count, 0U);
    EXPECT_EQ((*state)[RigCount::kLeaders], 1U);
    network.clock.advance_ns(600'000'000);
    EXPECT_EQ(told(left).role, status::RigRole::kLooks);
}

TEST_F(RigStatus, CountsMessagesThatDoNotBearTheKey) {
    Part stranger{network, "right"};
    stranger.key = {3, 4};
    stranger.machine.follower().tell_alive();
    frame(1);
    EXPECT_EQ(told(lead)[RigCount::kUnsealed], 1U);
    EXPECT_EQ(state->nodes[1].state, RigNodeState::kUnheard);
}

}  // namespace
}  // namespace skyig::server::tests
