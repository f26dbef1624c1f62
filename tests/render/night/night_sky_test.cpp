// When the dark sky's table is built, and in how many slices.
#include "render/night/night_sky.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "render/plan.h"
#include "tests/render/scenes.h"

namespace skyig::render::night {
namespace {

using namespace render::tests;

constexpr int kTableFrames =
    (NightSky::kSkyRows + NightSky::kGroundRows + NightSky::kRowsAFrame - 1) / NightSky::kRowsAFrame;
constexpr int kTownFrames = (LightDome::kRows + NightSky::kTownRowsAFrame - 1) / NightSky::kTownRowsAFrame;

const sky::AirTables& clear_air() {
    static const sky::AirTables air(sky::air_model(Scene{}.air, Scene{}.ground), sky::Orders::kFirst);
    return air;
}

Scene sun_at(double elevation_deg) {
    return make_scene(elevation_deg, 0.0, -40.0, 180.0, 300.0);
}

Scene among_towns() {
    Scene scene = sun_at(-40.0);
    scene.night.city_count = kMaxCities;
    for (std::size_t i = 0; i < kMaxCities; ++i)
        scene.night.cities[i] = {0.1 * static_cast<double>(i), 0.3, 5e3, 0.0, 1e5};
    return scene;
}

// A frame that does more than its slice would be fewer of them.
int frames_until_new(NightSky& night, const Scene& scene) {
    for (int frame = 1; frame < 200; ++frame) {
        if (night.update(scene, clear_air())) return frame;
    }
    return 0;
}

double green(const NightSky& night) {
    return static_cast<double>(night.sky_rgb(0.2, 0.5).y);
}

TEST(NightSky, AStaleHeightIsMendedInSlicesTownAfterTown) {
    NightSky night;
    Scene scene = among_towns();
    ASSERT_TRUE(night.update(scene, clear_air())) << "the first is built at once";
    ASSERT_FALSE(night.update(scene, clear_air()));
    scene.eye.height_m += 0.8 * LightDome::height_step_m(300.0);
    EXPECT_EQ(frames_until_new(night, scene), 1 + kTableFrames) << "the towns' own tables still serve";
    scene.eye.height_m += 0.8 * LightDome::height_step_m(300.0);
    const int frames = frames_until_new(night, scene);
    std::printf("%d frames with eight towns, %d without\n", frames, 1 + kTableFrames);
    EXPECT_EQ(frames, 1 + static_cast<int>(kMaxCities) * kTownFrames + kTableFrames);
    NightSky whole;
    whole.build(scene, clear_air());
    EXPECT_EQ(green(night), green(whole));
}

TEST(NightSky, IsBuiltBeforeItCounts) {
    const Plan plan = make_plan(sun_at(-2.5), {}, refraction_of(sun_at(-2.5)));
    EXPECT_TRUE(plan.needs(Pass::kNightSky));
    EXPECT_EQ(plan.night_share, 0.0);
    EXPECT_FALSE(make_plan(sun_at(-1.9), {}, refraction_of(sun_at(-1.9))).needs(Pass::kNightSky));

    NightSky night;
    EXPECT_EQ(frames_until_new(night, sun_at(-2.5)), 1 + kTableFrames);
    EXPECT_GT(night_share(-3.1 * kDegree), 0.0);
    EXPECT_FALSE(night.update(sun_at(-3.1), clear_air())) << "a table was there";
    EXPECT_GT(green(night), 0.0);
}

TEST(NightSky, IsFinishedAtOnceWhereDarknessFallsSooner) {
    NightSky night;
    EXPECT_FALSE(night.update(sun_at(-2.9), clear_air()));
    EXPECT_FALSE(night.update(sun_at(-2.95), clear_air()));
    EXPECT_TRUE(night.update(sun_at(-3.05), clear_air()));
    EXPECT_GT(green(night), 0.0);
    // Nor does the last night's serve the next.
    Scene later = sun_at(-2.9);
    later.stars.enu_from_gcrs = glm::transpose(later.stars.enu_from_gcrs);
    EXPECT_FALSE(night.update(later, clear_air()));
    later.sun.direction_enu = at(-3.05, 0.0);
    EXPECT_TRUE(night.update(later, clear_air()));
}

TEST(NightSky, ABuiltTableIsTheScenesAlone) {
    NightSky night, fresh;
    Scene scene = among_towns();
    night.build(scene, clear_air());
    scene.eye.height_m += 5.0;
    night.build(scene, clear_air());
    fresh.build(scene, clear_air());
    EXPECT_EQ(green(night), green(fresh));
}

}  // namespace
}  // namespace skyig::render::night
