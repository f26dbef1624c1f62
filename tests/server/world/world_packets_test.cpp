// What each packet does to the world of the obeyed host.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "tests/server/world/host_bench.h"

namespace skyig::server::world {
namespace {

using protocol::cigi::AtmosphereControl;
using protocol::cigi::CelestialSphereControl;
using protocol::cigi::EntityControl;
using protocol::cigi::EntityPosition;
using protocol::cigi::EntityState;
using protocol::cigi::Version;
using protocol::cigi::ViewControl;
using protocol::cigi::ViewDefinition;

EntityControl at(double latitude_deg, double longitude_deg, double height_m) {
    EntityControl control;
    control.entity_state = EntityState::kActive;
    control.lat_x = latitude_deg;
    control.lon_y = longitude_deg;
    control.alt_z = height_m;
    control.yaw = 270.0F;
    control.pitch = 5.0F;
    control.roll = -10.0F;
    return control;
}

AtmosphereControl air(float visibility_m) {
    AtmosphereControl control;
    control.model_enable = true;
    control.visibility = visibility_m;
    control.air_temperature = -20.0F;
    control.pressure = 1000.0F;
    control.humidity = 70;
    control.wind_horizontal = 8.0F;
    control.wind_direction = 240.0F;
    return control;
}

CelestialSphereControl sky(int hour, int minute, bool running) {
    CelestialSphereControl control;
    control.hour = static_cast<std::uint8_t>(hour);
    control.minute = static_cast<std::uint8_t>(minute);
    control.date = 12242026;
    control.date_time_valid = true;
    control.ephemeris_enable = running;
    control.sun_enable = true;
    control.star_enable = true;
    control.star_intensity = 25.0F;
    return control;
}

TEST(WorldPackets, EntityControlOfCigi3PlacesTheOwnship) {
    HostBench bench;
    bench.send(kHostA, at(63.9, -22.6, 500.0));
    const Ownship& ownship = bench.world.ownship();
    EXPECT_EQ(ownship.position, (ephemeris::Geodetic{63.9, -22.6, 500.0}));
    EXPECT_EQ(ownship.yaw_deg, 270.0);
    EXPECT_EQ(ownship.pitch_deg, 5.0);
    EXPECT_EQ(ownship.roll_deg, -10.0);
    EXPECT_TRUE(ownship.placed_by_host);
}

TEST(WorldPackets, EntityPositionOfCigi4PlacesAndCreatesTheOwnship) {
    HostBench bench;
    bench.version = Version::k40;
    EntityPosition position;
    position.lat_x = -45.0;
    position.lon_y = 170.0;
    position.alt_z = 100.0;
    position.yaw = 12.0F;
    bench.send(kHostA, position);
    EXPECT_EQ(bench.world.ownship().position, (ephemeris::Geodetic{-45.0, 170.0, 100.0}));
    // In 4.0 Entity Control carries no position: it must not move the ownship to the equator.
    EntityControl exists;
    exists.entity_state = EntityState::kActive;
    bench.send(kHostA, exists);
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, -45.0);
    EXPECT_TRUE(bench.world.ownship().exists);
    exists.entity_state = EntityState::kDestroyed;
    bench.send(kHostA, exists);
    EXPECT_FALSE(bench.world.ownship().exists);
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, -45.0);
    bench.send(kHostA, position);
    EXPECT_TRUE(bench.world.ownship().exists);
}

TEST(WorldPackets, OtherAndAttachedEntitiesDoNotMoveTheEye) {
    HostBench bench;
    bench.send(kHostA, at(10.0, 20.0, 30.0));
    EntityControl traffic = at(50.0, 50.0, 50.0);
    traffic.entity_id = 12;
    EntityControl attached = at(1.0, 2.0, 3.0);
    attached.attach_state = true;
    attached.parent_id = 12;
    EntityControl destroyed = at(0.0, 0.0, 0.0);
    destroyed.entity_state = EntityState::kDestroyed;
    bench.send(kHostA, traffic, attached, destroyed);
    EXPECT_EQ(bench.world.ownship().position, (ephemeris::Geodetic{10.0, 20.0, 30.0}));
    EXPECT_FALSE(bench.world.ownship().exists);
    EXPECT_TRUE(bench.world.entity(12) != nullptr);
    EXPECT_EQ(bench.world.counters().ownship_attached, 1U);
    EXPECT_EQ(bench.lines_with("ownship is attached"), 1U);
}

