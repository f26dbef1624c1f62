#include "render/cloud/field/noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <numeric>

#include "render/cloud/field/texture.h"

namespace skyig::render::cloud::field {
namespace {

// Bits of one lattice point (after the finaliser of MurmurHash3).
std::uint32_t bits_of(int x, int y, int z, std::uint32_t seed) {
    std::uint32_t h = seed * 0x9E3779B9U + static_cast<std::uint32_t>(x) * 0x85EBCA6BU +
                      static_cast<std::uint32_t>(y) * 0xC2B2AE35U +
                      static_cast<std::uint32_t>(z) * 0x27D4EB2FU;
    h ^= h >> 16;
    h *= 0x85EBCA6BU;
    h ^= h >> 13;
    h *= 0xC2B2AE35U;
    return h ^ (h >> 16);
}

float unit(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24F;
}

int wrap(int i, int period) {
    return ((i % period) + period) % period;
}

float eased(float f) {
    return f * f * f * (f * (f * 6.0F - 15.0F) + 10.0F);
}

struct Grid {
    int nx = 1;
    int ny = 1;
    std::uint32_t seed = 0;
};

// Gradient noise on a periodic grid (Perlin 2002), about -0.7..0.7; x and y in cells.
float perlin(const Grid& grid, float x, float y) {
    const int ix = static_cast<int>(std::floor(x));
    const int iy = static_cast<int>(std::floor(y));
    const float fx = x - static_cast<float>(ix);
    const float fy = y - static_cast<float>(iy);
    const auto corner = [&](int dx, int dy) {
        const std::uint32_t bits = bits_of(wrap(ix + dx, grid.nx), wrap(iy + dy, grid.ny), 0, grid.seed);
        const float gx = 2.4F * (unit(bits) - 0.5F);
        const float gy = 2.4F * (unit(bits * 0x9E3779B9U) - 0.5F);
        return gx * (fx - static_cast<float>(dx)) + gy * (fy - static_cast<float>(dy));
    };
    const float low = glm::mix(corner(0, 0), corner(1, 0), eased(fx));
    const float high = glm::mix(corner(0, 1), corner(1, 1), eased(fx));
    return glm::mix(low, high, eased(fy));
}

// Octaves of it, each twice as fine and half as strong; u and v are 0..1 over the tile.
float octaves(Grid grid, int count, float u, float v) {
    float sum = 0.0F;
    float weight = 1.0F;
    for (int k = 0; k < count; ++k) {
        sum += weight * perlin(grid, u * static_cast<float>(grid.nx), v * static_cast<float>(grid.ny));
        grid = {2 * grid.nx, 2 * grid.ny, grid.seed + 1};
        weight *= 0.5F;
    }
    return sum;
}

// 1 at a feature point, falling with the square of the distance in cells (Worley 1996).
float bump(const Grid& grid, float jitter, float u, float v) {
    const float x = u * static_cast<float>(grid.nx);
    const float y = v * static_cast<float>(grid.ny);
    const int ix = static_cast<int>(std::floor(x));
    const int iy = static_cast<int>(std::floor(y));
    float nearest = 4.0F;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const std::uint32_t bits = bits_of(wrap(ix + dx, grid.nx), wrap(iy + dy, grid.ny), 1, grid.seed);
            const float px = static_cast<float>(ix + dx) + 0.5F + jitter * (unit(bits) - 0.5F) - x;
            const float py =
                static_cast<float>(iy + dy) + 0.5F + jitter * (unit(bits * 0x9E3779B9U) - 0.5F) - y;
            nearest = std::min(nearest, px * px + py * py);
        }
    }
    return 1.0F - nearest;
}

float bump3(int n, std::uint32_t seed, glm::vec3 place) {
    const glm::vec3 p = place * static_cast<float>(n);
    const glm::ivec3 cell(glm::floor(p));
    float nearest = 4.0F;
    for (int k = 0; k < 27; ++k) {
        const glm::ivec3 at = cell + glm::ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        const std::uint32_t bits = bits_of(wrap(at.x, n), wrap(at.y, n), wrap(at.z, n), seed);
        const glm::vec3 point =
            glm::vec3(at) + glm::vec3(unit(bits), unit(bits * 0x9E3779B9U), unit(bits * 0x85EBCA6BU));
        nearest = std::min(nearest, glm::dot(point - p, point - p));
    }
    return 1.0F - nearest;
}

float sheet_value(Sheet which, float u, float v) {
    switch (which) {
        case Sheet::kPuffs: {
            const float large = bump({9, 9, 11}, 1.0F, u, v);
            const float small = bump({21, 21, 12}, 1.0F, u, v);
            return 0.8F * large + 0.45F * small + 0.9F * octaves({6, 6, 13}, 4, u, v);
        }
        case Sheet::kSmooth:
            return octaves({4, 4, 21}, 5, u, v);
        case Sheet::kCells: {
            const float warp = 0.012F * octaves({8, 8, 31}, 2, u, v);
            return bump({22, 22, 33}, 0.75F, u + warp, v - warp) + 0.5F * octaves({7, 7, 34}, 4, u, v);
        }
        case Sheet::kFibres: {
            const float bend = 0.09F * octaves({2, 3, 41}, 2, u, v);
            const float drawn = 0.06F * octaves({4, 6, 42}, 2, u, v);
            return octaves({3, 20, 43}, 3, u + drawn, v + bend) + 0.5F * octaves({3, 5, 44}, 2, u, v + bend);
        }
    }
    return 0.0F;
}

float block_value(glm::vec3 place) {
    return bump3(4, 51, place) + 0.5F * bump3(8, 52, place) + 0.25F * bump3(16, 53, place);
}

// Each value's rank among all, 0..255.
std::vector<std::uint8_t> ranks(const std::vector<float>& values) {
    std::vector<std::uint32_t> order(values.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return values[a] < values[b] || (values[a] == values[b] && a < b);
    });
    std::vector<std::uint8_t> ranked(values.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        ranked[order[i]] = static_cast<std::uint8_t>(i * 256 / order.size());
    return ranked;
}

}  // namespace

Noise::Noise() {
    constexpr float kTexel = 1.0F / static_cast<float>(kSheetSize);
    std::vector<float> values(static_cast<std::size_t>(kSheetSize) * kSheetSize);
    for (std::size_t s = 0; s < kSheets; ++s) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = sheet_value(static_cast<Sheet>(s), static_cast<float>(i % kSheetSize) * kTexel,
                                    static_cast<float>(i / kSheetSize) * kTexel);
        }
        sheets_[s] = packed(ranks(values), kSheetSize);
    }
    constexpr std::size_t kSize = kBlockSize;
    values.resize(kSize * kSize * kSize);
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] =
            block_value(glm::vec3(static_cast<float>(i % kSize), static_cast<float>(i / kSize % kSize),
                                  static_cast<float>(i / (kSize * kSize))) /
                        static_cast<float>(kSize));
    }
    block_ = packed(ranks(values), kSize);
}

}  // namespace skyig::render::cloud::field
