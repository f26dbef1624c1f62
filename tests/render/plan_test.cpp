#include "render/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vector>

#include "render/dome_bend.h"
#include "render/eye/tone_curve.h"
#include "render/geometry.h"
#include "render/night/star_colour.h"
#include "render/night/star_scintillation.h"
#include "render/star_field.h"
#include "render/warp/blend.h"
#include "tests/render/scenes.h"
#include "tests/render/warps.h"

namespace skyig::render {
namespace {

using tests::make_scene;

Plan plan_of(const Scene& scene, const Held& held) {
    return make_plan(scene, held, tests::refraction_of(scene));
}

// No star is too faint to change the picture.
constexpr double kNone_mag = 99.0;

Held fresh(const Scene& scene) {
    Held held;
    held.air_valid = held.air_fresh = held.sun_sky_valid = held.moon_sky_valid = true;
    held.sun_sky_elevation_rad = horizontal_of(scene.sun.direction_enu).elevation_rad;
    held.moon_sky_elevation_rad = horizontal_of(scene.moon.direction_enu).elevation_rad;
    held.sun_sky_height_m = held.moon_sky_height_m = scene.eye.height_m;
    return held;
}

TEST(Plan, NothingHeldBuildsAirAndSky) {
    const Plan plan = plan_of(make_scene(30, 180, -20, 0, 1000), {});
    EXPECT_TRUE(plan.needs(Pass::kAirTables));
    EXPECT_TRUE(plan.needs(Pass::kSunSky));
    EXPECT_FALSE(plan.needs(Pass::kMoonSky));
    EXPECT_TRUE(plan.needs(Pass::kDome));
}

TEST(Plan, WhatFallsIsDrawnWhereItFalls) {
    Scene scene = make_scene(30, 180, 10, 0, 1000);
    EXPECT_FALSE(plan_of(scene, fresh(scene)).needs(Pass::kPrecipitation));
    scene.weather.precipitations[0] = {Precipitation::Kind::kRain, 0.0, 2000.0};
    scene.weather.precipitation_count = 1;
    EXPECT_EQ(plan_of(scene, fresh(scene))[Pass::kPrecipitation].reason, "nothing falls");
    scene.weather.precipitations[0].rate_mm_h = 0.1;
    EXPECT_TRUE(plan_of(scene, fresh(scene)).needs(Pass::kPrecipitation));
    scene.weather.precipitations[0].top_m = 999.0;
    EXPECT_FALSE(plan_of(scene, fresh(scene)).needs(Pass::kPrecipitation));
    EXPECT_EQ(plan_of(scene, fresh(scene))[Pass::kPrecipitation].reason, "the eye is above what falls");
}

TEST(Plan, FreshTablesAreKept) {
    const Scene scene = make_scene(30, 180, 10, 0, 1000);
    const Plan plan = plan_of(scene, fresh(scene));
    EXPECT_FALSE(plan.needs(Pass::kAirTables));
    EXPECT_FALSE(plan.needs(Pass::kSunSky));
    EXPECT_EQ(plan.sun_share, 1.0);
}

TEST(Plan, SourceThatMovedAHundredthOfADegreeMakesItsTableStaleByNoonThree) {
    for (const auto& [sun_deg, step_deg] : {std::pair{0.0, 0.01}, std::pair{30.0, 0.03}}) {
        const Scene scene = make_scene(sun_deg, 180, 10, 0, 1000);
        Held held = fresh(scene);
        held.sun_sky_elevation_rad += 0.9 * step_deg * tests::kDegree;
        EXPECT_FALSE(plan_of(scene, held).needs(Pass::kSunSky)) << sun_deg;
        held.sun_sky_elevation_rad += 0.2 * step_deg * tests::kDegree;
        EXPECT_TRUE(plan_of(scene, held).needs(Pass::kSunSky)) << sun_deg;
    }
}

TEST(Plan, StaleAirIsAskedForAnew) {
    const Scene scene = make_scene(30, 180, 10, 0, 1000);
    Held held = fresh(scene);
    held.air_fresh = false;
    EXPECT_TRUE(plan_of(scene, held).needs(Pass::kAirTables));
    EXPECT_FALSE(plan_of(scene, held).needs(Pass::kSunSky))
        << "the table in use serves until the new air is there";
}

TEST(Plan, StarsGoBecauseTheSkyIsBrightNotBecauseTheSunIsUp) {
    const Scene scene = make_scene(30, 180, 10, 0, 1000);
    Plan plan = plan_of(scene, fresh(scene));
    plan_stars(plan, scene, PointBackgrounds::even(2000.0), kNone_mag);
    EXPECT_FALSE(plan.needs(Pass::kStars));
    plan_stars(plan, scene, PointBackgrounds::even(2e-4),
               kNone_mag);  // the same Sun, seen from above the air
    EXPECT_TRUE(plan.needs(Pass::kStars));
    EXPECT_GT(plan.stars.limit_mag, 6.5);
}

TEST(Plan, StarsTwinkleWhereItShowsAndIsAskedFor) {
    Scene scene = make_scene(-30, 180, -30, 0, 1000);
    Plan plan = plan_of(scene, fresh(scene));
    constexpr double kHalfCode_mag = 7.0;
    plan_stars(plan, scene, PointBackgrounds::even(2e-4), kHalfCode_mag);
    EXPECT_FALSE(plan.stars.twinkle);
    scene.sky.star_scintillation = true;
    plan_stars(plan, scene, PointBackgrounds::even(2e-4), kHalfCode_mag);
    EXPECT_TRUE(plan.stars.twinkle);
    EXPECT_EQ(plan[Pass::kStars].reason, "some stars outshine the sky, and twinkle");
    EXPECT_NEAR(plan.stars.twinkle_limit_mag, kHalfCode_mag + 2.5 * std::log10(night::strongest_flicker(1e3)),
                1e-9);
    // Nothing is left of the air.
    scene.eye.height_m = 200e3;
    plan_stars(plan, scene, PointBackgrounds::even(2e-4), kHalfCode_mag);
    EXPECT_FALSE(plan.stars.twinkle);
    // No star is bright enough for a half code to come and go.
    scene.eye.height_m = 12e3;
    plan_stars(plan, scene, PointBackgrounds::even(2e-4), -0.5);
    EXPECT_TRUE(plan.needs(Pass::kStars));
    EXPECT_FALSE(plan.stars.twinkle);
}

TEST(Plan, AllStarsAreDrawnWhereThereIsNoEyeButNotWhatIsSwitchedOff) {
    Scene scene = make_scene(30, 180, 10, 0, 1000);
    Plan plan = plan_of(scene, fresh(scene));
    plan_all_stars(plan, scene);
    EXPECT_TRUE(plan.needs(Pass::kStars));
    EXPECT_FALSE(plan.stars.seen_only);
    EXPECT_GT(plan.stars.limit_mag, 8.0);
    scene.stars.intensity = 0.0;
    plan_all_stars(plan, scene);
    EXPECT_FALSE(plan.needs(Pass::kStars));
}

TEST(Plan, PlanetsCountAsStarsForTheDecision) {
    Scene scene = make_scene(5, 180, -10, 0, 0);
    const double background = 2000.0;
    Plan plan = plan_of(scene, fresh(scene));
    plan_stars(plan, scene, PointBackgrounds::even(background), kNone_mag);
    ASSERT_FALSE(plan.needs(Pass::kStars));
    scene.planets[1] = {tests::at(30, 200), -4.5, 0.8};
    plan_stars(plan, scene, PointBackgrounds::even(background), kNone_mag);
    EXPECT_TRUE(plan.needs(Pass::kStars));
    scene.planets[1].direction_enu = tests::at(-30, 200);
    plan_stars(plan, scene, PointBackgrounds::even(background), kNone_mag);
    EXPECT_FALSE(plan.needs(Pass::kStars));
    scene.planets[1].direction_enu = tests::at(30, 200);
    PointBackgrounds beside_the_sun = PointBackgrounds::even(background);
    beside_the_sun.planets_cd_m2[1] = 40.0 * background;
    plan_stars(plan, scene, beside_the_sun, kNone_mag);
    EXPECT_FALSE(plan.needs(Pass::kStars)) << "before its own sky it is not seen";
    scene.stars.enabled = false;
    plan_stars(plan, scene, PointBackgrounds::even(background), kNone_mag);
    EXPECT_FALSE(plan.needs(Pass::kStars));
}

TEST(Plan, LimitingMagnitudeFollowsThePublishedTwilightRow) {
    // Zenith luminances and limits of the twilight row: sun -3, -6, -12 deg give 1.6, 3.6, 5.5 mag.
    for (const auto& [background, limit] :
         {std::pair{20.0, 1.6}, std::pair{0.6, 3.6}, std::pair{1.2e-3, 5.5}})
        EXPECT_NEAR(faintest_visible_mag(background), limit, 0.6) << background;
}

TEST(Plan, LimitingMagnitudeFallsSmoothlyFromNightToDay) {
    double last = faintest_visible_mag(1e-6);
    for (double log_b = -6.0; log_b < 5.0; log_b += 0.001) {
        const double now = faintest_visible_mag(std::pow(10.0, log_b));
        EXPECT_LE(now, last) << log_b;
        EXPECT_GT(now, last - 0.01) << log_b;
        last = now;
    }
}

TEST(Plan, MoonlightsTheAirOnlyByNight) {
    EXPECT_EQ(plan_of(make_scene(10, 0, 40, 180, 0), {}).moon_share, 0.0);
    EXPECT_EQ(plan_of(make_scene(-10, 0, 40, 180, 0), {}).moon_share, 1.0);
    EXPECT_EQ(plan_of(make_scene(-30, 0, -20, 180, 0), {}).moon_share, 0.0);
    EXPECT_EQ(plan_of(make_scene(-30, 0, -20, 180, 0), {}).sun_share, 0.0);
    // Its table is on the way before its light counts.
    const Plan before = plan_of(make_scene(-2.5, 0, 40, 180, 0), {});
    EXPECT_TRUE(before.needs(Pass::kMoonSky));
    EXPECT_EQ(before.moon_share, 0.0);
}

TEST(Plan, DiscsBelowTheDippedHorizonAreDropped) {
    EXPECT_FALSE(plan_of(make_scene(-1, 0, -40, 180, 0), {}).needs(Pass::kSunDisc));
    EXPECT_TRUE(plan_of(make_scene(-1, 0, -40, 180, 12000), {}).needs(Pass::kSunDisc));
    // Lifted by 33' on the ground and by 62' at 11 km, where the apparent dip is 3.17 deg.
    EXPECT_TRUE(plan_of(make_scene(-0.8, 0, -40, 180, 0), {}).needs(Pass::kSunDisc));
    EXPECT_TRUE(plan_of(make_scene(-4.4, 0, -40, 180, 11e3), {}).needs(Pass::kSunDisc));
    EXPECT_FALSE(plan_of(make_scene(-4.6, 0, -40, 180, 11e3), {}).needs(Pass::kSunDisc));
    Scene airless = make_scene(-0.8, 0, -40, 180, 0);
    airless.air.model_enabled = false;
    EXPECT_FALSE(plan_of(airless, {}).needs(Pass::kSunDisc));
    Scene off = make_scene(20, 0, 20, 180, 0);
    off.sun.enabled = false;
    EXPECT_EQ(plan_of(off, {})[Pass::kSunDisc].reason, "switched off");
}

TEST(Plan, AtNoonNeitherStarsNorMoonlightAreDrawn) {
    const Scene noon = make_scene(60, 180, 20, 90, 1000);
    Plan plan = plan_of(noon, fresh(noon));
    plan_stars(plan, noon, PointBackgrounds::even(1500.0), -3.0);
    for (const Pass pass : {Pass::kStars, Pass::kMoonSky, Pass::kCorona})
        EXPECT_FALSE(plan.needs(pass)) << pass_name(pass);
}

TEST(Plan, StarsThatAddLessThanHalfACodeAreLeftOut) {
    Scene scene = make_scene(5, 180, -10, 0, 0);
    scene.planets[1] = {tests::at(30, 200), -4.5, 0.8};
    Plan plan = plan_of(scene, fresh(scene));
    plan_stars(plan, scene, PointBackgrounds::even(2000.0), -4.4);
    EXPECT_TRUE(plan.needs(Pass::kStars));
    plan_stars(plan, scene, PointBackgrounds::even(2000.0), -4.6);
    EXPECT_FALSE(plan.needs(Pass::kStars));
}

TEST(HalfCode, IsThatOfTheScreensCurveAlsoBelowItsBlack) {
    constexpr double kPixel_sr = 1e-6;
    constexpr double kSky_cd_m2 = 1e-5;
    for (const double reflected_cd_m2 : {0.0, 0.2, 1.0, 10.0}) {
        DisplaySettings display;
        display.max_luminance_cd_m2 = 100.0;
        display.reflected_cd_m2 = reflected_cd_m2;
        const shaders64::ToneParameters tone = eye::tone_parameters(display, 2e-4);
        const double sky = shaders64::display_linear(glm::dvec3{kSky_cd_m2}, tone).y;
        // sRGB: the codes about the sky's own, on the straight part of the curve.
        const double black = reflected_cd_m2 / 100.0;
        const double added = std::max(black, sky) - sky + 0.5 / 255.0 / 12.92;
        ASSERT_LT(std::max(sky - black, 0.0) + 0.5 / 255.0 / 12.92, 0.0031308);
        const double lux = added * 100.0 / tone.point_gain * 2.0 * std::numbers::pi * 0.49 * kPixel_sr;
        const double expected_mag = -2.5 * std::log10(lux / night::star_illuminance_lux(0.0));
        const double mag = half_code_mag(kSky_cd_m2, tone, kPixel_sr);
        std::printf("%4.1f cd/m2 reflected: half a code at %.2f mag\n", reflected_cd_m2, mag);
        EXPECT_NEAR(mag, expected_mag, 2e-3) << reflected_cd_m2;
    }
}

TEST(HalfCode, NoStarIsBrighterThanWhite) {
    shaders64::ToneParameters tone = eye::tone_parameters({}, 1e3);
    tone.shoulder = 1.0;
    EXPECT_EQ(half_code_mag(1e9, tone, 1e-6), -INFINITY);
    const Scene scene = make_scene(30, 180, 10, 0, 1000);
    Plan plan = plan_of(scene, fresh(scene));
    plan_stars(plan, scene, PointBackgrounds::even(2e-4), -INFINITY);
    EXPECT_FALSE(plan.needs(Pass::kStars));
}

TEST(StarField, WeatherInMotionIsNoReasonToTurnAllStars) {
    constexpr double kPixel_rad = 8e-4;
    Scene scene = make_scene(-30.0, 180.0, -30.0, 0.0, 1000.0);
    SkyFrame frame({}, {});
    StarField field;
    const auto changed = [&] {
        scene.time_s += 1.0 / 60.0;
        frame.prepare(scene, kPixel_rad);
        return field.update(scene, frame, kPixel_rad);
    };
    ASSERT_GT(changed(), 1000U);
    EXPECT_EQ(changed(), 0U);
    int rebuilt = 0;
    for (int i = 0; i < 60; ++i) {
        scene.air.visibility_m *= 0.9999;
        scene.air.humidity_pct += 0.01;
        scene.air.temperature_c += 1e-4;
        scene.air.pressure_hpa -= 1e-3;
        rebuilt += changed() > 0 ? 1 : 0;
    }
    std::printf("turned anew in %d of 60 frames\n", rebuilt);
    EXPECT_LE(rebuilt, 6);
    // The horizon is lifted by half a degree and more: a hundredth of it shows.
    scene.air.pressure_hpa -= 10.0;
    EXPECT_GT(changed(), 1000U);
    const double horizon_rad = 1.5 * tests::kDegree;
    const sky::RefractionRow row = tests::refraction_of(scene);
    const double lowest_rad =
        std::asin(static_cast<double>(std::min_element(field.stars().begin(), field.stars().end(),
                                                       [](const StarVertex& a, const StarVertex& b) {
                                                           return a.direction_enu.z < b.direction_enu.z;
                                                       })
                                          ->direction_enu.z));
    EXPECT_GT(lowest_rad, row.horizon_elevation_rad() - 1e-3);
    EXPECT_LT(lowest_rad, horizon_rad);
}

TEST(StarField, OnlyStarsThatTwinkleChangeWithTime) {
    constexpr double kPixel_rad = 8e-4;
    constexpr double kPixel_sr = 1e-3;  // too coarse for faint ones to show
    Scene scene = make_scene(-30.0, 180.0, -30.0, 0.0, 0.0);
    scene.sky.star_scintillation = true;
    SkyFrame frame({}, {});
    StarField field;
    frame.prepare(scene, kPixel_rad, kPixel_sr);
    const std::size_t all = field.update(scene, frame, kPixel_rad);
    ASSERT_EQ(all, field.stars().size());
    const std::vector<StarVertex> before(field.stars().begin(), field.stars().end());
    scene.time_s += 1.0 / 60.0;
    frame.prepare(scene, kPixel_rad, kPixel_sr);
    const std::size_t twinkling = field.update(scene, frame, kPixel_rad);
    std::printf("%zu of %zu stars twinkle\n", twinkling, all);
    EXPECT_GT(twinkling, 10U);
    EXPECT_LT(twinkling, all);
    ASSERT_EQ(field.stars().size(), all);
    EXPECT_NE(field.stars()[0].illuminance_lux, before[0].illuminance_lux);
    for (std::size_t i = twinkling; i < all; ++i)
        ASSERT_EQ(field.stars()[i].illuminance_lux, before[i].illuminance_lux) << i;
}

TEST(Plan, ForcedPassesRunAndSaySo) {
    const Scene noon = make_scene(60, 180, -20, 90, 1000);
    Quality quality;
    quality.forced.set();
    Plan plan = make_plan(noon, fresh(noon), tests::refraction_of(noon), quality);
    plan_stars(plan, noon, PointBackgrounds::even(1500.0), -3.0);
    for (const PlannedPass& pass : plan.passes)
        EXPECT_TRUE(pass.needed) << pass_name(pass.pass);
    EXPECT_EQ(plan[Pass::kStars].reason, "forced");
    EXPECT_EQ(plan[Pass::kDome].reason, "smooth light of all directions");
    EXPECT_EQ(plan.moon_share, 1.0);
}

TEST(Plan, WavesAreDrawnWhereThereAreSomeToSee) {
    Scene scene = make_scene(30, 180, -20, 0, 100);
    const auto planned = [](const Scene& s, bool lit = true) {
        Plan plan = plan_of(s, fresh(s));
        plan_waves(plan, s, sky::sea_waves(s, 8e-4), lit);
        return plan[Pass::kWaves];
    };
    EXPECT_EQ(planned(scene).reason, "there is no sea");
    scene.ground.kind = Ground::Kind::kSea;
    EXPECT_FALSE(planned(scene).needed) << "wind alone";
    tests::add_waves(scene);
    EXPECT_TRUE(planned(scene).needed);
    EXPECT_FALSE(planned(scene, false).needed);
    scene.eye.height_m = 400e3;
    EXPECT_FALSE(planned(scene).needed) << "too small to see";
}

TEST(Plan, SaysWhatIsThinnedOutAndWhatWouldHelp) {
    Scene scene = make_scene(-30, 180, -30, 0, 100);
    Quality quality;
    const auto planned = [&] {
        Plan plan = make_plan(scene, fresh(scene), sky::RefractionRow{}, quality);
        plan_stars(plan, scene, PointBackgrounds::even(2e-4), 9.0);
        plan_milky_way(plan, scene, 5.0);
        plan_glare(plan, Pass::kMoonGlare, true, 0.1);
        return plan;
    };
    const auto helps = [](const Plan& plan, Thin thin) {
        return thinnable(plan).test(static_cast<std::size_t>(thin));
    };
    const Plan whole = planned();
    EXPECT_TRUE(helps(whole, Thin::kMilkyWay) && helps(whole, Thin::kGlare));
    EXPECT_FALSE(helps(whole, Thin::kCloudRefresh) || helps(whole, Thin::kCloudTones) ||
                 helps(whole, Thin::kCloudShadows) || helps(whole, Thin::kPrecipitation) ||
                 helps(whole, Thin::kWaves));
    quality.thinned.set();
    const Plan thinned = planned();
    EXPECT_TRUE(thinnable(thinned).none());
    EXPECT_FALSE(thinned.needs(Pass::kMilkyWay) || thinned.needs(Pass::kMoonGlare));
    EXPECT_EQ(thinned[Pass::kMilkyWay].reason, "thinned out for the frame rate");
    EXPECT_EQ(thin_name(Thin::kCloudRefresh), "cloud-refresh");
    EXPECT_EQ(thin_name(Thin::kMilkyWay), "milky-way");
    EXPECT_EQ(thin_name(Thin::kCloudShadows), "cloud-shadows");
    EXPECT_EQ(thin_name(static_cast<Thin>(1)), "") << "of a thing that older recordings know";
}

TEST(Plan, DirectionTableGrowsWithTheBudget) {
    int last_columns = 1000;
    for (const double budget : {0.25, 0.5, 4.0}) {
        Quality quality;
        quality.error_codes = budget;
        const sky::SkyViewSize size = direction_table_size(quality);
        EXPECT_LT(size.columns, last_columns) << budget;
        last_columns = size.columns;
    }
    EXPECT_EQ(direction_table_size({}), sky::SkyViewSize{});
}

TEST(Plan, DomeKeepsItsSizeUntilItIsClearlyTooFine) {
    // The light of a night without a moon and a tone curve: what bends is the horizon alone.
    SkyLight light;
    DomeBend bend;
    bend.measure(light, eye::tone_parameters({}, 1e-3), 0.0, 1e-3);
    const auto sized = [&](const DomeSize& held, double error_codes) {
        Quality quality;
        quality.error_codes = error_codes;
        return plan_dome(bend, held, quality);
    };
    const DomeSize fine = sized(DomeBend::kLeast, 0.01);
    const DomeSize coarse = sized(DomeBend::kLeast, 0.02);
    ASSERT_GT(fine.columns + fine.sky_rows, coarse.columns + coarse.sky_rows);
    EXPECT_EQ(sized(coarse, 0.01), fine) << "it grows at once";
    EXPECT_EQ(sized(fine, 0.011), fine) << "it stays while it is hardly too fine";
    const DomeSize shrunk = sized(fine, 4.0);
    EXPECT_LT(shrunk.sky_rows, fine.sky_rows);
}

TEST(Plan, ScreensThatAreWarpedResampledOrBlendedAskForTheirPasses) {
    Plan plan = plan_of(tests::four_times().front().scene, {});
    for (const Pass pass : {Pass::kWarp, Pass::kResampling, Pass::kBlend})
        EXPECT_FALSE(plan.needs(pass)) << pass_name(pass);
    const auto screen = tests::identity_warp(64, 48);
    std::vector<Channel> rig{{"flat", 64, 48}, {"curved", 64, 48}, {"deferred", 64, 48}};
    rig[1].warp = rig[2].warp = screen;
    plan_screens(plan, rig);
    EXPECT_TRUE(plan.needs(Pass::kWarp));
    EXPECT_FALSE(plan.needs(Pass::kResampling));
    rig[2].drawing = WarpDrawing::kResampled;
    rig[0].blend = std::make_shared<const warp::Blend>();
    plan_screens(plan, rig);
    EXPECT_TRUE(plan.needs(Pass::kWarp));
    EXPECT_TRUE(plan.needs(Pass::kResampling));
    EXPECT_TRUE(plan.needs(Pass::kBlend));
    EXPECT_EQ(plan[Pass::kBlend].cost, Cost::kChannel);
}

TEST(Plan, EveryPassSaysWhy) {
    for (const auto& named : tests::four_times()) {
        Plan plan = plan_of(named.scene, {});
        plan_stars(plan, named.scene, PointBackgrounds::even(1.0), kNone_mag);
        for (std::size_t i = 0; i < kPassCount; ++i) {
            EXPECT_EQ(static_cast<std::size_t>(plan.passes[i].pass), i);
            EXPECT_FALSE(plan.passes[i].reason.empty()) << pass_name(plan.passes[i].pass);
        }
    }
}

}  // namespace
}  // namespace skyig::render
