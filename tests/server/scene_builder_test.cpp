#include "server/scene_builder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "server/from_config.h"
#include "tests/server/world/host_bench.h"

namespace skyig::server {
namespace {

using world::HostBench;
using world::kHostA;

constexpr double kPi = 3.14159265358979323846;
constexpr double kRad = kPi / 180.0;
constexpr double kArcsec = kRad / 3600.0;

struct Attitude {
    double yaw_deg = 0.0;
    double pitch_deg = 0.0;
    double roll_deg = 0.0;
};

config::Config site(const ephemeris::Geodetic& place, const Attitude& attitude) {
    config::Config config = world::three_channels();
    config.start.latitude_deg = place.latitude_deg;
    config.start.longitude_deg = place.longitude_deg;
    config.start.height_m = place.height_m;
    config.start.yaw_deg = attitude.yaw_deg;
    config.start.pitch_deg = attitude.pitch_deg;
    config.start.roll_deg = attitude.roll_deg;
    return config;
}

render::Scene scene_of(const config::Config& config) {
    HostBench bench(config);
    SceneBuilder builder;
    return builder.build(bench.world, 1);
}

/// East-north-up direction of an axis of a view: x right, y up, -z ahead.
glm::dvec3 enu_of(const render::Scene& scene, std::size_t view, const glm::dvec3& in_view) {
    return glm::transpose(scene.views[view].view_from_enu) * in_view;
}

glm::dvec3 ahead(const render::Scene& scene, std::size_t view) {
    return enu_of(scene, view, {0.0, 0.0, -1.0});
}

glm::dvec3 direction_enu(double azimuth_deg, double elevation_deg) {
    const double a = azimuth_deg * kRad, e = elevation_deg * kRad;
    return {std::cos(e) * std::sin(a), std::cos(e) * std::cos(a), std::sin(e)};
}

/// Written out here once more, from the geometry: columns east, north, up.
glm::dmat3 ecef_from_enu(const render::Eye& eye) {
    const double f = eye.latitude_deg * kRad, l = eye.longitude_deg * kRad;
    return {glm::dvec3{-std::sin(l), std::cos(l), 0.0},
            glm::dvec3{-std::sin(f) * std::cos(l), -std::sin(f) * std::sin(l), std::cos(f)},
            glm::dvec3{std::cos(f) * std::cos(l), std::cos(f) * std::sin(l), std::sin(f)}};
}

void expect_close(const glm::dvec3& a, const glm::dvec3& b, double bound_rad, const char* what) {
    const double angle = ephemeris::angle_between_rad(a, b);
    std::printf("  %-32s %.2e rad\n", what, angle);
    EXPECT_LE(angle, bound_rad) << what;
}

TEST(SceneBuilder, YawNinetyLooksEastRightIsSouth) {
    const render::Scene scene = scene_of(site({47.0, 8.0, 500.0}, {90.0, 0.0, 0.0}));
    expect_close(ahead(scene, 1), {1.0, 0.0, 0.0}, 1e-15, "ahead is east");
    expect_close(enu_of(scene, 1, {1.0, 0.0, 0.0}), {0.0, -1.0, 0.0}, 1e-15, "right is south");
    expect_close(enu_of(scene, 1, {0.0, 1.0, 0.0}), {0.0, 0.0, 1.0}, 1e-15, "up is up");
}

TEST(SceneBuilder, PitchUpLooksUp) {
    expect_close(ahead(scene_of(site({47.0, 8.0, 500.0}, {0.0, 30.0, 0.0})), 1), direction_enu(0.0, 30.0),
                 1e-15, "30 deg above north");
    expect_close(ahead(scene_of(site({47.0, 8.0, 500.0}, {0.0, 90.0, 0.0})), 1), {0.0, 0.0, 1.0}, 1e-15,
                 "zenith");
}

TEST(SceneBuilder, RollRightPutsTheRightSideDown) {
    const render::Scene scene = scene_of(site({47.0, 8.0, 500.0}, {0.0, 0.0, 30.0}));
    expect_close(ahead(scene, 1), {0.0, 1.0, 0.0}, 1e-15, "still ahead");
    expect_close(enu_of(scene, 1, {1.0, 0.0, 0.0}), {std::cos(30.0 * kRad), 0.0, -std::sin(30.0 * kRad)},
                 1e-15, "right wing 30 deg down");
}

TEST(SceneBuilder, SideChannelsLookSixtyDegreesAside) {
    const render::Scene scene = scene_of(site({47.0, 8.0, 500.0}, {300.0, 0.0, 0.0}));
    ASSERT_EQ(scene.view_count, 3U);
    expect_close(ahead(scene, 0), direction_enu(240.0, 0.0), 1e-15, "left");
    expect_close(ahead(scene, 1), direction_enu(300.0, 0.0), 1e-15, "centre");
    expect_close(ahead(scene, 2), direction_enu(0.0, 0.0), 1e-15, "right");
    // Banked left by 90 deg, the left channel looks below the nose, not round the horizon.
    const render::Scene bank = scene_of(site({47.0, 8.0, 500.0}, {0.0, 0.0, -90.0}));
    expect_close(ahead(bank, 0), {0.0, std::cos(60.0 * kRad), -std::sin(60.0 * kRad)}, 1e-15, "left, banked");
}

TEST(SceneBuilder, ChannelsMeetAtTheirSeams) {
    const render::Scene scene = scene_of(site({-33.0, 151.0, 3000.0}, {123.0, -7.0, 25.0}));
    const render::Channel channel{"c", 1280, 1024};
    double worst_rad = 0.0;
    for (std::size_t left = 0; left < 2; ++left) {
        for (int y = 0; y <= channel.height_px; y += 64) {
            const glm::dvec3 a =
                render::view_direction(channel, scene.views[left].frustum, channel.width_px, y);
            const glm::dvec3 b = render::view_direction(channel, scene.views[left + 1].frustum, 0.0, y);
            worst_rad = std::max(
                worst_rad, ephemeris::angle_between_rad(enu_of(scene, left, a), enu_of(scene, left + 1, b)));
        }
    }
    std::printf("  largest gap at a seam %.2e rad\n", worst_rad);
    EXPECT_LE(worst_rad, 1e-15);
}

TEST(SceneBuilder, GroupTurnsFirstThenTheView) {
    config::Config config = site({47.0, 8.0, 500.0}, {0.0, 0.0, 0.0});
    for (config::Channel& channel : config.channels)
        channel.group_id = 5;
    HostBench bench(config);
    protocol::cigi::ViewControl group;
    group.group_id = 5;
    group.yaw_enable = group.pitch_enable = true;
    group.yaw = 90.0F;
    group.pitch = 30.0F;
    bench.send(kHostA, group);
    SceneBuilder builder;
    const render::Scene scene = builder.build(bench.world, 1);
    expect_close(ahead(scene, 1), direction_enu(90.0, 30.0), 1e-15, "centre of the group");
    // 60 deg to the left within a group that is pitched up: between the group's axis (east, 30 up) and its
    // left (north).
    const glm::dvec3 expected =
        std::cos(60.0 * kRad) * direction_enu(90.0, 30.0) + std::sin(60.0 * kRad) * glm::dvec3{0.0, 1.0, 0.0};
    expect_close(ahead(scene, 0), expected, 1e-15, "left in the group");
}

TEST(SceneBuilder, EyeIsTheMeanOfTheOffsetsTurnedByTheAttitude) {
    config::Config config = site({0.0, 10.0, 1000.0}, {90.0, 0.0, 0.0});
    for (config::Channel& channel : config.channels)
        channel.offset_m = {30.0, 0.0, -2.0};
    config.channels[0].offset_m[1] = -3.0;
    config.channels[2].offset_m[1] = 3.0;
    HostBench bench(config);
    SceneBuilder builder;
    const render::Scene scene = builder.build(bench.world, 1);
    // Forward is east; at the equator 30 m of east at radius a + h are that many radians of longitude.
    const double expected_deg = 10.0 + std::atan(30.0 / (6378137.0 + 1002.0)) / kRad;
    EXPECT_NEAR(scene.eye.longitude_deg, expected_deg, 1e-12);
    EXPECT_NEAR(scene.eye.latitude_deg, 0.0, 1e-12);
    EXPECT_NEAR(scene.eye.height_m, 1002.0 + 30.0 * 30.0 / 2.0 / 6378137.0, 1e-6);
    EXPECT_NEAR(builder.eye_spread_m(), 3.0, 1e-12);
}

TEST(SceneBuilder, GroupOffsetAndTurnMoveTheEye) {
    config::Config config = site({0.0, 10.0, 1000.0}, {90.0, 0.0, 0.0});
    config.channels.resize(1);
    config.channels[0].group_id = 5;
    config.channels[0].offset_m = {0.0, -2.0, 0.0};
    HostBench bench(config);
    protocol::cigi::ViewControl group;
    group.group_id = 5;
    group.yaw_enable = group.x_enable = true;
    group.yaw = 90.0F;
    group.x_offset = 10.0F;
    bench.send(kHostA, group);
    SceneBuilder builder;
    const render::Scene scene = builder.build(bench.world, 1);
    // The group looks to the right, so its left is forward: 10 + 2 m ahead, which is east.
    EXPECT_NEAR(scene.eye.longitude_deg, 10.0 + std::atan(12.0 / (6378137.0 + 1000.0)) / kRad, 1e-12);
}

TEST(SceneBuilder, HostsPositionPassesUntouchedWithoutOffsets) {
    const render::Scene scene = scene_of(site({47.123456789, 8.987654321, 512.25}, {10.0, 2.0, 3.0}));
    EXPECT_EQ(scene.eye.latitude_deg, 47.123456789);
    EXPECT_EQ(scene.eye.longitude_deg, 8.987654321);
    EXPECT_EQ(scene.eye.height_m, 512.25);
}

/// A few metres of offset must not turn the picture, wherever the longitude runs away to.
TEST(SceneBuilder, OffsetNeverTurnsTheViewNotEvenAtPoles) {
    struct Case {
        const char* name;
        ephemeris::Geodetic place;
    };
    const std::array cases{Case{"north pole", {90.0, 15.0, 100.0}},
                           Case{"near north pole", {89.99999, 15.0, 100.0}},
                           Case{"south pole", {-90.0, 0.0, 3000.0}},
                           Case{"antimeridian east", {10.0, 180.0, 0.0}},
                           Case{"antimeridian west", {10.0, -179.999999, 0.0}},
                           Case{"Greenwich", {0.0, 0.0, -400.0}},
                           Case{"mid latitude", {47.0, 8.0, 500.0}}};
    for (const Case& c : cases) {
        config::Config config = site(c.place, {33.0, 4.0, -12.0});
        const render::Scene without = scene_of(config);
        for (config::Channel& channel : config.channels)
            channel.offset_m = {20.0, 5.0, -3.0};
        const render::Scene with = scene_of(config);
        EXPECT_LE(std::abs(with.eye.longitude_deg), 180.0);
        expect_close(ecef_from_enu(without.eye) * ahead(without, 0), ecef_from_enu(with.eye) * ahead(with, 0),
                     1e-13, c.name);
        expect_close(ecef_from_enu(without.eye) * without.moon.direction_enu,
                     ecef_from_enu(with.eye) * with.moon.direction_enu, 0.02 * kArcsec, "  the Moon's place");
    }
}

TEST(SceneBuilder, SkyIsTheSameOnBothSidesOfTheAntimeridian) {
    const render::Scene east = scene_of(site({-17.0, 180.0, 100.0}, {0.0, 0.0, 0.0}));
    const render::Scene west = scene_of(site({-17.0, -180.0, 100.0}, {0.0, 0.0, 0.0}));
    expect_close(east.sun.direction_enu, west.sun.direction_enu, 1e-13, "Sun");
    expect_close(east.moon.direction_enu, west.moon.direction_enu, 1e-13, "Moon");
    expect_close(east.stars.enu_from_gcrs[2], west.stars.enu_from_gcrs[2], 1e-13, "celestial pole");
}

TEST(SceneBuilder, SunAndMoonAreThoseOfTheEphemeris) {
    const ephemeris::Geodetic place{47.0, 8.0, 500.0};
    const render::Scene scene = scene_of(site(place, {0.0, 0.0, 0.0}));
    const ephemeris::SkyState sky =
        ephemeris::compute_sky_state(ephemeris::make_instant(world::utc("2026-06-21T12:00:00Z")), place);
    expect_close(scene.sun.direction_enu, sky.sun.direction_enu, 0.02 * kArcsec, "Sun");
    expect_close(scene.moon.direction_enu, sky.moon.direction_enu, 0.02 * kArcsec, "Moon");
    expect_close(scene.moon.to_sun_enu, sky.moon.to_sun_enu, 0.02 * kArcsec, "Moon to Sun");
    EXPECT_NEAR(scene.moon.phase_angle_rad, sky.moon.phase_angle_rad, 0.02 * kArcsec);
    EXPECT_NEAR(scene.stars.years_since_j2000, 26.47, 0.01);
    const SkyAngles angles = sky_angles(scene);
    std::printf("  sun %.3f deg up at %.3f deg\n", angles.sun_elevation_deg, angles.sun_azimuth_deg);
    // By the book: solstice, declination 23.43 deg, 8 deg east, equation of time -1.9 minutes.
    const double hour_angle = (8.0 - 1.9 / 4.0) * kRad, latitude = 47.0 * kRad, declination = 23.43 * kRad;
    const double by_book_deg = std::asin(std::sin(latitude) * std::sin(declination) +
                                         std::cos(latitude) * std::cos(declination) * std::cos(hour_angle)) /
                               kRad;
    EXPECT_NEAR(angles.sun_elevation_deg, by_book_deg, 0.05);
    EXPECT_GT(angles.sun_azimuth_deg, 180.0);
    EXPECT_LT(angles.sun_azimuth_deg, 200.0);
}

TEST(SceneBuilder, PlanetsAreThoseOfTheEphemerisInTheirColours) {
    const ephemeris::Geodetic place{47.0, 8.0, 500.0};
    const render::Scene scene = scene_of(site(place, {0.0, 0.0, 0.0}));
    const ephemeris::SkyState sky =
        ephemeris::compute_sky_state(ephemeris::make_instant(world::utc("2026-06-21T12:00:00Z")), place);
    for (std::size_t i = 0; i < render::kPlanetCount; ++i) {
        expect_close(scene.planets[i].direction_enu, sky.planets[i].direction_enu, 0.001 * kArcsec, "planet");
        EXPECT_NEAR(scene.planets[i].magnitude, sky.planets[i].magnitude, 1e-4);
    }
    // Venus is the brightest and Mars the reddest.
    for (const std::size_t other : {0U, 2U, 3U, 4U})
        EXPECT_LT(scene.planets[1].magnitude, scene.planets[other].magnitude);
    for (const std::size_t other : {0U, 1U, 3U, 4U})
        EXPECT_GT(scene.planets[2].bv, scene.planets[other].bv);
}

TEST(SceneBuilder, MoonHasItsFaceAndTheEarthsShadow) {
    // In the umbra of 2018-07-27 over Mauritius; the same month before it there is no shadow near.
    config::Config config = site({-20.2, 57.5, 100.0}, {0.0, 0.0, 0.0});
    HostBench eclipsed(config, world::utc("2018-07-27T20:21:44Z"));
    SceneBuilder builder;
    const render::Moon moon = builder.build(eclipsed.world, 1).moon;
    std::printf("  axis %.3f, umbra %.3f, penumbra %.3f radii of the Moon\n",
                glm::length(moon.shadow_axis_enu), moon.umbra_radius, moon.penumbra_radius);
    EXPECT_LT(glm::length(moon.shadow_axis_enu) + 1.0, moon.umbra_radius);
    EXPECT_GT(moon.penumbra_radius, moon.umbra_radius + 1.5);
    EXPECT_EQ(moon.sunlit, 0.0);
    // The near side looks at the eye.
    EXPECT_GT(glm::dot(moon.enu_from_selenographic[0], -moon.direction_enu), std::cos(12.0 * kRad));
    HostBench before(config, world::utc("2018-07-20T20:21:44Z"));
    const render::Moon lit = builder.build(before.world, 2).moon;
    EXPECT_EQ(lit.sunlit, 1.0);
    EXPECT_GT(glm::length(lit.shadow_axis_enu), lit.penumbra_radius + 1.0);
}

TEST(SceneBuilder, EclipsedSunIsObscuredUnlessTheMoonIsSwitchedOff) {
    config::Config config = site({32.7767, -96.7970, 130.0}, {0.0, 0.0, 0.0});
    HostBench bench(config, world::utc("2024-04-08T18:42:30Z"));
    SceneBuilder builder;
    const double unobscured = builder.build(bench.world, 1).sun.unobscured;
    std::printf("  Dallas in totality: %.4f of the Sun left\n", unobscured);
    EXPECT_LT(unobscured, 0.001);
    config.sky.moon = false;
    HostBench moonless(config, world::utc("2024-04-08T18:42:30Z"));
    EXPECT_EQ(builder.build(moonless.world, 2).sun.unobscured, 1.0);
    EXPECT_FALSE(builder.build(moonless.world, 3).moon.enabled);
}

TEST(SceneBuilder, SwitchesAirAndFrustaReachTheScene) {
    HostBench bench;
    protocol::cigi::CelestialSphereControl sky;
    sky.moon_enable = true;
    sky.star_intensity = 40.0F;
    protocol::cigi::AtmosphereControl fog;
    fog.visibility = 1500.0F;
    fog.pressure = 990.0F;
    fog.humidity = 95;
    protocol::cigi::ViewDefinition narrow;
    narrow.view_id = 2;
    narrow.right_enable = true;
    narrow.right = 10.0F;
    bench.send(kHostA, sky, fog, narrow);
    bench.world.advance(0.25);
    SceneBuilder builder;
    const render::Scene scene = builder.build(bench.world, 42);
    EXPECT_EQ(scene.frame_number, 42U);
    EXPECT_EQ(scene.time_s, 0.25);
    EXPECT_FALSE(scene.sun.enabled);
    EXPECT_TRUE(scene.moon.enabled);
    EXPECT_FALSE(scene.stars.enabled);
    EXPECT_NEAR(scene.stars.intensity, 0.4, 1e-12);
    EXPECT_EQ(scene.air.visibility_m, 1500.0);
    EXPECT_EQ(scene.air.visibility_contrast, 0.05);
    EXPECT_EQ(scene.air.pressure_hpa, 990.0);
    EXPECT_EQ(scene.air.humidity_pct, 95.0);
    EXPECT_FALSE(scene.air.model_enabled);
    EXPECT_NEAR(scene.views[1].frustum.right_rad, 10.0 * kRad, 1e-15);
    EXPECT_NEAR(scene.views[1].frustum.left_rad, -30.0 * kRad, 1e-15);
}

TEST(SceneBuilder, ViewsAreShownAsTheirDefinitionsSay) {
    HostBench bench;
    for (int id = 1; id <= 3; ++id) {
        protocol::cigi::ViewDefinition definition;
        definition.view_id = static_cast<std::uint16_t>(id);
        definition.mirror_mode = static_cast<std::uint8_t>(id);
        definition.pixel_replication = static_cast<std::uint8_t>(id);
        definition.projection_type = id == 3;
        bench.send(kHostA, definition);
    }
    bench.control(protocol::cigi::ComponentClass::kView, 0, 2, 4);
    SceneBuilder builder;
    const render::Scene scene = builder.build(bench.world, 1);
    // Mirror: 1 across, 2 upright, 3 both. Replication: 1 two high, 2 two wide, 3 both.
    EXPECT_EQ(scene.views[0].showing, (render::Showing{.mirrored_across = true, .repeat_upright = 2}));
    EXPECT_EQ(scene.views[1].showing, (render::Showing{.mirrored_upright = true, .repeat_across = 2}));
    EXPECT_EQ(scene.views[2].showing, (render::Showing{.mirrored_across = true,
                                                       .mirrored_upright = true,
                                                       .repeat_across = 2,
                                                       .repeat_upright = 2,
                                                       .parallel = true}));
    EXPECT_EQ(scene.views[0].pattern, render::Pattern::kOff);
    EXPECT_EQ(scene.views[1].pattern, render::Pattern::kRamp);
}

TEST(SceneBuilder, SceneDependsOnTheWorldAloneNotOnWhatWasBuiltBefore) {
    HostBench now, then(world::three_channels(), world::utc("1990-02-03T04:05:06Z"));
    SceneBuilder fresh, used;
    (void)used.build(then.world, 1);
    const render::Scene a = fresh.build(now.world, 2), b = used.build(now.world, 2);
    EXPECT_EQ(a.sun.direction_enu, b.sun.direction_enu);
    EXPECT_EQ(a.moon.direction_enu, b.moon.direction_enu);
    EXPECT_EQ(a.stars.enu_from_gcrs, b.stars.enu_from_gcrs);
    EXPECT_EQ(a.views[2].view_from_enu, b.views[2].view_from_enu);
}

TEST(SceneBuilder, SettingsOfTheSkyReachTheScene) {
    config::Config config = site({50.0, 8.0, 0.0}, {});
    config.sky.model = config::SkyModel::kWindlight;
    config.sky.windlight.haze_density = 0.25;
    HostBench bench(config);
    SceneBuilder plain(ephemeris::Model::kSeries, {}, sky_settings(config.sky));
    const render::Scene dated = plain.build(bench.world, 1);
    EXPECT_EQ(dated.sky.model, render::SkyModel::kWindlight);
    EXPECT_EQ(dated.sky.windlight.haze_density, 0.25);
    EXPECT_EQ(dated.sun.direction_enu, scene_of(config).sun.direction_enu);
    config.sky.windlight.sun_angle_deg = 30.0;
    SceneBuilder placed(ephemeris::Model::kSeries, {}, sky_settings(config.sky));
    EXPECT_NEAR(placed.build(bench.world, 1).sun.direction_enu.z, 0.5, 1e-12);
    // The angles are windlight's alone.
    config.sky.model = config::SkyModel::kMulti;
    SceneBuilder other(ephemeris::Model::kSeries, {}, sky_settings(config.sky));
    EXPECT_EQ(other.build(bench.world, 1).sun.direction_enu, dated.sun.direction_enu);
}

TEST(SceneBuilder, DatesBeyondTheEphemerisAreSaid) {
    HostBench far(world::three_channels(), world::utc("2300-01-01T00:00:00Z"));
    SceneBuilder builder;
    EXPECT_TRUE(std::isfinite(builder.build(far.world, 1).sun.direction_enu.x));
    EXPECT_TRUE(builder.date_clamped());
    HostBench near;
    (void)builder.build(near.world, 2);
    EXPECT_FALSE(builder.date_clamped());
}

TEST(SceneBuilder, CostsMicroseconds) {
    HostBench bench;
    SceneBuilder builder;
    double sum = 0.0;
    (void)builder.build(bench.world, 0);
    constexpr int kFrames = 20'000;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kFrames; ++i) {
        bench.world.advance(1.0 / 60.0);
        sum += builder.build(bench.world, static_cast<std::uint64_t>(i)).sun.direction_enu.z;
    }
    const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - start;
    std::printf("  %.2f us a scene (three views, no offsets); checksum %.3f\n", spent.count() / kFrames, sum);
    RecordProperty("us_per_scene", std::to_string(spent.count() / kFrames));
    EXPECT_LT(spent.count() / kFrames, 200.0);
}

TEST(SceneBuilder, TheSeaBelowTheEyeIsTheHosts) {
    namespace cigi = protocol::cigi;
    HostBench bench(site({47.0, 8.0, 500.0}, {}));
    SceneBuilder builder;
    EXPECT_EQ(builder.build(bench.world, 1).sea.wave_count, 0U);
    cigi::MaritimeSurfaceControl sea;
    sea.enable = true;
    sea.whitecap_enable = true;
    sea.sea_surface_height = 1.5F;
    sea.water_temperature = 9.0F;
    sea.clarity = 40.0F;
    cigi::WaveControl swell;
    swell.wave_enable = true;
    swell.height = 3.0F;
    swell.wavelength = 120.0F;
    swell.period = 9.0F;
    swell.direction = 270.0F;
    swell.phase_offset = 90.0F;
    swell.leading = -45.0F;
    swell.breaker_type = cigi::BreakerType::kSurging;
    bench.send(kHostA, sea, swell);
    const render::Sea open = builder.build(bench.world, 2).sea;
    EXPECT_EQ(open.height_m, 1.5);
    EXPECT_EQ(open.temperature_c, 9.0);
    EXPECT_NEAR(open.clarity, 0.4, 1e-9);
    EXPECT_EQ(open.whitecaps, 1.0);
    ASSERT_EQ(open.all_waves().size(), 1U);
    const render::Wave& wave = open.waves[0];
    EXPECT_EQ(wave.height_m, 3.0);
    EXPECT_EQ(wave.length_m, 120.0);
    EXPECT_EQ(wave.period_s, 9.0);
    EXPECT_NEAR(wave.direction_rad, 1.5 * kPi, 1e-12);
    EXPECT_NEAR(wave.phase_rad, 0.5 * kPi, 1e-12);
    EXPECT_NEAR(wave.leading_rad, -0.25 * kPi, 1e-12);
    EXPECT_EQ(wave.breaker, render::Wave::Breaker::kSurging);
    // A lake around the eye has ripples of its own.
    cigi::EnvRegionControl lake;
    lake.region_id = 2;
    lake.region_state = cigi::RegionState::kActive;
    lake.latitude = 47.0;
    lake.longitude = 8.0;
    lake.size_x = lake.size_y = 5000.0F;
    cigi::WaveControl ripple = swell;
    ripple.scope = cigi::WeatherScope::kRegional;
    ripple.entity_region_id = 2;
    ripple.height = 0.1F;
    cigi::WaveControl on_ship = swell;
    on_ship.scope = cigi::WeatherScope::kEntity;
    bench.send(kHostA, lake, ripple, on_ship);
    const render::Sea inland = builder.build(bench.world, 3).sea;
    ASSERT_EQ(inland.wave_count, 1U);
    EXPECT_NEAR(inland.waves[0].height_m, 0.1, 1e-6);
    EXPECT_EQ(inland.height_m, 1.5) << "the lake has waves, but no surface of its own";
    EXPECT_EQ(bench.world.counters().surface_entity, 1U);
    bench.mode = cigi::IgMode::kStandby;
    bench.send(kHostA);
    EXPECT_EQ(builder.build(bench.world, 4).sea.wave_count, 0U);
}

}  // namespace
}  // namespace skyig::server
