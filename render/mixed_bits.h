// Numbers that look random and are the same for all who ask: every chance in a picture is drawn from these.
#pragma once

#include <cstdint>

namespace skyig::render {

/// SplitMix64 (Steele, Lea and Flood 2014): all 64 bits of the answer depend on all bits of `x`.
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t x) noexcept {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
}

/// Evenly in [0, 1), of the highest 53 bits.
[[nodiscard]] constexpr double unit_of(std::uint64_t bits) noexcept {
    return static_cast<double>(bits >> 11U) * 0x1p-53;
}

}  // namespace skyig::render
