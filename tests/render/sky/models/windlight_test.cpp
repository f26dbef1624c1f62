// `windlight` in the limits where its formula says something plain.
#include "render/sky/models/windlight_sky.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "render/colour.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky::models {
namespace {

const AirTables& all_orders() {
    static const AirTables tables(air_model({}));
    return tables;
}

constexpr shaders64::Windlight kLook{.blue_density = {0.25, 0.45, 0.76},
                                     .haze_density = 0.35,
                                     .per_m = 1e-4,
                                     .ceiling_m = 4000.0,
                                     .blue_horizon = {0.5, 0.5, 0.64},
                                     .haze_horizon = 0.19,
                                     .sunlight = {0.73, 0.78, 0.9},
                                     .ambient = {0.35, 0.35, 0.35},
                                     .glow_size = 5.0,
                                     .glow_floor = 0.001,
                                     .glow_power = -0.48,
                                     .horizon_drop = 0.0};
constexpr double kFar = 1e12;

// The formula once more, a colour at a time, the Sun well up.
double printed_added(const shaders64::Windlight& w, int i, double sine, double sun_sine, double sun_angle) {
    const double density = w.blue_density[i] + w.haze_density;
    const double length_m = w.ceiling_m / sine;
    const double sun = w.sunlight[i] * std::exp(-(w.blue_density[i] + 0.25 * w.haze_density) * w.per_m *
                                                w.ceiling_m / (sine + sun_sine));
    const double glow = std::pow((1.0 - std::cos(sun_angle)) * w.glow_size, w.glow_power) + 0.25;
    const double limit = w.blue_horizon[i] * (w.blue_density[i] / density) * (sun + w.ambient[i]) +
                         w.haze_horizon * (w.haze_density / density) * (sun * glow + w.ambient[i]);
    return (1.0 - std::exp(-density * w.per_m * length_m)) * limit;
}

TEST(Windlight, IsTheFormulaWhereNothingIsRoundedOff) {
    double largest = 0.0;
    for (const double sine : {0.05, 0.3, 0.9}) {
        for (const double angle : {0.2, 1.0, 2.5}) {
            const auto air = shaders64::windlight_air(sine, 0.6, angle, kFar, kLook);
            for (int i = 0; i < 3; ++i)
                largest = std::max(largest,
                                   std::abs(air.added[i] / printed_added(kLook, i, sine, 0.6, angle) - 1.0));
        }
    }
    std::printf("largest difference %.1e\n", largest);
    EXPECT_LT(largest, 1e-3);
}

TEST(Windlight, WithoutAirObjectsAreUntouchedAndTheSkyIsBlack) {
    auto none = kLook;
    none.blue_density = glm::dvec3(0.0);
    none.haze_density = 0.0;
    auto thin = kLook;
    thin.per_m = 0.0;
    for (const auto& look : {none, thin}) {
        const auto air = shaders64::windlight_air(0.2, 0.5, 1.0, kFar, look);
        EXPECT_EQ(air.passed, glm::dvec3(1.0));
        EXPECT_EQ(air.added, glm::dvec3(0.0));
    }
}

TEST(Windlight, InThickAirAllThatIsSeenIsTheConvergenceColour) {
    auto thick = kLook;
    thick.per_m = 0.1;
    const auto air = shaders64::windlight_air(0.2, 0.5, 1.0, 1e5, thick);
    const glm::dvec3 limit = shaders64::windlight_convergence(0.2, 0.5, 1.0, thick);
    for (int i = 0; i < 3; ++i) {
        EXPECT_LT(air.passed[i], 1e-12);
        EXPECT_NEAR(air.added[i], limit[i], 1e-12);
    }
}

TEST(Windlight, NearObjectsFadeWithTheirDistance) {
    for (const double distance_m : {0.0, 100.0, 4000.0 / 0.2, 1e7}) {
        const auto air = shaders64::windlight_air(0.2, 0.5, 1.0, distance_m, kLook);
        const double length_m = std::min(distance_m, 4000.0 / 0.2);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(air.passed[i], std::exp(-(kLook.blue_density[i] + 0.35) * 1e-4 * length_m), 1e-12);
    }
}

TEST(Windlight, GlowsAtTheSunAndFadesToAQuarterOrMoreBehindIt) {
    const double at = shaders64::windlight_glow(0.0, kLook);
    const double behind = shaders64::windlight_glow(3.14159265358979, kLook);
    EXPECT_NEAR(at, std::pow(0.001 * 5.0, -0.48) + 0.25, 1e-12);
    EXPECT_NEAR(behind, std::pow(2.0 * 5.0, -0.48) + 0.25, 1e-12);
    double last = at;
    for (const double angle : steps(0.05, 3.1, 0.05)) {
        const double now = shaders64::windlight_glow(angle, kLook);
        EXPECT_LT(now, last);
        last = now;
    }
}

TEST(Windlight, HorizonDropLowersTheRaysVerticalComponent) {
    EXPECT_NEAR(shaders64::windlight_lowered(0.3, kLook), 0.3, 1e-15);
    auto dropped = kLook;
    dropped.horizon_drop = 0.1;
    // The ray (level, 0.3) becomes (level, 0.2), then a unit ray again.
    const double level = std::sqrt(1.0 - 0.09);
    EXPECT_NEAR(shaders64::windlight_lowered(0.3, dropped), 0.2 / std::hypot(level, 0.2), 1e-15);
    // What was on the horizon is seen where the drop has lifted it to, and nothing jumps there.
    const auto below = shaders64::windlight_air(0.1 - 1e-7, 0.5, 1.0, kFar, dropped);
    const auto above = shaders64::windlight_air(0.1 + 1e-7, 0.5, 1.0, kFar, dropped);
    const glm::dvec3 limit = shaders64::windlight_convergence(0.0, 0.5, 1.0, dropped);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(below.added[i], limit[i], 1e-5);
        EXPECT_NEAR(above.added[i], limit[i], 1e-5);
    }
}

