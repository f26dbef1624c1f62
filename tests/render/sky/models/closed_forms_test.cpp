// `cie` and `preetham` against their publications' tables and formulas, stated here once more in another
// form.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include "render/sky/models/cie_sky.h"
#include "render/sky/models/preetham_sky.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky::models {
namespace {

using Real = long double;
constexpr Real kPi = 3.14159265358979323846264338327950288L;

// ISO 15469:2004, table 1: a, b, c, d, e of types 1..15.
constexpr std::array<std::array<double, 5>, 15> kStandard{{{4.0, -0.70, 0, -1.0, 0.00},
                                                           {4.0, -0.70, 2, -1.5, 0.15},
                                                           {1.1, -0.80, 0, -1.0, 0.00},
                                                           {1.1, -0.80, 2, -1.5, 0.15},
                                                           {0.0, -1.00, 0, -1.0, 0.00},
                                                           {0.0, -1.00, 2, -1.5, 0.15},
                                                           {0.0, -1.00, 5, -2.5, 0.30},
                                                           {0.0, -1.00, 10, -3.0, 0.45},
                                                           {-1.0, -0.55, 2, -1.5, 0.15},
                                                           {-1.0, -0.55, 5, -2.5, 0.30},
                                                           {-1.0, -0.55, 10, -3.0, 0.45},
                                                           {-1.0, -0.32, 10, -3.0, 0.45},
                                                           {-1.0, -0.32, 16, -3.0, 0.30},
                                                           {-1.0, -0.15, 16, -3.0, 0.30},
                                                           {-1.0, -0.15, 24, -2.8, 0.15}}};

struct Angles {
    Real view_zenith;
    Real sun_zenith;
    Real azimuth;

    [[nodiscard]] Real between() const {
        return std::acos(std::cos(sun_zenith) * std::cos(view_zenith) +
                         std::sin(sun_zenith) * std::sin(view_zenith) * std::cos(azimuth));
    }
};

// Away from the ends, where this test's own arc cosine is exact.
std::vector<Angles> random_angles(int count) {
    std::mt19937 random{5};
    std::uniform_real_distribution<double> unit(0.01, 0.99);
    std::vector<Angles> angles;
    while (static_cast<int>(angles.size()) < count) {
        const Angles a{0.5L * kPi * unit(random), 0.5L * kPi * unit(random), kPi * unit(random)};
        if (a.view_zenith < 1.555L && a.sun_zenith < 1.5L && a.between() > 0.01L) angles.push_back(a);
    }
    return angles;
}

double f64(Real value) {
    return static_cast<double>(value);
}

double sun_angle(const Angles& a) {
    return shaders64::angle_between(f64(0.5L * kPi - a.view_zenith), f64(0.5L * kPi - a.sun_zenith),
                                    f64(a.azimuth));
}

TEST(CieSky, EqualsThePrintedFormulaAtRandomAngles) {
    double largest = 0.0;
    for (std::size_t type = 1; type <= 15; ++type) {
        const auto& k = kStandard[type - 1];
        const auto phi = [&](Real z) { return 1.0L + k[0] * std::exp(k[1] / std::cos(z)); };
        const auto f = [&](Real chi) {
            return 1.0L + k[2] * (std::exp(k[3] * chi) - std::exp(k[3] * 0.5L * kPi)) +
                   k[4] * std::cos(chi) * std::cos(chi);
        };
        for (const Angles& a : random_angles(400)) {
            const Real wanted = f(a.between()) * phi(a.view_zenith) / (f(a.sun_zenith) * phi(0.0L));
            const double made =
                shaders64::cie_relative(f64(std::cos(a.view_zenith)), sun_angle(a), f64(a.sun_zenith),
                                        cie_coefficients(static_cast<int>(type)));
            largest = std::max(largest, f64(std::abs(made / wanted - 1.0L)));
        }
    }
    std::printf("largest relative difference %.1e\n", largest);
    EXPECT_LT(largest, 1e-12);
}

TEST(CieSky, OvercastIsThreeTimesBrighterAtTheZenithThanAtTheHorizon) {
    EXPECT_DOUBLE_EQ(shaders64::cie_overcast(1.0), 1.0);
    EXPECT_DOUBLE_EQ(shaders64::cie_overcast(0.0), 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(shaders64::cie_overcast(std::sin(30.0 * kDeg)), 2.0 / 3.0);
}

// As the authors print it: coefficients linear in the turbidity, zenith values by matrices.
struct Printed {
    Real t;

    [[nodiscard]] static Real perez(const std::array<Real, 5>& k, Real theta, Real gamma) {
        return (1.0L + k[0] * std::exp(k[1] / std::cos(theta))) *
               (1.0L + k[2] * std::exp(k[3] * gamma) + k[4] * std::pow(std::cos(gamma), 2.0L));
    }
    [[nodiscard]] std::array<Real, 5> coefficients(const std::array<std::array<double, 2>, 5>& table) const {
        std::array<Real, 5> k{};
        for (std::size_t i = 0; i < k.size(); ++i)
            k[i] = table[i][0] * t + table[i][1];
        return k;
    }
    [[nodiscard]] Real zenith(const std::array<std::array<double, 4>, 3>& m, Real s) const {
        const std::array<Real, 3> powers{t * t, t, 1.0L};
        Real sum = 0.0L;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 4; ++j)
                sum += powers[i] * m[i][j] * std::pow(s, static_cast<Real>(3 - j));
        }
        return sum;
    }
};

