#include "render/cloud/impostor/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "render/cloud/impostor/order.h"

namespace skyig::render::cloud::impostor {

namespace {

// Part of the distance to the middle below which particles stay out of a picture.
constexpr float kNearest = 0.05F;
constexpr float kOpaque = 0.998F;
constexpr float kSmallestDisc = 0.8F;  // texels: less would fall between their centres

glm::ivec2 rounded_up(const glm::vec2& texels, int most) {
    const auto one = [&](float n) {
        const int steps = static_cast<int>(std::ceil(std::min(n, static_cast<float>(most)) / kSizeStep));
        return std::clamp(steps * kSizeStep, kSizeStep, most);
    };
    return {one(texels.x), one(texels.y)};
}

struct Projected {
    glm::vec2 place_m;
    float scale = 0.0F;  // 0: not before the eye
    float depth_m = 0.0F;
};

Projected project(const glm::vec3& place_m, const Capture& capture, float distance_m) {
    const float ahead = glm::dot(place_m, capture.away);
    if (ahead < kNearest * distance_m) return {};
    const float scale = distance_m / ahead;
    return {glm::vec2{glm::dot(place_m, capture.right), glm::dot(place_m, capture.up)} * scale, scale,
            ahead - distance_m};
}

}  // namespace

void shade(std::span<const Particle> particles, std::span<const Lit> lit, const Shading& shading,
           const glm::vec3& middle_m, std::span<Shaded> out) noexcept {
    std::array<float, kMostParticles> distances;
    std::array<std::uint16_t, kMostParticles> order;
    const std::size_t count = std::min({particles.size(), out.size(), kMostParticles});
    for (std::size_t i = 0; i < count; ++i)
        distances[i] = glm::length(middle_m + particles[i].centre_m);
    sort_by({distances.data(), count}, {order.data(), count});
    for (std::size_t i = 0; i < count; ++i) {
        const Particle& particle = particles[order[i]];
        const glm::vec3 place = middle_m + particle.centre_m;
        const float distance = distances[order[i]];
        const glm::vec3 ray = distance > 0.0F ? place / distance : glm::vec3{0.0F, 0.0F, 1.0F};
        out[i] = {shading.colour(lit[order[i]], ray), place, particle.radius_m, particle.optical_depth};
        out[i].colour.v[kDepth_m] = distance;
    }
}

Capture capture_of(std::span<const Shaded> particles, const glm::vec3& middle_m, float texel_rad,
                   int most) noexcept {
    Capture capture;
    capture.middle_m = middle_m;
    const float distance = glm::length(middle_m);
    if (particles.empty() || !(distance > 0.0F)) return capture;
    capture.away = middle_m / distance;
    const glm::vec3 aside =
        std::abs(capture.away.z) < 0.95F ? glm::vec3{0.0F, 0.0F, 1.0F} : glm::vec3{0.0F, 1.0F, 0.0F};
    capture.right = glm::normalize(glm::cross(capture.away, aside));
    capture.up = glm::cross(capture.right, capture.away);
    glm::vec2 low{std::numeric_limits<float>::max()};
    glm::vec2 high{std::numeric_limits<float>::lowest()};
    for (const Shaded& particle : particles) {
        const Projected seen = project(particle.place_m, capture, distance);
        if (!(seen.scale > 0.0F)) continue;
        const float radius = particle.radius_m * seen.scale;
        low = glm::min(low, seen.place_m - radius);
        high = glm::max(high, seen.place_m + radius);
        capture.reach_m = std::max(capture.reach_m, std::abs(seen.depth_m));
    }
    if (!(high.x > low.x)) return capture;
    capture.low_m = low;
    capture.high_m = high;
    const float texel_m = distance * texel_rad;
    capture.size = rounded_up((high - low) / texel_m + 2.0F, most);
    return resized(capture, capture.size);
}

Capture resized(const Capture& capture, glm::ivec2 size) noexcept {
    Capture other = capture;
    other.size = size;
    // An empty texel all round, so that what is fetched between texels fades out.
    const glm::vec2 texel = (capture.high_m - capture.low_m) / (glm::vec2{size} - 2.0F);
    other.texel_m = std::max(texel.x, texel.y);
    other.corner_m = 0.5F * (capture.low_m + capture.high_m - glm::vec2{size} * other.texel_m);
    return other;
}

void draw(std::span<const Shaded> particles, const Capture& capture, std::span<Texel> picture) noexcept {
    const auto texels = static_cast<std::size_t>(capture.size.x) * static_cast<std::size_t>(capture.size.y);
    std::fill_n(picture.begin(), texels, Texel{});
    const float distance = glm::length(capture.middle_m);
    const float per_m = 1.0F / capture.texel_m;
    const Kernels& kernel = kernels();
    for (std::size_t i = particles.size(); i-- > 0;) {
        const Shaded& particle = particles[i];
        const Projected seen = project(particle.place_m, capture, distance);
        if (!(seen.scale > 0.0F)) continue;
        const glm::vec2 centre = (seen.place_m - capture.corner_m) * per_m;
        const float radius = particle.radius_m * seen.scale * per_m;
        const float drawn = std::max(radius, kSmallestDisc);
        Disc disc{particle.colour, centre.x, centre.y, drawn,
                  particle.optical_depth * (radius * radius) / (drawn * drawn)};
        disc.colour.v[kDepth_m] = seen.depth_m;
        kernel.splat(disc, picture.data(), capture.size.x, capture.size.y);
    }
}

void lay_out(std::span<const Shaded> particles, Spheres& spheres) noexcept {
    const std::size_t count = std::min(particles.size(), kMostParticles);
    spheres.batches = static_cast<int>((count + kBatch - 1) / kBatch);
    const auto end = static_cast<std::size_t>(spheres.batches) * kBatch;
    for (std::size_t i = 0; i < end; ++i) {
        const bool real = i < count;
        const glm::vec3 place = real ? particles[i].place_m : glm::vec3{0.0F};
        spheres.x[i] = place.x;
        spheres.y[i] = place.y;
        spheres.z[i] = place.z;
        // What fills up the last batch is met by no ray.
        spheres.gap[i] = real ? glm::dot(place, place) - particles[i].radius_m * particles[i].radius_m : 1.0F;
    }
}

Texel meet(std::span<const Shaded> particles, const Spheres& spheres, const glm::vec3& ray,
           const CloudRange& range) noexcept {
    alignas(64) std::array<float, kMostParticles> half2;
    std::array<float, kMostParticles / kBatch> any;
    kernels().halves(spheres.table(), &ray.x, half2.data(), any.data());
    Texel seen{};
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (i % kBatch == 0 && any[i / kBatch] <= 0.0F) {
            i += kBatch - 1;
            continue;
        }
        if (half2[i] <= 0.0F) continue;
        const Shaded& particle = particles[i];
        const float along = glm::dot(particle.place_m, ray);
        const float half = std::sqrt(half2[i]);
        if (along <= -half) continue;
        const float distance = particle.colour.v[kDepth_m];
        if (distance < range.from_m || distance >= range.to_m) continue;
        const float part = std::min(1.0F, 0.5F * (along + half) / half);
        const float q = half2[i] / (particle.radius_m * particle.radius_m);
        const float depth =
            particle.optical_depth * q * q * std::sqrt(q) * part * part * (3.0F - 2.0F * part);
        const float opacity = (1.0F - seen.v[kOpacity]) * -std::expm1(-depth);
        for (int c = 0; c < kChannels; ++c)
            seen.v[c] += opacity * particle.colour.v[c];
        if (seen.v[kOpacity] > kOpaque) break;
    }
    return seen;
}

}  // namespace skyig::render::cloud::impostor
