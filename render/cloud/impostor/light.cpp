#include "render/cloud/impostor/light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/cloud/impostor/order.h"
#include "render/sky/phase.h"

namespace skyig::render::cloud::impostor {

namespace {

constexpr float kFull = 65535.0F;
// Solid angle from which light scattered forward is gathered (the published code's).
constexpr float kGather_sr = 0.09F;
// A buffer that stands for depth is dimmed by this part of it, so that 16 bits reach to a depth of 177.
constexpr float kDepthRate = 1.0F / 16.0F;

struct Plane {
    glm::vec3 right;
    glm::vec3 up;
};

Plane plane_across(const glm::vec3& towards) {
    const glm::vec3 aside =
        std::abs(towards.z) < 0.9F ? glm::vec3{0.0F, 0.0F, 1.0F} : glm::vec3{0.0F, 1.0F, 0.0F};
    const glm::vec3 right = glm::normalize(glm::cross(aside, towards));
    return {right, glm::cross(towards, right)};
}

std::uint16_t word(float x) {
    return static_cast<std::uint16_t>(std::clamp(x, 0.0F, 1.0F) * kFull + 0.5F);
}

}  // namespace

Shading::Shading(LightMethod method, const std::array<Beam, CloudLight::kSources>& beams) noexcept
    : method_(method), beams_(beams) {
    for (std::size_t i = 0; i < CloudLight::kSources; ++i)
        scatter_[i] = CloudScatter(beams[i].direction_enu.z);
}

Texel Shading::colour(const Lit& lit, const glm::vec3& ray) const noexcept {
    Texel texel{};
    for (std::size_t i = 0; i < CloudLight::kSources; ++i) {
        if (!beams_[i].lit) continue;
        const float cosine = glm::dot(ray, beams_[i].direction_enu);
        float& to = texel.v[i == CloudLight::kSun ? kSunlight : kMoonlight];
        to = method_ == LightMethod::kDepths
                 ? scatter_[i].ray(-ray.z, cosine).source({lit.beams[i], lit.above, lit.below})
                 : sky::rayleigh_phase(cosine) * lit.beams[i];
    }
    const CloudAmbient ambient = scatter_[0].ambient({0.0F, lit.above, lit.below});
    texel.v[kFromAbove] = ambient.from_above;
    texel.v[kFromBelow] = ambient.from_below;
    texel.v[kOpacity] = 1.0F;
    return texel;
}

LightBuffer::LightBuffer() : light_(static_cast<std::size_t>(kStride) * kStride) {}

void LightBuffer::prepare(const CloudShape& shape) noexcept {
    if (texels_per_m_ > 0.0F && shape == shape_) return;
    shape_ = shape;
    texels_per_m_ = 0.5F * kSide / shape.bound_m;
    constexpr float kMiddle = 0.5F * kStampSide;
    for (std::uint32_t key = 0; key < CloudShape::kSizes; ++key) {
        const float radius = std::clamp(class_radius_m(shape, key) * texels_per_m_, 1.0F, kMiddle);
        const auto part = [radius](float dx, float dy) {
            const float q = std::max(0.0F, 1.0F - (dx * dx + dy * dy) / (radius * radius));
            return q * q * std::sqrt(q);
        };
        // Where the light is read, between the four middle texels, a particle takes all that it is told to.
        const float middle = part(0.5F, 0.5F);
        for (int i = 0; i < kStampSide * kStampSide; ++i) {
            const float dx = static_cast<float>(i % kStampSide) + 0.5F - kMiddle;
            const float dy = static_cast<float>(i / kStampSide) + 0.5F - kMiddle;
            masks_[key][static_cast<std::size_t>(i)] = word(part(dx, dy) / middle);
        }
    }
}

std::span<const std::uint16_t> LightBuffer::ordered(std::span<const Particle> particles,
                                                    const glm::vec3& towards) noexcept {
    for (std::size_t i = 0; i < particles.size(); ++i)
        keys_[i] = -glm::dot(particles[i].centre_m, towards);
    sort_by({keys_.data(), particles.size()}, {order_.data(), particles.size()});
    return {order_.data(), particles.size()};
}

template <class Out>
void LightBuffer::trace(std::span<const Particle> particles, std::span<const std::uint16_t> order,
                        const glm::vec3& towards, Meaning meaning, const Out& out) noexcept {
    const Plane plane = plane_across(towards);
    std::fill(light_.begin(), light_.end(), std::uint16_t{65535});
    const float rate = meaning == Meaning::kDepth ? kDepthRate : 1.0F;
    // p(l, l) gamma / (4 pi), with a phase function of mean 1 / (4 pi) here.
    const float forward = meaning == Meaning::kGathered ? sky::rayleigh_phase(1.0F) * kGather_sr : 0.0F;
    constexpr int kLast = kStride - kStampSide;
    const Kernels& kernel = kernels();
    for (const std::uint16_t index : order) {
        const Particle& particle = particles[index];
        const float x = glm::dot(particle.centre_m, plane.right) * texels_per_m_ + 0.5F * kStride;
        const float y = glm::dot(particle.centre_m, plane.up) * texels_per_m_ + 0.5F * kStride;
        const int left = std::clamp(static_cast<int>(x + 0.5F) - kStampSide / 2, 0, kLast);
        const int top = std::clamp(static_cast<int>(y + 0.5F) - kStampSide / 2, 0, kLast);
        std::uint16_t* corner = light_.data() + static_cast<std::ptrdiff_t>(top) * kStride + left;
        const std::uint16_t* middle =
            corner + static_cast<std::ptrdiff_t>(kStampSide / 2 - 1) * kStride + kStampSide / 2 - 1;
        const float part = static_cast<float>(middle[0] + middle[1] + middle[kStride] + middle[kStride + 1]) /
                           (4.0F * kFull);
        out(index, part);
        const float opacity = 1.0F - std::exp(-rate * particle.optical_depth);
        const Stamp stamp{masks_[particle.key].data(), word(opacity), word(forward * opacity * part)};
        kernel.dim(corner, kStride, stamp);
    }
}

void LightBuffer::light(const CloudShape& shape, std::span<const Particle> particles, const Shading& shading,
                        std::span<Lit> lit) noexcept {
    prepare(shape);
    const auto depth = [](float part) {
        return std::log(std::max(part, 1.0F / kFull)) * (-1.0F / kDepthRate);
    };
    // To its own centre a particle has half of itself in the way: one that stands out alone would be as dark
    // as a wisp, but opaque.
    const auto at_least_own = [&](std::uint16_t i, float part) {
        return std::max(depth(part), 0.5F * particles[i].optical_depth);
    };
    const glm::vec3 zenith{0.0F, 0.0F, 1.0F};
    const auto down = ordered(particles, zenith);
    trace(particles, down, zenith, Meaning::kDepth,
          [&](std::uint16_t i, float part) { lit[i].above = at_least_own(i, part); });
    std::reverse(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(particles.size()));
    trace(particles, down, -zenith, Meaning::kDepth,
          [&](std::uint16_t i, float part) { lit[i].below = at_least_own(i, part); });
    const bool depths = shading.method() == LightMethod::kDepths;
    const Meaning meaning = depths                                     ? Meaning::kDepth
                            : shading.method() == LightMethod::kGather ? Meaning::kGathered
                                                                       : Meaning::kPart;
    for (std::size_t source = 0; source < CloudLight::kSources; ++source) {
        const Beam& beam = shading.beams()[source];
        if (!beam.lit) {
            for (Lit& one : lit)
                one.beams[source] = 0.0F;
            continue;
        }
        trace(particles, ordered(particles, beam.direction_enu), beam.direction_enu, meaning,
              [&](std::uint16_t i, float part) {
                  lit[i].beams[source] = depths ? at_least_own(i, part) : part;
              });
    }
}

}  // namespace skyig::render::cloud::impostor
