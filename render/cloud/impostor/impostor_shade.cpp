// The light that impostors leave on the ground: each particle's shade is laid where the beam through it comes
// down.
#include <algorithm>
#include <array>
#include <cmath>

#include "render/cloud/impostor/impostor_field.h"

namespace skyig::render::cloud::impostor {
namespace {

// Neighbours that are asked together.
constexpr std::size_t kPlaces = 16;
constexpr float kEarthRadius_m = 6371000.0F;
// A beam along the ground would meet all clouds there are.
constexpr float kLowest = 0.01F;

}  // namespace

struct ImpostorField::Shade {
    glm::vec3 towards;
    float grain_m;
    std::span<const glm::vec2> places_m;
    glm::vec2 low_m;
    glm::vec2 high_m;
    std::array<float, kPlaces> depth;

    /// Whether a sphere whose shade is laid round `foot_m` may dim one of the places.
    [[nodiscard]] bool meets(const glm::vec2& foot_m, float radius_m) const noexcept {
        // Along the beam its shade is longer than wide.
        const glm::vec2 reach = radius_m * (1.0F + glm::abs(glm::vec2{towards}) / towards.z);
        return foot_m.x + reach.x > low_m.x && foot_m.x - reach.x < high_m.x &&
               foot_m.y + reach.y > low_m.y && foot_m.y - reach.y < high_m.y;
    }
};

void ImpostorField::add_shade(const Placed& cloud, Shade& shade) const noexcept {
    const Cloud& now = cloud.layer->clouds()[cloud.cloud];
    if (!now.alive || now.key != cloud.key || now.particles == 0) return;
    const glm::vec2 aside{cloud.middle_m};
    const float ground_z =
        std::min(static_cast<float>(-eye_height_m_), 0.0F) - 0.5F * glm::dot(aside, aside) / kEarthRadius_m;
    const auto foot_of = [&](const glm::vec3& point_m) {
        return glm::vec2{point_m} -
               glm::vec2{shade.towards} * (std::max(point_m.z - ground_z, 0.0F) / shade.towards.z);
    };
    if (!shade.meets(foot_of(cloud.middle_m), now.bound_m + shade.grain_m)) return;
    const glm::vec2 along{shade.towards};
    for (const Particle& particle : cloud.layer->particles(now)) {
        // What is finer than the grain is spread over it.
        const float own2 = particle.radius_m * particle.radius_m;
        const float radius2 = own2 + shade.grain_m * shade.grain_m;
        const glm::vec2 foot_m = foot_of(cloud.middle_m + particle.centre_m);
        if (!shade.meets(foot_m, std::sqrt(radius2))) continue;
        const float most = cloud.part * particle.optical_depth * own2 / radius2;
        for (std::size_t i = 0; i < shade.places_m.size(); ++i) {
            const glm::vec2 apart = shade.places_m[i] - foot_m;
            const float forward = glm::dot(apart, along);
            const float inside = 1.0F - (glm::dot(apart, apart) - forward * forward) / radius2;
            if (inside > 0.0F) shade.depth[i] += most * inside * inside * std::sqrt(inside);
        }
    }
}

void ImpostorField::shadow(const CloudBeam& beam, float grain_m, std::span<const glm::vec2> ground_m,
                           std::span<float> passed) const noexcept {
    Shade shade{};
    shade.towards = beam.direction_enu;
    shade.towards.z = std::max(shade.towards.z, kLowest);
    shade.grain_m = grain_m;
    for (std::size_t first = 0; first < ground_m.size(); first += kPlaces) {
        shade.places_m = ground_m.subspan(first, std::min(kPlaces, ground_m.size() - first));
        shade.low_m = shade.high_m = shade.places_m[0];
        for (const glm::vec2& place : shade.places_m) {
            shade.low_m = glm::min(shade.low_m, place);
            shade.high_m = glm::max(shade.high_m, place);
        }
        shade.depth.fill(0.0F);
        for (std::size_t i = 0; i < placed_count_; ++i)
            add_shade(placed_[i], shade);
        for (std::size_t i = 0; i < shade.places_m.size(); ++i)
            passed[first + i] = std::exp(-shade.depth[i]);
    }
}

}  // namespace skyig::render::cloud::impostor
