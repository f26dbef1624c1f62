// Geometry of one view ray through the shell, cut into steps.
#pragma once

#include <limits>
#include <span>

#include "render/sky/air_data.h"

namespace skyig::render::sky {

enum class Side { kSky, kGround };

/// \param eye_height_m >= 0, also above the lid
/// \param cosine of the ray to the vertical at the eye; at or below the horizon for Side::kGround, at or
/// above it for
///        Side::kSky (rounding at the horizon itself is absorbed)
/// \param steps_most  at most as many as `path.steps` holds; at least 4
/// \param farthest_m  where the path ends, if neither the ground nor the lid does before
/// Fills everything in `path` but the weights.
void lay_path(const AirData& data, double eye_height_m, double cosine, Side side, int steps_most, Path& path,
              double farthest_m = std::numeric_limits<double>::infinity());

/// One step between each two of `boundaries_m`, rising distances along the ray. The ground is as glass, with
/// air of height 0 beneath it, so that nothing jumps where a ray begins to meet it. `path.steps` holds as
/// many.
void lay_steps_between(const AirData& data, double eye_height_m, double cosine,
                       std::span<const double> boundaries_m, Path& path);

}  // namespace skyig::render::sky
