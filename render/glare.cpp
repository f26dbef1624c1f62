#include "render/glare.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/colour.h"
#include "render/eye/fovea.h"
#include "render/night/moon_light.h"

namespace skyig::render {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// Angles at which the veil is tried, from the limb out.
constexpr int kTrials = 24;

double luminance(const glm::dvec3& rgb) {
    return shaders64::luminance_709(rgb);
}

// Right, up and out, in the scene's axes.
glm::dmat3 source_axes(const GlareSource& source) noexcept {
    const double azimuth_rad = source.at.azimuth_rad;
    const glm::dvec3 right{std::cos(azimuth_rad), -std::sin(azimuth_rad), 0.0};
    const glm::dvec3 out = direction_of(source.at);
    return {right, glm::cross(right, out), out};
}

// Where the air shows a disc.
GlareSource unlit_source(const glm::dvec3& airless_enu, double radius_rad, const SkyLight& light) noexcept {
    const Horizontal airless = horizontal_of(airless_enu);
    return {{light.refraction.apparent_from_true(airless.elevation_rad), airless.azimuth_rad},
            radius_rad,
            glm::dvec3{0.0}};
}

}  // namespace

double veil_per_lux(double angle_rad) noexcept {
    constexpr double kAge_years = 35.0;
    constexpr double kPigment = 0.5;
    const double of_age = 1.0 + std::pow(kAge_years / 62.5, 4.0);
    const double deg = std::max(angle_rad / kDegree, 0.1);
    return 10.0 / (deg * deg * deg) + (5.0 / (deg * deg) + 0.1 * kPigment / deg) * of_age + 0.0025 * kPigment;
}

GlareSource sun_glare(const Scene& scene, const sky::AirTables& air, const SkyLight& light) noexcept {
    GlareSource source = unlit_source(scene.sun.direction_enu, scene.sun.angular_radius_rad, light);
    if (!scene.sun.enabled) return source;
    const double straight_rad = light.straight_elevation_rad(source.at.elevation_rad);
    source.rgb_lux =
        light.veil_passes(straight_rad) * scene.sun.unobscured *
        (kRec709FromXyz * air.direct_sun_xyz(light.eye_height_m, straight_rad, scene.sun.distance_au));
    return source;
}

GlareSource moon_glare(const Scene& scene, const sky::AirTables& air, const SkyLight& light) noexcept {
    GlareSource source = unlit_source(scene.moon.direction_enu, scene.moon.angular_radius_rad, light);
    if (!scene.moon.enabled) return source;
    const double straight_rad = light.straight_elevation_rad(source.at.elevation_rad);
    source.rgb_lux = light.veil_passes(straight_rad) * scene.moon.sunlit *
                     night::moon_illuminance_lux(scene.moon, scene.sun.distance_au) * night::moon_tint_rgb() *
                     air.transmittance_rgb(light.eye_height_m, straight_rad);
    return source;
}

// One frame's veil as light and as what it adds to the picture.
struct Glare::Veiled {
    const DisplaySettings& display;
    const shaders64::ToneParameters& tone;
    glm::dvec3 rgb_lux;
    double reach_rad;

    // As the frame's curve is to show it over that background.
    [[nodiscard]] glm::dvec3 as_shown(const glm::dvec3& background, const glm::dvec3& veil,
                                      double angle_rad) const {
        constexpr double kEyeBesideDisc = 0.3;
        const double own = luminance(background + veil);
        if (!(own > 0.0)) return glm::dvec3{0.0};
        const double share = std::min(angle_rad / reach_rad, 1.0);
        const double fade = (1.0 - share * share) * (1.0 - share * share);
        return veil * (kEyeBesideDisc * fade * eye::looked_at_cd_m2(display, tone, own) / own);
    }
    [[nodiscard]] glm::vec3 added(const glm::dvec3& background, double angle_rad) const {
        const glm::dvec3 veil = rgb_lux * veil_per_lux(angle_rad);
        const double photopic = shaders64::photopic_share(luminance(background + veil));
        const glm::dvec3 with =
            shaders64::seen_before(as_shown(background, veil, angle_rad), photopic, background, tone);
        return glm::vec3{
            glm::max(shaders64::encoded(with, tone) - shaders64::shown(background, tone), glm::dvec3{0.0})};
    }
};

Glare::Glare() {
    for (std::size_t i = 0; i < kSectors; ++i) {
        const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / kSectors;
        circle_[i] = glm::vec2{glm::dvec2{std::cos(turn), std::sin(turn)}};
    }
}

std::vector<std::uint32_t> Glare::indices() {
    std::vector<std::uint32_t> indices;
    indices.reserve(kIndices);
    const auto at = [](std::size_t ring, std::size_t sector) {
        return static_cast<std::uint32_t>(1 + ring * kSectors + sector % kSectors);
    };
    for (std::size_t s = 0; s < kSectors; ++s)
        indices.insert(indices.end(), {0U, at(0, s), at(0, s + 1)});
    for (std::size_t ring = 0; ring + 1 < kRings; ++ring) {
        for (std::size_t s = 0; s < kSectors; ++s) {
            indices.insert(indices.end(), {at(ring, s), at(ring + 1, s), at(ring + 1, s + 1)});
            indices.insert(indices.end(), {at(ring, s), at(ring + 1, s + 1), at(ring, s + 1)});
        }
    }
    return indices;
}

