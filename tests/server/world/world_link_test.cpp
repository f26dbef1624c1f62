// Who is obeyed, when a host counts as lost, and what the modes let through.
#include <gtest/gtest.h>

#include "tests/server/world/host_bench.h"

namespace skyig::server::world {
namespace {

using protocol::cigi::AtmosphereControl;
using protocol::cigi::EntityControl;
using protocol::cigi::EntityState;
using protocol::cigi::IgControl;
using protocol::cigi::IgMode;
using protocol::cigi::Version;

EntityControl ownship(double latitude_deg) {
    EntityControl control;
    control.entity_state = EntityState::kActive;
    control.lat_x = latitude_deg;
    return control;
}

TEST(WorldLink, FirstValidHostIsObeyedAndSaidOnce) {
    HostBench bench;
    EXPECT_EQ(bench.world.link().state, LinkState::kWaiting);
    bench.send(kHostA, ownship(10.0));
    bench.send(kHostA, ownship(11.0));
    EXPECT_EQ(bench.world.link().state, LinkState::kLive);
    EXPECT_EQ(bench.world.link().host, kHostA);
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 11.0);
    EXPECT_EQ(bench.lines_with("host 127.0.0.1:40001 speaks CIGI 3.3, big-endian"), 1U);
    EXPECT_TRUE(bench.world.from_obeyed_host());
}

TEST(WorldLink, SecondHostIsCountedIgnoredAndSaidOnce) {
    HostBench bench;
    bench.send(kHostA, ownship(10.0));
    for (int i = 0; i < 5; ++i)
        bench.send(kHostB, ownship(50.0));
    EXPECT_FALSE(bench.world.from_obeyed_host());
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 10.0);
    EXPECT_EQ(bench.world.counters().second_host, 5U);
    EXPECT_EQ(bench.lines_with("second host 127.0.0.1:40002 ignored"), 1U);
    // It does not disturb the sequence of the first, nor keep a dead one alive.
    EXPECT_EQ(bench.world.session().last_host_frame_number(), 1U);
    bench.wait(1.5);
    EXPECT_EQ(bench.world.link().state, LinkState::kLost);
}

TEST(WorldLink, SecondHostTakesOverWhenTheFirstIsLost) {
    HostBench bench;
    bench.send(kHostA, ownship(10.0));
    for (int i = 0; i < 100; ++i)
        bench.send(kHostA, ownship(10.0));
    bench.wait(1.5);
    // Its own frame numbers begin anew, lower than those of the first: nothing of it is taken for late.
    bench.frame = 0;
    bench.send(kHostB, ownship(50.0));
    EXPECT_EQ(bench.world.link().host, kHostB);
    EXPECT_EQ(bench.world.session().last_host_frame_number(), 1U);
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 50.0);
    bench.send(kHostA, ownship(10.0));
    EXPECT_EQ(bench.world.counters().second_host, 1U);
    EXPECT_EQ(bench.lines_with("second host 127.0.0.1:40001 ignored"), 1U);
}

TEST(WorldLink, SilentHostIsLostOnceThePictureStaysAndTheClockRuns) {
    HostBench bench;
    bench.send(kHostA, ownship(10.0));
    bench.wait(0.9);
    EXPECT_EQ(bench.world.link().state, LinkState::kStale);
    bench.wait(9.1);
    EXPECT_EQ(bench.world.link().state, LinkState::kLost);
    EXPECT_EQ(bench.world.link().losses, 1U);
    EXPECT_EQ(bench.lines_with("lost: silent"), 1U);
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 10.0);
    EXPECT_NEAR(ephemeris::seconds_between(bench.world.clock().utc(), utc("2026-06-21T12:00:10Z")), 0.0,
                1e-6);
    bench.send(kHostA, ownship(12.0));
    EXPECT_EQ(bench.lines_with("is back after 10.0 s"), 1U);
    EXPECT_EQ(bench.world.link().state, LinkState::kLive);
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 12.0);
}

