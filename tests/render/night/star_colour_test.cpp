// Colour and brightness of stars from their magnitudes.
#include "render/night/star_colour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "render/night/star_catalogue.h"
#include "tests/csv.h"

namespace skyig::render::night {
namespace {

double luminance(const glm::dvec3& rgb) {
    return 0.2126729 * rgb.x + 0.7151522 * rgb.y + 0.0721750 * rgb.z;
}

TEST(StarColour, AgreesWithTheReferenceTable) {
    const std::vector<tests::CsvRow> rows = tests::read_csv(SKYIG_REFERENCE "/night/bv_colour.csv");
    if (rows.empty()) GTEST_SKIP() << "the table bv_colour.csv is not part of this clone";
    double largest_kelvin = 0.0;
    double largest_xy = 0.0;
    double largest_rgb = 0.0;
    for (const tests::CsvRow& row : rows) {
        const double bv = row.number("B_V");
        const double temperature_k = temperature_from_bv_k(bv);
        const glm::dvec2 xy = planckian_xy(temperature_k);
        const glm::dvec3 rgb = star_colour_of_bv(bv);
        largest_kelvin = std::max(largest_kelvin, std::abs(temperature_k - row.number("T_ballesteros_K")));
        largest_xy =
            std::max({largest_xy, std::abs(xy.x - row.number("x")), std::abs(xy.y - row.number("y"))});
        largest_rgb =
            std::max({largest_rgb, std::abs(rgb.x - row.number("R_lin")),
                      std::abs(rgb.y - row.number("G_lin")), std::abs(rgb.z - row.number("B_lin"))});
    }
    std::printf("%zu colours: T max %.2f K, xy max %.5f, rgb max %.5f off\n", rows.size(), largest_kelvin,
                largest_xy, largest_rgb);
    EXPECT_LE(largest_kelvin, 0.6);
    EXPECT_LE(largest_xy, 1e-4);
    EXPECT_LE(largest_rgb, 5e-4);
}

TEST(StarColour, HasLuminanceOneAndStaysInTheGamut) {
    double largest = 0.0;
    for (int step = -200; step <= 600; ++step) {
        const glm::dvec3 rgb = star_colour_of_bv(0.01 * step);
        EXPECT_GE(std::min({rgb.x, rgb.y, rgb.z}), 0.0);
        largest = std::max(largest, std::abs(luminance(rgb) - 1.0));
    }
    std::printf("luminance off one by at most %.1e\n", largest);
    EXPECT_LE(largest, 1e-6);
}

TEST(StarColour, ReddensWithTheColourIndex) {
    double before = 0.0;
    for (int step = 0; step <= 240; ++step) {
        const glm::dvec3 rgb = star_colour_of_bv(-0.4 + 0.01 * step);
        const double red_over_blue = rgb.x / rgb.z;
        EXPECT_GT(red_over_blue, before) << step;
        before = red_over_blue;
    }
    // Rigel blue, the Sun's like nearly white, Betelgeuse orange.
    EXPECT_GT(star_colour_of_bv(-0.03).z, star_colour_of_bv(-0.03).x * 1.5);
    EXPECT_NEAR(star_colour_of_bv(0.5).x, star_colour_of_bv(0.5).z, 0.05);
    EXPECT_GT(star_colour_of_bv(1.85).x, star_colour_of_bv(1.85).z * 4.0);
}

TEST(StarColour, IsClampedOutsideItsRange) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(star_colour_of_bv(-3.0), star_colour_of_bv(kMinBv));
    EXPECT_EQ(star_colour_of_bv(3.45), star_colour_of_bv(kMaxBv));
    EXPECT_EQ(star_colour_of_bv(-kInfinity), star_colour_of_bv(kMinBv));
    EXPECT_EQ(star_colour_of_bv(kInfinity), star_colour_of_bv(kMaxBv));
    EXPECT_EQ(star_colour_of_bv(std::numeric_limits<double>::quiet_NaN()), star_colour_of_bv(0.65));
    EXPECT_EQ(planckian_xy(100.0), planckian_xy(1667.0));
    EXPECT_EQ(planckian_xy(1e9), planckian_xy(25000.0));
}

TEST(StarColour, JoinsThePiecesOfTheLocus) {
    // The published pieces themselves meet to a few units of the fourth decimal.
    for (const double kelvin : {2222.0, 4000.0}) {
        const glm::dvec2 below = planckian_xy(kelvin);
        const glm::dvec2 above = planckian_xy(kelvin + 1e-6);
        std::printf("%.0f K: pieces differ by (%.1e, %.1e)\n", kelvin, above.x - below.x, above.y - below.y);
        EXPECT_LE(glm::length(above - below), 5e-4);
    }
}

TEST(StarColour, DesaturatesAtConstantLuminance) {
    EXPECT_LE(glm::length(linear_rec709_of_xy({0.31271, 0.32902}) - glm::dvec3(1.0)), 2e-3);
    for (const glm::dvec2& xy : {glm::dvec2(0.70, 0.29), glm::dvec2(0.10, 0.80), glm::dvec2(0.16, 0.02)}) {
        const glm::dvec3 rgb = linear_rec709_of_xy(xy);
        EXPECT_EQ(std::min({rgb.x, rgb.y, rgb.z}), 0.0);
        EXPECT_NEAR(luminance(rgb), 1.0, 1e-6);
    }
}

TEST(StarIlluminance, FollowsTheMagnitudeScale) {
    EXPECT_DOUBLE_EQ(star_illuminance_lux(0.0), 2.54e-6);
    EXPECT_NEAR(star_illuminance_lux(5.0) / star_illuminance_lux(0.0), 0.01, 1e-15);
    EXPECT_NEAR(star_illuminance_lux(-26.74), 1.26e5, 0.03e5);
    double sum_lux = 0.0;
    for (const CatalogueStar& star : star_catalogue())
        sum_lux += star_illuminance_lux(static_cast<double>(star.vmag));
    std::printf("all catalogue stars together: %.3e lux\n", sum_lux);
    // The README's counts by magnitude, each at the middle of its light, come to some 96 stars of magnitude
    // 0.
    EXPECT_NEAR(sum_lux / star_illuminance_lux(0.0), 96.0, 3.0);
}

}  // namespace
}  // namespace skyig::render::night
