#include "render/cloud/impostor/noise.h"

#include <array>
#include <cmath>

namespace skyig::render::cloud::impostor {

namespace {

// Quintic: first and second slope vanish at both ends.
float eased(float x) {
    return x * x * x * (x * (x * 6.0F - 15.0F) + 10.0F);
}

// One of the 32 edges of a tesseract: three coordinates with signs, the fourth 0.
float slope(std::uint32_t hash, const glm::vec4& away) {
    const std::uint32_t left_out = (hash >> 3U) & 3U;
    const float a = left_out == 0U ? away.y : away.x;
    const float b = left_out <= 1U ? away.z : away.y;
    const float c = left_out <= 2U ? away.w : away.z;
    return ((hash & 1U) != 0U ? -a : a) + ((hash & 2U) != 0U ? -b : b) + ((hash & 4U) != 0U ? -c : c);
}

}  // namespace

// The finaliser of MurmurHash3 (Appleby 2011).
std::uint32_t hashed(std::uint32_t x) noexcept {
    x ^= x >> 16U;
    x *= 0x85ebca6bU;
    x ^= x >> 13U;
    x *= 0xc2b2ae35U;
    return x ^ (x >> 16U);
}

float chance(std::uint32_t key, std::uint32_t salt) noexcept {
    return static_cast<float>(hashed(key ^ hashed(salt + 0x9e3779b9U)) >> 8U) * 0x1p-24F;
}

float gradient_noise(const glm::vec4& place, std::uint32_t seed) noexcept {
    constexpr auto kMask = static_cast<std::uint32_t>(kNoisePeriod - 1);
    std::array<std::uint32_t, 4> low{};
    glm::vec4 part;
    glm::vec4 weight;
    for (int axis = 0; axis < 4; ++axis) {
        const float floor = std::floor(place[axis]);
        part[axis] = place[axis] - floor;
        weight[axis] = eased(part[axis]);
        low[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(static_cast<std::int32_t>(floor));
    }
    float sum = 0.0F;
    for (std::uint32_t corner = 0; corner < 16U; ++corner) {
        glm::vec4 away;
        float share = 1.0F;
        std::uint32_t key = seed;
        for (std::uint32_t axis = 0; axis < 4U; ++axis) {
            const std::uint32_t up = (corner >> axis) & 1U;
            const auto i = static_cast<int>(axis);
            away[i] = part[i] - static_cast<float>(up);
            share *= up != 0U ? weight[i] : 1.0F - weight[i];
            key = (key ^ ((low[axis] + up) & kMask)) * 0x9e3779b1U;
            key ^= key >> 15U;
        }
        sum += share * slope(hashed(key), away);
    }
    // An edge's slope gives up to 1.5 in the middle of a cell.
    return sum * (2.0F / 3.0F);
}

float layered_noise(const glm::vec4& place, std::uint32_t seed) noexcept {
    return (4.0F * gradient_noise(place, seed) + 2.0F * gradient_noise(place * 2.0F, seed + 1U) +
            gradient_noise(place * 4.0F, seed + 2U)) *
           (1.0F / 7.0F);
}

}  // namespace skyig::render::cloud::impostor
