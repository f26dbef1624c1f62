// What of the ground rain or snow reaches: the view from above, along its fall, through which another
// renderer draws the map of what stands in its way. Pure mathematics.
#pragma once

#include <glm/glm.hpp>

#include "render/scene.h"

namespace skyig::render::precipitation {

/// An orthographic view along the way that things fall, round the eye. Its texels lie still on the Earth
/// while the way stays as it is.
struct ExposureView {
    static constexpr int kSize_px = 1024;
    static constexpr double kSide_m = 512.0;
    static constexpr double kDepth_m = 1024.0;
    static constexpr double kTexel_m = kSide_m / kSize_px;

    /// Clip coordinates, each -1..1, from metres east, north and up of the eye; z grows along the fall.
    glm::dmat4 clip_from_enu_m{1.0};
    /// Unit vector along which things fall.
    glm::dvec3 fall_enu{0.0, 0.0, -1.0};
    /// What stands over a place by less than this along the fall is the place itself: what a level surface
    /// gains over one and a half texels, and a hand's breadth.
    double bias_m = 0.25;
};

/// Along wind and fall together, each sort by its rate; the wind counts from nothing to all of it over the
/// first 0.1 mm/h, so that where nothing falls the view is straight down.
[[nodiscard]] ExposureView exposure_view(const Scene& scene) noexcept;

}  // namespace skyig::render::precipitation
