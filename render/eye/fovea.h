// The eye that looks at one small place, and adapts to that place as far as it is brighter than the scene.
#pragma once

#include "render/display.h"
#include "render/shaders/shared.h"

namespace skyig::render::eye {

/// Luminance, cd/m2, that the frame's tone curve shows as bright as eyes adapted to `own_cd_m2` see a field
/// of that luminance with brighter things in it: at most own_cd_m2, rises with it. \param frame  the curve of
/// the frame, made of the same display. With the linear operator and Reinhard's nothing is dimmed.
[[nodiscard]] double looked_at_cd_m2(const DisplaySettings& display, const shaders64::ToneParameters& frame,
                                     double own_cd_m2) noexcept;

/// As a factor for things that are themselves the brightest there, so that the display needs little room for
/// brighter ones (highlight_room()): exact at the two luminances and a power of the luminance between and
/// beyond. Precondition: 0 < low_cd_m2 < high_cd_m2.
[[nodiscard]] shaders64::Fovea fovea(const DisplaySettings& display, const shaders64::ToneParameters& frame,
                                     double low_cd_m2, double high_cd_m2) noexcept;

}  // namespace skyig::render::eye
