#include "render/night/zodiacal_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace skyig::render::night {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kObliquity_rad = 23.4392911 * kDegree;

constexpr std::size_t kRows = 19;
constexpr std::size_t kColumns = 11;
constexpr std::array<double, kRows> kLongitude_deg{0,  5,  10, 15,  20,  25,  30,  35,  40, 45,
                                                   60, 75, 90, 105, 120, 135, 150, 165, 180};
constexpr std::array<double, kColumns> kLatitude_deg{0, 5, 10, 15, 20, 25, 30, 45, 60, 75, 90};

// S10; 0 where it cannot be observed.
constexpr std::array<std::array<double, kColumns>, kRows> kTable{{
    {0, 0, 0, 2450, 1260, 770, 500, 215, 117, 78, 60},
    {0, 0, 0, 2300, 1200, 740, 490, 212, 117, 78, 60},
    {0, 0, 3700, 1930, 1070, 675, 460, 206, 116, 78, 60},
    {9000, 5300, 2690, 1450, 870, 590, 410, 196, 114, 78, 60},
    {5000, 3500, 1880, 1100, 710, 495, 355, 185, 110, 77, 60},
    {3000, 2210, 1350, 860, 585, 425, 320, 174, 106, 76, 60},
    {1940, 1460, 955, 660, 480, 365, 285, 162, 102, 74, 60},
    {1290, 990, 710, 530, 400, 310, 250, 151, 98, 73, 60},
    {925, 735, 545, 415, 325, 264, 220, 140, 94, 72, 60},
    {710, 570, 435, 345, 278, 228, 195, 130, 91, 70, 60},
    {395, 345, 275, 228, 190, 163, 143, 105, 81, 67, 60},
    {264, 248, 210, 177, 153, 134, 118, 91, 73, 64, 60},
    {202, 196, 176, 151, 130, 115, 103, 81, 67, 62, 60},
    {166, 164, 154, 133, 117, 104, 93, 75, 64, 60, 60},
    {147, 145, 138, 120, 108, 98, 88, 70, 60, 58, 60},
    {140, 139, 130, 115, 105, 95, 86, 70, 60, 57, 60},
    {140, 139, 129, 116, 107, 99, 91, 75, 62, 56, 60},
    {153, 150, 140, 129, 118, 110, 102, 81, 64, 56, 60},
    {180, 166, 152, 139, 127, 116, 105, 82, 65, 56, 60},
}};

double corona_s10(double longitude_deg, double latitude_deg) {
    const double longitude_rad = longitude_deg * kDegree;
    const double latitude_rad = latitude_deg * kDegree;
    const double sine = std::hypot(std::cos(latitude_rad) * std::sin(longitude_rad), std::sin(latitude_rad));
    const double elongation_deg =
        std::atan2(sine, std::cos(latitude_rad) * std::cos(longitude_rad)) / kDegree;
    return 9000.0 * std::pow(15.0 / std::max(elongation_deg, 2.5), 2.3);
}

using LogTable = std::array<std::array<double, kColumns>, kRows>;

const LogTable& log_table() {
    static const LogTable table = [] {
        LogTable logs{};
        for (std::size_t row = 0; row < kRows; ++row) {
            for (std::size_t column = 0; column < kColumns; ++column) {
                const double seen = kTable[row][column];
                logs[row][column] =
                    std::log2(seen > 0.0 ? seen : corona_s10(kLongitude_deg[row], kLatitude_deg[column]));
            }
        }
        return logs;
    }();
    return table;
}

struct Place {
    std::size_t low;
    double share;
};

template <std::size_t Count>
Place place_in(const std::array<double, Count>& nodes, double value) {
    std::size_t low = 0;
    while (low + 2 < Count && nodes[low + 1] <= value)
        ++low;
    return {low, std::clamp((value - nodes[low]) / (nodes[low + 1] - nodes[low]), 0.0, 1.0)};
}

}  // namespace

double zodiacal_s10(double longitude_rad, double latitude_rad) noexcept {
    const double longitude_deg = std::abs(std::remainder(longitude_rad, 2.0 * std::numbers::pi)) / kDegree;
    const Place row = place_in(kLongitude_deg, longitude_deg);
    const Place column = place_in(kLatitude_deg, std::abs(latitude_rad) / kDegree);
    const LogTable& logs = log_table();
    const auto along = [&](std::size_t r) {
        return std::lerp(logs[r][column.low], logs[r][column.low + 1], column.share);
    };
    return std::exp2(std::lerp(along(row.low), along(row.low + 1), row.share));
}

double zodiacal_s10(const glm::dvec3& direction_gcrs, const glm::dvec3& sun_gcrs) noexcept {
    static const double c = std::cos(kObliquity_rad);
    static const double s = std::sin(kObliquity_rad);
    const glm::dvec3 pole{0.0, -s, c};
    const double north = std::abs(glm::dot(pole, direction_gcrs));
    const double level = glm::length(glm::cross(pole, direction_gcrs));
    // cos elongation = cos latitude cos longitude, the Sun on the ecliptic.
    const double apart = glm::length(glm::cross(sun_gcrs, direction_gcrs));
    const double aside = std::sqrt(std::max(0.0, (apart - north) * (apart + north)));
    const double towards = glm::dot(sun_gcrs, direction_gcrs);
    return zodiacal_s10(std::atan2(aside, towards), std::atan2(north, level));
}

double typical_zodiacal_s10() noexcept {
    constexpr int kLatitudes = 60;
    constexpr int kLongitudes = 90;
    const double ecliptic = std::sin(20.0 * kDegree);
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < kLatitudes; ++i) {
        const double latitude_rad = std::asin(std::lerp(ecliptic, 1.0, (i + 0.5) / kLatitudes));
        for (int j = 0; j < kLongitudes; ++j) {
            const double longitude_rad = (j + 0.5) * std::numbers::pi / kLongitudes;
            if (longitude_rad < 0.5 * std::numbers::pi) continue;
            sum += std::log(zodiacal_s10(longitude_rad, latitude_rad));
            ++count;
        }
    }
    return std::exp(sum / count);
}

}  // namespace skyig::render::night
