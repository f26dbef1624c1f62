// Each medium as its sources state it: optics at any wavelength. AirModel samples one at sixteen wavelengths
// for drawing, the reference solver at forty for truth.
#pragma once

#include <concepts>
#include <functional>

#include "render/scene.h"
#include "render/sky/air_shape.h"
#include "render/sky/spectra.h"

namespace skyig::render::sky {

struct PlanetAir;

/// Per metre at height 0; ozone at the peak of its layer.
struct AirOptics {
    double rayleigh_per_m = 0.0;
    double aerosol_extinction_per_m = 0.0;
    double aerosol_scattering_per_m = 0.0;
    double ozone_peak_per_m = 0.0;
    double ground_albedo = 0.0;
};

/// \tparam Optics  AirOptics(double wavelength_nm), defined from 360 to 830 nm
template <class Optics>
struct LawOf {
    AirShape shape;
    Optics optics;
    /// Of the Sun outside the air at 1 AU.
    Samples sunlight_w_m2_nm{};

    template <class Other>
    requires std::constructible_from<Other, Optics>
    operator LawOf<Other>() const { return {shape, optics, sunlight_w_m2_nm}; }
};

using AirLaw = LawOf<std::function<AirOptics(double wavelength_nm)>>;

/// Of air_law(), as a plain value.
struct SceneOptics {
    double molecules_per_m = 0.0;
    double aerosol_per_m = 0.0;
    double angstrom_exponent = 0.0;

    [[nodiscard]] AirOptics operator()(double wavelength_nm) const noexcept;
};

/// What atmosphere_a(), atmosphere_b() and air_model() sample; limits and meaning are told there.
[[nodiscard]] AirLaw atmosphere_a_law();
[[nodiscard]] AirLaw atmosphere_b_law();
[[nodiscard]] LawOf<SceneOptics> air_law(const Air& air) noexcept;
[[nodiscard]] AirLaw planet_law(const PlanetAir& planet);

/// Albedo of land that nobody has said more about.
[[nodiscard]] double bare_land_albedo(double wavelength_nm) noexcept;

}  // namespace skyig::render::sky
