// The light of any direction of a frame, discs and stars left out: what the dome, the backgrounds of stars
// and discs, the adaptation and the tests all ask.
#pragma once

#include <glm/glm.hpp>

#include "render/geometry.h"
#include "render/sky/sky_view.h"

namespace skyig::render {

/// A light source and the table of the air and ground it lights.
struct LitAir {
    const sky::SkyView* view = nullptr;  ///< null: this source lights nothing
    Horizontal source;                   ///< where it stands in this frame; the table may lag by 0.01 deg
    /// Factors on X, Y, Z of the table (distance, obscuration, the Moon's share and tint).
    glm::vec3 scale_xyz{0.0F};
};

/// Which side of the horizon a direction is taken from when it lies on the edge.
enum class Side { kByElevation, kSky, kGround };

struct SkyLight {
    LitAir sun;
    LitAir moon;
    /// Of this frame's eye, exact; a table made a little lower or higher is asked at the same angle from its
    /// own horizon.
    double horizon_elevation_rad = 0.0;
    double eye_height_m = 0.0;

    /// Linear Rec.709, cd/m2 (components may be negative outside the gamut; luminance is >= 0).
    [[nodiscard]] glm::vec3 rgb_cd_m2(double elevation_rad, double azimuth_rad, Side side) const noexcept;
};

}  // namespace skyig::render
