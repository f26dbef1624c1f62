// Refraction against rays traced step by step, and the rules that every picture relies on.
#include "render/sky/refraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>

#include "render/geometry.h"

namespace skyig::render::sky {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kArcminute = kDegree / 60.0;
constexpr double kArcsecond = kDegree / 3600.0;

const Refraction& refraction() {
    static const Refraction table;
    return table;
}

RefractionRow standard(double height_m) {
    return refraction().at(height_m, 1013.25, 15.0);
}

// The ray equation d(n t)/ds = grad n in the plane of the ray, by Runge and Kutta: position and n times the
// direction, in metres from the Earth's centre.
struct Ray {
    glm::dvec2 place;
    glm::dvec2 momentum;
};

class Tracer {
  public:
    explicit Tracer(double strength) : strength_(strength) {}

    /// How far the ray is turned on its way out of the air; not a number when it meets the ground.
    [[nodiscard]] double bending_rad(double height_m, double elevation_rad) const {
        const glm::dvec2 direction{std::cos(elevation_rad), std::sin(elevation_rad)};
        Ray ray{{0.0, kEarthRadius_m + height_m}, direction * index(height_m)};
        if (height_m > kRefractionTop_m) {
            const double r = ray.place.y;
            const double excess =
                (height_m - kRefractionTop_m) * (2.0 * kEarthRadius_m + height_m + kRefractionTop_m);
            const double root = r * r * direction.y * direction.y - excess;
            if (direction.y >= 0.0 || root <= 0.0) return 0.0;
            ray.place += direction * (excess / (-r * direction.y + std::sqrt(root)) + 1e-3);
        }
        while (true) {
            const double h = glm::length(ray.place) - kEarthRadius_m;
            if (h < std::min(height_m, 0.0) - 1e-3) return std::numeric_limits<double>::quiet_NaN();
            if (h >= kRefractionTop_m && glm::dot(ray.place, ray.momentum) > 0.0) break;
            step(ray, h < 30e3 ? 100.0 : 500.0);
        }
        const double cross = direction.x * ray.momentum.y - direction.y * ray.momentum.x;
        return -std::atan2(cross, glm::dot(direction, ray.momentum));
    }

  private:
    [[nodiscard]] double index(double height_m) const {
        return 1.0 + strength_ * air_.at(height_m).refractivity;
    }
    [[nodiscard]] Ray slope(const Ray& ray) const {
        const double r = glm::length(ray.place);
        const StandardAir::At here = air_.at(r - kEarthRadius_m);
        return {ray.momentum / (1.0 + strength_ * here.refractivity),
                ray.place * (strength_ * here.slope_per_m / r)};
    }
    static Ray along(const Ray& ray, const Ray& slope, double length_m) {
        return {ray.place + slope.place * length_m, ray.momentum + slope.momentum * length_m};
    }
    void step(Ray& ray, double length_m) const {
        const Ray a = slope(ray);
        const Ray b = slope(along(ray, a, 0.5 * length_m));
        const Ray c = slope(along(ray, b, 0.5 * length_m));
        const Ray d = slope(along(ray, c, length_m));
        ray.place += (a.place + 2.0 * b.place + 2.0 * c.place + d.place) * (length_m / 6.0);
        ray.momentum += (a.momentum + 2.0 * b.momentum + 2.0 * c.momentum + d.momentum) * (length_m / 6.0);
    }

