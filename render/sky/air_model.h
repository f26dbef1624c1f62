// The optical medium: what the air is made of, how it thins out with height, and how sixteen wavelengths of
// sunlight add up to CIE XYZ. A plain value; everything else in this folder is computed from it.
#pragma once

#include <array>
#include <cstddef>

#include "render/scene.h"
#include "render/sky/air_shape.h"

namespace skyig::render::sky {

/// Wavelengths carried everywhere: 390, 411, ... 705 nm. One AVX-512 register, two AVX2 ones.
inline constexpr int kWavelengths = 16;
using Spectrum = std::array<float, kWavelengths>;

inline constexpr double kFirstWavelengthNm = 390.0;
inline constexpr double kWavelengthStepNm = 21.0;

/// Spherical shell of molecules, aerosol and ozone over a Lambertian ground. Coefficients are per metre at
/// height 0, except ozone's, which is at the peak of its triangular layer. No refraction, no polarisation.
struct AirModel : AirShape {
    Spectrum wavelength_nm{};
    Spectrum rayleigh_per_m{};
    Spectrum aerosol_extinction_per_m{};
    Spectrum aerosol_scattering_per_m{};
    Spectrum ozone_peak_per_m{};
    Spectrum ground_albedo{};
    /// What each wavelength carries of the Sun's XYZ illuminance (lux scale, 1 AU, outside the air): X, Y, Z
    /// rows. Sums to 1.32e5 lx in Y. Radiances in this folder are per unit of solar irradiance (1/sr), so XYZ
    /// in cd/m2 = sum over i of sunlight_xyz_lux[.][i] * transfer[i].
    std::array<Spectrum, 3> sunlight_xyz_lux{};

    friend bool operator==(const AirModel& a, const AirModel& b) noexcept;
};

/// The two media of the truth tables in tests/data/sky (6360 km ground, lid at 60 km).
/// A: Penndorf molecules, absorbing haze with an Angstrom exponent 0.8, grass, no ozone.
/// B: lambda^-4 molecules, grey haze, 300 DU of ozone, albedo 0.1.
[[nodiscard]] AirModel atmosphere_a();
[[nodiscard]] AirModel atmosphere_b();

/// Visibilities outside this range are taken as its nearest end: denser mist than the lower end is the
/// business of fog layers, clearer air than the upper end does not exist (molecules alone give 257 km at
/// contrast 5 %).
inline constexpr double kMinVisibilityM = 1000.0;
inline constexpr double kMaxVisibilityM = 250.0e3;

/// The air of a scene: US Standard Atmosphere 1976 molecules (scaled with the pressure), 300 DU of ozone,
/// aerosol with a scale height of 1.2 km (less below 4 km of visibility, in proportion: mist is shallow)
/// whose extinction at the ground brings the total at 550 nm to -ln(contrast) / visibility, a dull
/// grass-and-soil ground (luminous albedo about 0.1), lid at 120 km, ground at 6371 km. `model_enabled ==
/// false`: molecules and ozone only. Any input is legal: what is not finite counts as the default, what is
/// out of range is clamped (visibility as above, contrast 0.01..0.2, pressure 850..1085 hPa), and the model
/// depends continuously on each number. Temperature and humidity do not enter.
[[nodiscard]] AirModel air_model(const Air& air);

}  // namespace skyig::render::sky
