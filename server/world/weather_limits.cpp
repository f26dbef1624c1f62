#include "server/world/weather_limits.h"

namespace skyig::server::world {

namespace {

bool limit(float& value, double least, double most) noexcept {
    if (value >= static_cast<float>(least) && value <= static_cast<float>(most)) return false;
    value = static_cast<float>(value > 0.0F ? most : least);
    return true;
}

}  // namespace

bool limit(protocol::cigi::WeatherControl& layer) noexcept {
    const bool carried = layer.scope == protocol::cigi::WeatherScope::kEntity;
    // Round an entity the band is the radius.
    const double band_m = carried ? kLargestArea_m : kThickestLayer_m;
    bool outside = limit(layer.wind_horizontal, 0.0, kMostWind_m_s);
    outside |= limit(layer.wind_vertical, -kMostUpdraught_m_s, kMostUpdraught_m_s);
    outside |= limit(layer.transition_band, 0.0, band_m);
    outside |= limit(layer.top_transition_band, 0.0, band_m);
    if (carried) return outside;
    outside |= limit(layer.base_elevation, kLowestLayer_m, kHighestLayer_m);
    outside |= limit(layer.thickness, 0.0, kThickestLayer_m);
    return outside;
}

bool limit(protocol::cigi::EnvRegionControl& region) noexcept {
    bool outside = limit(region.size_x, 0.0, 2.0 * kLargestArea_m);
    outside |= limit(region.size_y, 0.0, 2.0 * kLargestArea_m);
    outside |= limit(region.corner_radius, 0.0, kLargestArea_m);
    outside |= limit(region.transition_perimeter, 0.0, kLargestArea_m);
    return outside;
}

}  // namespace skyig::server::world
