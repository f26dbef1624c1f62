// What falls: how much by its severity, and how much water hangs in the air meanwhile.
#pragma once

#include "render/weather.h"

namespace skyig::server {

/// mm of liquid water an hour, of a CIGI severity 0..5 (clamped). Severity 1, 2 and 3 are the light, moderate
/// and heavy of weather reports.
[[nodiscard]] double rate_of_severity_mm_h(render::Precipitation::Kind kind, int severity) noexcept;

/// Liquid water in the air of a rain of that rate, and back: 0.0889 R^0.84 g/m3, the drops of Marshall and
/// Palmer (J. Meteor. 5, 1948): pi rho 8000 / (4.1 R^-0.21)^4. Serves for all that falls.
[[nodiscard]] double water_g_m3(double rate_mm_h) noexcept;
[[nodiscard]] double rate_of_water_mm_h(double water_g_m3) noexcept;

}  // namespace skyig::server
