// The bodies that the sky shows besides the stars, in one order for every table and array of the ephemeris.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace skyig::server::ephemeris {

enum class Body : std::uint8_t { kSun, kMoon, kMercury, kVenus, kMars, kJupiter, kSaturn };

inline constexpr std::size_t kBodyCount = 7;
inline constexpr std::array<Body, kBodyCount> kBodies{
    Body::kSun, Body::kMoon, Body::kMercury, Body::kVenus, Body::kMars, Body::kJupiter, Body::kSaturn};
/// Names as they are typed and printed, in the order of Body.
inline constexpr std::array<std::string_view, kBodyCount> kBodyNames{"sun",  "moon",    "mercury", "venus",
                                                                     "mars", "jupiter", "saturn"};
/// Kilometres in an astronomical unit (IAU 2012).
inline constexpr double kKmPerAu = 149597870.7;
/// Radii that semidiameters are made of, km: nominal Sun, mean Moon, equatorial planets.
inline constexpr std::array<double, kBodyCount> kBodyRadii_km{695700.0, 1737.4,  2439.7, 6051.8,
                                                              3396.19,  71492.0, 60268.0};

/// The planets that a naked eye sees, Mercury to Saturn without the Earth.
inline constexpr std::size_t kPlanetCount = 5;

[[nodiscard]] constexpr std::size_t index_of(Body body) noexcept {
    return static_cast<std::size_t>(body);
}
[[nodiscard]] constexpr std::string_view name_of(Body body) noexcept {
    return kBodyNames[index_of(body)];
}

/// Which series the sky is computed from: from cheap to good. Errors and costs: docs/accuracy.
enum class Model : std::uint8_t { kAlmanac, kErfa, kSeries };

inline constexpr std::array<std::string_view, 3> kModelNames{"almanac", "erfa", "series"};

[[nodiscard]] constexpr std::string_view name_of(Model model) noexcept {
    return kModelNames[static_cast<std::size_t>(model)];
}

}  // namespace skyig::server::ephemeris
