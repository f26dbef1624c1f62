#include "protocol/canaerospace/weather_stage.h"

namespace skyig::protocol::canaerospace {
namespace {

constexpr std::size_t surface_index(Parameter parameter) noexcept {
    return index_of(parameter) - index_of(Parameter::kVisibility);
}
constexpr std::size_t layer_index(Parameter parameter) noexcept {
    return index_of(parameter) - index_of(Parameter::kLayerBase);
}

}  // namespace

void WeatherStage::stage(Parameter parameter, std::uint8_t layer, double value) noexcept {
    if (is_surface_weather(parameter)) staged_.surface[surface_index(parameter)] = value;
    if (is_layer_weather(parameter) && layer < kCloudLayers)
        staged_.layers[layer][layer_index(parameter)] = value;
}

bool WeatherStage::is_sound(const Layer& layer) noexcept {
    const std::optional<double>& enable = layer[layer_index(Parameter::kLayerEnable)];
    if (enable && *enable == 0.0) return true;
    const std::optional<double>& base = layer[layer_index(Parameter::kLayerBase)];
    const std::optional<double>& top = layer[layer_index(Parameter::kLayerTop)];
    const std::optional<double>& coverage = layer[layer_index(Parameter::kLayerCoverage)];
    const bool has_height = !base || !top || *top > *base;
    return has_height && (!coverage || (*coverage >= 0.0 && *coverage <= 1.0));
}

std::uint8_t WeatherStage::commit_layer(std::uint8_t layer) noexcept {
    if (layer >= kCloudLayers) return 0;
    if (!is_sound(staged_.layers[layer])) return static_cast<std::uint8_t>(1U << layer);
    applied_.layers[layer] = staged_.layers[layer];
    return 0;
}

std::uint8_t WeatherStage::commit_all() noexcept {
    applied_.surface = staged_.surface;
    unsigned held = 0;
    for (std::uint8_t layer = 0; layer < kCloudLayers; ++layer)
        held |= commit_layer(layer);
    return static_cast<std::uint8_t>(held);
}

std::optional<double> WeatherStage::get(const Weather& weather, Parameter parameter,
                                        std::uint8_t layer) noexcept {
    if (is_surface_weather(parameter)) return weather.surface[surface_index(parameter)];
    if (is_layer_weather(parameter) && layer < kCloudLayers)
        return weather.layers[layer][layer_index(parameter)];
    return std::nullopt;
}

std::optional<double> WeatherStage::applied(Parameter parameter, std::uint8_t layer) const noexcept {
    return get(applied_, parameter, layer);
}

std::optional<double> WeatherStage::staged(Parameter parameter, std::uint8_t layer) const noexcept {
    return get(staged_, parameter, layer);
}

bool WeatherStage::is_drawable(std::uint8_t layer) const noexcept {
    return applied(Parameter::kLayerBase, layer) && applied(Parameter::kLayerTop, layer) &&
           applied(Parameter::kLayerCoverage, layer) &&
           applied(Parameter::kLayerEnable, layer).value_or(1.0) != 0.0;
}

}  // namespace skyig::protocol::canaerospace
