// Weather that comes value by value and counts only when it is committed, so that no picture shows half of a
// change.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/canaerospace/identifier_map.h"

namespace skyig::protocol::canaerospace {

[[nodiscard]] constexpr bool is_surface_weather(Parameter parameter) noexcept {
    return parameter >= Parameter::kVisibility && parameter <= Parameter::kSurfaceTemperature;
}
[[nodiscard]] constexpr bool is_layer_weather(Parameter parameter) noexcept {
    return parameter >= Parameter::kLayerBase && parameter <= Parameter::kLayerSeed;
}

class WeatherStage {
  public:
    static constexpr std::size_t kSurfaceValues =
        index_of(Parameter::kSurfaceTemperature) - index_of(Parameter::kVisibility) + 1;
    static constexpr std::size_t kLayerValues =
        index_of(Parameter::kLayerSeed) - index_of(Parameter::kLayerBase) + 1;

    /// Keeps a value until a commit. `parameter` is weather of the surface (`layer` then does not count) or
    /// of layer 0..7; others are ignored. Coverage is 0..1, all else in the unit of the default map.
    void stage(Parameter parameter, std::uint8_t layer, double value) noexcept;

    /// Applies what is staged: everything, or one layer alone.
    /// \return bit n set: layer n stays staged, since its top is not above its base, or its coverage is not
    ///         0..1. A layer whose enable is 0 is always applied.
    std::uint8_t commit_all() noexcept;
    std::uint8_t commit_layer(std::uint8_t layer) noexcept;

    /// The value that applies; none if none was ever committed.
    [[nodiscard]] std::optional<double> applied(Parameter parameter, std::uint8_t layer = 0) const noexcept;
    [[nodiscard]] std::optional<double> staged(Parameter parameter, std::uint8_t layer = 0) const noexcept;
    /// Layer `layer` applies, is enabled (by 1, or by nobody having said 0) and has base, top and coverage.
    [[nodiscard]] bool is_drawable(std::uint8_t layer) const noexcept;

  private:
    using Surface = std::array<std::optional<double>, kSurfaceValues>;
    using Layer = std::array<std::optional<double>, kLayerValues>;
    struct Weather {
        Surface surface{};
        std::array<Layer, kCloudLayers> layers{};
    };

    [[nodiscard]] static bool is_sound(const Layer& layer) noexcept;
    [[nodiscard]] static std::optional<double> get(const Weather& weather, Parameter parameter,
                                                   std::uint8_t layer) noexcept;

    Weather staged_;
    Weather applied_;
};

}  // namespace skyig::protocol::canaerospace
