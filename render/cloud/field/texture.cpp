#include "render/cloud/field/texture.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace skyig::render::cloud::field {
namespace {

std::vector<std::uint8_t> bytes_of(const std::vector<float>& values) {
    std::vector<std::uint8_t> bytes(values.size());
    std::transform(values.begin(), values.end(), bytes.begin(), [](float value) {
        return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
    });
    return bytes;
}

// Half as many on a side, each the mean of four.
std::vector<float> halved(const std::vector<float>& values, std::size_t side) {
    std::vector<float> half;
    half.reserve(values.size() / 4);
    for (std::size_t row = 0; row < side; row += 2) {
        for (std::size_t column = 0; column < side; column += 2) {
            const float* low = &values[row * side + column];
            const float* high = low + side;
            half.push_back(0.25F * (low[0] + low[1] + high[0] + high[1]));
        }
    }
    return half;
}

}  // namespace

std::vector<std::uint32_t> packed(std::span<const std::uint8_t> bytes, std::size_t size) {
    std::vector<std::uint32_t> entries(bytes.size());
    const std::size_t slice = size * size;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const std::size_t x = i % size;
        const std::size_t row = i - x;
        const std::size_t next = row % slice + size == slice ? row + size - slice : row + size;
        const std::size_t right = (x + 1) % size;
        entries[i] = static_cast<std::uint32_t>(bytes[i]) |
                     static_cast<std::uint32_t>(bytes[row + right]) << 8U |
                     static_cast<std::uint32_t>(bytes[next + x]) << 16U |
                     static_cast<std::uint32_t>(bytes[next + right]) << 24U;
    }
    return entries;
}

Texture::Texture(int side, std::span<const float> values)
    : side_log2_(std::countr_zero(static_cast<unsigned>(side))) {
    std::vector<float> level(values.begin(), values.end());
    for (std::size_t k = 0;; ++k) {
        starts_[k] = static_cast<std::uint32_t>(entries_.size());
        const std::size_t across = static_cast<std::size_t>(side) >> k;
        const std::vector<std::uint32_t> entries = packed(bytes_of(level), across);
        entries_.insert(entries_.end(), entries.begin(), entries.end());
        if (across == 1) return;
        level = halved(level, across);
    }
}

}  // namespace skyig::render::cloud::field
