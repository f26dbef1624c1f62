#include "render/cloud/impostor/order.h"

#include <algorithm>
#include <array>

#include "render/cloud/impostor/particles.h"

namespace skyig::render::cloud::impostor {

void sort_by(std::span<const float> keys, std::span<std::uint16_t> order) noexcept {
    if (keys.empty()) return;
    constexpr std::size_t kBins = 512;
    const auto [low, high] = std::minmax_element(keys.begin(), keys.end());
    const float lowest = *low;
    const float scale = *high > lowest ? static_cast<float>(kBins - 1) / (*high - lowest) : 0.0F;
    std::array<std::uint16_t, kMostParticles> bins{};
    std::array<std::uint16_t, kBins + 1> starts{};
    for (std::size_t i = 0; i < keys.size(); ++i) {
        bins[i] = static_cast<std::uint16_t>((keys[i] - lowest) * scale);
        ++starts[bins[i] + 1U];
    }
    for (std::size_t bin = 1; bin <= kBins; ++bin)
        starts[bin] = static_cast<std::uint16_t>(starts[bin] + starts[bin - 1]);
    for (std::size_t i = 0; i < keys.size(); ++i)
        order[starts[bins[i]]++] = static_cast<std::uint16_t>(i);
}

}  // namespace skyig::render::cloud::impostor
