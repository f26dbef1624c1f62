#include "render/sky/air_law.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/sky/air_model.h"

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

double column_m(const DensityProfile& profile) {
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < profile.knot_count; ++k) {
        const double low = std::exp(profile.log_density[k]);
        const double high = std::exp(profile.log_density[k + 1]);
        sum += (low - high) * (profile.height_m[k + 1] - profile.height_m[k]) /
               (profile.log_density[k] - profile.log_density[k + 1]);
    }
    return sum;
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

// Grass over bare soil whose albedo rises evenly from 0.08 in the violet to 0.24 in the red.
double ground_albedo(double nm) {
    const double soil = 0.08 + 0.16 * std::clamp((nm - 400.0) / 300.0, 0.0, 1.0);
    return 0.6 * sample_at(kGrassAlbedo, nm) + 0.4 * soil;
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

AirLaw air_law(const Air& air) {
    const Air defaults;
    const double visibility_m =
        std::clamp(finite_or(air.visibility_m, defaults.visibility_m), kMinVisibilityM, kMaxVisibilityM);
    const double contrast =
        std::clamp(finite_or(air.visibility_contrast, defaults.visibility_contrast), 0.01, 0.2);
    const double pressure_hpa = std::clamp(finite_or(air.pressure_hpa, defaults.pressure_hpa), 850.0, 1085.0);

    AirShape shape;
    shape.molecules = standard_molecules();
    const double per_m = pressure_hpa / 1013.25 / column_m(shape.molecules);
    double aerosol_per_m = 0.0;
    if (air.model_enabled) {
        aerosol_per_m = std::max(0.0, -std::log(contrast) / visibility_m - per_m * rayleigh_depth(550.0));
        // Mist is shallow, haze fills the boundary layer: this holds the aerosol's vertical depth below about
        // 0.9.
        constexpr double kHazeVisibilityM = 4000.0;
        shape.aerosol_scale_height_m *= std::min(1.0, visibility_m / kHazeVisibilityM);
    }
    const double exponent = angstrom_exponent(visibility_m);
    const auto optics = [per_m, aerosol_per_m, exponent](double nm) {
        constexpr double kSingleScatteringAlbedo = 0.94;  // continental background
        const double extinction = aerosol_per_m * std::pow(nm / 550.0, -exponent);
        return AirOptics{per_m * rayleigh_depth(nm), extinction, kSingleScatteringAlbedo * extinction,
                         sample_at(kOzonePeak, nm), ground_albedo(nm)};
    };
    return {shape, optics, kSolarBins};
}

}  // namespace skyig::render::sky
