// Who has the say: by right, priority, freshness and life.
#include "server/world/authority.h"

#include <gtest/gtest.h>

#include "tests/server/world/host_bench.h"

namespace skyig::server::world {
namespace {

using config::Aspect;
using config::Aspects;

constexpr std::size_t kHost = 0;
constexpr std::size_t kOther = 1;

SourceRule rule(std::string name, int priority, Aspects owns = Aspects{0b11111}) {
    SourceRule made;
    made.name = std::move(name);
    made.rights.owns = owns;
    made.rights.priority = priority;
    return made;
}

/// In steps of 10 ms, as frames would.
void wait(Authority& authority, double seconds, std::vector<LinkChange>* changes = nullptr) {
    for (int i = 0; i < static_cast<int>(seconds * 100.0 + 0.5); ++i) {
        authority.advance(0.01, [changes](const LinkChange& change) {
            if (changes != nullptr) changes->push_back(change);
        });
    }
}

bool speak(Authority& authority, std::size_t source, Aspect aspect) {
    authority.heard(source);
    return authority.claim(source, aspect);
}

TEST(Authority, FirstOfEqualsKeepsTheSayWhileItLives) {
    Authority authority({rule("a", 50), rule("b", 50)});
    EXPECT_TRUE(speak(authority, kHost, Aspect::kWeather));
    EXPECT_FALSE(speak(authority, kOther, Aspect::kWeather));
    wait(authority, 0.8);
    EXPECT_FALSE(speak(authority, kOther, Aspect::kWeather));
    wait(authority, 0.4);
    EXPECT_EQ(authority.state(kHost), LinkState::kLost);
    EXPECT_TRUE(speak(authority, kOther, Aspect::kWeather));
    // The one that comes back finds its place taken.
    EXPECT_FALSE(speak(authority, kHost, Aspect::kWeather));
    EXPECT_EQ(authority.holder(Aspect::kWeather), kOther);
}

TEST(Authority, LargerPriorityTakesOverAtOnceAndComesBack) {
    Authority authority({rule("host", 50), rule("instructor", 60)});
    EXPECT_TRUE(speak(authority, kHost, Aspect::kTime));
    EXPECT_TRUE(speak(authority, kOther, Aspect::kTime));
    EXPECT_FALSE(speak(authority, kHost, Aspect::kTime));
    wait(authority, 1.2);
    EXPECT_TRUE(speak(authority, kHost, Aspect::kTime));
    EXPECT_TRUE(speak(authority, kOther, Aspect::kTime));
}

TEST(Authority, TellsHowAHolderCameToItAndWhoWasOverruled) {
    Authority authority({rule("a", 50), rule("b", 60), rule("c", 50)});
    constexpr std::size_t kThird = 2;
    EXPECT_TRUE(speak(authority, kHost, Aspect::kOwnship));
    EXPECT_EQ(authority.hold_reason(Aspect::kOwnship), HoldReason::kFirst);
    EXPECT_TRUE(speak(authority, kOther, Aspect::kOwnship));
    EXPECT_EQ(authority.hold_reason(Aspect::kOwnship), HoldReason::kPriority);
    EXPECT_FALSE(speak(authority, kHost, Aspect::kOwnship));
    EXPECT_FALSE(speak(authority, kHost, Aspect::kOwnship));
    EXPECT_EQ(authority.overruled(kHost, Aspect::kOwnship), 2U);
    EXPECT_EQ(authority.overruled(kOther, Aspect::kOwnship), 0U);
    wait(authority, 0.6);
    EXPECT_TRUE(speak(authority, kHost, Aspect::kOwnship));
    EXPECT_EQ(authority.hold_reason(Aspect::kOwnship), HoldReason::kHolderStale);
    wait(authority, 1.2);
    EXPECT_TRUE(speak(authority, kThird, Aspect::kOwnship));
    EXPECT_EQ(authority.hold_reason(Aspect::kOwnship), HoldReason::kHolderLost);
    EXPECT_TRUE(speak(authority, kThird, Aspect::kOwnship));
    EXPECT_EQ(authority.hold_reason(Aspect::kOwnship), HoldReason::kHolderLost);
}

TEST(Authority, NobodySaysWhatItDoesNotOwn) {
    Aspects weather;
    weather.set(static_cast<std::size_t>(Aspect::kWeather));
    Authority authority({rule("host", 50), rule("instructor", 90, weather)});
    EXPECT_FALSE(speak(authority, kOther, Aspect::kControl));
    EXPECT_FALSE(speak(authority, kOther, Aspect::kOwnship));
    EXPECT_TRUE(speak(authority, kOther, Aspect::kWeather));
    EXPECT_EQ(authority.holder(Aspect::kControl), std::nullopt);
    EXPECT_TRUE(authority.owned(Aspect::kControl));
}

TEST(Authority, StaleOwnshipGivesWayThoughItsSourceLives) {
    Authority authority({rule("a", 60), rule("b", 50)});
    EXPECT_TRUE(speak(authority, kHost, Aspect::kOwnship));
    for (int i = 0; i < 60; ++i) {
        authority.heard(kHost);
        wait(authority, 0.01);
    }
    EXPECT_EQ(authority.state(kHost), LinkState::kLive);
    EXPECT_TRUE(speak(authority, kOther, Aspect::kOwnship));
    // A state does not age: the same silence about the weather changes nothing.
    EXPECT_TRUE(speak(authority, kHost, Aspect::kWeather));
    for (int i = 0; i < 60; ++i) {
        authority.heard(kHost);
        wait(authority, 0.01);
    }
    EXPECT_FALSE(speak(authority, kOther, Aspect::kWeather));
}

TEST(Authority, LinkGoesFromWaitingThroughLiveAndStaleToLostAndBack) {
    Authority authority({rule("a", 50)});
    EXPECT_EQ(authority.state(kHost), LinkState::kWaiting);
    wait(authority, 100.0);
    EXPECT_EQ(authority.state(kHost), LinkState::kWaiting);
    EXPECT_TRUE(authority.heard(kHost).has_value());
    EXPECT_FALSE(authority.heard(kHost).has_value());
    std::vector<LinkChange> changes;
    wait(authority, 2.0, &changes);
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_EQ(changes[0].to, LinkState::kStale);
    EXPECT_EQ(changes[1].to, LinkState::kLost);
    EXPECT_NEAR(authority.silent_s(kHost), 2.0, 0.02);
    EXPECT_EQ(authority.losses(kHost), 1U);
    EXPECT_EQ(authority.heard(kHost)->from, LinkState::kLost);
}

TEST(Authority, LongStepAfterAMessageIsNoSilence) {
    Authority authority({rule("a", 50)});
    authority.heard(kHost);
    authority.advance(5.0, [](const LinkChange&) { FAIL(); });
    EXPECT_EQ(authority.state(kHost), LinkState::kLive);
}

// The same in a world with datagrams: the weather of the instructor beside the position of the host.
class TwoSources : public ::testing::Test {
  protected:
    static config::Config settings() {
        config::Config config = three_channels();
        config::Source& instructor = config.sources.emplace_back();
        instructor.name = "instructor";
        instructor.rights.owns.reset();
        instructor.rights.owns.set(static_cast<std::size_t>(Aspect::kTime));
        instructor.rights.owns.set(static_cast<std::size_t>(Aspect::kWeather));
        instructor.rights.priority = 60;
        return config;
    }
    static protocol::cigi::EntityControl ownship(double latitude_deg) {
        protocol::cigi::EntityControl control;
        control.entity_state = protocol::cigi::EntityState::kActive;
        control.lat_x = latitude_deg;
        return control;
    }
    static protocol::cigi::AtmosphereControl visibility(float visibility_m) {
        protocol::cigi::AtmosphereControl air;
        air.visibility = visibility_m;
        return air;
    }

