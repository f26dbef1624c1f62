#include "render/cloud/impostor/particles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/cloud/impostor/noise.h"

namespace skyig::render::cloud::impostor {

namespace {

constexpr float kSmallest = 0.6F;  // radius of the least particle, of the largest one's
// Overlapping particles: the lattice's mean density over that of one particle's middle is
// 32 pi / 105 (radius / spacing)^3.
constexpr float kOverlap = 1.2F;
constexpr float kMeanDensity = 0.957F * kOverlap * kOverlap * kOverlap;
// Of a cell's box, what a cloud fills at most.
constexpr float kFilled = 2.0F;
constexpr double kUsualExtinction_per_m = 0.04;
constexpr double kIceExtinction_per_m = 0.001;
/// Shapes are new after about this time.
constexpr double kLife_s = 900.0;

double usual_extinction_per_m(CloudGenus genus) {
    const bool ice = genus == CloudGenus::kCirrus || genus == CloudGenus::kCirrostratus ||
                     genus == CloudGenus::kCirrocumulus;
    return ice ? kIceExtinction_per_m : kUsualExtinction_per_m;
}

// About the width of a cloud's parts.
double cell_m(CloudGenus genus) {
    switch (genus) {
        case CloudGenus::kCumulonimbus:
            return 12000.0;
        case CloudGenus::kAltocumulus:
        case CloudGenus::kCirrocumulus:
            return 800.0;
        case CloudGenus::kStratocumulus:
            return 1400.0;
        case CloudGenus::kCumulus:
        case CloudGenus::kFogPatches:
            break;
        case CloudGenus::kAltostratus:
        case CloudGenus::kCirrostratus:
        case CloudGenus::kCirrus:
        case CloudGenus::kNimbostratus:
        case CloudGenus::kStratus:
            return 3000.0;
    }
    return 1600.0;
}

// A dome on a flat base, with bulges. Above 0 is cloud.
float density(const CloudShape& shape, const glm::vec3& place, float grown, float noise) {
    const float own = std::min(grown, 1.0F);
    const float width = shape.half_width_m * std::sqrt(own);
    const float height = shape.height_m * (0.35F + 0.65F * own);
    const float up = (place.z + 0.5F * shape.height_m) / height;
    const float out = glm::length(glm::vec2{place.x, place.y}) / width;
    const float flare = 1.0F - 0.25F * up;
    // Past full growth gaps close and neighbours meet.
    return 0.75F + 0.7F * (grown - own) - out * out / (flare * flare) - 0.65F * up * up + 1.1F * noise;
}

float softened(float x) {
    const float s = std::clamp(x, 0.0F, 1.0F);
    return s * s * (3.0F - 2.0F * s);
}

}  // namespace

CloudShape shape_of(const CloudLayer& layer) noexcept {
    CloudShape shape;
    const double thickness_m = std::max(layer.thickness_m, 30.0);
    shape.cell_m = cell_m(layer.genus);
    shape.height_m = static_cast<float>(thickness_m);
    const auto cell = static_cast<float>(shape.cell_m);
    shape.spacing_m = std::cbrt(cell * cell * shape.height_m * kFilled / static_cast<float>(kMostParticles));
    shape.radius_m = kOverlap * shape.spacing_m;
    const double told = layer.extinction_per_m;
    shape.extinction_per_m =
        static_cast<float>(told > 0.0 ? told : usual_extinction_per_m(layer.genus)) / kMeanDensity;
    // Thick layers have larger and denser particles, which cover ground farther out: to where half the light
    // passes.
    const float clear = std::pow(0.693F / std::max(1.0F, shape.extinction_per_m * shape.radius_m), 0.4F);
    const float reach_m = shape.radius_m * std::sqrt(1.0F - clear);
    shape.half_width_m = 0.82F * cell - 2.1F * reach_m;
    shape.bound_m = std::hypot(shape.half_width_m * 1.2F, 0.5F * shape.height_m) + shape.radius_m;
    return shape;
}

float class_radius_m(const CloudShape& shape, std::uint32_t key) noexcept {
    const float place = (static_cast<float>(key) + 0.5F) / static_cast<float>(CloudShape::kSizes);
    return shape.radius_m * (kSmallest + (1.0F - kSmallest) * place);
}

std::uint32_t cell_key(std::int64_t east, std::int64_t north, std::uint32_t seed) noexcept {
    return hashed(hashed(hashed(seed) + static_cast<std::uint32_t>(east)) * 3U +
                  static_cast<std::uint32_t>(north));
}

glm::dvec2 place_in_cell(std::uint32_t key) noexcept {
    return {0.15 + 0.7 * static_cast<double>(chance(key, 1U)),
            0.15 + 0.7 * static_cast<double>(chance(key, 2U))};
}

float growth(double coverage, std::uint32_t key) noexcept {
    if (!(coverage > 0.0)) return 0.0F;
    // Fewer and smaller clouds under little cover. Fitted to the measured part of the ground below opaque
    // cloud (particles_test).
    constexpr std::array<double, 11> kReach{0.0,   0.534, 0.741, 0.903, 1.048, 1.197,
                                            1.361, 1.548, 1.780, 2.130, 3.0};
    const double place = std::clamp(coverage, 0.0, 1.0) * 10.0;
    const auto low = std::min(static_cast<std::size_t>(place), kReach.size() - 2);
    const double reach = kReach[low] + (place - static_cast<double>(low)) * (kReach[low + 1] - kReach[low]);
    return static_cast<float>(std::clamp(reach - static_cast<double>(chance(key, 3U)), 0.0, 2.0));
}

std::size_t make_particles(const CloudShape& shape, std::uint32_t key, float grown, double age_s,
                           std::span<Particle> out) noexcept {
    if (!(grown > 0.0F)) return 0;
    const std::size_t room = std::min(out.size(), kMostParticles);
    const float step = shape.spacing_m;
    const int half = static_cast<int>(std::ceil(1.2F * shape.half_width_m / step));
    const int levels = std::max(1, static_cast<int>(std::ceil(shape.height_m / step)));
    const auto time = static_cast<float>(std::fmod(age_s / kLife_s, kNoisePeriod));
    const float wave = 1.0F / (0.8F * std::min(shape.half_width_m, 2.0F * shape.height_m));
    std::size_t count = 0;
    for (int up = 0; up < levels; ++up) {
        for (int north = -half; north <= half; ++north) {
            for (int east = -half; east <= half && count < room; ++east) {
                const std::uint32_t node = cell_key(east, north * 64 + up, key);
                const glm::vec3 jitter{chance(node, 4U) - 0.5F, chance(node, 5U) - 0.5F,
                                       chance(node, 6U) - 0.5F};
                const glm::vec3 regular{static_cast<float>(east) * step, static_cast<float>(north) * step,
                                        -0.5F * shape.height_m + (static_cast<float>(up) + 0.6F) * step};
                // The base is flat: only what stands above it is jolted about in height.
                const float lift = up == 0 ? 0.2F : 0.9F;
                const glm::vec3 place = regular + jitter * glm::vec3{0.9F, 0.9F, lift} * step;
                // Three octaves in -1..1 cannot lift this place into the cloud.
                if (density(shape, place, grown, 0.55F) <= 0.0F) continue;
                const float value =
                    density(shape, place, grown, layered_noise(glm::vec4{place * wave, time}, key));
                if (value <= 0.0F) continue;
                const float size = kSmallest + (1.0F - kSmallest) * softened(value * 1.5F);
                Particle& particle = out[count++];
                particle.centre_m = place;
                particle.radius_m = shape.radius_m * size;
                particle.optical_depth =
                    16.0F / 15.0F * shape.extinction_per_m * particle.radius_m * std::min(1.0F, value * 5.0F);
                const float part = (size - kSmallest) / (1.0F - kSmallest);
                particle.key =
                    std::min(static_cast<std::uint32_t>(part * CloudShape::kSizes), CloudShape::kSizes - 1U);
            }
        }
    }
    return count;
}

}  // namespace skyig::render::cloud::impostor