TEST(Windlight, SunlightSinksWithoutAnEdge) {
    double last = shaders64::windlight_sunlight(0.0, 0.2, kLook).y;
    for (const double sun : steps(0.199, -0.2, -0.001)) {
        const double now = shaders64::windlight_sunlight(0.0, sun, kLook).y;
        EXPECT_LE(now, last);
        EXPECT_GT(now, last * 0.5 - 1e-6) << sun;
        last = now;
    }
}

TEST(Windlight, ShowsItsUnitInCandelasAndThinsOutWithHeight) {
    WindlightSky sky;
    const WindlightSettings settings;
    sky.begin(settings, all_orders(), 0.0, 0.8);
    const float zenith = 1.5707F;
    const auto added = shaders64::windlight_air(1.0, std::sin(0.8), 1.5707 - 0.8, kFar, kLook).added;
    const glm::vec3 rgb = rec709_from_xyz(sky.xyz(zenith, 0.0F));
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(rgb[i] / (30000.0 * added[i]), 1.0, 2e-3);
    std::printf("zenith %.0f cd/m2, horizon %.0f cd/m2\n", static_cast<double>(sky.xyz(zenith, 0.0F).y),
                static_cast<double>(sky.xyz(0.001F, 1.5F).y));
    float last = sky.xyz(zenith, 0.0F).y;
    for (const double height_m : {1e3, 5e3, 12e3, 50e3}) {
        sky.begin(settings, all_orders(), height_m, 0.8);
        EXPECT_LT(sky.xyz(zenith, 0.0F).y, last);
        last = sky.xyz(zenith, 0.0F).y;
    }
    sky.begin(settings, all_orders(), 400e3, 0.8);
    EXPECT_EQ(sky.xyz(zenith, 0.0F).y, 0.0F);
}

TEST(Windlight, PutsTheSunWhereTheAnglesSay) {
    WindlightSettings settings;
    settings.sun_angle_rad = 30.0 * kDeg;
    const glm::dvec3 in_the_east = placed_sun_enu(settings);
    EXPECT_NEAR(in_the_east.x, std::cos(30.0 * kDeg), 1e-15);
    EXPECT_NEAR(in_the_east.z, 0.5, 1e-15);
    settings.east_angle_rad = 90.0 * kDeg;
    EXPECT_NEAR(placed_sun_enu(settings).y, -std::cos(30.0 * kDeg), 1e-15);  // clockwise of east is south
    settings.sun_angle_rad = 150.0 * kDeg;
    EXPECT_NEAR(placed_sun_enu(settings).y, std::cos(30.0 * kDeg), 1e-15);  // past the zenith
}

}  // namespace
}  // namespace skyig::render::sky::models
