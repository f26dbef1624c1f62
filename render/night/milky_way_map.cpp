#include "render/night/milky_way_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/night/starlight.h"
#include "render/night/zodiacal_light.h"

namespace skyig::render::night {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr double kColumnStep_rad = 2.0 * kPi / (MilkyWayMap::kWidth - 1);
constexpr double kRowStep_rad = 2.0 * kBelt_rad / (MilkyWayMap::kHeight - 1);

constexpr double kSpread = 0.35;
constexpr double kGamma = 2.2;

std::uint32_t hashed(std::uint32_t x) {
    x ^= x >> 16U;
    x *= 0x7feb352dU;
    x ^= x >> 15U;
    x *= 0x846ca68bU;
    return x ^ (x >> 16U);
}

// Value noise, -1..1 at the points of a lattice.
double noise(const glm::dvec3& at, std::uint32_t seed) {
    const glm::dvec3 floor = glm::floor(at);
    const glm::dvec3 t = at - floor;
    const glm::dvec3 s = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    const glm::uvec3 low{glm::ivec3{floor}};
    const auto edge = [&](std::uint32_t row) {
        const double first = hashed(low.x + row);
        const double second = hashed(low.x + 1U + row);
        return (first + (second - first) * s.x) * (2.0 / 4294967295.0) - 1.0;
    };
    const auto face = [&](std::uint32_t layer) {
        const double first = edge(hashed(low.y + layer));
        return first + (edge(hashed(low.y + 1U + layer)) - first) * s.y;
    };
    const double first = face(hashed(low.z + seed));
    return first + (face(hashed(low.z + 1U + seed)) - first) * s.z;
}

// Rms about 0.5.
double fractal(glm::dvec3 at, int octaves, std::uint32_t seed) {
    double sum = 0.0;
    double height = 0.8;
    for (int i = 0; i < octaves; ++i) {
        sum += height * noise(at, seed + static_cast<std::uint32_t>(i));
        height *= 0.62;
        at = at * 2.03 + glm::dvec3{13.1, 7.7, 3.9};
    }
    return sum;
}

double bell(double x) {
    return std::exp(-0.5 * x * x);
}

// A cloud of stars (gain > 0) or of dust (< 0): centre, half widths in longitude and latitude, degrees.
struct Cloud {
    double l, b, along, across, gain;
};
constexpr std::array<Cloud, 10> kClouds{{{287.5, -0.8, 3.0, 1.6, 1.0},    // Carina
                                         {330.0, -2.2, 5.0, 1.8, 0.45},   // Norma
                                         {27.0, -2.9, 2.6, 1.9, 0.7},     // Scutum
                                         {12.8, -1.5, 1.6, 1.0, 0.8},     // Sagittarius, small
                                         {3.5, -4.5, 4.0, 2.5, 0.35},     // Sagittarius, great
                                         {72.0, 2.6, 5.0, 2.4, 0.55},     // Cygnus
                                         {117.0, -1.5, 8.0, 2.0, 0.25},   // Cassiopeia
                                         {302.8, -0.5, 2.3, 2.3, -0.75},  // Coalsack
                                         {353.0, 5.0, 5.0, 3.0, -0.55},   // Ophiuchus, Pipe
                                         {84.0, 1.0, 2.4, 1.6, -0.55}}};  // Northern Coalsack

// How much of the light the Great Rift and the thin layer of dust let through.
double rift(double l_deg, double b_deg, double wander_deg) {
    const double l = std::remainder(l_deg, 360.0);
    const double long_range = bell((l - 12.0) / 42.0);
    const double centre_deg = 1.2 + 2.6 * bell((l - 25.0) / 25.0) + 3.0 * wander_deg;
    const double lane = 0.8 * long_range * bell((b_deg - centre_deg) / 1.7);
    const double layer = 0.3 * bell((b_deg - 1.5 * wander_deg) / 1.1);
    return (1.0 - lane) * (1.0 - layer);
}

double detail(double longitude_rad, double latitude_rad, std::uint32_t seed) {
    const double l = longitude_rad / kDegree;
    const double b = latitude_rad / kDegree;
    const double c = std::cos(latitude_rad);
    // Clouds are drawn out along the plane.
    const glm::dvec3 at{c * std::cos(longitude_rad), c * std::sin(longitude_rad),
                        1.8 * std::sin(latitude_rad)};
    const double wander = fractal(at * 5.0, 4, seed + 101U);
    double clouds = 1.0;
    for (const Cloud& cloud : kClouds) {
        const double x = std::remainder(l - cloud.l, 360.0) / cloud.along;
        const double y = (b - cloud.b) / cloud.across;
        if (x * x + y * y < 16.0) clouds *= 1.0 + cloud.gain * bell(x) * bell(y);
    }
    return clouds * rift(l, b, wander) * std::exp(2.0 * kSpread * fractal(at * 9.0, 5, seed));
}

}  // namespace

double MilkyWayMap::warped(double luminance_cd_m2) noexcept {
    return std::pow(1.0 + luminance_cd_m2 / kWarp_cd_m2, 1.0 / kGamma) - 1.0;
}

double MilkyWayMap::unwarped(double t) noexcept {
    return kWarp_cd_m2 * (std::pow(1.0 + t, kGamma) - 1.0);
}

MilkyWayMap::MilkyWayMap()
    : texels_(static_cast<std::size_t>(kWidth) * kHeight),
      raw_(static_cast<std::size_t>(kAround) * (2 * kMeanRows + 1)) {}

void MilkyWayMap::begin(double structure, std::uint32_t seed) noexcept {
    structure_ = structure;
    seed_ = seed;
    next_row_ = 0;
}

