#include "render/sky/ray_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/colour.h"
#include "render/sky/path.h"
#include "render/sky/phase.h"

namespace skyig::render::sky {
namespace {

constexpr int kSteps = 48;
constexpr double kLowestEyeM = 0.01;
constexpr double kFarthestEyeM = 1e9;

// Of everything on the path, the forward peak of the aerosol included.
Spectrum sharp_transmittance(const Medium& medium, const Path& path) {
    float molecules_m = 0.0F;
    float aerosol_m = 0.0F;
    float ozone_m = 0.0F;
    for (int k = 0; k < path.count; ++k) {
        const PathStep& step = path.steps[k];
        molecules_m += step.molecules * step.length_m;
        aerosol_m += step.aerosol * step.length_m;
        ozone_m += step.ozone * step.length_m;
    }
    Lanes lanes{};
    for (int i = 0; i < kLanes; ++i) {
        lanes.v[i] = -(medium.rayleigh.v[i] * molecules_m + medium.aerosol_extinction.v[i] * aerosol_m +
                       medium.ozone.v[i] * ozone_m);
    }
    kernels().exponential(lanes);
    Spectrum spectrum{};
    std::copy(std::begin(lanes.v), std::end(lanes.v), spectrum.begin());
    return spectrum;
}

}  // namespace

RayLight ray_light(const AirTables& tables, const RayQuery& query) noexcept {
    RayLight light;
    light.transmittance.fill(1.0F);
    light.diffuse_transmittance.fill(1.0F);
    constexpr double kHalfPi = 0.5 * std::numbers::pi;
    if (!std::isfinite(query.elevation_rad) || !std::isfinite(query.relative_azimuth_rad) ||
        !std::isfinite(query.source_elevation_rad) || std::isnan(query.distance_m)) {
        return light;
    }
    const AirData& data = tables.data();
    const double eye_m = std::isfinite(query.eye_height_m)
                             ? std::clamp(query.eye_height_m, kLowestEyeM, kFarthestEyeM)
                             : kLowestEyeM;
    const double elevation = std::clamp(query.elevation_rad, -kHalfPi, kHalfPi);
    const double source = std::clamp(query.source_elevation_rad, -kHalfPi, kHalfPi);
    const Side side = elevation < -data.shell.dip_rad(eye_m) ? Side::kGround : Side::kSky;
    const double sine = std::sin(elevation);
    const double between = sine * std::sin(source) +
                           std::cos(elevation) * std::cos(source) * std::cos(query.relative_azimuth_rad);

    std::array<PathStep, kSteps> steps;  // NOLINT: laid before it is read
    Path path{};
    path.steps = steps.data();
    lay_path(data, eye_m, sine, side, kSteps, path, std::max(query.distance_m, 0.0));
    const bool meets_ground = path.meets_ground;
    path.meets_ground = meets_ground && query.ground;
    kernels().weigh(data.medium, path);
    const Source toward{std::sin(source), std::clamp(between, -1.0, 1.0),
                        static_cast<float>(rayleigh_phase(between))};
    Lanes all{};
    Lanes haze{};
    kernels().add_first_order(data.medium, data.source_table(), path, toward, all, haze);
    if (tables.orders() == Orders::kAll)
        kernels().add_higher_orders(data.medium, data.moment_table(), path, &toward, 1, &all);
    const auto phase = static_cast<float>(cornette_shanks_phase(data.model.aerosol_g, toward.view_cosine));
    Spectrum transfer{};
    for (std::size_t i = 0; i < transfer.size(); ++i)
        transfer[i] = all.v[i] + phase * haze.v[i];
    light.xyz = xyz_of_sunlight(data.model, transfer);
    light.transmittance = sharp_transmittance(data.medium, path);
    std::copy(std::begin(path.transmittance.v), std::end(path.transmittance.v),
              light.diffuse_transmittance.begin());
    light.meets_ground = meets_ground;
    return light;
}

glm::dvec3 transmittance_rgb(const AirModel& model, const Spectrum& transmittance) noexcept {
    Spectrum whole;
    whole.fill(1.0F);
    const glm::dvec3 before = kRec709FromXyz * xyz_of_sunlight(model, whole);
    const glm::dvec3 after = kRec709FromXyz * xyz_of_sunlight(model, transmittance);
    return glm::max(after / before, glm::dvec3(0.0));
}

}  // namespace skyig::render::sky