    StandardAir air_;
    double strength_;
};

TEST(StandardAir, HasThePublishedDensities) {
    // US Standard Atmosphere 1976, kg/m3 at geometric heights.
    const StandardAir air;
    double worst = 0.0;
    for (const auto& [height_m, density] :
         {std::pair{-500.0, 1.2849}, std::pair{0.0, 1.2250}, std::pair{5e3, 0.73643},
          std::pair{11e3, 0.36480}, std::pair{15e3, 0.19476}, std::pair{20e3, 0.088910},
          std::pair{30e3, 0.018410}, std::pair{40e3, 0.0039957}, std::pair{50e3, 0.0010269},
          std::pair{70e3, 8.2829e-5}}) {
        const double ratio = air.at(height_m).refractivity / kSeaLevelRefractivity * 1.2250 / density;
        worst = std::max(worst, std::abs(ratio - 1.0));
    }
    std::printf("density: %.2g off at most\n", worst);
    EXPECT_LT(worst, 4e-4);
}

TEST(StandardAir, SlopeIsThatOfTheRefractivity) {
    const StandardAir air;
    for (double h = -400.0; h < 95e3; h += 777.0) {
        const double slope = (air.at(h + 1.0).refractivity - air.at(h - 1.0).refractivity) / 2.0;
        EXPECT_NEAR(air.at(h).slope_per_m / slope, 1.0, 1e-4) << h;
    }
}

TEST(Refraction, IsThatOfTracedRaysFromTheDeadSeaToOrbit) {
    double worst = 0.0;
    for (const auto& [pressure_hpa, temperature_c] :
         {std::pair{1013.25, 15.0}, std::pair{1030.0, -25.0}, std::pair{990.0, 40.0}}) {
        const Tracer tracer(pressure_hpa / 1013.25 * 288.15 / (temperature_c + 273.15));
        for (const double height_m :
             {-430.0, 0.0, 100.0, 1234.0, 6e3, 10.97e3, 10.99e3, 11.5e3, 18288.0, 35e3, 400e3, 36e6}) {
            const RefractionRow row = refraction().at(height_m, pressure_hpa, temperature_c);
            const double horizon = row.horizon_elevation_rad();
            double worst_here = 0.0;
            for (const double above : {1e-5, 0.02, 0.1, 0.5, 1.0, 2.0, 3.1, 4.4, 12.0, 45.0}) {
                const double apparent = horizon + (height_m < 1e6 ? above : 0.05 * above) * kDegree;
                const double traced = tracer.bending_rad(height_m, apparent);
                ASSERT_TRUE(std::isfinite(traced)) << height_m << " " << above;
                const double bending = apparent - row.true_from_apparent(apparent);
                worst_here = std::max(worst_here, std::abs(bending - traced));
            }
            std::printf("%6.0f hPa %4.0f C %9.0f m: dip %7.4f deg, at the horizon %6.2f', error %.3f\"\n",
                        pressure_hpa, temperature_c, height_m, -horizon / kDegree,
                        (horizon - row.setting_elevation_rad()) / kArcminute, worst_here / kArcsecond);
            worst = std::max(worst, worst_here);
        }
    }
    RecordProperty("worst_arcsec", std::to_string(worst / kArcsecond));
    EXPECT_LT(worst, 1.0 * kArcsecond);
}

TEST(Refraction, ApparentHorizonIsWhereRaysBeginToMissTheGround) {
    for (const double height_m : {50.0, 3e3, 11e3, 400e3, 36e6}) {
        const RefractionRow row = standard(height_m);
        const Tracer tracer(1.0);
        const double hair = height_m < 1e6 ? 2e-6 : 2e-8;
        EXPECT_TRUE(std::isfinite(tracer.bending_rad(height_m, row.horizon_elevation_rad() + hair)))
            << height_m;
        EXPECT_FALSE(std::isfinite(tracer.bending_rad(height_m, row.horizon_elevation_rad() - hair)))
            << height_m;
    }
}

TEST(Refraction, AgreesWithAnIndependentTraceOfTheStandardAtmosphere) {
    struct Line {
        double height_m, dip_deg, level_arcmin, horizon_arcmin;
    };
    // Ground, and cruise levels: dip, refraction at apparent 0 and at the apparent horizon.
    for (const Line& line :
         {Line{0.0, 0.0, 33.0, 33.0}, Line{1e3, 0.928, 30.1, 44.0}, Line{3e3, 1.619, 24.9, 51.1},
          Line{6e3, 2.311, 18.6, 56.8}, Line{11e3, 3.169, 11.5, 61.7}, Line{15e3, 3.728, 6.1, 63.9},
          Line{18288.0, 4.142, 3.6, 64.8}}) {
        const RefractionRow row = standard(line.height_m);
        EXPECT_NEAR(-row.horizon_elevation_rad() / kDegree, line.dip_deg, 0.002) << line.height_m;
        EXPECT_NEAR(-row.true_from_apparent(0.0) / kArcminute, line.level_arcmin, 0.35) << line.height_m;
        EXPECT_NEAR((row.horizon_elevation_rad() - row.setting_elevation_rad()) / kArcminute,
                    line.horizon_arcmin, 0.2)
            << line.height_m;
    }
    const double fl360 = -standard(10972.8).setting_elevation_rad() / kDegree;
    std::printf("FL360: a point sets %.3f deg below the level\n", fl360);
    EXPECT_NEAR(fl360, 4.2, 0.02);
}

TEST(Refraction, IsBennettsOnTheGround) {
    // R in arcminutes from the apparent elevation in degrees, 1010 hPa, 10 C.
    const RefractionRow row = refraction().at(0.0, 1010.0, 10.0);
    double worst = 0.0;
    for (double h = 0.0; h < 90.0; h += 0.5) {
        const double bennett = 1.0 / std::tan((h + 7.31 / (h + 4.4)) * kDegree);
        const double here = (h * kDegree - row.true_from_apparent(h * kDegree)) / kArcminute;
        worst = std::max(worst, std::abs(here - bennett) / (0.1 + 0.03 * bennett));
        if (h == 0.0 || h == 0.5 || h == 5.0)
            std::printf("%4.1f deg: %.2f', Bennett %.2f'\n", h, here, bennett);
    }
    EXPECT_LT(worst, 1.0);
}

TEST(Refraction, RoundTripsAndRisesEverywhere) {
    double worst = 0.0;
    for (const double height_m :
         {-12e3, -430.0, 0.0, 3.0, 1500.0, 10972.8, 11019.1, 30e3, 99e3, 100e3, 400e3, 36e6, 1e9}) {
        for (const auto& [pressure_hpa, temperature_c] :
             {std::pair{1013.25, 15.0}, std::pair{1085.0, -60.0}, std::pair{500.0, 40.0}}) {
            const RefractionRow row = refraction().at(height_m, pressure_hpa, temperature_c);
            double last = -10.0;
            for (int i = -90000; i <= 90000; ++i) {
                // Thousandths of a degree, with a fine look at the horizon.
                const double apparent =
                    i % 2 == 0 ? i * 1e-3 * kDegree : row.horizon_elevation_rad() + 1e-7 * i * kDegree;
                const double there = row.true_from_apparent(apparent);
                if (i % 2 == 0) {
                    ASSERT_GT(there, last) << height_m << " " << i;
                    last = there;
                }
                if (i % 37 != 0) continue;
                worst = std::max(
                    worst, std::abs(row.true_from_apparent(row.apparent_from_true(apparent)) - apparent));
                worst = std::max(worst, std::abs(row.apparent_from_true(there) - apparent));
            }
        }
    }
    std::printf("round trip: %.2g rad at most\n", worst);
    EXPECT_LT(worst, 1e-11);
}

TEST(Refraction, LeavesZenithAndNadirAndCountsOnBeyondTheZenith) {
    for (const double height_m : {0.0, 11e3, 36e6}) {
        const RefractionRow row = standard(height_m);
        EXPECT_NEAR(row.true_from_apparent(90.0 * kDegree), 90.0 * kDegree, 1e-13);
        EXPECT_NEAR(row.true_from_apparent(-90.0 * kDegree), -90.0 * kDegree, 1e-13);
        EXPECT_NEAR(row.true_from_apparent(91.0 * kDegree) + row.true_from_apparent(89.0 * kDegree),
                    180.0 * kDegree, 1e-13);
        EXPECT_NEAR(row.apparent_from_true(91.0 * kDegree) + row.apparent_from_true(89.0 * kDegree),
                    180.0 * kDegree, 1e-13);
    }
}

TEST(Refraction, HasNoJumpInAngleHeightOrAir) {
    double worst_angle = 0.0;
    double worst_height = 0.0;
    double worst_air = 0.0;
    for (double height_m = -600.0; height_m < 120e3; height_m += 97.0) {
        const RefractionRow row = standard(height_m);
        const RefractionRow higher = standard(height_m + 0.01);
        const RefractionRow colder = refraction().at(height_m, 1013.25, 14.999);
        for (double above = -2.0; above < 6.0; above += 0.0625) {
            const double apparent = row.horizon_elevation_rad() + above * kDegree;
            const double there = row.true_from_apparent(apparent);
            worst_angle = std::max(worst_angle, row.true_from_apparent(apparent + 1e-9) - there);
            worst_height = std::max(
                worst_height,
                std::abs(higher.true_from_apparent(higher.horizon_elevation_rad() + above * kDegree) -
                         there));
            worst_air = std::max(
                worst_air,
                std::abs(colder.true_from_apparent(colder.horizon_elevation_rad() + above * kDegree) -
                         there));
        }
    }
    std::printf("steps: %.2g rad over 1e-9 rad, %.2g\" over 1 cm, %.2g\" over 0.001 C\n", worst_angle,
                worst_height / kArcsecond, worst_air / kArcsecond);
    EXPECT_LT(worst_angle, 1e-8);
    // The dip itself goes as the root of the height.
    EXPECT_LT(worst_height, 12.0 * kArcsecond);
    EXPECT_LT(worst_air, 0.05 * kArcsecond);
}

TEST(Refraction, NoAirNoRefraction) {
    for (const double height_m : {0.0, 11e3, 400e3}) {
        const RefractionRow row = refraction().at(height_m, 0.0, 15.0);
        for (double e = -89.0; e < 90.0; e += 1.7) {
            EXPECT_EQ(row.true_from_apparent(e * kDegree), e * kDegree);
            EXPECT_EQ(row.apparent_from_true(e * kDegree), e * kDegree);
        }
        EXPECT_NEAR(row.horizon_elevation_rad(), horizon_elevation_rad(height_m), 1e-12);
        EXPECT_NEAR(row.vertical_scale(0.1), 1.0, 1e-10);
    }
    EXPECT_EQ(RefractionRow{}.apparent_from_true(-0.1), -0.1);
}

TEST(Refraction, TakesAnyInput) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, infinity, -infinity, 1e300, -1e300}) {
        for (const RefractionRow& row :
             {refraction().at(bad, 1013.25, 15.0), refraction().at(0.0, bad, 15.0),
              refraction().at(0.0, 1013.25, bad), refraction().at(bad, bad, bad)}) {
            for (double e = -90.0; e <= 90.0; e += 0.5) {
                const double apparent = row.apparent_from_true(e * kDegree);
                ASSERT_TRUE(std::isfinite(apparent)) << bad << " " << e;
                ASSERT_GE(apparent, e * kDegree - 1e-12) << bad << " " << e;
            }
        }
    }
}

