// What the surface below sends back into the air.
#pragma once

#include "render/sky/air_model.h"

namespace skyig::render::sky {

/// Replaces the model's ground by what `ground` says; see air_model().
void lay_ground(const Ground& ground, AirModel& model) noexcept;

}  // namespace skyig::render::sky
