// What the surface below sends back into the air.
#pragma once

#include "render/sky/air_model.h"

namespace skyig::render::sky {

/// Replaces the model's ground by what `ground` says; see air_model().
void lay_ground(const Ground& ground, AirModel& model) noexcept;

/// Clean snow loses a little towards the red (Wiscombe and Warren 1980); sastrugi and age take a tenth.
[[nodiscard]] double snow_albedo(double wavelength_nm) noexcept;

}  // namespace skyig::render::sky
