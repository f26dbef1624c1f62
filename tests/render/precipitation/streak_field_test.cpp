// Streaks in space: where they come from, how much they cover, and that time alone moves them.
#include "render/precipitation/streak_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

#include "render/precipitation/extinction.h"
#include "render/precipitation/fall.h"

namespace skyig::render::precipitation {
namespace {

using Kind = Precipitation::Kind;

Scene falling_scene(Kind kind, double rate_mm_h) {
    Scene scene;
    scene.eye = {47.0, 10.0, 800.0};
    scene.weather.precipitations[0] = {kind, rate_mm_h, 2000.0};
    scene.weather.precipitation_count = 1;
    scene.weather.wind_m_s = {3.0, -2.0, 0.5};
    return scene;
}

std::vector<Streak> streaks_of(const StreakField& field) {
    std::vector<Streak> all;
    for (const auto& group : field.groups())
        all.insert(all.end(), group.streaks.begin(), group.streaks.end());
    return all;
}

bool same(const std::vector<Streak>& a, const std::vector<Streak>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Streak)) == 0;
}

glm::vec3 middle(const Streak& streak) {
    return 0.5F * (streak.head_enu_m + streak.tail_enu_m);
}

TEST(StreakField, IsEmptyWhereNothingFalls) {
    StreakField field;
    Scene scene = falling_scene(Kind::kRain, 0.0);
    field.update(scene);
    EXPECT_TRUE(field.groups().empty());
    scene.weather.precipitations[0] = {Kind::kRain, 5.0, 700.0};
    field.update(scene);
    EXPECT_TRUE(field.groups().empty()) << "the eye is above it";
    scene.weather.precipitations[0].top_m = 801.0;
    field.update(scene);
    ASSERT_EQ(field.groups().size(), 1U);
    for (const Streak& streak : streaks_of(field))
        EXPECT_LE(middle(streak).z, 1.0F);
}

TEST(StreakField, LiesAlongTheRelativeWindAsLongAsTheExposureMakesIt) {
    StreakField field;
    for (const double speed_m_s : {0.0, 70.0, 130.0}) {
        Scene scene = falling_scene(Kind::kRain, 10.0);
        scene.weather.eye_velocity_m_s = {0.6 * speed_m_s, 0.8 * speed_m_s, -3.0};
        field.update(scene);
        const double fall = fall_speed_m_s(Kind::kRain, 10.0, 800.0);
        const glm::dvec3 way_m{(3.0 - 0.6 * speed_m_s) / 30.0, (-2.0 - 0.8 * speed_m_s) / 30.0,
                               (0.5 + 3.0 - fall) / 30.0};
        const std::vector<Streak> streaks = streaks_of(field);
        EXPECT_GT(streaks.size(), 500U);
        for (const Streak& streak : streaks) {
            const glm::dvec3 off = glm::dvec3{streak.head_enu_m - streak.tail_enu_m} - way_m;
            ASSERT_LT(glm::length(off), 2e-5);
        }
        std::printf("%3.0f m/s: %zu streaks of %.2f m\n", speed_m_s, streaks.size(), glm::length(way_m));
    }
}

// The share of all directions that rods cover, by their own shape: in the mean as much as the shells' drops
// dim, where shells pass into each other less.
TEST(StreakField, CoversAsMuchOfTheViewAsTheDropsDim) {
    StreakField field;
    Scene scene = falling_scene(Kind::kRain, 0.03);
    scene.weather.wind_m_s = {60.0, 10.0, 0.0};
    double covered_sr = 0.0;
    constexpr int kFrames = 20;
    for (int i = 0; i < kFrames; ++i) {
        scene.time_s += 0.7;
        field.update(scene);
        for (const Streak& streak : streaks_of(field)) {
            const double distance_m = glm::length(middle(streak));
            const double width_rad = 2.0 * static_cast<double>(streak.half_width_m) / distance_m;
            const double length_rad =
                std::atan2(glm::length(glm::cross(streak.head_enu_m, streak.tail_enu_m)),
                           glm::dot(streak.head_enu_m, streak.tail_enu_m));
            covered_sr += static_cast<double>(streak.opacity) * width_rad *
                          (length_rad + 0.25 * M_PI * width_rad) / kFrames;
        }
    }
    // Of the shells' depth, what their soft ends leave: the mean of rise(1, 1.3) (1 - rise(1.7, 2))
    // over 1..2.
    constexpr double kWhole = 0.7;
    const double dimmed = rain_extinction_per_m(0.03) * 30.0 * kWhole;
    std::printf("covered %.5f of the view, dimmed %.5f\n", covered_sr / (4.0 * M_PI), dimmed);
    EXPECT_NEAR(covered_sr / (4.0 * M_PI) / dimmed, 1.0, 0.1);
}