TEST(WorldPackets, WindsThatNoAirHasAreRefused) {
    HostBench bench;
    protocol::cigi::AtmosphereControl sent;
    sent.model_enable = true;
    sent.air_temperature = 10.0F;
    sent.pressure = 1000.0F;
    sent.visibility = 9000.0F;
    sent.wind_horizontal = 12.0F;
    bench.send(kHostA, sent);
    sent.wind_horizontal = 3.4e38F;
    sent.wind_vertical = -3.4e38F;
    bench.send(kHostA, sent);
    EXPECT_EQ(bench.world.air().wind_horizontal_m_s, 12.0);
    EXPECT_EQ(bench.world.air().wind_vertical_m_s, 0.0);
    EXPECT_EQ(bench.world.counters().air_refused, 2U);
}

TEST(WorldPackets, LayersBeyondWhatIsDrawnAreBroughtToTheNearest) {
    HostBench bench;
    protocol::cigi::WeatherControl layer;
    layer.scope = protocol::cigi::WeatherScope::kGlobal;
    layer.layer_id = 1;
    layer.weather_enable = true;
    layer.cloud_type = protocol::cigi::CloudType::kCumulus;
    layer.coverage = 50.0F;
    layer.base_elevation = 1000.0F;
    layer.thickness = 800.0F;
    layer.transition_band = 100.0F;
    layer.wind_horizontal = 20.0F;
    bench.send(kHostA, layer);
    EXPECT_EQ(bench.world.counters().weather_limited, 0U);
    layer.base_elevation = 3.4e38F;
    layer.thickness = 1e7F;
    layer.transition_band = 3.4e38F;
    layer.wind_horizontal = 3.4e38F;
    layer.wind_vertical = -3.4e38F;
    bench.send(kHostA, layer);
    EXPECT_EQ(bench.world.counters().weather_limited, 1U);
    EXPECT_EQ(bench.lines_with("weather beyond what can be drawn"), 1U);
    ASSERT_EQ(bench.world.weather().layers().size(), 1U);
    const protocol::cigi::WeatherControl& kept = bench.world.weather().layers().front();
    EXPECT_EQ(kept.base_elevation, 60'000.0F);
    EXPECT_EQ(kept.thickness, 20'000.0F);
    EXPECT_EQ(kept.transition_band, 20'000.0F);
    EXPECT_EQ(kept.wind_horizontal, 200.0F);
    EXPECT_EQ(kept.wind_vertical, -100.0F);
    // A bus may reckon beyond what a float holds.
    layer.thickness = std::numeric_limits<float>::infinity();
    layer.wind_horizontal = std::numeric_limits<float>::infinity();
    bench.world.report(0, layer);
    EXPECT_EQ(bench.world.weather().layers().front().wind_horizontal, 200.0F);
    EXPECT_EQ(bench.world.weather().layers().front().thickness, 20'000.0F);
    layer.wind_horizontal = std::numeric_limits<float>::quiet_NaN();
    bench.world.report(0, layer);
    EXPECT_EQ(bench.world.weather().layers().front().wind_horizontal, 0.0F);
}

TEST(WorldPackets, ABussVelocityThatNoCraftHasIsRefused) {
    HostBench bench;
    bench.send(kHostA, at(10.0, 20.0, 30.0));
    OwnshipReport report;
    report.position = ephemeris::Geodetic{11.0, 20.0, 30.0};
    for (const double speed_m_s : {1e30, -13'000.0, std::numeric_limits<double>::quiet_NaN()}) {
        report.velocity_enu_m_s = glm::dvec3{speed_m_s, 0.0, 0.0};
        bench.world.report(0, report);
        bench.world.advance(1.0);
        EXPECT_NEAR(bench.world.ownship().position.height_m, 30.0, 1.0) << speed_m_s;
        EXPECT_NEAR(bench.world.ownship().position.longitude_deg, 20.0, 1e-3) << speed_m_s;
    }
    EXPECT_EQ(bench.world.counters().rate_refused, 3U);
}

TEST(WorldPackets, ImpossibleHeightsAreRefused) {
    HostBench bench;
    bench.send(kHostA, at(10.0, 20.0, 30.0));
    bench.send(kHostA, at(11.0, 20.0, 1.0e300));
    bench.send(kHostA,
               at(11.0, 20.0, std::numeric_limits<double>::quiet_NaN()));  // refused by the decoder already
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 10.0);
    EXPECT_EQ(bench.world.counters().position_refused, 1U);
    bench.send(kHostA, at(11.0, 20.0, 400.0e3));
    EXPECT_EQ(bench.world.ownship().position.height_m, 400.0e3);
}

TEST(WorldPackets, CelestialSphereSetsSwitchesAndClock) {
    HostBench bench;
    bench.send(kHostA, sky(5, 30, true));
    EXPECT_TRUE(bench.world.celestial().sun);
    EXPECT_FALSE(bench.world.celestial().moon);
    EXPECT_EQ(bench.world.celestial().star_intensity, 0.25);
    EXPECT_EQ(ephemeris::to_iso(bench.world.clock().utc()), "2026-12-24T05:30:00Z");
    for (int i = 0; i < 60; ++i) {  // a host that repeats its setting in every message
        bench.send(kHostA, sky(5, 30, true));
        bench.world.advance(0.5);
    }
    EXPECT_NEAR(ephemeris::seconds_between(bench.world.clock().utc(), utc("2026-12-24T05:30:30Z")), 0.0,
                1e-6);
    bench.send(kHostA, sky(5, 30, false));
    bench.world.advance(100.0);
    EXPECT_NEAR(ephemeris::seconds_between(bench.world.clock().utc(), utc("2026-12-24T05:30:30Z")), 0.0,
                1e-6);
    EXPECT_FALSE(bench.world.clock().running());
}

TEST(WorldPackets, SecondsSentAsAnIntegerAreUnderstood) {
    HostBench bench;
    bench.version = Version::k40;
    CelestialSphereControl control = sky(5, 30, true);
    control.seconds = std::bit_cast<float>(std::uint32_t{42});
    bench.send(kHostA, control);
    EXPECT_EQ(ephemeris::to_iso(bench.world.clock().utc()), "2026-12-24T05:30:42Z");
}

TEST(WorldPackets, SceneTimeRunsWhileFrozenAndJumpsWithTheClock) {
    HostBench bench;
    bench.world.advance(1.0);
    EXPECT_EQ(bench.world.time_s(), 1.0);
    bench.send(kHostA, sky(12, 0, false));
    const double jump_s =
        ephemeris::seconds_between(utc("2026-06-21T12:00:01Z"), utc("2026-12-24T12:00:00Z"));
    EXPECT_NEAR(bench.world.time_s(), 1.0 + jump_s, 1e-6);
    bench.world.advance(2.0);
    EXPECT_NEAR(bench.world.time_s(), 3.0 + jump_s, 1e-6);
    // A host that drives a frozen clock second by second makes no jump.
    bench.version = Version::k40;
    CelestialSphereControl next = sky(12, 0, false);
    next.seconds = 1.0F;
    bench.send(kHostA, next);
    EXPECT_NEAR(bench.world.time_s(), 3.0 + jump_s, 1e-6);
    EXPECT_EQ(bench.lines_with("clock set to 2026-12-24T12:00:00Z"), 1U);
}

TEST(WorldPackets, NonsenseStepsMoveNothing) {
    HostBench bench;
    bench.world.advance(-1.0);
    bench.world.advance(std::numeric_limits<double>::quiet_NaN());
    bench.world.advance(std::numeric_limits<double>::infinity());
    EXPECT_EQ(bench.world.time_s(), 0.0);
    EXPECT_EQ(ephemeris::to_iso(bench.world.clock().utc()), "2026-06-21T12:00:00Z");
}

TEST(WorldPackets, AtmosphereReplacesTheBaseState) {
    HostBench bench;
    bench.send(kHostA, air(2500.0F));
    const AirState& state = bench.world.air();
    EXPECT_TRUE(state.model_enabled);
    EXPECT_EQ(state.visibility_m, 2500.0);
    EXPECT_EQ(state.visibility_contrast, 0.05);
    EXPECT_EQ(state.temperature_c, -20.0);
    EXPECT_EQ(state.pressure_hpa, 1000.0);
    EXPECT_EQ(state.humidity_pct, 70.0);
    EXPECT_EQ(state.wind_from_deg, 240.0);
    AtmosphereControl careless = air(9000.0F);
    careless.pressure = 0.0F;
    careless.model_enable = false;
    bench.send(kHostA, careless);
    EXPECT_EQ(state.visibility_m, 9000.0);
    EXPECT_EQ(state.pressure_hpa, 1000.0);
    EXPECT_FALSE(state.model_enabled);
    EXPECT_EQ(bench.world.counters().air_refused, 1U);
}

TEST(WorldPackets, PerPacketFaultLeavesTheRestOfTheMessage) {
    HostBench bench;
    AtmosphereControl broken = air(1.0F);
    broken.visibility = std::numeric_limits<float>::infinity();
    bench.send(kHostA, broken, at(10.0, 20.0, 30.0));
    EXPECT_EQ(bench.world.air().visibility_m, 80000.0);
    EXPECT_EQ(bench.world.ownship().position.latitude_deg, 10.0);
}

TEST(WorldPackets, ViewsAreMovedAndRefusalsCounted) {
    HostBench bench;
    ViewControl turn;
    turn.view_id = 2;
    turn.yaw_enable = true;
    turn.yaw = 45.0F;
    ViewControl unknown = turn;
    unknown.view_id = 77;
    ViewControl chase = turn;
    chase.entity_id = 3;
    ViewDefinition coarse;
    coarse.view_id = 1;
    coarse.pixel_replication = 5;
    ViewDefinition mirror;
    mirror.view_id = 3;
    mirror.mirror_mode = 2;
    ViewDefinition narrow;
    narrow.view_id = 3;
    narrow.left_enable = true;
    narrow.left = 40.0F;
    bench.send(kHostA, turn, unknown, chase, coarse, mirror, narrow);
    EXPECT_EQ(bench.world.views().all()[1].pose.yaw_deg, 45.0);
    const Counters& counters = bench.world.counters();
    EXPECT_EQ(counters.unknown_view, 1U);
    EXPECT_EQ(counters.view_entity, 1U);
    EXPECT_EQ(counters.replication_refused, 1U);
    EXPECT_EQ(counters.frustum_refused, 1U);
    EXPECT_EQ(bench.lines_with("view 77: no channel has this view_id"), 1U);
    EXPECT_EQ(bench.lines_with("view 1: pixel replication 4 to 7"), 1U);
    EXPECT_EQ(bench.world.views().all()[2].mirror_mode, 2);
    for (int i = 0; i < 100; ++i)
        bench.send(kHostA, unknown);
    EXPECT_EQ(bench.lines_with("no channel has this view_id"), 1U);
}

TEST(WorldPackets, WeatherIsKept) {
    HostBench bench;
    protocol::cigi::EnvRegionControl region;
    region.region_id = 4;
    region.region_state = protocol::cigi::RegionState::kActive;
    region.size_x = region.size_y = 1000.0F;
    protocol::cigi::WeatherControl layer;
    layer.scope = protocol::cigi::WeatherScope::kRegional;
    layer.entity_region_id = 4;
    layer.layer_id = 2;
    layer.weather_enable = true;
    bench.send(kHostA, region, layer);
    EXPECT_EQ(bench.world.weather().regions().size(), 1U);
    ASSERT_EQ(bench.world.weather().layers().size(), 1U);
    EXPECT_EQ(bench.world.weather().layers()[0].layer_id, 2);
}

}  // namespace
}  // namespace skyig::server::world
