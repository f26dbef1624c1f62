// Twinkling: the air's eddies make a point of light flicker.
#pragma once

#include <cstdint>

namespace skyig::render::night {

/// Standard deviation of the logarithm of a star's light, of the light that one frame of 1/30 s collects:
/// min(0.08 X^1.75, 0.5) exp(-h / 8 km), the eye's whole band, times 0.82. The flicker is taken as noise
/// whose correlation falls by e in tau = 25 ms; the mean over T has
/// 2 (tau/T)^2 (T/tau - 1 + exp(-T/tau)) = 0.67 of its variance.
/// \param air_mass  X of the star, 1 at the zenith of an eye at sea level; \param eye_height_m  h
[[nodiscard]] double scintillation_rms(double air_mass, double eye_height_m) noexcept;

/// What three standard deviations add to the light of a star on the horizon, parts of it: from this eye none
/// flickers more. \see scintillation()
[[nodiscard]] double strongest_flicker(double eye_height_m) noexcept;

/// What a planet's disc leaves of a point's flicker.
inline constexpr double kPlanetScintillation = 0.2;

/// Air mass of an apparent elevation (Kasten and Young 1989); below the horizon as on it.
[[nodiscard]] double air_mass(double apparent_elevation_rad) noexcept;

/// Factor on the light of one source at one time, log-normal with mean 1 (within 2e-3 for rms <= 0.5). A
/// function of its arguments alone: every channel, every machine and every replay sees the same. From one
/// frame of 1/30 s to the next it is independent, between it runs smoothly.
[[nodiscard]] float scintillation(std::uint32_t source, double time_s, float rms) noexcept;

}  // namespace skyig::render::night
