#include "render/sky/air_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/sky/phase.h"
#include "render/sky/quadrature.h"

namespace skyig::render::sky {
namespace {

double log_density(const DensityProfile& profile, double height_m) {
    std::size_t k = 0;
    while (k + 2 < profile.knot_count && height_m > profile.height_m[k + 1])
        ++k;
    const double part = (height_m - profile.height_m[k]) / (profile.height_m[k + 1] - profile.height_m[k]);
    return profile.log_density[k] + part * (profile.log_density[k + 1] - profile.log_density[k]);
}

double ozone_density(const AirModel& model, double height_m) {
    const double up = (height_m - model.ozone_bottom_m) / (model.ozone_peak_m - model.ozone_bottom_m);
    const double down = (model.ozone_top_m - height_m) / (model.ozone_top_m - model.ozone_peak_m);
    return std::clamp(std::min(up, down), 0.0, 1.0);
}

// Means of the Legendre polynomials over the aerosol's phase function, one degree more than is carried.
std::array<double, kDegrees + 2> legendre_moments(double g) {
    static const auto rule = gauss_legendre<64>();
    std::array<double, kDegrees + 2> moments{};
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
        const double c = rule.node[i];
        const double weight = 2.0 * std::numbers::pi * rule.weight[i] * cornette_shanks_phase(g, c);
        double previous = 0.0;
        double value = 1.0;
        for (std::size_t degree = 0; degree < moments.size(); ++degree) {
            moments[degree] += weight * value;
            const auto l = static_cast<double>(degree);
            const double next = ((2.0 * l + 1.0) * c * value - l * previous) / (l + 1.0);
            previous = value;
            value = next;
        }
    }
    return moments;
}

// Light scattered by a few degrees is as good as unscattered, except that it leaves the bright band at the
// horizon. How much of the phase function's peak beyond the carried degrees counts as unscattered (delta-M
// would take all of it): fitted to the truth tables, by the aerosol's vertical depth, from the thin haze of A
// and B to that of scenes with a visibility of 5 km.
double peak_share(const AirModel& model) {
    constexpr std::size_t kGreen = 8;
    const double depth =
        static_cast<double>(model.aerosol_extinction_per_m[kGreen]) * model.aerosol_scale_height_m;
    return 0.2 - 0.55 * std::expm1(-depth / 0.4);
}

Lanes lanes_of(const Spectrum& spectrum) {
    Lanes lanes{};
    std::copy(spectrum.begin(), spectrum.end(), lanes.v);
    return lanes;
}

}  // namespace

Densities AirData::densities(double height_m) const noexcept {
    const double position = std::clamp(height_m / shell.top_height_m, 0.0, 1.0) * kProfileCells;
    const auto cell = std::min(static_cast<std::size_t>(position), std::size_t{kProfileCells - 1});
    const auto part = static_cast<float>(position - static_cast<double>(cell));
    Densities d;
    d.molecules = std::exp(log_molecules[cell] + part * (log_molecules[cell + 1] - log_molecules[cell]));
    d.aerosol = static_cast<float>(std::exp(-height_m / model.aerosol_scale_height_m));
    d.ozone = static_cast<float>(ozone_density(model, height_m));
    return d;
}

ColumnTable AirData::source_table() const noexcept {
    const double sine = source_dip_sine.front();
    return {source_columns.data(), kColumnRows + 1, kColumnAngles, static_cast<float>(sine),
            static_cast<float>(std::sqrt((1.0 - sine) * (1.0 + sine)))};
}

double AirData::seen_row(double height_m) const noexcept {
    return std::sqrt(std::clamp(height_m / shell.top_height_m, 0.0, 1.0)) * (kColumnRows - 1);
}

double AirData::dip_sine(const std::vector<double>& sines, double height_m) const noexcept {
    const double row = seen_row(height_m);
    const auto low = std::min(static_cast<std::size_t>(row), std::size_t{kColumnRows - 2});
    return sines[low] + (row - static_cast<double>(low)) * (sines[low + 1] - sines[low]);
}

double AirData::moment_row(double height_m) const noexcept {
    return std::cbrt(std::clamp(height_m / shell.top_height_m, 0.0, 1.0)) * (kMomentRows - 1);
}

double AirData::moment_row_height_m(int row) const noexcept {
    const double part = static_cast<double>(row) / (kMomentRows - 1);
    return shell.top_height_m * part * part * part;
}

double moment_sine(int node) noexcept {
    if (node < kNightNodes) {
        const double root = 1.0 - static_cast<double>(node) / kNightNodes;
        return -static_cast<double>(kLowestSine) * root * root;
    }
    const double root = static_cast<double>(node - kNightNodes) / kDayNodes;
    return root * root;
}

void leave_mirror_out(AirData& data) noexcept {
    for (float& albedo : data.medium.albedo_over_pi.v)
        albedo -= data.model.ground_mirror_albedo * std::numbers::inv_pi_v<float>;
}

void build_medium(const AirModel& model, AirData& data) {
    data.model = model;
    data.shell = {model.ground_radius_m, model.top_height_m};
    data.medium.rayleigh = lanes_of(model.rayleigh_per_m);
    data.medium.aerosol_extinction = lanes_of(model.aerosol_extinction_per_m);
    data.medium.aerosol_scattering = lanes_of(model.aerosol_scattering_per_m);
    data.medium.ozone = lanes_of(model.ozone_peak_per_m);
    data.medium.albedo_over_pi = lanes_of(model.ground_albedo);
    for (float& albedo : data.medium.albedo_over_pi.v)
        albedo *= std::numbers::inv_pi_v<float>;
    const auto chi = legendre_moments(model.aerosol_g);
    const double peak = peak_share(model) * chi[kDegrees + 1];
    const auto passed = static_cast<float>(peak);
    data.medium.aerosol_diffuse_extinction = data.medium.aerosol_extinction;
    data.medium.aerosol_diffuse_scattering = data.medium.aerosol_scattering;
    for (int i = 0; i < kLanes; ++i) {
        data.medium.aerosol_diffuse_extinction.v[i] -= passed * data.medium.aerosol_scattering.v[i];
        data.medium.aerosol_diffuse_scattering.v[i] *= 1.0F - passed;
    }
    for (std::size_t degree = 0; degree <= kDegrees; ++degree)
        data.medium.chi[degree] = static_cast<float>((chi[degree] - peak) / (1.0 - peak));
    data.log_molecules.resize(kProfileCells + 1);
    for (std::size_t i = 0; i <= kProfileCells; ++i) {
        data.log_molecules[i] = static_cast<float>(
            log_density(model.molecules, model.top_height_m * static_cast<double>(i) / kProfileCells));
    }
}

void keep_forward_peak(AirData& data) noexcept {
    data.medium.aerosol_diffuse_extinction = data.medium.aerosol_extinction;
    data.medium.aerosol_diffuse_scattering = data.medium.aerosol_scattering;
}

}  // namespace skyig::render::sky
