// The compiled-in catalogue against the file it is made from, its published check sums, and stars everybody
// knows.
#include "render/night/star_catalogue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "tests/csv.h"

namespace skyig::render::night {
namespace {

using tests::CsvRow;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kArcsecPerRad = 3600.0 / kRadPerDeg;

glm::dvec3 direction_of(double ra_deg, double dec_deg) {
    const double ra = ra_deg * kRadPerDeg;
    const double dec = dec_deg * kRadPerDeg;
    return {std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec)};
}

double separation_arcsec(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * kArcsecPerRad;
}

double right_ascension_deg(const glm::dvec3& direction) {
    const double deg = std::atan2(direction.y, direction.x) / kRadPerDeg;
    return deg < 0.0 ? deg + 360.0 : deg;
}

const CatalogueStar& star(int hr) {
    const CatalogueStar* const found = find_star(hr);
    EXPECT_NE(found, nullptr) << "HR " << hr;
    return found != nullptr ? *found : star_catalogue().front();
}

std::vector<CsvRow> catalogue_file() {
    return tests::read_csv(SKYIG_SOURCE_DIR "/render/night/data/bsc5.csv");
}

TEST(StarCatalogue, HasItsCheckSums) {
    double ra_sum_deg = 0.0;
    double dec_sum_deg = 0.0;
    double vmag_sum = 0.0;
    std::map<int, int> count_by_magnitude;
    for (const CatalogueStar& entry : star_catalogue()) {
        const glm::dvec3 direction(entry.direction_gcrs);
        ra_sum_deg += right_ascension_deg(direction);
        dec_sum_deg += std::atan2(direction.z, std::hypot(direction.x, direction.y)) / kRadPerDeg;
        vmag_sum += static_cast<double>(entry.vmag);
        // A float of 5.00 may lie just below.
        ++count_by_magnitude[static_cast<int>(std::floor(static_cast<double>(entry.vmag) + 1e-4))];
    }
    std::printf("sums: RA %.2f, Dec %.3f, V %.2f\n", ra_sum_deg, dec_sum_deg, vmag_sum);
    EXPECT_EQ(star_catalogue().size(), 9096U);
    EXPECT_NEAR(ra_sum_deg, 1644340.24, 0.02);
    EXPECT_NEAR(dec_sum_deg, -13142.836, 0.002);
    EXPECT_NEAR(vmag_sum, 51471.84, 0.01);
    const std::map<int, int> expected{{-2, 1},  {-1, 3},   {0, 11},   {1, 33},   {2, 122},
                                      {3, 343}, {4, 1091}, {5, 3419}, {6, 4023}, {7, 50}};
    EXPECT_EQ(count_by_magnitude, expected);
}

TEST(StarCatalogue, HoldsEveryRowOfItsFile) {
    const std::vector<CsvRow> rows = catalogue_file();
    const std::span<const CatalogueStar> stars = star_catalogue();
    ASSERT_EQ(rows.size(), stars.size());
    double largest_arcsec = 0.0;
    double largest_motion_mas_yr = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const glm::dvec3 truth = direction_of(rows[i].number("ra_deg"), rows[i].number("dec_deg"));
        const glm::dvec3 direction(stars[i].direction_gcrs);
        largest_arcsec = std::max(largest_arcsec, separation_arcsec(direction, truth));
        EXPECT_NEAR(glm::length(direction), 1.0, 1e-7);
        const glm::dvec3 motion(stars[i].proper_motion_rad_yr);
        const double motion_mas_yr = std::hypot(rows[i].number("pmra_masyr"), rows[i].number("pmdec_masyr"));
        largest_motion_mas_yr = std::max(
            largest_motion_mas_yr, std::abs(glm::length(motion) * kArcsecPerRad * 1000.0 - motion_mas_yr));
        EXPECT_NEAR(glm::dot(motion, direction), 0.0, 1e-11);
        EXPECT_EQ(stars[i].vmag, static_cast<float>(rows[i].number("vmag")));
        EXPECT_EQ(stars[i].hr, static_cast<int>(rows[i].number("hr")));
    }
    std::printf("compiled-in against the file: direction max %.4f arcsec, proper motion max %.5f mas/yr\n",
                largest_arcsec, largest_motion_mas_yr);
    EXPECT_LE(largest_arcsec, 0.02);
    EXPECT_LE(largest_motion_mas_yr, 0.001);
}

TEST(StarCatalogue, FillsEveryGapInColour) {
    const std::vector<CsvRow> rows = catalogue_file();
    const std::span<const CatalogueStar> stars = star_catalogue();
    ASSERT_EQ(rows.size(), stars.size());
    int gaps = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_GE(stars[i].bv, -0.5F);
        EXPECT_LE(stars[i].bv, 6.0F);
        if (rows[i].text("bv").empty()) {
            ++gaps;
        } else {
            EXPECT_EQ(stars[i].bv, static_cast<float>(rows[i].number("bv"))) << stars[i].hr;
        }
    }
    EXPECT_EQ(gaps, 310);
    // Without a class that can be read; gamma Vir B is F0V, the medians say 0.28.
    EXPECT_EQ(star(312).bv, 0.6F);
    EXPECT_EQ(star(2277).bv, 0.6F);
    EXPECT_EQ(star(4826).bv, 0.28F);
}