TEST(WorldLink, StallOfTheDaemonIsNoSilenceOfTheHost) {
    HostBench bench;
    bench.send(kHostA, ownship(10.0));
    bench.world.advance(5.0);
    EXPECT_EQ(bench.world.link().state, LinkState::kLive);
    bench.world.advance(1.5);
    EXPECT_EQ(bench.world.link().state, LinkState::kLost);
}

TEST(WorldLink, FlickeringLinkDoesNotFillTheLog) {
    HostBench bench;
    for (int i = 0; i < 20; ++i) {
        bench.send(kHostA, ownship(10.0));
        bench.wait(1.25);
    }
    EXPECT_EQ(bench.world.link().losses, 20U);
    EXPECT_LE(bench.lines.size(), 9U);  // 25 s: three of each kind
    EXPECT_GE(bench.lines_with("more like this left out"), 1U);
}

TEST(WorldLink, GarbageNeitherClaimsNorKeepsTheLink) {
    HostBench bench;
    std::array<std::byte, 40> garbage{};
    garbage.fill(std::byte{0x5A});
    bench.world.begin_message(0, kHostB);
    EXPECT_FALSE(protocol::cigi::decode_host_message(garbage, bench.world, bench.counters).accepted);
    EXPECT_EQ(bench.world.link().state, LinkState::kWaiting);
    bench.send(kHostA, ownship(10.0));
    EXPECT_EQ(bench.world.link().host, kHostA);
    for (int i = 0; i < 20; ++i) {
        bench.world.begin_message(0, kHostA);
        (void)protocol::cigi::decode_host_message(garbage, bench.world, bench.counters);
        bench.wait(0.1);
    }
    EXPECT_EQ(bench.world.link().state, LinkState::kLost);
}

TEST(WorldLink, RefusedControlLeavesTheOtherPacketsOfTheObeyedHostOnly) {
    HostBench bench;
    IgControl bad;
    bad.ig_mode = IgMode::kOfflineMaintenance;  // a host may not ask for it: refused by the decoder
    bad.host_frame_number = 7;
    bench.send_as(kHostA, bad, ownship(10.0));
    EXPECT_EQ(bench.world.link().state, LinkState::kWaiting);
    EXPECT_EQ(bench.world.counters().no_host, 1U);
    EXPECT_FALSE(bench.world.ownship().placed_by_host);
    bench.send(kHostA, ownship(20.0));
    bench.send_as(kHostA, bad, ownship(30.0));
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 30.0);
    bench.send_as(kHostB, bad, ownship(40.0));
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 30.0);
}

TEST(WorldLink, StandbyObeysTheModeOnly) {
    HostBench bench;
    bench.mode = IgMode::kStandby;
    bench.send(kHostA, ownship(10.0), AtmosphereControl{});
    EXPECT_EQ(bench.world.mode(), IgMode::kStandby);
    EXPECT_EQ(bench.world.counters().standby_ignored, 2U);
    EXPECT_FALSE(bench.world.ownship().placed_by_host);
    bench.mode = IgMode::kOperate;
    bench.send(kHostA, ownship(10.0));
    EXPECT_EQ(bench.world.mode(), IgMode::kOperate);
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 10.0);
    EXPECT_EQ(bench.world.counters().standby_ignored, 2U);
    bench.mode = IgMode::kDebug;
    bench.send(kHostA, ownship(11.0));
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 11.0);
    EXPECT_EQ(bench.lines_with("set mode operate"), 1U);
}