TEST(Refraction, FlattensTheSettingSun) {
    const double ground = standard(0.0).vertical_scale(0.0);
    const RefractionRow high = standard(11e3);
    const double cruise = high.vertical_scale(high.horizon_elevation_rad() + 0.1 * kDegree);
    std::printf("vertical scale at the horizon: %.3f on the ground, %.3f at 11 km\n", ground, cruise);
    EXPECT_NEAR(ground, 0.83, 0.02);
    EXPECT_LT(cruise, 0.7);
    EXPECT_NEAR(standard(0.0).vertical_scale(1.0), 1.0, 1e-3);
}

TEST(Refraction, CostsWhatItSays) {
    using Clock = std::chrono::steady_clock;
    const auto seconds = [](Clock::time_point from) {
        return std::chrono::duration<double>(Clock::now() - from).count();
    };
    auto from = Clock::now();
    const Refraction table;
    const double build_ms = 1e3 * seconds(from);
    from = Clock::now();
    double sum = 0.0;
    for (int i = 0; i < 1000; ++i)
        sum += table.at(10.0 * i, 1013.25, 15.0).horizon_elevation_rad();
    const double row_us = 1e3 * seconds(from);
    const RefractionRow row = table.at(11e3, 1013.25, 15.0);
    from = Clock::now();
    for (int i = 0; i < 10000; ++i)
        sum += row.true_from_apparent(-0.05 + 1e-4 * i);
    const double apparent_us = 100.0 * seconds(from);
    from = Clock::now();
    for (int i = 0; i < 10000; ++i)
        sum += row.apparent_from_true(-0.07 + 1e-4 * i);
    const double true_us = 100.0 * seconds(from);
    std::printf("built in %.1f ms; a row %.2f us, from apparent %.3f us, from true %.3f us (%g)\n", build_ms,
                row_us, apparent_us, true_us, sum);
    // Far above what it takes, for busy and instrumented machines.
    EXPECT_LT(build_ms, 3000.0);
    EXPECT_LT(row_us, 300.0);
}

}  // namespace
}  // namespace skyig::render::sky
