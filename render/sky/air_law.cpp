#include "render/sky/air_law.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/sky/air_model.h"
#include "render/sky/standard_air.h"

namespace skyig::render::sky {
namespace {

double sample_at(const Samples& samples, double wavelength_nm) {
    const double place =
        std::clamp((wavelength_nm - kFirstSampleNm) / kSampleStepNm, 0.0, double(kSampleCount - 1));
    const auto low = std::min(static_cast<std::size_t>(place), kSampleCount - 2);
    const double part = place - static_cast<double>(low);
    return samples[low] * (1.0 - part) + samples[low + 1] * part;
}

DensityProfile exponential(double scale_height_m) {
    DensityProfile profile;
    profile.knot_count = 2;
    profile.height_m = {0.0, scale_height_m};
    profile.log_density = {0.0, -1.0};
    return profile;
}

// US Standard Atmosphere 1976, mass density over that at sea level (1.225 kg/m3).
DensityProfile standard_molecules() {
    constexpr std::array<double, 27> kHeightKm = {0,  2,  4,  6,  8,  10, 12, 15, 20, 25, 30,  35,  40, 45,
                                                  50, 55, 60, 65, 70, 75, 80, 85, 90, 95, 100, 110, 120};
    constexpr std::array<double, 27> kDensity = {
        1.225,     1.0066,    0.81935,   0.66011,   0.52579,   0.41351,   0.31194,  0.19476,   0.088910,
        0.040084,  0.018410,  8.4634e-3, 3.9957e-3, 1.9663e-3, 1.0269e-3, 5.681e-4, 3.0968e-4, 1.6321e-4,
        8.2829e-5, 3.9921e-5, 1.8458e-5, 8.220e-6,  3.416e-6,  1.393e-6,  5.604e-7, 9.708e-8,  2.222e-8};
    DensityProfile profile;
    profile.knot_count = kHeightKm.size();
    for (std::size_t k = 0; k < kHeightKm.size(); ++k) {
        profile.height_m[k] = 1000.0 * kHeightKm[k];
        profile.log_density[k] = std::log(kDensity[k] / kDensity[0]);
    }
    return profile;
}

// Optical depth of all molecules at 1013.25 hPa: Bodhaine et al., J. Atmos. Oceanic Technol. 16 (1999) 1854,
// eq. 30.
double rayleigh_depth(double nm) {
    const double um2 = nm * nm * 1e-6;
    return 0.0021520 * (1.0455996 - 341.29061 / um2 - 0.90230850 * um2) /
           (1.0 + 0.0027059889 / um2 - 85.968563 * um2);
}

double finite_or(double value, double fallback) {
    return std::isfinite(value) ? value : fallback;
}

// Clear air holds fine particles only (steep spectrum), mist holds droplets (grey).
double angstrom_exponent(double visibility_m) {
    const double part = std::log(visibility_m / kMinVisibilityM) / std::log(50.0e3 / kMinVisibilityM);
    return 0.2 + 1.1 * std::clamp(part, 0.0, 1.0);
}

// What A and B have in common.
AirShape table_shape(double aerosol_g) {
    AirShape shape;
    shape.ground_radius_m = 6360.0e3;
    shape.top_height_m = 60.0e3;
    shape.molecules = exponential(8000.0);
    shape.aerosol_g = aerosol_g;
    return shape;
}

}  // namespace

AirLaw atmosphere_a_law() {
    const auto optics = [](double nm) {
        const double extinction = 0.04 * std::pow(nm * 1e-3, -0.8) / 1200.0;
        return AirOptics{sample_at(kPenndorfRayleigh, nm), extinction, 0.8 * extinction, 0.0,
                         sample_at(kGrassAlbedo, nm)};
    };
    return {table_shape(0.7), optics, kSolarBins};
}

AirLaw atmosphere_b_law() {
    const auto optics = [](double nm) {
        constexpr double kExtinction = 5.328e-3 / 1200.0;
        return AirOptics{1.24062e-6 * std::pow(nm * 1e-3, -4.0), kExtinction, 0.9 * kExtinction,
                         sample_at(kOzonePeak, nm), 0.1};
    };
    return {table_shape(0.8), optics, kSolarPoints};
}

AirOptics SceneOptics::operator()(double nm) const noexcept {
    constexpr double kSingleScatteringAlbedo = 0.94;  // continental background
    const double extinction = aerosol_per_m * std::pow(nm / 550.0, -angstrom_exponent);
    return {molecules_per_m * rayleigh_depth(nm), extinction, kSingleScatteringAlbedo * extinction,
            sample_at(kOzonePeak, nm), bare_land_albedo(nm)};
}

LawOf<SceneOptics> air_law(const Air& air) noexcept {
    const Air defaults;
    const double visibility_m =
        std::clamp(finite_or(air.visibility_m, defaults.visibility_m), kMinVisibilityM, kMaxVisibilityM);
    const double contrast =
        std::clamp(finite_or(air.visibility_contrast, defaults.visibility_contrast), 0.01, 0.2);
    const double pressure_hpa = std::clamp(finite_or(air.pressure_hpa, defaults.pressure_hpa), 850.0, 1085.0);

    AirShape shape;
    shape.molecules = standard_molecules();
    const double per_m = pressure_hpa / 1013.25 / column_above_m(shape.molecules, 0.0);
    double aerosol_per_m = 0.0;
    if (air.model_enabled) {
        shape.refractivity = kSeaLevelRefractivity * pressure_hpa / 1013.25;
        aerosol_per_m = std::max(0.0, -std::log(contrast) / visibility_m - per_m * rayleigh_depth(550.0));
        // Mist is shallow, haze fills the boundary layer: this holds the aerosol's vertical depth below about
        // 0.9.
        constexpr double kHazeVisibilityM = 4000.0;
        shape.aerosol_scale_height_m *= std::min(1.0, visibility_m / kHazeVisibilityM);
    }
    return {shape, {per_m, aerosol_per_m, angstrom_exponent(visibility_m)}, kSolarBins};
}

AirLaw planet_law(const PlanetAir& planet) {
    const PlanetAir usual;
    const auto in = [&](double PlanetAir::*number, double least, double most) {
        return std::clamp(finite_or(planet.*number, usual.*number), least, most);
    };
    const auto between_colours = [](double blue, double red) {
        return [=](double nm) { return std::clamp(blue + (red - blue) * (nm - 440.0) / 240.0, 0.0, 1.0); };
    };
    AirShape shape;
    shape.ground_radius_m = in(&PlanetAir::ground_radius_m, 1e5, 1e8);
    shape.top_height_m = in(&PlanetAir::top_height_m, 1e3, 1e6);
    shape.molecules = exponential(in(&PlanetAir::molecule_height_m, 10.0, 1e6));
    shape.aerosol_scale_height_m = in(&PlanetAir::aerosol_height_m, 10.0, 1e6);
    shape.aerosol_g = in(&PlanetAir::aerosol_g, -0.95, 0.95);
    const double rayleigh = in(&PlanetAir::rayleigh_per_m, 0.0, 0.01);
    const double aerosol = in(&PlanetAir::aerosol_per_m, 0.0, 0.01);
    const double angstrom = in(&PlanetAir::aerosol_angstrom, -2.0, 4.0);
    const auto scattered = between_colours(in(&PlanetAir::aerosol_albedo_blue, 0.0, 1.0),
                                           in(&PlanetAir::aerosol_albedo_red, 0.0, 1.0));
    constexpr double kTabulatedDobson = 300.0;
    const double ozone = in(&PlanetAir::ozone_dobson, 0.0, 1000.0) / kTabulatedDobson;
    const auto ground = between_colours(in(&PlanetAir::ground_albedo_blue, 0.0, 1.0),
                                        in(&PlanetAir::ground_albedo_red, 0.0, 1.0));
    const auto optics = [=](double nm) {
        const double extinction = aerosol * std::pow(nm / 550.0, -angstrom);
        return AirOptics{rayleigh * std::pow(nm / 550.0, -4.0), extinction, scattered(nm) * extinction,
                         ozone * sample_at(kOzonePeak, nm), ground(nm)};
    };
    return {shape, optics, kSolarBins};
}

// Grass over bare soil whose albedo rises evenly from 0.08 in the violet to 0.24 in the red.
double bare_land_albedo(double nm) noexcept {
    const double soil = 0.08 + 0.16 * std::clamp((nm - 400.0) / 300.0, 0.0, 1.0);
    return 0.6 * sample_at(kGrassAlbedo, nm) + 0.4 * soil;
}

}  // namespace skyig::render::sky
