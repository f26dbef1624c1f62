#include "render/rain_light.h"

#include <cmath>
#include <numbers>

#include "render/geometry.h"

namespace skyig::render {

namespace {

constexpr float kWater = 0.94F;
constexpr float kFlakes = 0.9F;
// Mean of the cosine from an axis over the half of directions about it, weighed by that cosine.
constexpr float kHalf = 2.0F / 3.0F;

// A gradient is the whole truth of smooth light alone; round a low Sun it would leave less than nothing on
// the other side: what remains there is no less than this part of the mean.
constexpr float kLeast = 0.3F;

Surroundings as_seen(const Surroundings& around, float share, float direction_share) {
    const glm::vec3 luminance{0.2126F, 0.7152F, 0.0722F};
    const float mean = glm::dot(luminance, around.mean_cd_m2);
    const float steep = direction_share * glm::length(luminance * around.gradient_cd_m2);
    const float most = (1.0F - kLeast) * mean;
    const float kept = steep > most ? most / steep : 1.0F;
    return {share * around.mean_cd_m2, share * direction_share * kept * around.gradient_cd_m2};
}

}  // namespace

Surroundings surroundings(const SkyLight& light) noexcept {
    constexpr int kDirections = 48;
    Surroundings sum;
    for (int i = 0; i < kDirections; ++i) {
        // Evenly over the sphere, along a spiral.
        const double height = 1.0 - (2.0 * i + 1.0) / kDirections;
        const double azimuth_rad =
            std::remainder(i * std::numbers::pi * (3.0 - std::sqrt(5.0)), 2.0 * std::numbers::pi);
        const Horizontal at{std::asin(height), azimuth_rad};
        const glm::vec3 rgb =
            glm::max(light.covered_rgb_cd_m2(at.elevation_rad, at.azimuth_rad, Side::kByElevation), 0.0F);
        sum.mean_cd_m2 += rgb / static_cast<float>(kDirections);
        sum.gradient_cd_m2 +=
            glm::outerProduct(rgb, glm::vec3{direction_of(at)}) * (3.0F / static_cast<float>(kDirections));
    }
    return sum;
}

Surroundings shown_by(Precipitation::Kind kind, const Surroundings& around) noexcept {
    switch (kind) {
        case Precipitation::Kind::kRain:
        case Precipitation::Kind::kDrizzle:
            return as_seen(around, kWater, kHalf);
        case Precipitation::Kind::kSnow:
            return as_seen(around, kFlakes, 0.0F);
        case Precipitation::Kind::kSleet:
        case Precipitation::Kind::kHail:
            break;
    }
    return as_seen(around, 0.5F * (kWater + kFlakes), 0.5F * kHalf);
}

}  // namespace skyig::render
