// How far runway lights and marks are seen: what a transmissometer makes of extinction, and what an
// instructor sets. Lights by Allard's law, E = I exp(-sigma R) / R^2, against the threshold of a pilot's eye;
// marks by Koschmieder's law; the runway visual range is the larger of both (ICAO Annex 3, 4.6.3; Doc 9328).
#pragma once

namespace skyig::render::fog {

/// Illuminance at the eye at which a light before this background is just seen, lux: log10 E = 0.05 B^2 +
/// 0.573 B - 6.667 with B the log10 of the background in cd/m2 (ICAO Doc 9328, a smooth line through its
/// steps 8e-7, 1e-5, 1e-4, 1e-3). Backgrounds below 1 cd/m2 count as that, above 40,000 as that.
[[nodiscard]] double light_threshold_lux(double background_cd_m2) noexcept;

/// Distance at which a light is at its threshold, metres; 0 for no light. Any finite input: extinction below
/// 0 counts as 0. Within 1e-12 of the root.
[[nodiscard]] double allard_range_m(double intensity_cd, double extinction_per_m,
                                    double threshold_lux) noexcept;
/// Distance at which a black mark has that contrast with what lies behind it; infinite in empty air. \param
/// contrast  0..1
[[nodiscard]] double koschmieder_range_m(double extinction_per_m, double contrast = 0.05) noexcept;

struct RunwayVisualRange {
    double range_m = 0.0;
    double allard_m = 0.0;
    double koschmieder_m = 0.0;
    double threshold_lux = 0.0;
};
[[nodiscard]] RunwayVisualRange runway_visual_range(double extinction_per_m, double intensity_cd,
                                                    double background_cd_m2, double contrast = 0.05) noexcept;

/// Extinction with which the range is `range_m` > 0: the largest at which lights or marks are still seen that
/// far. \return 0 if lights would not be seen as far in empty air, and marks are
[[nodiscard]] double extinction_for_range(double range_m, double intensity_cd, double background_cd_m2,
                                          double contrast = 0.05) noexcept;

}  // namespace skyig::render::fog
