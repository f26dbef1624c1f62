// Gradient noise over four coordinates, the fourth for time (Perlin, "Improving Noise", 2002), and whole
// numbers turned into chance.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace skyig::render::cloud::impostor {

/// Steps between which gradient_noise() repeats along each axis.
inline constexpr int kNoisePeriod = 256;

/// Every bit of the answer depends on every bit of `x`.
[[nodiscard]] std::uint32_t hashed(std::uint32_t x) noexcept;

/// 0..1, evenly. \param salt  tells draws about the same thing apart
[[nodiscard]] float chance(std::uint32_t key, std::uint32_t salt) noexcept;

/// Smooth, mean 0, 0 at whole numbers, within -1..1. \param place  any finite value of up to 1e6
[[nodiscard]] float gradient_noise(const glm::vec4& place, std::uint32_t seed) noexcept;

/// Three octaves of the above, each half as strong and twice as fine as the one before; within -1..1.
[[nodiscard]] float layered_noise(const glm::vec4& place, std::uint32_t seed) noexcept;

}  // namespace skyig::render::cloud::impostor
