#include "render/sky/air_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/sky/spectra.h"

namespace skyig::render::sky {
namespace {

double wavelength_nm(int i) {
    return kFirstWavelengthNm + kWavelengthStepNm * i;
}

double sample_at(const Samples& samples, double wavelength_nm) {
    const double place =
        std::clamp((wavelength_nm - kFirstSampleNm) / kSampleStepNm, 0.0, double(kSampleCount - 1));
    const auto low = std::min(static_cast<std::size_t>(place), kSampleCount - 2);
    const double part = place - static_cast<double>(low);
    return samples[low] * (1.0 - part) + samples[low + 1] * part;
}

template <class Function>
Spectrum spectrum_of(Function&& function) {
    Spectrum spectrum{};
    for (int i = 0; i < kWavelengths; ++i) {
        spectrum[static_cast<std::size_t>(i)] = static_cast<float>(function(wavelength_nm(i)));
    }
    return spectrum;
}

// The transfer function (radiance over irradiance) is smooth in wavelength while the solar spectrum is not:
// so the transfer is interpolated (cubic Lagrange) to the fine grid, and sunlight and observer are summed
// there once.
std::array<double, 4> cubic_weights(double x) {
    return {-x * (x - 1.0) * (x - 2.0) / 6.0, (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0,
            -(x + 1.0) * x * (x - 2.0) / 2.0, (x + 1.0) * x * (x - 1.0) / 6.0};
}

Spectrum sunlight_row(const Samples& solar, const Samples& observer) {
    std::array<double, kWavelengths> sum{};
    for (std::size_t k = 0; k < kSampleCount; ++k) {
        const double lux = 683.0 * kSampleStepNm * solar[k] * observer[k];
        const double place = (kFirstSampleNm + kSampleStepNm * static_cast<double>(k) - kFirstWavelengthNm) /
                             kWavelengthStepNm;
        const double inside = std::clamp(place, 0.0, double(kWavelengths - 1));
        const int first = std::clamp(static_cast<int>(inside) - 1, 0, kWavelengths - 4);
        const auto weights = cubic_weights(inside - first - 1.0);
        for (std::size_t j = 0; j < 4; ++j)
            sum[static_cast<std::size_t>(first) + j] += lux * weights[j];
    }
    Spectrum row{};
    for (std::size_t i = 0; i < row.size(); ++i)
        row[i] = static_cast<float>(sum[i]);
    return row;
}

AirModel with_sunlight(const Samples& solar) {
    AirModel model;
    model.wavelength_nm = spectrum_of([](double nm) { return nm; });
    model.sunlight_xyz_lux = {sunlight_row(solar, kObserverX), sunlight_row(solar, kObserverY),
                              sunlight_row(solar, kObserverZ)};
    return model;
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

// Grass over bare soil whose albedo rises evenly from 0.08 in the violet to 0.24 in the red.
double ground_albedo(double nm) {
    const double soil = 0.08 + 0.16 * std::clamp((nm - 400.0) / 300.0, 0.0, 1.0);
    return 0.6 * sample_at(kGrassAlbedo, nm) + 0.4 * soil;
}

// Clean snow loses a little towards the red (Wiscombe and Warren 1980); sastrugi and age take a tenth.
double snow_albedo(double nm) {
    return 0.87 - 0.04 * std::clamp((nm - 400.0) / 300.0, 0.0, 1.0);
}

// Light that comes back out of clear ocean: pi times the remote-sensing reflectance.
double water_albedo(double nm) {
    constexpr std::array<double, 9> kNm = {390, 412, 443, 490, 510, 555, 620, 670, 705};
    constexpr std::array<double, 9> kPerSr = {6.8e-3, 7.0e-3, 6.5e-3, 5.5e-3, 3.5e-3,
                                              1.7e-3, 4e-4,   1.5e-4, 5e-5};
    std::size_t k = 1;
    while (k + 1 < kNm.size() && nm > kNm[k])
        ++k;
    const double part = std::clamp((nm - kNm[k - 1]) / (kNm[k] - kNm[k - 1]), 0.0, 1.0);
    return std::numbers::pi * (kPerSr[k - 1] + part * (kPerSr[k] - kPerSr[k - 1]));
}

void lay_land(const Ground& ground, AirModel& model) {
    model.ground_albedo = spectrum_of(ground_albedo);
    const double bare = luminous_albedo(model, model.ground_albedo);
    const double scale = std::clamp(finite_or(ground.albedo.value_or(bare), bare), 0.0, 1.0) / bare;
    const double snow = std::clamp(finite_or(ground.snow, 0.0), 0.0, 1.0);
    model.ground_albedo = spectrum_of([&](double nm) {
        const double land = std::min(scale * ground_albedo(nm), 1.0);
        return land + snow * (snow_albedo(nm) - land);
    });
}

void lay_sea(AirModel& model) {
    model.ground_mirror_albedo = 0.05F;
    model.ground_albedo = spectrum_of(water_albedo);
    for (float& albedo : model.ground_albedo)
        albedo += model.ground_mirror_albedo;
}

// Clear air holds fine particles only (steep spectrum), mist holds droplets (grey).
double angstrom_exponent(double visibility_m) {
    const double part = std::log(visibility_m / kMinVisibilityM) / std::log(50.0e3 / kMinVisibilityM);
    return 0.2 + 1.1 * std::clamp(part, 0.0, 1.0);
}

}  // namespace

bool operator==(const AirModel& a, const AirModel& b) noexcept {
    const bool same_profile = a.molecules.knot_count == b.molecules.knot_count &&
                              a.molecules.height_m == b.molecules.height_m &&
                              a.molecules.log_density == b.molecules.log_density;
    return same_profile && a.ground_radius_m == b.ground_radius_m && a.top_height_m == b.top_height_m &&
           a.aerosol_scale_height_m == b.aerosol_scale_height_m && a.aerosol_g == b.aerosol_g &&
           a.ozone_bottom_m == b.ozone_bottom_m && a.ozone_peak_m == b.ozone_peak_m &&
           a.ozone_top_m == b.ozone_top_m && a.wavelength_nm == b.wavelength_nm &&
           a.rayleigh_per_m == b.rayleigh_per_m && a.aerosol_extinction_per_m == b.aerosol_extinction_per_m &&
           a.aerosol_scattering_per_m == b.aerosol_scattering_per_m &&
           a.ozone_peak_per_m == b.ozone_peak_per_m && a.ground_albedo == b.ground_albedo &&
           a.ground_mirror_albedo == b.ground_mirror_albedo && a.sunlight_xyz_lux == b.sunlight_xyz_lux;
}

double column_above_m(const DensityProfile& profile, double height_m) noexcept {
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < profile.knot_count; ++k) {
        const bool last = k + 2 == profile.knot_count;
        if (!last && profile.height_m[k + 1] <= height_m) continue;
        const double scale_m = (profile.height_m[k + 1] - profile.height_m[k]) /
                               (profile.log_density[k] - profile.log_density[k + 1]);
        const double from_m = std::max(height_m, profile.height_m[k]);
        const double low = std::exp(profile.log_density[k] - (from_m - profile.height_m[k]) / scale_m);
        const double high = last ? 0.0 : std::exp(profile.log_density[k + 1]);
        sum += scale_m * (low - high);
    }
    return sum;
}

glm::dvec3 xyz_of_sunlight(const AirModel& model, const Spectrum& part) noexcept {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < part.size(); ++i) {
        sum += static_cast<double>(part[i]) * glm::dvec3(model.sunlight_xyz_lux[0][i],
                                                         model.sunlight_xyz_lux[1][i],
                                                         model.sunlight_xyz_lux[2][i]);
    }
    return glm::max(sum, glm::dvec3(0.0));
}

double luminous_albedo(const AirModel& model, const Spectrum& albedo) noexcept {
    Spectrum whole;
    whole.fill(1.0F);
    return xyz_of_sunlight(model, albedo).y / xyz_of_sunlight(model, whole).y;
}

AirModel atmosphere_a() {
    AirModel model = with_sunlight(kSolarBins);
    model.ground_radius_m = 6360.0e3;
    model.top_height_m = 60.0e3;
    model.molecules = exponential(8000.0);
    model.aerosol_g = 0.7;
    model.rayleigh_per_m = spectrum_of([](double nm) { return sample_at(kPenndorfRayleigh, nm); });
    const auto extinction = [](double nm) { return 0.04 * std::pow(nm * 1e-3, -0.8) / 1200.0; };
    model.aerosol_extinction_per_m = spectrum_of(extinction);
    model.aerosol_scattering_per_m = spectrum_of([&](double nm) { return 0.8 * extinction(nm); });
    model.ground_albedo = spectrum_of([](double nm) { return sample_at(kGrassAlbedo, nm); });
    return model;
}

AirModel atmosphere_b() {
    AirModel model = with_sunlight(kSolarPoints);
    model.ground_radius_m = 6360.0e3;
    model.top_height_m = 60.0e3;
    model.molecules = exponential(8000.0);
    model.aerosol_g = 0.8;
    model.rayleigh_per_m = spectrum_of([](double nm) { return 1.24062e-6 * std::pow(nm * 1e-3, -4.0); });
    model.aerosol_extinction_per_m.fill(5.328e-3F / 1200.0F);
    model.aerosol_scattering_per_m.fill(0.9F * 5.328e-3F / 1200.0F);
    model.ozone_peak_per_m = spectrum_of([](double nm) { return sample_at(kOzonePeak, nm); });
    model.ground_albedo.fill(0.1F);
    return model;
}

AirModel air_model(const Air& air, const Ground& ground) {
    const Air defaults;
    const double visibility_m =
        std::clamp(finite_or(air.visibility_m, defaults.visibility_m), kMinVisibilityM, kMaxVisibilityM);
    const double contrast =
        std::clamp(finite_or(air.visibility_contrast, defaults.visibility_contrast), 0.01, 0.2);
    const double pressure_hpa = std::clamp(finite_or(air.pressure_hpa, defaults.pressure_hpa), 850.0, 1085.0);

    AirModel model = with_sunlight(kSolarBins);
    model.molecules = standard_molecules();
    const double per_m = pressure_hpa / 1013.25 / column_above_m(model.molecules, 0.0);
    model.rayleigh_per_m = spectrum_of([&](double nm) { return per_m * rayleigh_depth(nm); });
    model.ozone_peak_per_m = spectrum_of([](double nm) { return sample_at(kOzonePeak, nm); });
    if (ground.kind == Ground::Kind::kSea) {
        lay_sea(model);
    } else {
        lay_land(ground, model);
    }
    if (!air.model_enabled) return model;

    const double total_per_m = -std::log(contrast) / visibility_m;
    const double aerosol_per_m = std::max(0.0, total_per_m - per_m * rayleigh_depth(550.0));
    const double exponent = angstrom_exponent(visibility_m);
    const auto extinction = [&](double nm) { return aerosol_per_m * std::pow(nm / 550.0, -exponent); };
    // Mist is shallow, haze fills the boundary layer: this holds the aerosol's vertical depth below about
    // 0.9.
    constexpr double kHazeVisibilityM = 4000.0;
    model.aerosol_scale_height_m *= std::min(1.0, visibility_m / kHazeVisibilityM);
    constexpr double kSingleScatteringAlbedo = 0.94;  // continental background
    model.aerosol_extinction_per_m = spectrum_of(extinction);
    model.aerosol_scattering_per_m =
        spectrum_of([&](double nm) { return kSingleScatteringAlbedo * extinction(nm); });
    return model;
}

AirModel planet_air(const PlanetAir& planet) {
    const PlanetAir usual;
    const auto in = [&](double PlanetAir::*number, double least, double most) {
        return std::clamp(finite_or(planet.*number, usual.*number), least, most);
    };
    const auto between_colours = [](double blue, double red) {
        return [=](double nm) { return std::clamp(blue + (red - blue) * (nm - 440.0) / 240.0, 0.0, 1.0); };
    };
    AirModel model = with_sunlight(kSolarBins);
    model.ground_radius_m = in(&PlanetAir::ground_radius_m, 1e5, 1e8);
    model.top_height_m = in(&PlanetAir::top_height_m, 1e3, 1e6);
    model.molecules = exponential(in(&PlanetAir::molecule_height_m, 10.0, 1e6));
    model.aerosol_scale_height_m = in(&PlanetAir::aerosol_height_m, 10.0, 1e6);
    model.aerosol_g = in(&PlanetAir::aerosol_g, -0.95, 0.95);
    const double rayleigh = in(&PlanetAir::rayleigh_per_m, 0.0, 0.01);
    model.rayleigh_per_m = spectrum_of([&](double nm) { return rayleigh * std::pow(nm / 550.0, -4.0); });
    const double aerosol = in(&PlanetAir::aerosol_per_m, 0.0, 0.01);
    const double angstrom = in(&PlanetAir::aerosol_angstrom, -2.0, 4.0);
    const auto extinction = [&](double nm) { return aerosol * std::pow(nm / 550.0, -angstrom); };
    const auto scattered = between_colours(in(&PlanetAir::aerosol_albedo_blue, 0.0, 1.0),
                                           in(&PlanetAir::aerosol_albedo_red, 0.0, 1.0));
    model.aerosol_extinction_per_m = spectrum_of(extinction);
    model.aerosol_scattering_per_m = spectrum_of([&](double nm) { return scattered(nm) * extinction(nm); });
    constexpr double kTabulatedDobson = 300.0;
    const double ozone = in(&PlanetAir::ozone_dobson, 0.0, 1000.0) / kTabulatedDobson;
    model.ozone_peak_per_m = spectrum_of([&](double nm) { return ozone * sample_at(kOzonePeak, nm); });
    model.ground_albedo = spectrum_of(between_colours(in(&PlanetAir::ground_albedo_blue, 0.0, 1.0),
                                                      in(&PlanetAir::ground_albedo_red, 0.0, 1.0)));
    return model;
}

}  // namespace skyig::render::sky
