// Colour across the sky by the chromaticity formulas of Preetham, Shirley and Smits (1999).
#pragma once

#include <glm/glm.hpp>

#include "render/shaders/shared.h"
#include "render/sky/air_model.h"

namespace skyig::render::sky::models {

/// Turbidities of the formulas' fit: below, luminance turns negative at the horizon; above, it runs away.
inline constexpr double kLeastTurbidity = 2.0;
inline constexpr double kMostTurbidity = 10.0;

/// The formulas hold for a Sun above the horizon: theirs stays at this elevation, and twilight fades their
/// light.
inline constexpr double kLowestFormulaSun_rad = glm::radians(3.0);

/// Turbidity as its authors define it, (molecules + haze) / molecules in vertical optical depth, here at 558
/// nm; brought into the range of the fit. For the scene's air the depths follow from visibility, pressure and
/// the scale heights (air_model()): 23 km give 2.5, 10 km 4.7, 5 km 8.6.
[[nodiscard]] double turbidity_of(const AirModel& model) noexcept;

/// x and y relative to the zenith, times a zenith that may come from elsewhere.
class PerezColour {
  public:
    PerezColour() = default;
    /// \param sun_zenith_rad  of the formulas' Sun
    PerezColour(double turbidity, double sun_zenith_rad, const glm::dvec2& zenith_xy) noexcept;

    /// XYZ of that luminance in the direction's colour, x and y kept where colours are.
    [[nodiscard]] glm::vec3 xyz(float luminance, float view_sine, float sun_angle_rad) const noexcept;

  private:
    shaders32::PerezSky x_{};
    shaders32::PerezSky y_{};
    // Zenith chromaticity over the formulas' value there.
    float x_scale_ = 0.0F;
    float y_scale_ = 0.0F;
};

/// Chromaticity; that of daylight (D65) where there is no light.
[[nodiscard]] glm::dvec2 chromaticity_of(const glm::vec3& xyz) noexcept;

}  // namespace skyig::render::sky::models
