#include "render/dome.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/eye/tone_curve.h"

namespace skyig::render {

namespace {

constexpr double kPi = std::numbers::pi;

// Puts `nodes` so that each interval holds the same share of the density's integral over [low, high]; both
// ends are nodes.
template <class Density>
void place_by_density(std::span<double> nodes, double low, double high, Density density) {
    constexpr std::size_t kSteps = 1024;
    std::array<double, kSteps + 1> sum{};
    const double step = (high - low) / kSteps;
    for (std::size_t i = 0; i < kSteps; ++i) {
        sum[i + 1] = sum[i] + density(low + (static_cast<double>(i) + 0.5) * step);
    }
    std::size_t at = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const double wanted = sum[kSteps] * static_cast<double>(n) / static_cast<double>(nodes.size() - 1);
        while (at + 1 < kSteps && sum[at + 1] < wanted)
            ++at;
        const double share = (wanted - sum[at]) / (sum[at + 1] - sum[at]);
        nodes[n] = low + (static_cast<double>(at) + share) * step;
    }
    nodes.front() = low;
    nodes.back() = high;
}

double peak(double distance, double width) {
    return 1.0 / (std::abs(distance) + width);
}

}  // namespace

Dome::Dome() {
    // Sky rows from the horizon up, ground rows from the horizon down, the two edge rows a softening angle
    // apart.
    const std::size_t row_count = kSkyRows + kGroundRows;
    rows_.resize(row_count);
    azimuths_rad_.resize(kColumns + 1);
    vertices_.resize(row_count * (kColumns + 1));
    constexpr std::uint32_t kStride = kColumns + 1;
    for (std::uint32_t row = 0; row + 1 < row_count; ++row) {
        for (std::uint32_t column = 0; column < kColumns; ++column) {
            const std::uint32_t corner = row * kStride + column;
            for (const std::uint32_t index :
                 {corner, corner + 1, corner + kStride, corner + kStride, corner + 1, corner + kStride + 1}) {
                indices_.push_back(index);
            }
        }
    }
}

void Dome::lay_out(const DomeLayout& layout) {
    layout_ = layout;
    const double horizon = layout.horizon_elevation_rad;
    const double source = layout.source_elevation_rad;

    std::array<double, kSkyRows> sky{};
    place_by_density(sky, horizon, 0.5 * kPi, [&](double e) {
        return 1.0 + 0.35 * peak(e - horizon, 0.002) + 0.25 * peak(e - std::max(source, horizon), 0.03);
    });
    std::array<double, kGroundRows> ground{};
    place_by_density(ground, -0.5 * kPi, horizon,
                     [&](double e) { return 0.3 + 0.5 * peak(e - horizon, 0.002); });

    const double half_edge = 0.5 * layout.edge_rad;
    for (std::size_t i = 0; i < kGroundRows; ++i)
        rows_[i] = {ground[i], ground[i], Side::kGround};
    for (std::size_t i = 0; i < kSkyRows; ++i)
        rows_[kGroundRows + i] = {sky[i], sky[i], Side::kSky};
    // The colours of the edge rows belong to the horizon itself; only their place is spread over one pixel.
    rows_[kGroundRows - 1].elevation_rad = horizon - half_edge;
    rows_[kGroundRows].elevation_rad = horizon + half_edge;

    std::array<double, kColumns / 2 + 1> half_turn{};
    place_by_density(half_turn, 0.0, kPi, [&](double a) { return 0.8 + 0.25 * peak(a, 0.03); });
    for (std::size_t i = 0; i < half_turn.size(); ++i) {
        azimuths_rad_[kColumns / 2 + i] = half_turn[i];
        azimuths_rad_[kColumns / 2 - i] = -half_turn[i];
    }

    std::size_t out = 0;
    for (const Row& row : rows_) {
        for (const double azimuth : azimuths_rad_) {
            vertices_[out++].direction = glm::vec3{direction_of({row.elevation_rad, azimuth})};
        }
    }
}

void Dome::shade(const SkyLight& light, double source_azimuth_rad, const shaders64::ToneParameters& tone) {
    const auto tone32 = eye::single_precision(tone);
    std::size_t out = 0;
    for (const Row& row : rows_) {
        for (const double azimuth : azimuths_rad_) {
            const glm::vec3 rgb =
                light.rgb_cd_m2(row.light_elevation_rad, source_azimuth_rad + azimuth, row.side);
            vertices_[out++].encoded = shaders32::shown(rgb, tone32);
        }
    }
}

glm::dmat3 Dome::enu_from_mesh(double source_azimuth_rad) noexcept {
    const double c = std::cos(source_azimuth_rad);
    const double s = std::sin(source_azimuth_rad);
    return {glm::dvec3{c, -s, 0.0}, glm::dvec3{s, c, 0.0}, glm::dvec3{0.0, 0.0, 1.0}};
}

}  // namespace skyig::render