bool still_serves(const GlareSource& made, const GlareSource& now) noexcept {
    constexpr double kStep_rad = 3.5e-4;
    constexpr double kStep = 0.005;
    const double was = luminance(made.rgb_lux);
    return std::abs(made.at.elevation_rad - now.at.elevation_rad) < kStep_rad &&
           std::abs(std::remainder(made.at.azimuth_rad - now.at.azimuth_rad, 2.0 * std::numbers::pi)) <
               kStep_rad &&
           std::abs(made.radius_rad - now.radius_rad) <= kStep * made.radius_rad &&
           std::abs(luminance(now.rgb_lux) - was) <= kStep * was;
}

void Glare::update(const GlareSource& source, const SkyLight& light, const DisplaySettings& display,
                   const shaders64::ToneParameters& tone) noexcept {
    reach_rad_ = 0.0;
    limb_ = {};
    vertices_.fill({});
    const glm::dvec3 lux = glm::max(source.rgb_lux, glm::dvec3{0.0});
    if (!display.glare || !(luminance(lux) > 0.0)) return;
    Veiled veiled{display, tone, lux, kReach_rad};
    find_reach(veiled, source, light);
    if (reach_rad_ <= 0.0) return;
    veiled.reach_rad = reach_rad_;
    const glm::dvec3 sky{light.rgb_cd_m2(source.at.elevation_rad, source.at.azimuth_rad, Side::kSky)};
    const glm::dvec3 veil = lux * veil_per_lux(source.radius_rad);
    limb_ = {glm::vec3{veiled.as_shown(sky, veil, source.radius_rad)},
             static_cast<float>(luminance(sky + veil))};
    lay(veiled, source, light);
}

void Glare::find_reach(const Veiled& veiled, const GlareSource& source, const SkyLight& light) noexcept {
    const double step = std::pow(kReach_rad / source.radius_rad, 1.0 / kTrials);
    double at_rad = source.radius_rad;
    double last = 0.0;
    for (int i = 0; i < kTrials; ++i, at_rad *= step) {
        // Upwards the sky is darker, and no ground comes between.
        const glm::dvec3 sky{
            light.rgb_cd_m2(source.at.elevation_rad + at_rad, source.at.azimuth_rad, Side::kSky)};
        const double codes = 255.0 * static_cast<double>(luminance(glm::dvec3{veiled.added(sky, at_rad)}));
        constexpr double kHalf = 0.5;
        if (codes < kHalf) {
            // Between the last trial and this one, as a straight line has it: no step from frame to frame.
            if (last > kHalf) reach_rad_ = at_rad * std::pow(step, -(kHalf - codes) / (last - codes));
            return;
        }
        last = codes;
    }
    reach_rad_ = kReach_rad;
}

void Glare::follow(const GlareSource& source, const SkyLight& light) noexcept {
    enu_from_source_ = glm::mat3{source_axes(source)};
    horizon_rad_ = static_cast<float>(light.horizon_elevation_rad);
}

void Glare::lay(const Veiled& veiled, const GlareSource& source, const SkyLight& light) noexcept {
    follow(source, light);
    const glm::dmat3 axes = source_axes(source);
    const glm::dvec3 right = axes[0], up = axes[1], out = axes[2];
    const bool low = source.at.elevation_rad - reach_rad_ < light.horizon_elevation_rad;
    const double ratio = std::pow(reach_rad_ / source.radius_rad, 1.0 / (kRings - 1));
    double ring_rad = source.radius_rad;
    for (std::size_t ring = 0; ring < kRings; ++ring, ring_rad *= ratio) {
        const auto extent = static_cast<float>(std::tan(ring_rad));
        for (std::size_t s = 0; s < kSectors; ++s) {
            GlareVertex& vertex = vertices_[1 + ring * kSectors + s];
            vertex.offset = circle_[s] * extent;
            const Horizontal at = horizontal_of(out + static_cast<double>(vertex.offset.x) * right +
                                                static_cast<double>(vertex.offset.y) * up);
            const auto over = [&](Side side) {
                const glm::dvec3 behind{light.rgb_cd_m2(at.elevation_rad, at.azimuth_rad, side)};
                return ring + 1 < kRings ? veiled.added(behind, ring_rad) : glm::vec3{0.0F};
            };
            vertex.over_sky = over(Side::kSky);
            vertex.over_ground = low ? over(Side::kGround) : vertex.over_sky;
        }
    }
    vertices_[0] = {glm::vec2{0.0F}, glm::vec3{0.0F}, glm::vec3{0.0F}};
    for (std::size_t s = 0; s < kSectors; ++s) {
        vertices_[0].over_sky += vertices_[1 + s].over_sky / static_cast<float>(kSectors);
        vertices_[0].over_ground += vertices_[1 + s].over_ground / static_cast<float>(kSectors);
    }
}

}  // namespace skyig::render
