// Drops on a pane against what rain brings and physics lets them do.
#include "render/precipitation/windscreen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "render/precipitation/fall.h"
#include "tests/render/scenes.h"

namespace skyig::render::precipitation {
namespace {

using namespace render::tests;

constexpr double kFrame_s = 1.0 / 30.0;

Scene rain(double rate_mm_h, double speed_m_s) {
    Scene scene = make_scene(30.0, 180.0, -30.0, 0.0, 300.0);
    scene.weather.precipitations[0] = {Precipitation::Kind::kRain, rate_mm_h, 3000.0};
    scene.weather.precipitation_count = rate_mm_h > 0.0 ? 1 : 0;
    scene.weather.eye_velocity_m_s = {0.0, speed_m_s, 0.0};
    add_view(scene, symmetric_frustum(30.0, 1280, 1024), view_from_enu(0.0, 0.0, 0.0));
    scene.views[0].windscreen_m = 0.8F;
    return scene;
}

double area_m2(const Scene& scene) {
    const ImagePlane p = image_plane(scene.views[0].frustum);
    return 0.64 * (p.right - p.left) * (p.top - p.bottom);
}

double covered(const Windscreen& pane, const Scene& scene) {
    double sum_m2 = 0.0;
    for (const Windscreen::Drop& drop : pane.drops())
        sum_m2 += drop.there * std::numbers::pi * drop.radius_m * drop.radius_m;
    return sum_m2 / area_m2(scene);
}

void run(Windscreen& pane, Scene& scene, double seconds) {
    for (int i = 0; i <= static_cast<int>(std::lround(seconds / kFrame_s)); ++i) {
        pane.advance(scene, scene.views[0]);
        scene.time_s += kFrame_s;
    }
}

// Marshall and Palmer's drops of more than 1.5 mm, by their fall and a cap of 40 degrees, integrated.
double covered_a_second(double rate_mm_h) {
    const double slope = 4.1 * std::pow(rate_mm_h, -0.21);
    const double fall_m_s = fall_speed_m_s(Precipitation::Kind::kRain, rate_mm_h, 300.0);
    const double towards_m_s = fall_m_s * std::numbers::sqrt2 / 2.0;
    double sum = 0.0;
    for (double d = 1.505; d < 9.0; d += 0.01) {
        const double c = std::cos(40.0 * kDegree), s = std::sin(40.0 * kDegree);
        const double volume_share = (2.0 - 3.0 * c + c * c * c) / (3.0 * s * s * s);
        const double seen = std::min(d, 6.0);
        const double radius_m = 1e-3 * seen * std::cbrt(1.0 / (6.0 * volume_share));
        sum += 0.01 * 8000.0 * std::exp(-slope * d) * towards_m_s * std::numbers::pi * radius_m * radius_m;
    }
    return sum;
}

TEST(Windscreen, IsCoveredAsRainHitsItUntilDropsRun) {
    for (const double rate_mm_h : {1.0, 2.0, 5.0}) {
        double mean = 0.0;
        for (std::uint64_t seed = 0; seed < 8; ++seed) {
            Scene scene = rain(rate_mm_h, 0.0);
            Windscreen pane(seed);
            run(pane, scene, 4.0);
            mean += covered(pane, scene) / 8.0;
        }
        // A fade's half is missing.
        const double wanted = covered_a_second(rate_mm_h) * (4.0 - 0.5 * Windscreen::kFade_s);
        std::printf("%.0f mm/h for 4 s: %.3f %% covered, by the drops that hit it %.3f %%\n", rate_mm_h,
                    100.0 * mean, 100.0 * wanted);
        EXPECT_NEAR(mean / wanted, 1.0, 0.12);
    }
}

TEST(Windscreen, IsCoveredMoreInHarderRainAndLessAtSpeed) {
    double before = 0.0;
    for (const double rate_mm_h : {0.5, 2.0, 50.0}) {
        Scene scene = rain(rate_mm_h, 0.0);
        Windscreen pane;
        run(pane, scene, 25.0);
        double now = 0.0;
        for (int i = 0; i < 5; ++i) {
            run(pane, scene, 1.0);
            now += covered(pane, scene) / 5.0;
        }
        std::printf("%4.1f mm/h for half a minute: %.2f %% covered\n", rate_mm_h, 100.0 * now);
        EXPECT_GT(now, before);
        before = now;
    }
    EXPECT_LT(before, 0.3);
    Scene fast = rain(50.0, 70.0);
    Windscreen pane;
    run(pane, fast, 5.0);
    const double at_speed = covered(pane, fast);
    std::printf("50 mm/h at 70 m/s: %.2f %%\n", 100.0 * at_speed);
    EXPECT_GT(at_speed, 0.0);
    EXPECT_LT(at_speed, before);
    // Without rain they go.
    Scene dry = fast;
    dry.weather.precipitation_count = 0;
    run(pane, dry, 60.0);
    EXPECT_TRUE(pane.dry());
}

TEST(Windscreen, DropsRunDownAtRestAndUpInFlightAndNeverJump) {
    for (const double speed_m_s : {0.0, 70.0}) {
        Scene scene = rain(20.0, speed_m_s);
        Windscreen pane;
        run(pane, scene, 8.0);
        double along_m = 0.0, fastest_m = 0.0, fade = 0.0;
        for (int frame = 0; frame < 150; ++frame) {
            const std::vector<Windscreen::Drop> before(pane.drops().begin(), pane.drops().end());
            run(pane, scene, 0.0);
            for (std::size_t i = 0; i < before.size(); ++i) {
                const Windscreen::Drop& was = before[i];
                const Windscreen::Drop& is = pane.drops()[i];
                // One that goes may have left its place to another.
                fade = std::max(fade, std::abs(is.there - was.there));
                if (!(was.there > 0.0) || was.goes) continue;
                along_m += is.at_m.y - was.at_m.y;
                fastest_m = std::max(fastest_m, glm::distance(is.at_m, was.at_m));
            }
        }
        std::printf(
            "%.0f m/s: drops run %+.2f m in all, %.1f mm a frame at most; come and go by %.2f a frame\n",
            speed_m_s, along_m, 1e3 * fastest_m, fade);
        EXPECT_LT(fade, 0.6);
        EXPECT_LE(fastest_m, 1.001 * kFrame_s * Windscreen::kFastest_m_s);
        EXPECT_TRUE(speed_m_s > 0.0 ? along_m > 0.1 : along_m < -0.1);
    }
}

TEST(Windscreen, IsTheSameOnReplayAndStandsWithTheClock) {
    Windscreen one(3), two(3), other(4);
    for (Windscreen* pane : {&one, &two, &other}) {
        Scene scene = rain(10.0, 30.0);
        run(*pane, scene, 5.0);
    }
    const auto same = [](const Windscreen::Drop& a, const Windscreen::Drop& b) {
        return a.at_m == b.at_m && a.radius_m == b.radius_m && a.there == b.there;
    };
    const auto first = one.drops();
    EXPECT_TRUE(std::equal(first.begin(), first.end(), two.drops().begin(), same));
    EXPECT_FALSE(std::equal(first.begin(), first.end(), other.drops().begin(), same));
}

}  // namespace
}  // namespace skyig::render::precipitation
