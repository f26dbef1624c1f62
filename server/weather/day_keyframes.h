// The look of the day by keyframes: eight sets of values a day, each for good and for bad weather.
#pragma once

#include "config/keyframes.h"
#include "render/scene.h"

namespace skyig::server::weather {

/// Linear between the sets on both sides, and between good and bad weather; fog as extinction, which is kept
/// as the far end of a fog that begins at the eye.
/// \param day  time of the day in days, 0 = midnight = the first set; any finite, the day repeats
[[nodiscard]] config::Keyframe look_at(const config::Keyframes& keyframes, double day) noexcept;

/// Distance at which fog that grows linearly from near to far leaves 5 % of a contrast: where the air's
/// visibility ends.
[[nodiscard]] double visibility_of_fog_m(const config::Keyframe& look) noexcept;

/// Local mean solar time, days: 0.5 when the mean Sun stands in the south.
[[nodiscard]] double solar_day(double utc_second_of_day, double longitude_deg) noexcept;

/// What of a look the air and the sky take: visibility, opacity of stars (a part of the host's), and, where
/// the model is `windlight`, its colours.
void put_look(const config::Keyframe& look, render::Scene& scene) noexcept;

}  // namespace skyig::server::weather
