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
    constexpr std::size_t kSteps = 2048;
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
    directions_.resize(vertices_.size());
}

void Dome::lay_out(const DomeLayout& layout) {
    layout_ = layout;
    const double horizon = layout.horizon_elevation_rad;
    const double half_edge = 0.5 * layout.edge_rad;
    const double first = layout.first_lights ? 0.25 : 0.0;
    const double second = layout.second_lights ? 0.25 : 0.0;

    std::array<double, kSkyRows> sky{};
    place_by_density(sky, horizon + half_edge, 0.5 * kPi, [&](double e) {
        return 1.0 + 0.35 * peak(e - horizon, 0.002) +
               first * peak(e - std::max(layout.first_elevation_rad, horizon), 0.03) +
               second * peak(e - std::max(layout.second_elevation_rad, horizon), 0.03);
    });
    std::array<double, kGroundRows> ground{};
    place_by_density(ground, -0.5 * kPi, horizon - half_edge, [&](double e) {
        double density = 0.3 + 0.5 * peak(e - horizon, 0.002);
        if (layout.sea) {
            density += first * peak(e - layout.first_mirror_rad, 0.05) +
                       second * peak(e - layout.second_mirror_rad, 0.05);
        }
        return density;
    });
    for (std::size_t i = 0; i < kGroundRows; ++i)
        rows_[i] = {ground[i], ground[i] - horizon, Side::kGround};
    for (std::size_t i = 0; i < kSkyRows; ++i)
        rows_[kGroundRows + i] = {sky[i], sky[i] - horizon, Side::kSky};
    // The colours of the edge rows belong to the horizon itself; only their place is spread over one pixel.
    rows_[kGroundRows - 1].above_horizon_rad = 0.0;
    rows_[kGroundRows].above_horizon_rad = 0.0;

    // Low light lays a narrow path on the water.
    const double width = layout.sea ? 0.006 : 0.03;
    place_by_density(azimuths_rad_, -kPi, kPi, [&](double a) {
        const double from_second = std::remainder(a - layout.second_azimuth_rad, 2.0 * kPi);
        return 0.8 + first * peak(a, width) + second * peak(from_second, width);
    });

    std::size_t out = 0;
    for (const Row& row : rows_) {
        for (const double azimuth : azimuths_rad_) {
            directions_[out] = glm::vec3{direction_of({row.elevation_rad, azimuth})};
            vertices_[out].direction = directions_[out];
            ++out;
        }
    }
    patches_.bound(directions_);
}

void Dome::shade(const SkyLight& light, const shaders64::ToneParameters& tone) {
    const auto tone32 = eye::single_precision(tone);
    const double turn = dome_azimuth_rad(light);
    std::size_t out = 0;
    for (const Row& row : rows_) {
        const double elevation = light.horizon_elevation_rad + row.above_horizon_rad;
        for (const double azimuth : azimuths_rad_) {
            const glm::vec3 rgb = light.rgb_cd_m2(elevation, turn + azimuth, row.side);
            vertices_[out++].encoded = shaders32::shown(rgb, tone32);
        }
    }
}

DomeLayout dome_layout(const SkyLight& light, double edge_rad) noexcept {
    DomeLayout layout;
    layout.horizon_elevation_rad = light.horizon_elevation_rad;
    layout.edge_rad = edge_rad;
    const bool sun = light.sun.view != nullptr;
    const bool moon = light.moon.view != nullptr;
    const LitAir& first = sun ? light.sun : light.moon;
    layout.first_lights = sun || moon;
    layout.first_elevation_rad = first.source.elevation_rad;
    layout.second_lights = sun && moon;
    layout.second_elevation_rad = light.moon.source.elevation_rad;
    layout.second_azimuth_rad =
        layout.second_lights
            ? std::remainder(light.moon.source.azimuth_rad - light.sun.source.azimuth_rad, 2.0 * kPi)
            : 0.0;
    layout.sea = light.sea != nullptr;
    if (layout.sea) {
        layout.first_mirror_rad = sky::mirror_elevation_rad(light.eye_height_m, layout.first_elevation_rad);
        layout.second_mirror_rad = sky::mirror_elevation_rad(light.eye_height_m, layout.second_elevation_rad);
    }
    return layout;
}

double dome_azimuth_rad(const SkyLight& light) noexcept {
    if (light.sun.view != nullptr) return light.sun.source.azimuth_rad;
    return light.moon.view != nullptr ? light.moon.source.azimuth_rad : 0.0;
}

bool still_serves(const DomeLayout& held, const DomeLayout& wanted) noexcept {
    constexpr double kSourceStep_rad = 0.005;
    const auto near = [](double a, double b) {
        return std::abs(std::remainder(a - b, 2.0 * kPi)) < kSourceStep_rad;
    };
    return held.edge_rad == wanted.edge_rad && held.first_lights == wanted.first_lights &&
           held.second_lights == wanted.second_lights &&
           std::abs(held.horizon_elevation_rad - wanted.horizon_elevation_rad) < 0.05 * wanted.edge_rad &&
           held.sea == wanted.sea && near(held.first_mirror_rad, wanted.first_mirror_rad) &&
           near(held.second_mirror_rad, wanted.second_mirror_rad) &&
           near(held.first_elevation_rad, wanted.first_elevation_rad) &&
           near(held.second_elevation_rad, wanted.second_elevation_rad) &&
           near(held.second_azimuth_rad, wanted.second_azimuth_rad);
}

glm::dmat3 Dome::enu_from_mesh(double azimuth_rad) noexcept {
    const double c = std::cos(azimuth_rad);
    const double s = std::sin(azimuth_rad);
    return {glm::dvec3{c, -s, 0.0}, glm::dvec3{s, c, 0.0}, glm::dvec3{0.0, 0.0, 1.0}};
}

}  // namespace skyig::render
