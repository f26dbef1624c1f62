#include "render/sky/air_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/sky/air_data.h"
#include "render/sky/sea_sky.h"

namespace skyig::render::sky {
namespace {

constexpr double kDiscRadiusRad = 0.004654;

double visible_part(double above_horizon_rad) {
    const double part = std::clamp(0.5 + above_horizon_rad / (2.0 * kDiscRadiusRad), 0.0, 1.0);
    return part * part * (3.0 - 2.0 * part);
}

Spectrum spectrum_of(const Lanes& lanes) {
    Spectrum spectrum{};
    std::copy(std::begin(lanes.v), std::end(lanes.v), spectrum.begin());
    return spectrum;
}

double at_wavelength(const Spectrum& transmittance, double nm) {
    constexpr float kLeast = 1e-37F;
    const double place = (nm - kFirstWavelengthNm) / kWavelengthStepNm;
    const auto low = static_cast<std::size_t>(place);
    const double part = place - static_cast<double>(low);
    if (transmittance[low] <= 0.0F) return 0.0;
    // Linear in depth, since the coefficients are what is smooth.
    return std::exp((1.0 - part) * std::log(static_cast<double>(std::max(transmittance[low], kLeast))) +
                    part * std::log(static_cast<double>(std::max(transmittance[low + 1], kLeast))));
}

}  // namespace

AirTables::AirTables(const AirModel& model, Orders orders) {
    auto data = std::make_shared<AirData>();
    build_medium(model, *data);
    build_columns(*data);
    if (orders == Orders::kAll) {
        build_moments(*data);
    } else {
        keep_forward_peak(*data);
    }
    if (model.ground_mirror_albedo > 0.0F) {
        leave_mirror_out(*data);
        build_sea_sky(*data);
    }
    data_ = std::move(data);
}

const AirModel& AirTables::model() const noexcept {
    return data_->model;
}

Orders AirTables::orders() const noexcept {
    return data_->moments.empty() ? Orders::kFirst : Orders::kAll;
}

Spectrum AirTables::transmittance(double height_m, double elevation_rad) const noexcept {
    const Shell& shell = data_->shell;
    const double eye_m = std::max(0.0, height_m);
    const double elevation = std::clamp(elevation_rad, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi);
    const double visible = visible_part(elevation + shell.dip_rad(eye_m));
    Spectrum clear{};
    if (visible <= 0.0) return clear;

    double sine = std::sin(elevation);
    double inside_m = eye_m;
    if (eye_m > shell.top_height_m) {
        // Where the ray enters the lid, by its distance from the Earth's centre at the closest point.
        const double r = shell.ground_radius_m + eye_m;
        const double top_radius_m = shell.ground_radius_m + shell.top_height_m;
        const double closest = r * std::cos(elevation) / top_radius_m;
        if (sine >= 0.0 || closest >= 1.0) {
            clear.fill(1.0F);
            return clear;
        }
        sine = -std::sqrt((1.0 - closest) * (1.0 + closest));
        inside_m = shell.top_height_m;
    }
    // The curved ray that comes as near to the ground.
    const double dip_sine = data_->dip_sine(data_->seen_dip_sine, inside_m);
    if (sine < 0.0 && dip_sine > 0.0) sine *= dip_sine / shell.dip_sine(inside_m);
    Lanes lanes{};
    kernels().transmit(data_->medium, data_->seen_table(), static_cast<float>(data_->seen_row(inside_m)),
                       static_cast<float>(sine + dip_sine), static_cast<float>(dip_sine), lanes);
    for (float& value : lanes.v)
        value *= static_cast<float>(visible);
    return spectrum_of(lanes);
}

glm::dvec3 AirTables::transmittance_rgb(double height_m, double elevation_rad) const noexcept {
    const Spectrum spectrum = transmittance(height_m, elevation_rad);
    return {at_wavelength(spectrum, 612.0), at_wavelength(spectrum, 549.0), at_wavelength(spectrum, 465.0)};
}

glm::dvec3 AirTables::direct_sun_xyz(double height_m, double elevation_rad,
                                     double distance_au) const noexcept {
    return xyz_of_sunlight(data_->model, transmittance(height_m, elevation_rad)) /
           (distance_au * distance_au);
}

glm::dvec3 AirTables::ground_diffuse_xyz(double source_elevation_rad) const noexcept {
    if (data_->log_ground.empty()) return glm::dvec3(0.0);
    // Same interpolation as the kernels: the logarithm, between nodes quadratic about the horizon.
    const double sine = std::sin(source_elevation_rad);
    const double root = sine < 0.0 ? std::sqrt(-sine / static_cast<double>(kLowestSine)) : std::sqrt(sine);
    const double place =
        sine < 0.0 ? kNightNodes * (1.0 - std::min(1.0, root)) : kNightNodes + kDayNodes * root;
    const auto low = static_cast<std::size_t>(std::clamp(static_cast<int>(place), 0, kSineNodes - 2));
    const auto part = static_cast<float>(std::clamp(place - static_cast<double>(low), 0.0, 1.0));
    const float* node = data_->log_ground.data() + low * kLanes;
    Spectrum irradiance{};
    for (std::size_t i = 0; i < kLanes; ++i) {
        const float value = std::exp(node[i] + part * (node[i + kLanes] - node[i])) - kDarkness;
        irradiance[i] = std::max(0.0F, value);
    }
    return xyz_of_sunlight(data_->model, irradiance);
}

}  // namespace skyig::render::sky
