// The optical medium: what the air is made of, how it thins out with height, and how sixteen wavelengths of
// sunlight add up to CIE XYZ. A plain value; everything else in this folder is computed from it.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

#include "render/scene.h"
#include "render/sky/air_shape.h"

namespace skyig::render::sky {

/// Wavelengths carried everywhere: 390, 411, ... 705 nm. One AVX-512 register, two AVX2 ones.
inline constexpr int kWavelengths = 16;
using Spectrum = std::array<float, kWavelengths>;

inline constexpr double kFirstWavelengthNm = 390.0;
inline constexpr double kWavelengthStepNm = 21.0;

/// Spherical shell of molecules, aerosol and ozone over a Lambertian ground. Coefficients are per metre at
/// height 0, except ozone's, which is at the peak of its triangular layer. No polarisation; the source's
/// light is bent on its way in if `refractivity` says so, views are straight.
struct AirModel : AirShape {
    Spectrum wavelength_nm{};
    Spectrum rayleigh_per_m{};
    Spectrum aerosol_extinction_per_m{};
    Spectrum aerosol_scattering_per_m{};
    Spectrum ozone_peak_per_m{};
    Spectrum ground_albedo{};
    /// The part of it that a wavy mirror reflects, the same at all wavelengths: it lights the air, but is
    /// left out where the ground is seen (SeaView adds it). 0 on land.
    float ground_mirror_albedo = 0.0F;
    /// What each wavelength carries of the Sun's XYZ illuminance (lux scale, 1 AU, outside the air): X, Y, Z
    /// rows. Sums to 1.32e5 lx in Y. Radiances in this folder are per unit of solar irradiance (1/sr), so XYZ
    /// in cd/m2 = sum over i of sunlight_xyz_lux[.][i] * transfer[i].
    std::array<Spectrum, 3> sunlight_xyz_lux{};

    friend bool operator==(const AirModel& a, const AirModel& b) noexcept;
};

/// Metres of air of the density at height 0 that weigh as much as all above `height_m`, the last slope going
/// on.
[[nodiscard]] double column_above_m(const DensityProfile& profile, double height_m) noexcept;

/// XYZ of sunlight of which `part` is left over, wavelength by wavelength: cd/m2 for radiances per unit of
/// solar irradiance, lux for transmittances. Not below 0.
[[nodiscard]] glm::dvec3 xyz_of_sunlight(const AirModel& model, const Spectrum& part) noexcept;

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
/// grass-and-soil ground (luminous albedo about 0.1) unless `ground` says otherwise, lid at 120 km, ground at
/// 6371 km. `model_enabled == false`: molecules and ozone only. Any input is legal: what is not finite counts
/// as the default, what is out of range is clamped (visibility as above, contrast 0.01..0.2, pressure
/// 850..1085 hPa), and the model depends continuously on each number. Temperature and humidity do not enter.
/// The standard atmosphere's refraction, scaled with the pressure; none if the model is switched off.
///
/// Land of another albedo has the same colour; snow is nearly white (albedo 0.85). The sea sends back what
/// its surface reflects of a day's light (0.05) and blue light from below: open ocean, remote-sensing
/// reflectances that the band ratio OC4 (O'Reilly et al. 1998) reads as 0.15 mg/m3 of chlorophyll.
[[nodiscard]] AirModel air_model(const Air& air, const Ground& ground = {});

/// What a surface of this albedo reflects of sunlight's illuminance.
[[nodiscard]] double luminous_albedo(const AirModel& model, const Spectrum& albedo) noexcept;

/// Another planet's air, or a simple one of this: exponential molecules and dust, optics at 550 nm with
/// simple spectra. The defaults are the Earth's.
struct PlanetAir {
    double ground_radius_m = 6371.0e3;  ///< 1e5..1e8
    double top_height_m = 120.0e3;      ///< 1e3..1e6
    double molecule_height_m = 8000.0;  ///< scale height, 10..1e6
    double rayleigh_per_m = 1.16e-5;    ///< at the ground, as the wavelength's -4th power; 0..0.01
    double aerosol_height_m = 1200.0;   ///< scale height, 10..1e6
    double aerosol_per_m = 2.0e-5;      ///< extinction at the ground; 0..0.01
    double aerosol_angstrom = 1.2;      ///< its fall with wavelength, -2..4
    double aerosol_albedo_blue = 0.94;  ///< single-scattering albedo at 440 nm, 0..1; linear between
    double aerosol_albedo_red = 0.94;   ///< at 680 nm
    double aerosol_g = 0.75;            ///< Cornette-Shanks, -0.95..0.95
    double ozone_dobson = 300.0;        ///< 0..1000
    double ground_albedo_blue = 0.08;   ///< at 440 nm, 0..1; linear between
    double ground_albedo_red = 0.2;     ///< at 680 nm
};

/// Numbers out of range count as the nearest end, what is not finite as the default. Sunlight is that at 1
/// AU.
[[nodiscard]] AirModel planet_air(const PlanetAir& planet);

}  // namespace skyig::render::sky