TEST(StreakField, MovesByTimeAndWindAndByTheEyesOwnWay) {
    for (const Kind kind : {Kind::kRain, Kind::kHail}) {
        StreakField field;
        Scene scene = falling_scene(kind, 10.0);
        field.update(scene);
        const std::vector<Streak> before = streaks_of(field);
        constexpr double kStep_s = 0.01;
        scene.time_s += kStep_s;
        constexpr double kNorth_m = 0.3;
        scene.eye.latitude_deg += kNorth_m / 111170.0;  // a degree of the meridian at 47 N
        field.update(scene);
        const std::vector<Streak> after = streaks_of(field);
        const double fall = fall_speed_m_s(kind, 10.0, 800.0);
        const glm::vec3 moved{kStep_s * 3.0, kStep_s * -2.0 - kNorth_m, kStep_s * (0.5 - fall)};
        int found = 0;
        int sought = 0;
        for (std::size_t i = 0; i < before.size(); i += 37) {
            const float far = glm::length(middle(before[i]));
            if (std::fmod(std::log2(far), 1.0F) < 0.2F || std::fmod(std::log2(far), 1.0F) > 0.8F) continue;
            ++sought;
            found += std::any_of(after.begin(), after.end(), [&](const Streak& streak) {
                return glm::distance(middle(streak), middle(before[i]) + moved) < 2e-3F;
            });
        }
        EXPECT_GT(sought, 4);
        EXPECT_EQ(found, sought);
    }
}

TEST(StreakField, StandsWhileTimeAndEyeStandAndIsTheSameForTwo) {
    StreakField one;
    StreakField two;
    Scene scene = falling_scene(Kind::kSnow, 2.0);
    scene.weather.eye_velocity_m_s = {70.0, 0.0, 0.0};
    for (int i = 0; i < 200; ++i) {
        scene.time_s += 1.0 / 30.0;
        one.update(scene);
        two.update(scene);
    }
    const std::vector<Streak> held = streaks_of(one);
    EXPECT_TRUE(same(held, streaks_of(two)));
    one.update(scene);
    EXPECT_TRUE(same(held, streaks_of(one)));
    scene.time_s += 1.0 / 30.0;
    one.update(scene);
    EXPECT_FALSE(same(held, streaks_of(one)));
}

// A day of fall and wind, then the same steps as a field that has just begun: rounding has not crept in.
TEST(StreakField, IsAsExactAfterADay) {
    StreakField field;
    Scene scene = falling_scene(Kind::kHail, 1.0);
    constexpr double kStep_s = 4.0;
    for (scene.time_s = 0.0; scene.time_s < 86400.0; scene.time_s += kStep_s)
        field.update(scene);
    const std::vector<Streak> late = streaks_of(field);
    // Where one step of the whole day would have brought it, in wide numbers.
    const double fall = fall_speed_m_s(Kind::kHail, 1.0, 800.0);
    const auto carried = [&](double speed_m_s) {
        const long double way_m = static_cast<long double>(speed_m_s) * (86400.0L - 4.0L);
        return static_cast<double>(way_m - 64.0L * std::floor(way_m / 64.0L));
    };
    Scene fresh = falling_scene(Kind::kHail, 1.0);
    StreakField young;
    young.update(fresh);
    // One more second with that way in it.
    fresh.weather.wind_m_s = {carried(3.0), carried(-2.0), carried(0.5 - fall) + fall};
    fresh.time_s = 1.0;
    young.update(fresh);
    const std::vector<Streak> now = streaks_of(young);
    int sought = 0;
    int found = 0;
    for (std::size_t i = 0; i < late.size(); ++i) {
        if (glm::length(middle(late[i])) < 5.0F || glm::length(middle(late[i])) > 13.0F) continue;
        ++sought;
        found += std::any_of(now.begin(), now.end(), [&](const Streak& streak) {
            return glm::distance(middle(streak), middle(late[i])) < 1e-3F;
        });
    }
    // Streaks of the strong wind are longer, thus fewer: each that is left stands where it should.
    EXPECT_GT(sought, 10);
    EXPECT_GT(found, sought / 5);
}

TEST(StreakField, KeepsWithinItsRoomAndFinite) {
    StreakField field;
    Scene scene = falling_scene(Kind::kRain, 500.0);
    std::size_t i = 0;
    for (const Kind kind : {Kind::kRain, Kind::kDrizzle, Kind::kSnow, Kind::kSleet, Kind::kHail})
        scene.weather.precipitations[i++] = {kind, 500.0, 2000.0};
    scene.weather.precipitation_count = i;
    for (const double speed_m_s : {0.0, 1.0, 30.0, 900.0}) {
        scene.weather.eye_velocity_m_s = {speed_m_s, 0.0, 0.0};
        scene.time_s += 0.03;
        field.update(scene);
        EXPECT_EQ(field.groups().size(), 5U);
        for (const Streak& streak : streaks_of(field)) {
            ASSERT_TRUE(std::isfinite(glm::dot(streak.head_enu_m, streak.tail_enu_m)));
            ASSERT_GT(streak.opacity, 0.0F);
            ASSERT_LE(streak.opacity, 1.0F);
        }
    }
}

}  // namespace
}  // namespace skyig::render::precipitation
