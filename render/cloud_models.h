// Which model draws each layer of cloud: what the weather asks for, and what `auto` and too many of a kind
// come to.
#pragma once

#include <cstddef>
#include <string_view>

#include "render/weather.h"

namespace skyig::render {

/// Layers of model impostor that are kept at a time, each with some 110 MB of particles and pictures.
inline constexpr std::size_t kMostImpostorLayers = 2;

/// Never kAuto: that is kVolume, and kLayer for ice clouds, which are thin, and where there is a look.
/// Beyond the first
/// kMostImpostorLayers of them impostors are drawn as volumes. \param layer  index into weather.clouds
[[nodiscard]] CloudModel drawn_as(const Weather& weather, std::size_t layer) noexcept;

/// One plain sentence part for the plan: the models of all layers that cover some of the sky, and why.
[[nodiscard]] std::string_view drawn_models(const Weather& weather) noexcept;

}  // namespace skyig::render