constexpr std::array<std::array<double, 2>, 5> kY{
    {{0.1787, -1.4630}, {-0.3554, 0.4275}, {-0.0227, 5.3251}, {0.1206, -2.5771}, {-0.0670, 0.3703}}};
constexpr std::array<std::array<double, 2>, 5> kSmallX{
    {{-0.0193, -0.2592}, {-0.0665, 0.0008}, {-0.0004, 0.2125}, {-0.0641, -0.8989}, {-0.0033, 0.0452}}};
constexpr std::array<std::array<double, 2>, 5> kSmallY{
    {{-0.0167, -0.2608}, {-0.0950, 0.0092}, {-0.0079, 0.2102}, {-0.0441, -1.6537}, {-0.0109, 0.0529}}};
constexpr std::array<std::array<double, 4>, 3> kZenithX{{{0.00166, -0.00375, 0.00209, 0.0},
                                                         {-0.02903, 0.06377, -0.03202, 0.00394},
                                                         {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr std::array<std::array<double, 4>, 3> kZenithY{{{0.00275, -0.00610, 0.00317, 0.0},
                                                         {-0.04214, 0.08970, -0.04153, 0.00516},
                                                         {0.15346, -0.26756, 0.06670, 0.26688}}};

TEST(PreethamSky, EqualsThePrintedFormulasAtRandomAngles) {
    double largest = 0.0;
    const auto note = [&](double made, Real wanted) {
        largest = std::max(largest, f64(std::abs(made / wanted - 1.0L)));
    };
    for (const double t : {2.0, 2.53, 4.7, 10.0}) {
        const Printed printed{t};
        for (const Angles& a : random_angles(500)) {
            const double sine = f64(std::cos(a.view_zenith));
            const double s = f64(a.sun_zenith);
            const auto ratio = [&](const std::array<std::array<double, 2>, 5>& table) {
                const auto k = printed.coefficients(table);
                return Printed::perez(k, a.view_zenith, a.between()) / Printed::perez(k, 0.0L, a.sun_zenith);
            };
            note(shaders64::perez_relative(sine, sun_angle(a), s, shaders64::preetham_luminance(t)),
                 ratio(kY));
            note(shaders64::perez_relative(sine, sun_angle(a), s, shaders64::preetham_x(t)), ratio(kSmallX));
            note(shaders64::perez_relative(sine, sun_angle(a), s, shaders64::preetham_y(t)), ratio(kSmallY));
            const Real chi = (4.0L / 9.0L - t / 120.0L) * (kPi - 2.0L * a.sun_zenith);
            const double per_t[4] = {4.0453, 4.9710, 0.2155, 2.4192};
            const Real luminance =
                1000.0L * ((per_t[0] * t - per_t[1]) * std::tan(chi) - per_t[2] * t + per_t[3]);
            note(shaders64::preetham_zenith_luminance(t, s), luminance);
            note(shaders64::preetham_zenith_x(t, s), printed.zenith(kZenithX, a.sun_zenith));
            note(shaders64::preetham_zenith_y(t, s), printed.zenith(kZenithY, a.sun_zenith));
        }
    }
    std::printf("largest relative difference %.1e\n", largest);
    EXPECT_LT(largest, 1e-11);
}

// What is drawn is the formula in single precision.
TEST(PreethamSky, DrawsThePrintedFormulas) {
    const AirTables tables(atmosphere_b());
    PreethamSettings settings;
    settings.turbidity = 3.1;
    PreethamSky sky;
    const Printed printed{3.1};
    double largest = 0.0;
    for (const Angles& a : random_angles(40)) {
        sky.begin(settings, tables, 0.0, f64(0.5L * kPi - a.sun_zenith));
        if (a.sun_zenith > 1.5L) continue;
        const glm::vec3 xyz =
            sky.xyz_above(static_cast<float>(0.5L * kPi - a.view_zenith), static_cast<float>(a.azimuth));
        const auto k = printed.coefficients(kY);
        const Real wanted = shaders64::preetham_zenith_luminance(3.1, f64(a.sun_zenith)) *
                            Printed::perez(k, a.view_zenith, a.between()) /
                            Printed::perez(k, 0.0L, a.sun_zenith);
        const auto kx = printed.coefficients(kSmallX);
        const Real x = printed.zenith(kZenithX, a.sun_zenith) *
                       Printed::perez(kx, a.view_zenith, a.between()) /
                       Printed::perez(kx, 0.0L, a.sun_zenith);
        largest = std::max({largest, f64(std::abs(static_cast<Real>(xyz.y) / wanted - 1.0L)),
                            f64(std::abs(static_cast<Real>(xyz.x / (xyz.x + xyz.y + xyz.z)) - x))});
    }
    std::printf("largest difference %.1e\n", largest);
    EXPECT_LT(largest, 1e-5);
}

TEST(PreethamSky, TurbidityFollowsTheOpticalDepthsOfTheAir) {
    // Rayleigh 0.093 and haze 0.065 make 1.7: below the fit's range.
    EXPECT_EQ(turbidity_of(atmosphere_a()), kLeastTurbidity);
    for (const double visibility_m : {200e3, 60e3, 23e3, 10e3, 5e3, 2e3}) {
        Air air;
        air.visibility_m = visibility_m;
        // By hand: all molecules 0.0973 at 550 nm over 8435 m, haze what then lacks to the extinction of the
        // visibility, over 1200 m; both carried to 558 nm.
        const double redder = 550.0 / 558.0;
        const double steepness = 0.2 + 1.1 * std::min(1.0, std::log(visibility_m / 1e3) / std::log(50.0));
        const double molecules = 0.0973 * std::pow(redder, 4.08);
        const double haze =
            std::max(0.0, 2.9957 / visibility_m - 0.0973 / 8435.0) * 1200.0 * std::pow(redder, steepness);
        const double t = turbidity_of(air_model(air));
        std::printf("visibility %.0f m: turbidity %.2f\n", visibility_m, t);
        EXPECT_NEAR(t, std::clamp(1.0 + haze / molecules, 2.0, 10.0), 0.02);
    }
}

TEST(AngleBetween, IsExactWhereTheDirectionsMeetAndWhereTheyAreOpposite) {
    EXPECT_EQ(shaders64::angle_between(0.3, 0.3, 0.0), 0.0);
    EXPECT_NEAR(shaders64::angle_between(0.3, 0.3 + 1e-9, 0.0), 1e-9, 1e-16);
    EXPECT_NEAR(shaders32::angle_between(0.7F, 0.7F + 1e-3F, 0.0F), 1e-3F, 1e-7F);
    EXPECT_NEAR(shaders64::angle_between(0.3, -0.3, 3.14159265358979323846), 3.14159265358979323846, 1e-7);
}

}  // namespace
}  // namespace skyig::render::sky::models
