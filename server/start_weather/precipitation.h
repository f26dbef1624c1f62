// What falls: how much by its severity, how much water hangs in the air, how far one sees in it.
#pragma once

namespace skyig::server {

enum class Falling { kDrizzle, kRain, kSnow, kSleet, kHail };

/// mm of liquid water an hour, of a CIGI severity 0..5 (clamped). Severity 1, 2 and 3 are the light, moderate
/// and heavy of weather reports.
[[nodiscard]] double rate_of_severity_mm_h(Falling kind, int severity) noexcept;

/// Liquid water in the air of a rain of that rate, and back: 0.0889 R^0.84 g/m3, the drops of Marshall and
/// Palmer (J. Meteor. 5, 1948): pi rho 8000 / (4.1 R^-0.21)^4. Serves for all that falls.
[[nodiscard]] double water_g_m3(double rate_mm_h) noexcept;
[[nodiscard]] double rate_of_water_mm_h(double water_g_m3) noexcept;

/// Of visible light, 1/m. Rain, drizzle, sleet and hail: pi 8000 / L^3 1e-6 with L = 4.1 R^-0.21 1/mm
/// (Marshall and Palmer 1948, geometric optics, Q = 2); snow: 5.5 R^1.38 dB/km (dry snow, fits of free-space
/// optics).
[[nodiscard]] double extinction_of_rate_per_m(Falling kind, double rate_mm_h) noexcept;

}  // namespace skyig::server