TEST(WorldLink, EnteringStandbyBringsBackTheConfiguredWorld) {
    HostBench bench;
    AtmosphereControl fog;
    fog.visibility = 300.0F;
    fog.pressure = 990.0F;
    protocol::cigi::CelestialSphereControl night;
    night.hour = 23;
    night.date = 1012027;
    night.date_time_valid = true;
    protocol::cigi::ViewControl aside;
    aside.view_id = 2;
    aside.yaw_enable = true;
    aside.yaw = 33.0F;
    protocol::cigi::WeatherControl cloud;
    cloud.layer_id = 1;
    cloud.weather_enable = true;
    bench.send(kHostA, ownship(10.0), fog, night, aside, cloud);
    EXPECT_EQ(bench.world.air().visibility_m, 300.0);
    EXPECT_FALSE(bench.world.celestial().stars);
    EXPECT_EQ(bench.world.weather().layers().size(), 1U);
    bench.wait(0.5);

    bench.mode = IgMode::kStandby;
    bench.send(kHostA);
    EXPECT_EQ(bench.world.air().visibility_m, 80000.0);
    EXPECT_EQ(bench.world.air().pressure_hpa, 1013.25);
    EXPECT_TRUE(bench.world.celestial().stars);
    EXPECT_TRUE(bench.world.weather().layers().empty());
    EXPECT_EQ(bench.world.views().all()[1].pose.yaw_deg, 0.0);
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, bench.config.start.latitude_deg);
    EXPECT_FALSE(bench.world.ownship().placed_by_host);
    EXPECT_TRUE(bench.world.clock().running());
    EXPECT_EQ(ephemeris::to_iso(bench.world.clock().utc()), "2026-06-21T12:00:00Z");
}

TEST(WorldLink, ConfiguredNowGoesOnWhileTheHostHasItsOwnTime) {
    config::Config config = three_channels();
    config.start.utc.reset();
    HostBench bench(config, utc("2026-03-01T08:00:00Z"));
    protocol::cigi::CelestialSphereControl frozen;
    frozen.hour = 23;
    frozen.date = 1012027;
    frozen.date_time_valid = true;
    bench.send(kHostA, frozen);
    bench.wait(30.0);
    EXPECT_EQ(ephemeris::to_iso(bench.world.clock().utc()), "2027-01-01T23:00:00Z");
    bench.mode = IgMode::kStandby;
    bench.send(kHostA);
    EXPECT_NEAR(ephemeris::seconds_between(bench.world.clock().utc(), utc("2026-03-01T08:00:30Z")), 0.0,
                1e-6);
}

TEST(WorldLink, OldMessagesAreLeftAside) {
    HostBench bench;
    bench.frame = 1000;
    bench.send(kHostA, ownship(10.0));
    bench.frame = 990;
    bench.send(kHostA, ownship(50.0));
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 10.0);
    EXPECT_EQ(bench.world.counters().late_ignored, 1U);
    bench.frame = 1009;
    bench.send(kHostA, ownship(11.0));
    EXPECT_EQ(bench.world.counters().frames_missed, 8U);
    bench.frame = 0;  // far back: it began anew
    bench.send(kHostA, ownship(12.0));
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 12.0);
    EXPECT_EQ(bench.lines_with("began anew"), 1U);
}

TEST(WorldLink, AnswersInTheHostsVersion) {
    HostBench bench;
    EXPECT_EQ(bench.world.session().version(), Version::k33);
    bench.version = Version::k40;
    bench.send(kHostA);
    EXPECT_EQ(bench.world.session().version(), Version::k40);
    EXPECT_EQ(bench.lines_with("speaks CIGI 4.0"), 1U);
}

TEST(WorldLink, EveryCounterHasItsName) {
    Counters counters;
    std::uint64_t value = 0;
    for (const NamedCounter& counter : kCounterNames)
        counters.*counter.value = ++value;
    EXPECT_EQ(counters.second_host, 1U);
    EXPECT_EQ(counters.ig_message_lost, kCounterNames.size());
    for (std::size_t i = 0; i < kCounterNames.size(); ++i)
        EXPECT_EQ(counters.*kCounterNames[i].value, i + 1);
}

}  // namespace
}  // namespace skyig::server::world
