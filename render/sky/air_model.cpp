#include "render/sky/air_model.h"

#include <algorithm>
#include <cmath>

#include "render/sky/air_law.h"
#include "render/sky/ground_albedo.h"
#include "render/sky/spectra.h"

namespace skyig::render::sky {
namespace {

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

template <class Law>
AirModel sampled(const Law& law) {
    AirModel model;
    static_cast<AirShape&>(model) = law.shape;
    for (std::size_t i = 0; i < kWavelengths; ++i) {
        const double nm = kFirstWavelengthNm + kWavelengthStepNm * static_cast<double>(i);
        const AirOptics optics = law.optics(nm);
        model.wavelength_nm[i] = static_cast<float>(nm);
        model.rayleigh_per_m[i] = static_cast<float>(optics.rayleigh_per_m);
        model.aerosol_extinction_per_m[i] = static_cast<float>(optics.aerosol_extinction_per_m);
        model.aerosol_scattering_per_m[i] = static_cast<float>(optics.aerosol_scattering_per_m);
        model.ozone_peak_per_m[i] = static_cast<float>(optics.ozone_peak_per_m);
        model.ground_albedo[i] = static_cast<float>(optics.ground_albedo);
    }
    model.sunlight_xyz_lux = {sunlight_row(law.sunlight_w_m2_nm, kObserverX),
                              sunlight_row(law.sunlight_w_m2_nm, kObserverY),
                              sunlight_row(law.sunlight_w_m2_nm, kObserverZ)};
    return model;
}

}  // namespace

bool operator==(const AirModel& a, const AirModel& b) noexcept {
    return static_cast<const AirShape&>(a) == static_cast<const AirShape&>(b) &&
           a.wavelength_nm == b.wavelength_nm && a.rayleigh_per_m == b.rayleigh_per_m &&
           a.aerosol_extinction_per_m == b.aerosol_extinction_per_m &&
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
    return sampled(atmosphere_a_law());
}

AirModel atmosphere_b() {
    return sampled(atmosphere_b_law());
}

AirModel air_model(const Air& air, const Ground& ground) {
    AirModel model = sampled(air_law(air));
    lay_ground(ground, model);
    return model;
}

AirModel planet_air(const PlanetAir& planet) {
    return sampled(planet_law(planet));
}

}  // namespace skyig::render::sky
