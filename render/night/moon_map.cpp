#include "render/night/moon_map.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace skyig::render::night {
namespace {

constexpr std::uint8_t kMap[] = {
#include "moon_map.inc"
};
static_assert(std::size(kMap) == std::size_t{kMoonMapSize} * kMoonMapSize);

constexpr double kMeans[] = {
#include "moon_means.inc"
};
static_assert(std::size(kMeans) == kMoonPhaseCount);

}  // namespace

std::span<const std::uint8_t> moon_map() noexcept {
    return kMap;
}

double moon_map_mean(double sun_longitude_rad) noexcept {
    constexpr double kStep_rad = moon_phase_longitude_rad(1) - moon_phase_longitude_rad(0);
    const double place =
        std::clamp((sun_longitude_rad - moon_phase_longitude_rad(0)) / kStep_rad, 0.0, kMoonPhaseCount - 1.0);
    const auto low = std::min(static_cast<std::size_t>(place), std::size_t{kMoonPhaseCount - 2});
    const double share = place - static_cast<double>(low);
    return kMeans[low] + share * (kMeans[low + 1] - kMeans[low]);
}

}  // namespace skyig::render::night
