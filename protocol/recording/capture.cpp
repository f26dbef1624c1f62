#include "protocol/recording/capture.h"

#include <algorithm>
#include <limits>

namespace skyig::protocol::recording {
namespace {

// Ticks of 64 bits times a billion do not fit 64.
__extension__ using Wide = __int128;

constexpr Wide kNsPerSecond = 1'000'000'000;

constexpr Wide power_of_ten(int exponent) noexcept {
    Wide power = 1;
    for (int i = 0; i < exponent; ++i)
        power *= 10;
    return power;
}

}  // namespace

std::int64_t to_ns(const StampUnit& unit, std::uint64_t ticks) noexcept {
    Wide ns = ticks;
    if (unit.binary) {
        ns = (ns * kNsPerSecond) >> unit.exponent;
    } else if (unit.exponent <= 9) {
        ns *= power_of_ten(9 - unit.exponent);
    } else {
        ns /= power_of_ten(unit.exponent - 9);
    }
    ns += unit.offset_s * kNsPerSecond;
    constexpr Wide kLeast = std::numeric_limits<std::int64_t>::min();
    constexpr Wide kMost = std::numeric_limits<std::int64_t>::max();
    return static_cast<std::int64_t>(std::clamp(ns, kLeast, kMost));
}

}  // namespace skyig::protocol::recording
