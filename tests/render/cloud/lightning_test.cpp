// Lightning: the same for all who ask, as often as told, where its cloud is.
#include "render/cloud/lightning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "render/geometry.h"

namespace skyig::render::cloud {
namespace {

Scene stormy_scene(double flashes_per_min) {
    Scene scene;
    scene.eye = {48.0, 11.0, 500.0};
    scene.weather.clouds[0].genus = CloudGenus::kCumulus;
    scene.weather.clouds[1].genus = CloudGenus::kCumulonimbus;
    scene.weather.clouds[1].base_m = 1200.0;
    scene.weather.clouds[1].thickness_m = 8000.0;
    scene.weather.cloud_count = 2;
    scene.weather.lightnings[0] = {1, flashes_per_min, 77};
    scene.weather.lightning_count = 1;
    return scene;
}

double all_cd(const Flashes& flashes) {
    double sum = 0.0;
    for (const Flash& flash : flashes.all())
        sum += flash.intensity_cd;
    return sum;
}

TEST(Lightning, IsDarkWithoutRateLayerOrTime) {
    for (double t = 0.0; t < 600.0; t += 0.1) {
        Scene scene = stormy_scene(0.0);
        scene.time_s = t;
        EXPECT_EQ(flashes_at(scene).count, 0U);
        scene = stormy_scene(60.0);
        scene.time_s = t;
        scene.weather.lightnings[0].layer = 2;
        EXPECT_EQ(flashes_at(scene).count, 0U);
    }
    Scene scene = stormy_scene(60.0);
    for (const double t :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
        scene.time_s = t;
        EXPECT_EQ(flashes_at(scene).count, 0U);
    }
}

// Flashes are counted where their light begins, over a simulated while.
TEST(Lightning, ComesAsOftenAsTold) {
    for (const double rate : {2.0, 12.0, 60.0}) {
        Scene scene = stormy_scene(rate);
        constexpr double kStep_s = 0.3;
        const double hours = 60.0 / rate;
        int begun = 0;
        std::size_t before = 0;
        std::array<glm::dvec3, Flashes::kMost> places{};
        for (double t = 0.0; t < hours * 3600.0; t += kStep_s) {
            scene.time_s = t;
            const Flashes now = flashes_at(scene);
            for (const Flash& flash : now.all()) {
                begun += std::find(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(before),
                                   flash.place_m) == places.begin() + static_cast<std::ptrdiff_t>(before);
            }
            before = now.count;
            for (std::size_t i = 0; i < before; ++i)
                places[i] = now.flashes[i].place_m;
        }
        const double wanted = rate * 60.0 * hours;
        std::printf("%.0f a minute: %d of %.0f\n", rate, begun, wanted);
        EXPECT_NEAR(begun, wanted, 4.0 * std::sqrt(wanted));
    }
}

TEST(Lightning, OfOneMomentIsTheSameWhateverWasAskedBefore) {
    Scene scene = stormy_scene(40.0);
    int lit = 0;
    for (int i = 0; i < 2000; ++i) {
        scene.time_s = 1e6 + 7.013 * ((i * 7919) % 2000);  // back and forth
        const Flashes once = flashes_at(scene);
        const Flashes again = flashes_at(scene);
        ASSERT_EQ(once.count, again.count);
        EXPECT_TRUE(std::equal(once.all().begin(), once.all().end(), again.all().begin()));
        lit += once.count > 0;
    }
    EXPECT_GT(lit, 100);
    // Another seed has other flashes.
    Scene other = scene;
    other.weather.lightnings[0].seed = 78;
    int unlike = 0;
    for (int i = 0; i < 500; ++i) {
        scene.time_s = other.time_s = 0.5 * i;
        unlike += all_cd(flashes_at(scene)) != all_cd(flashes_at(other));
    }
    EXPECT_GT(unlike, 50);
}

TEST(Lightning, IsTheSameWhereverItsLayerStandsAmongTheOthers) {
    Scene second = stormy_scene(12.0);
    Scene first = second;
    first.weather.clouds[0] = second.weather.clouds[1];
    first.weather.cloud_count = 1;
    first.weather.lightnings[0].layer = 0;
    int lit = 0;
    for (int i = 0; i < 6000; ++i) {
        first.time_s = second.time_s = 0.1 * i;
        const Flashes here = flashes_at(first);
        const Flashes there = flashes_at(second);
        ASSERT_EQ(here.count, there.count);
        for (std::size_t k = 0; k < here.count; ++k) {
            EXPECT_EQ(here.flashes[k].place_m, there.flashes[k].place_m);
            EXPECT_EQ(here.flashes[k].intensity_cd, there.flashes[k].intensity_cd);
            EXPECT_EQ(here.flashes[k].layer, 0U);
            EXPECT_EQ(there.flashes[k].layer, 1U);
        }
        lit += here.count > 0;
    }
    EXPECT_GT(lit, 500);
}

TEST(Lightning, StandsStillOnTheEarthInItsCloudWithinReach) {
    Scene scene = stormy_scene(60.0);
    Scene moved = scene;
    moved.eye.latitude_deg += 100.0 / 111200.0;
    int seen = 0;
    double farthest_m = 0.0;
    for (int i = 0; i < 1500; ++i) {
        scene.time_s = moved.time_s = 0.37 * i;
        const Flashes here = flashes_at(scene);
        const Flashes there = flashes_at(moved);
        for (std::size_t k = 0; k < std::min(here.count, there.count); ++k) {
            const glm::dvec3 place = here.flashes[k].place_m;
            farthest_m = std::max({farthest_m, std::abs(place.x), std::abs(place.y)});
            EXPECT_GE(place.z + 500.0, 1200.0);
            EXPECT_LE(place.z + 500.0, 9200.0);
            if (std::abs(place.y) > 29e3) continue;  // another image of it may be the nearer one
            EXPECT_NEAR(there.flashes[k].place_m.y - place.y, -100.0, 1.0);
            // Parallels close to the north.
            EXPECT_NEAR(there.flashes[k].place_m.x, place.x, 4.4);
            ++seen;
        }
    }
    EXPECT_GT(seen, 500);
    EXPECT_LE(farthest_m, 30e3);
    EXPECT_GT(farthest_m, 29e3);
}

TEST(Lightning, KeepsToItsArea) {
    Scene scene = stormy_scene(60.0);
    WeatherArea& area = scene.weather.clouds[1].area.emplace();
    area.centre_m = {40e3, -10e3};
    area.axis_rad = 0.5;
    area.half_size_m = {6e3, 0.0};
    area.corner_radius_m = 2e3;
    double longest = 0.0;
    double widest = 0.0;
    for (int i = 0; i < 4000; ++i) {
        scene.time_s = 0.29 * i;
        const auto flashes = flashes_at(scene);
        for (const Flash& flash : flashes.all()) {
            const glm::dvec2 off = glm::dvec2{flash.place_m} - area.centre_m;
            // Its own x axis, clockwise from north.
            const double along = std::abs(off.x * std::sin(0.5) + off.y * std::cos(0.5));
            const double across = std::abs(off.x * std::cos(0.5) - off.y * std::sin(0.5));
            EXPECT_LE(std::hypot(std::max(along - 6e3, 0.0), across), 2001.0);
            longest = std::max(longest, along);
            widest = std::max(widest, across);
        }
    }
    EXPECT_GT(longest, 7e3);
    EXPECT_GT(widest, 1.9e3);
}

// Light as photographs of flashes have it: it rises within frames, flickers, and is over in time.
TEST(Lightning, FlickersWithoutAStep) {
    Scene scene = stormy_scene(1.0);
    double before = 0.0;
    double brightest = 0.0;
    int peaks = 0;
    int flashes = 0;
    double lit_s = 0.0;
    bool rising = false;
    constexpr double kStep_s = 0.001;
    double largest_step = 0.0;
    for (double t = 0.0; t < 1200.0; t += kStep_s) {
        scene.time_s = t;
        const double now = all_cd(flashes_at(scene));
        flashes += before == 0.0 && now > 0.0;
        lit_s += now > 0.0 ? kStep_s : 0.0;
        if (now < before && rising) ++peaks;
        if (now != before) rising = now > before;
        largest_step = std::max(largest_step, std::abs(now - before));
        brightest = std::max(brightest, now);
        before = now;
    }
    const double steepest = largest_step / brightest;
    std::printf("%d flashes, %.1f strokes each, %.2f s each, brightest %.2e cd, largest step in 1 ms %.3f\n",
                flashes, static_cast<double>(peaks) / flashes, lit_s / flashes, brightest, steepest);
    EXPECT_GT(flashes, 8);
    EXPECT_GE(static_cast<double>(peaks) / flashes, 2.5);
    EXPECT_LE(static_cast<double>(peaks) / flashes, 5.0);
    EXPECT_LT(lit_s / flashes, 1.01 * kLongestFlash_s);
    // A stroke rises over 8 ms.
    EXPECT_LT(steepest, 0.15);
}

TEST(Lightning, LightsCloudByTheSquareOfTheDistanceAndByWhatIsBetween) {
    Flash flash;
    flash.place_m = {1000.0, 2000.0, 3000.0};
    flash.intensity_cd = 1e8;
    const auto at = [&](double away_m, double depth) {
        return static_cast<double>(
            flash_on_cloud_cd_m2(flash, flash.place_m + glm::dvec3{0.0, away_m, 0.0}, depth, 0.85).y);
    };
    EXPECT_NEAR(at(500.0, 0.0) / at(1000.0, 0.0), 4.0, 1e-4);
    EXPECT_NEAR(at(1000.0, 10.0) / at(1000.0, 0.0), std::exp(-1.5), 1e-4);
    EXPECT_NEAR(at(1000.0, 0.0), 1e8 / 1e6 / M_PI, 0.02 * 1e8 / 1e6 / M_PI);
    EXPECT_EQ(at(0.0, 0.0), at(150.0, 0.0));
    EXPECT_EQ(at(kFlashReach_m, 0.0), 0.0);
    EXPECT_GE(at(kFlashReach_m - 1.0, 0.0), 0.0);
    EXPECT_LT(at(kFlashReach_m - 10.0, 0.0), 1e-4 * at(3000.0, 0.0));
}

TEST(Lightning, LightsGroundAndAirMoreTheNearerItIs) {
    Scene scene = stormy_scene(1.0);
    Flashes flashes;
    flashes.count = 1;
    flashes.flashes[0] = {{0.0, 0.0, 3000.0}, 1e8, 1};
    const FlashLight over = light_of(flashes, scene, 1e-4);
    EXPECT_NEAR(over.ground_lux.y, 1e8 / (3500.0 * 3500.0), 0.02 * 1e8 / (3500.0 * 3500.0));
    EXPECT_GT(over.sky_cd_m2.z, over.sky_cd_m2.x);
    flashes.flashes[0].place_m.x = 10e3;
    const FlashLight beside = light_of(flashes, scene, 1e-4);
    EXPECT_NEAR(beside.ground_lux.y / over.ground_lux.y, std::pow(3.5 / std::hypot(3.5, 10.0), 3.0), 1e-4);
    EXPECT_LT(beside.sky_cd_m2.y, over.sky_cd_m2.y);
    EXPECT_GT(beside.sky_cd_m2.y, 0.0F);
    EXPECT_EQ(light_of(flashes, scene, 0.0).sky_cd_m2, glm::vec3{0.0F});
    EXPECT_EQ(light_of({}, scene, 1e-4), FlashLight{});
}

}  // namespace
}  // namespace skyig::render::cloud