// Rows are finished eight rows behind those whose detail is new: then the window is whole.
bool MilkyWayMap::build_rows(int most_rows) noexcept {
    const int last = std::min(next_row_ + most_rows, kHeight);
    for (; next_row_ < last; ++next_row_) {
        detail_row(next_row_);
        sum_row(next_row_);
        if (next_row_ >= kMeanRows) finish_row(next_row_ - kMeanRows);
        if (next_row_ + 1 < kHeight) continue;
        for (int row = kHeight - kMeanRows; row < kHeight; ++row)
            finish_row(row);
    }
    return complete();
}

std::span<MilkyWayMap::Raw> MilkyWayMap::raw_row(int row) noexcept {
    const auto place = static_cast<std::size_t>(row % (2 * kMeanRows + 1));
    return std::span(raw_).subspan(place * kAround, kAround);
}

void MilkyWayMap::detail_row(int row) noexcept {
    const double latitude_rad = row * kRowStep_rad - kBelt_rad;
    for (int column = 0; Raw & raw : raw_row(row)) {
        const double longitude_rad = column++ * kColumnStep_rad;
        raw.smooth_cd_m2 = static_cast<float>(kS10_cd_m2 * starlight_s10(longitude_rad, latitude_rad).belt);
        raw.detail = static_cast<float>(
            structure_ > 0.0 ? std::pow(detail(longitude_rad, latitude_rad, seed_), structure_) : 1.0);
    }
}

void MilkyWayMap::sum_row(int row) noexcept {
    const std::span<Raw> raw = raw_row(row);
    const auto at = [raw](int column) -> Raw& {
        return raw[static_cast<std::size_t>((column + kAround) % kAround)];
    };
    double smooth = 0.0;
    double detailed = 0.0;
    const auto take = [&](int column, double sign) {
        const double light = sign * static_cast<double>(at(column).smooth_cd_m2);
        smooth += light;
        detailed += light * static_cast<double>(at(column).detail);
    };
    for (int column = -kMeanColumns; column < kMeanColumns; ++column)
        take(column, 1.0);
    for (int column = 0; column < kAround; ++column) {
        take(column + kMeanColumns, 1.0);
        at(column).smooth_sum = smooth;
        at(column).detailed_sum = detailed;
        take(column - kMeanColumns, -1.0);
    }
}

// Divides by the mean of what the window shows, so that photometry is the fit's.
void MilkyWayMap::finish_row(int row) noexcept {
    const int first = std::max(row - kMeanRows, 0);
    const int last = std::min(row + kMeanRows, kHeight - 1);
    float* out = &texels_[static_cast<std::size_t>(row) * kWidth];
    for (std::size_t column = 0; column < kAround; ++column) {
        double smooth = 1e-12;
        double detailed = 1e-12;
        for (int r = first; r <= last; ++r) {
            const Raw& raw = raw_row(r)[column];
            smooth += raw.smooth_sum;
            detailed += raw.detailed_sum;
        }
        const Raw& here = raw_row(row)[column];
        const double luminance =
            static_cast<double>(here.smooth_cd_m2) * static_cast<double>(here.detail) * smooth / detailed;
        out[column] = static_cast<float>(warped(luminance));
    }
    out[kAround] = out[0];
}

glm::dvec2 MilkyWayMap::place(double longitude_rad, double latitude_rad) noexcept {
    return {longitude_rad / (2.0 * kPi), 0.5 * (latitude_rad / kBelt_rad + 1.0)};
}

double MilkyWayMap::luminance_cd_m2(const glm::dvec3& direction) const noexcept {
    const double latitude_rad = std::asin(std::clamp(direction.z, -1.0, 1.0));
    if (!complete() || std::abs(latitude_rad) >= kBelt_rad) return 0.0;
    const double longitude_rad = std::atan2(direction.y, direction.x);
    const glm::dvec2 at =
        place(longitude_rad < 0.0 ? longitude_rad + 2.0 * kPi : longitude_rad, latitude_rad);
    const double x = at.x * (kWidth - 1);
    const double y = at.y * (kHeight - 1);
    const auto column = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(kWidth) - 2);
    const auto row = std::min(static_cast<std::size_t>(y), static_cast<std::size_t>(kHeight) - 2);
    const float* t = &texels_[row * kWidth + column];
    const double along = x - static_cast<double>(column);
    const auto mixed = [along](const float* pair) {
        return std::lerp(static_cast<double>(pair[0]), static_cast<double>(pair[1]), along);
    };
    return unwarped(std::lerp(mixed(t), mixed(t + kWidth), y - static_cast<double>(row)));
}

double mean_starlight_cd_m2(const MilkyWayMap& map, double longitude_rad, double latitude_rad,
                            double disc_radius_rad) noexcept {
    constexpr int kSteps = 4;  // each way from the middle
    double sum = 0.0;
    int count = 0;
    for (int y = -kSteps; y <= kSteps; ++y) {
        for (int x = -kSteps; x <= kSteps; ++x) {
            if (x * x + y * y > kSteps * kSteps) continue;
            const double b = latitude_rad + y * disc_radius_rad / kSteps;
            const double l = longitude_rad + x * disc_radius_rad / (kSteps * std::cos(b));
            sum += map.luminance_cd_m2({std::cos(b) * std::cos(l), std::cos(b) * std::sin(l), std::sin(b)}) +
                   kS10_cd_m2 * starlight_s10(l, b).even;
            ++count;
        }
    }
    return sum / count;
}

}  // namespace skyig::render::night