TEST(StarCatalogue, KnowsTheBrightStars) {
    struct Known {
        int hr;
        double ra_deg;
        double dec_deg;
        double vmag;
        double bv;
    };
    constexpr std::array kKnown{
        Known{2491, 101.2871, -16.7161, -1.46, 0.00}, Known{2326, 95.9879, -52.6958, -0.72, 0.15},
        Known{7001, 279.2346, 38.7836, 0.03, 0.00},   Known{424, 37.9529, 89.2642, 2.02, 0.60},
        Known{5340, 213.9154, 19.1825, -0.04, 1.23},  Known{1708, 79.1725, 45.9981, 0.08, 0.80},
        Known{1713, 78.6346, -8.2017, 0.12, -0.03},   Known{2061, 88.7929, 7.4069, 0.50, 1.85},
        Known{6134, 247.3517, -26.4319, 0.96, 1.83},  Known{472, 24.4288, -57.2367, 0.46, -0.16},
        Known{8728, 344.4129, -29.6222, 1.16, 0.09},  Known{7557, 297.6958, 8.8683, 0.77, 0.22},
        Known{4730, 186.6496, -63.0992, 1.33, -0.24}};
    for (const Known& known : kKnown) {
        const CatalogueStar& found = star(known.hr);
        EXPECT_LE(
            separation_arcsec(glm::dvec3(found.direction_gcrs), direction_of(known.ra_deg, known.dec_deg)),
            0.3)
            << known.hr;
        EXPECT_NEAR(static_cast<double>(found.vmag), known.vmag, 1e-6) << known.hr;
        EXPECT_NEAR(static_cast<double>(found.bv), known.bv, 1e-6) << known.hr;
    }
    const auto brightest = std::min_element(star_catalogue().begin(), star_catalogue().end(),
                                            [](const auto& a, const auto& b) { return a.vmag < b.vmag; });
    EXPECT_EQ(brightest->hr, 2491);
}

TEST(StarCatalogue, PutsPolarisBesideThePole) {
    const double from_pole_deg =
        separation_arcsec(glm::dvec3(star(424).direction_gcrs), glm::dvec3(0.0, 0.0, 1.0)) / 3600.0;
    EXPECT_NEAR(from_pole_deg, 90.0 - 89.2642, 0.0001);
    // A century of its motion is 4 arcsec; nothing is divided by the cosine of its declination.
    const double moved_arcsec =
        separation_arcsec(direction_at(star(424), 100.0), direction_at(star(424), 0.0));
    std::printf("Polaris moves %.2f arcsec in a century\n", moved_arcsec);
    EXPECT_NEAR(moved_arcsec, 4.1, 0.5);
}

TEST(StarCatalogue, MovesTheFastStars) {
    // 61 Cygni: 5.2 arcsec a year, towards the north-east; the catalogue's 4.13 and 3.19 arcsec a year.
    const glm::dvec3 at_2000 = direction_at(star(8085), 0.0);
    const glm::dvec3 at_2100 = direction_at(star(8085), 100.0);
    const double moved_arcsec = separation_arcsec(at_2000, at_2100);
    const double north_arcsec = (std::asin(at_2100.z) - std::asin(at_2000.z)) * kArcsecPerRad;
    std::printf("61 Cyg A moves %.1f arcsec in a century, %.1f of them north\n", moved_arcsec, north_arcsec);
    EXPECT_NEAR(moved_arcsec, 520.0, 10.0);
    EXPECT_NEAR(north_arcsec, 320.0, 10.0);
    EXPECT_GT(right_ascension_deg(at_2100), right_ascension_deg(at_2000));
    // Groombridge 1830 goes south-east at 7.06 arcsec a year, back as far as on.
    EXPECT_NEAR(separation_arcsec(direction_at(star(4550), -50.0), direction_at(star(4550), 50.0)), 706.0,
                3.0);
    EXPECT_NEAR(glm::length(direction_at(star(4550), -100.0)), 1.0, 1e-14);
}

TEST(StarCatalogue, LeavesOutWhatIsNoStar) {
    for (const int hr :
         {0, -1, 92, 95, 182, 1057, 1841, 2472, 2496, 3515, 3671, 6309, 6515, 7189, 7539, 8296, 9111, 70000})
        EXPECT_EQ(find_star(hr), nullptr) << hr;
    EXPECT_NE(find_star(1), nullptr);
    EXPECT_NE(find_star(9110), nullptr);
    const std::span<const CatalogueStar> stars = star_catalogue();
    EXPECT_TRUE(std::is_sorted(stars.begin(), stars.end(),
                               [](const CatalogueStar& a, const CatalogueStar& b) { return a.hr < b.hr; }));
}

}  // namespace
}  // namespace skyig::render::night