    HostBench bench_{settings()};
};

TEST_F(TwoSources, WeatherAndPositionComeFromDifferentSendersAtOnce) {
    for (int i = 0; i < 10; ++i) {
        bench_.send(kHostA, ownship(10.0 + i), visibility(9000.0F));
        bench_.source = 1;
        bench_.send(kHostB, ownship(70.0), visibility(800.0F));
        bench_.source = 0;
        bench_.wait(0.016);
    }
    EXPECT_EQ(bench_.world.ownship().position.latitude_deg, 19.0);
    EXPECT_EQ(bench_.world.air().visibility_m, 800.0);
    // The first message of the host came before the instructor had spoken.
    EXPECT_EQ(bench_.world.counters().not_in_charge, 9U + 10U);
    EXPECT_EQ(bench_.world.counters().second_host, 0U);
    EXPECT_EQ(bench_.world.control_link().host, kHostA);
}

TEST_F(TwoSources, IgControlOfAnotherSourceCountsForFramingOnly) {
    bench_.send(kHostA, ownship(10.0));
    const std::uint32_t frame = bench_.world.session().last_host_frame_number();
    bench_.source = 1;
    bench_.mode = protocol::cigi::IgMode::kStandby;
    bench_.send(kHostB, visibility(800.0F));
    EXPECT_EQ(bench_.world.mode(), protocol::cigi::IgMode::kOperate);
    EXPECT_EQ(bench_.world.session().last_host_frame_number(), frame);
    EXPECT_EQ(bench_.world.air().visibility_m, 800.0);
    EXPECT_EQ(bench_.world.link(1).state, LinkState::kLive);
}

TEST_F(TwoSources, HostInStandbyKeepsTheInstructorOutToo) {
    bench_.mode = protocol::cigi::IgMode::kStandby;
    bench_.send(kHostA);
    bench_.source = 1;
    bench_.send(kHostB, visibility(800.0F));
    EXPECT_EQ(bench_.world.air().visibility_m, 80000.0);
    EXPECT_EQ(bench_.world.counters().standby_ignored, 1U);
}

TEST_F(TwoSources, HostGetsTheWeatherBackWhenTheInstructorIsLost) {
    bench_.source = 1;
    bench_.send(kHostB, visibility(800.0F));
    bench_.source = 0;
    bench_.send(kHostA, visibility(9000.0F));
    // Nobody has set a mode of Operate before the host did: what the instructor said was too early.
    EXPECT_EQ(bench_.world.air().visibility_m, 9000.0);
    bench_.source = 1;
    bench_.send(kHostB, visibility(800.0F));
    EXPECT_EQ(bench_.world.air().visibility_m, 800.0);
    for (int i = 0; i < 20; ++i) {
        bench_.source = 0;
        bench_.send(kHostA, visibility(9000.0F));
        bench_.wait(0.1);
    }
    EXPECT_EQ(bench_.world.air().visibility_m, 9000.0);
    EXPECT_EQ(bench_.lines_with("instructor 127.0.0.1:40002 lost"), 1U);
}

TEST_F(TwoSources, NewsOfEachSourceIsToldWhateverTheOtherDoes) {
    bench_.send(kHostA, ownship(10.0));
    bench_.source = 1;
    bench_.send(kHostB, visibility(800.0F));
    EXPECT_EQ(bench_.lines_with("host 127.0.0.1:40001 speaks CIGI"), 1U);
    EXPECT_EQ(bench_.lines_with("instructor 127.0.0.1:40002 speaks CIGI"), 1U);
    bench_.wait(3.0);
    EXPECT_EQ(bench_.lines_with("host 127.0.0.1:40001 lost"), 1U);
    EXPECT_EQ(bench_.lines_with("instructor 127.0.0.1:40002 lost"), 1U);
}

TEST(WorldWithoutControl, LosesASourceWithoutAnAddressByItsName) {
    config::Config config = three_channels();
    config::Source& bus = config.sources.emplace_back();
    bus.name = "bus";
    bus.kind = config::SourceKind::kCanAerospace;
    HostBench bench(config);
    bench.world.heard(1);
    bench.wait(3.0);
    EXPECT_EQ(bench.lines_with("bus lost: silent for"), 1U);
}

TEST(WorldWithoutControl, IsInOperationFromTheStart) {
    config::Config config = three_channels();
    config.host.enabled = false;
    config::Source& bus = config.sources.emplace_back();
    bus.name = "bus";
    bus.rights.owns.reset(static_cast<std::size_t>(Aspect::kControl));
    HostBench bench(config);
    bench.source = 1;
    protocol::cigi::EntityControl control;
    control.entity_state = protocol::cigi::EntityState::kActive;
    control.lat_x = 12.0;
    bench.send(kHostA, control);
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 12.0);
}

}  // namespace
}  // namespace skyig::server::world
