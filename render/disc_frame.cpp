#include "render/disc_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/eye/fovea.h"
#include "render/night/moon_light.h"

namespace skyig::render {

namespace {

// Tables fade transmittance out while a disc sets, which the shader does by cutting the disc: they are asked
// no lower than where the whole disc still stands above the horizon.
constexpr double kWholeDisc_rad = 0.0048;

void place(const Horizontal& at, const glm::dvec3& true_centre_enu, DiscFrame& frame) {
    const Horizontal true_at = horizontal_of(true_centre_enu);
    const glm::dvec3 right{std::cos(at.azimuth_rad), -std::sin(at.azimuth_rad), 0.0};
    const auto up_of = [](const Horizontal& h) {
        const double sine = std::sin(h.elevation_rad);
        return glm::dvec3{-sine * std::sin(h.azimuth_rad), -sine * std::cos(h.azimuth_rad),
                          std::cos(h.elevation_rad)};
    };
    frame.centre_enu = direction_of(at);
    frame.right_enu = right;
    frame.up_enu = up_of(at);
    frame.true_centre_enu = true_centre_enu;
    frame.true_up_enu = up_of(true_at);
}

void lay_rows(double true_rad, double seen_rad, double reach_rad, const SkyLight& light, DiscFrame& frame) {
    const sky::RefractionRow& bend = light.refraction;
    const double margin_rad = 2.0 * static_cast<double>(frame.pixel_rad);
    const double low_rad = bend.apparent_from_true(true_rad - reach_rad) - margin_rad;
    const double high_rad = bend.apparent_from_true(true_rad + reach_rad) + margin_rad;
    const auto half_width = static_cast<float>(std::tan(reach_rad + margin_rad));
    for (std::size_t row = 0; row < DiscFrame::kRows; ++row) {
        const double share = static_cast<double>(row) / (DiscFrame::kRows - 1);
        const double at_rad = low_rad + share * (high_rad - low_rad);
        const auto seen_up = static_cast<float>(std::tan(at_rad - seen_rad));
        const auto true_up = static_cast<float>(std::tan(bend.true_from_apparent(at_rad) - true_rad));
        const auto stretch = static_cast<float>(1.0 / bend.vertical_scale(at_rad));
        frame.vertices[2 * row] = {{-half_width, seen_up}, true_up, stretch, glm::vec3{0.0F}};
        frame.vertices[2 * row + 1] = {{half_width, seen_up}, true_up, stretch, glm::vec3{0.0F}};
        frame.straight_elevation_rad[row] =
            std::max(light.straight_elevation_rad(at_rad), light.straight_horizon_rad + kWholeDisc_rad);
    }
}

}  // namespace

DiscFrame disc_frame(const glm::dvec3& direction_enu, double angular_radius_rad, double pixel_rad,
                     const SkyLight& light, double reach_radii) noexcept {
    const Horizontal true_at = horizontal_of(direction_enu);
    const Horizontal at{light.refraction.apparent_from_true(true_at.elevation_rad), true_at.azimuth_rad};
    DiscFrame frame;
    frame.radius = static_cast<float>(std::tan(angular_radius_rad));
    frame.pixel_rad = static_cast<float>(pixel_rad);
    frame.horizon_rad = static_cast<float>(light.horizon_elevation_rad);
    place(at, glm::normalize(direction_enu), frame);
    lay_rows(true_at.elevation_rad, at.elevation_rad, reach_radii * angular_radius_rad, light, frame);

    const double aside_rad = angular_radius_rad / std::max(std::cos(at.elevation_rad), angular_radius_rad);
    const auto sky = [&](double up_rad, double right_rad) {
        return light.rgb_cd_m2(at.elevation_rad + up_rad, at.azimuth_rad + right_rad, Side::kSky);
    };
    frame.background_cd_m2 = sky(0.0, 0.0);
    frame.background_up = 0.5F * (sky(angular_radius_rad, 0.0) - sky(-angular_radius_rad, 0.0));
    frame.background_right = 0.5F * (sky(0.0, aside_rad) - sky(0.0, -aside_rad));
    return frame;
}

shaders64::Fovea moon_fovea(const Scene& scene, const sky::AirTables& air, const SkyLight& light,
                            const DisplaySettings& display, const shaders64::ToneParameters& tone) noexcept {
    const double seen_rad =
        light.refraction.apparent_from_true(horizontal_of(scene.moon.direction_enu).elevation_rad);
    const double straight_rad =
        std::max(light.straight_elevation_rad(seen_rad), light.straight_horizon_rad + kWholeDisc_rad);
    const double passed = light.veil_passes(straight_rad) *
                          shaders64::luminance_709(air.transmittance_rgb(light.eye_height_m, straight_rad));
    const double mean_cd_m2 =
        std::max(passed * night::moon_mean_cd_m2(scene.moon, scene.sun.distance_au), 1.0);
    return eye::fovea(display, tone, 1e-4 * mean_cd_m2, mean_cd_m2);
}

}  // namespace skyig::render
