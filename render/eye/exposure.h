// How luminance is stored as it is: linear Rec.709 times 2^k, the same k in all channels of a frame.
#pragma once

#include "render/shaders/shared.h"
#include "render/target.h"

namespace skyig::render::eye {

/// The k of a target of luminance.
/// 32-bit floats: always -20, so that the largest stored value, 65504, is 6.9e10 cd/m2; nothing in the sky is
/// brighter (the Sun's disc has 2e9).
/// 16-bit floats: the adaptation luminance is stored between 2^-9 and 2^-8. Full precision (a tenth of a
/// percent or better) reaches down to a fiftieth of it, 1 % to 1/600; 2.5e7 of it is the largest value, more
/// than the Moon in a moonless night (1.2e7 .. 1.8e7). What is brighter, the Sun's disc in a scene adapted to
/// less than 60 cd/m2, is stored as 65504.
[[nodiscard]] int exposure_exponent(Target target, double adaptation_cd_m2) noexcept;

/// The tone curve that stores luminance: shown(L) = L * 2^k, with negative components (colours outside
/// Rec.709), without an eye, not above 65504; point sources have no gain of their own.
[[nodiscard]] shaders64::ToneParameters luminance_parameters(int exposure_exponent) noexcept;

}  // namespace skyig::render::eye
