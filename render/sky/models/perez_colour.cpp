#include "render/sky/models/perez_colour.h"

#include <algorithm>
#include <cmath>

namespace skyig::render::sky::models {

double turbidity_of(const AirModel& model) noexcept {
    constexpr std::size_t kGreen = 8;
    const double molecules =
        static_cast<double>(model.rayleigh_per_m[kGreen]) * column_above_m(model.molecules, 0.0);
    const double haze =
        static_cast<double>(model.aerosol_extinction_per_m[kGreen]) * model.aerosol_scale_height_m;
    if (!(molecules > 0.0)) return kMostTurbidity;
    return std::clamp(1.0 + haze / molecules, kLeastTurbidity, kMostTurbidity);
}

PerezColour::PerezColour(double turbidity, double sun_zenith_rad, const glm::dvec2& zenith_xy) noexcept {
    const auto t = static_cast<float>(turbidity);
    const auto sun = static_cast<float>(sun_zenith_rad);
    x_ = shaders32::preetham_x(t);
    y_ = shaders32::preetham_y(t);
    x_scale_ = static_cast<float>(zenith_xy.x) / shaders32::perez(1.0F, sun, x_);
    y_scale_ = static_cast<float>(zenith_xy.y) / shaders32::perez(1.0F, sun, y_);
}

glm::vec3 PerezColour::xyz(float luminance, float view_sine, float sun_angle_rad) const noexcept {
    const float x = std::clamp(x_scale_ * shaders32::perez(view_sine, sun_angle_rad, x_), 0.1F, 0.6F);
    const float y = std::clamp(y_scale_ * shaders32::perez(view_sine, sun_angle_rad, y_), 0.1F, 0.4F);
    return std::max(luminance, 0.0F) * glm::vec3(x / y, 1.0F, (1.0F - x - y) / y);
}

glm::dvec2 chromaticity_of(const glm::vec3& xyz) noexcept {
    const double sum = static_cast<double>(xyz.x + xyz.y + xyz.z);
    if (!(sum > 0.0)) return {0.3127, 0.3290};
    return {static_cast<double>(xyz.x) / sum, static_cast<double>(xyz.y) / sum};
}

}  // namespace skyig::render::sky::models
