#include "render/light_on_clouds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/colour.h"
#include "render/geometry.h"
#include "render/night/light_dome.h"

namespace skyig::render {

namespace {

using cloud::CloudLight;

constexpr double kPi = std::numbers::pi;
// Even light passes a layer of air as a beam of this many times its depth does (Elsasser's diffusivity).
constexpr double kDiffusivity = 1.66;

double height_m(std::size_t i) noexcept {
    return CloudLight::kLowest_m + static_cast<double>(i) * CloudLight::kStep_m;
}

// Of the air, by height: what does not change with the sources.
struct Column {
    /// Part of the air's vertical depth, by colour, that lies above, and even light from the ground that
    /// comes so high.
    std::array<glm::dvec3, CloudLight::kHeights> above{};
    std::array<glm::dvec3, CloudLight::kHeights> from_ground{};
};

Column column_of(const sky::AirTables& air) noexcept {
    const auto depth = [&](double at_m) {
        return -glm::log(glm::max(air.transmittance_rgb(at_m, 0.5 * kPi), glm::dvec3{1e-12}));
    };
    Column column;
    const glm::dvec3 whole = glm::max(depth(0.0), glm::dvec3{1e-9});
    for (std::size_t i = 0; i < CloudLight::kHeights; ++i) {
        const glm::dvec3 above = depth(height_m(i));
        column.above[i] = above / whole;
        column.from_ground[i] = glm::exp(-kDiffusivity * glm::max(whole - above, 0.0));
    }
    return column;
}

/// Even light as luminance, from the sky over level ground.
void add_even(const Column& column, const glm::dvec3& sky_cd_m2, const glm::dvec3& ground_cd_m2,
              CloudLight& light) noexcept {
    for (std::size_t i = 0; i < CloudLight::kHeights; ++i) {
        const glm::dvec3& passed = column.from_ground[i];
        light.above_cd_m2[i] += glm::vec3{sky_cd_m2 * column.above[i]};
        light.below_cd_m2[i] += glm::vec3{ground_cd_m2 * passed + sky_cd_m2 * (1.0 - passed)};
    }
}

void add_source(CloudLight::Source source, const LitAir& lit, const glm::dvec3& direction_enu,
                const sky::AirTables& air, const SkyLight& sky, const Column& column,
                CloudLight& light) noexcept {
    cloud::Beam& beam = light.beams[source];
    beam = {lit.view != nullptr, glm::vec3{direction_enu}};
    light.beam_lx[source].fill(glm::vec3{0.0F});
    if (!beam.lit) return;
    const glm::dvec3 scale_xyz{lit.scale_xyz};
    const double elevation_rad = horizontal_of(direction_enu).elevation_rad;
    const double seen_rad = sky.refraction.apparent_from_true(elevation_rad);
    for (std::size_t i = 0; i < CloudLight::kHeights; ++i) {
        light.beam_lx[source][i] =
            glm::max(rec709_from_xyz(glm::vec3{scale_xyz * air.direct_sun_xyz(height_m(i), seen_rad)}), 0.0F);
    }
    const glm::dvec3 sky_lux =
        glm::max(kRec709FromXyz * (scale_xyz * air.ground_diffuse_xyz(elevation_rad)), 0.0);
    const glm::dvec3 ground_lux =
        sky_lux + std::max(std::sin(seen_rad), 0.0) * glm::dvec3{light.beam_lx[source][0]};
    add_even(column, sky_lux / kPi, sky.ground_albedo / kPi * ground_lux, light);
}

// Garstang's lights (night/light_dome.h) on a plane that faces down over them, less by the air between.
void add_towns(const Scene& scene, const sky::AirTables& air, const Column& column, double share,
               CloudLight& light) noexcept {
    constexpr double kDegree = kPi / 180.0;
    constexpr std::size_t kGreen = 8;  // 558 nm
    const night::TownAir town_air{static_cast<double>(air.model().rayleigh_per_m[kGreen]),
                                  static_cast<double>(air.model().aerosol_extinction_per_m[kGreen])};
    for (const City& city : scene.night.all_cities()) {
        const double north_m = (city.latitude_deg - scene.eye.latitude_deg) * kDegree * kEarthRadius_m;
        const double east_rad = std::remainder(city.longitude_deg - scene.eye.longitude_deg, 360.0) * kDegree;
        const double east_m = east_rad * std::cos(scene.eye.latitude_deg * kDegree) * kEarthRadius_m;
        const double away_m2 = north_m * north_m + east_m * east_m;
        // Beyond this even its steepest light is below the horizon of any cloud.
        if (away_m2 > 3e5 * 3e5) continue;
        const double lumen = share * night::town_lumen(city, town_air);
        for (std::size_t i = 0; i < CloudLight::kHeights; ++i) {
            // From no nearer than its lights lie spread.
            const double up_m2 = height_m(i) * height_m(i) + 0.5 * city.radius_m * city.radius_m;
            const double far_m2 = up_m2 + away_m2;
            const double mu = std::sqrt(up_m2 / far_m2);
            const double zenith = std::acos(mu);
            const double candela =
                lumen / (2.0 * kPi) * (2.0 * 0.15 * 0.85 * mu + 0.554 * 0.15 * std::pow(zenith, 4.0));
            const double cd_m2 = candela * mu / far_m2 / kPi;
            light.below_cd_m2[i] += glm::vec3{cd_m2 * column.from_ground[i]};
        }
    }
}

}  // namespace

void light_clouds(const Scene& scene, const Plan& plan, const LightTables& tables, const SkyLight& sky,
                  CloudLight& on_clouds) noexcept {
    const sky::AirTables& air = tables.air();
    const Column column = column_of(air);
    on_clouds.above_cd_m2.fill(glm::vec3{0.0F});
    on_clouds.below_cd_m2.fill(glm::vec3{0.0F});
    add_source(CloudLight::kSun, sky.sun, scene.sun.direction_enu, air, sky, column, on_clouds);
    add_source(CloudLight::kMoon, sky.moon, scene.moon.direction_enu, air, sky, column, on_clouds);
    if (sky.night == nullptr) return;
    // The dark sky shines through the air from beyond it, so it is no less high up.
    const glm::vec3 night_cd_m2 = sky.night_share / static_cast<float>(kPi) * sky.night->ground_rgb_lux();
    for (glm::vec3& above : on_clouds.above_cd_m2)
        above += night_cd_m2;
    for (glm::vec3& below : on_clouds.below_cd_m2)
        below += static_cast<float>(sky.ground_albedo) * night_cd_m2;
    add_towns(scene, air, column, plan.night_share, on_clouds);
}

}  // namespace skyig::render
