#include "render/sky_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/colour.h"
#include "render/night/natural_light.h"
#include "render/night/starlight.h"
#include "render/sky/geometry.h"

namespace skyig::render {

namespace {

glm::vec3 table_xyz(const LitAir& lit, double above_horizon_rad, double azimuth_rad, bool ground) {
    const auto elevation = static_cast<float>(lit.view->horizon_elevation_rad() + above_horizon_rad);
    const auto azimuth = static_cast<float>(azimuth_rad - lit.source.azimuth_rad);
    if (!ground) return lit.view->xyz_above(elevation, azimuth);
    glm::vec3 xyz = lit.view->xyz_below(elevation, azimuth);
    if (lit.sea != nullptr) {
        xyz += lit.sea->xyz(lit.sea->horizon_elevation_rad() + above_horizon_rad, azimuth_rad,
                            lit.source.azimuth_rad);
    }
    return xyz;
}

// Under cover the clear air before the ground is left out: what stands there instead is
// SkyLight::even_cd_m2. The sea's own light differs all round; of it as much is taken off as of endless air.
// \param passes  of the ground's light through that air
glm::vec3 source_rgb(const LitAir& lit, double above_horizon_rad, double azimuth_rad, bool ground,
                     const glm::vec3& passes) {
    if (lit.view == nullptr) return glm::vec3{0.0F};
    const glm::vec3 clear =
        rec709_from_xyz(lit.scale_xyz * table_xyz(lit, above_horizon_rad, azimuth_rad, ground));
    const glm::vec3 shared = lit.clouded.share(above_horizon_rad) * clear;
    if (!ground || !(lit.clouded.covered > 0.0F)) return shared;
    if (lit.sea == nullptr) return shared + lit.clouded.of_ground() * passes * lit.land_cd_m2;
    const glm::vec3 endless = rec709_from_xyz(lit.scale_xyz * table_xyz(lit, 0.0, azimuth_rad, false));
    return shared + lit.clouded.of_ground() * glm::max(clear - (1.0F - passes) * endless, 0.0F);
}

// Of the angle between a ray and the ground where it meets it.
double sine_from_ground(const SkyLight& light, double straight_rad) {
    const double level = std::cos(straight_rad) * (1.0 + std::max(light.eye_height_m, 0.0) / kEarthRadius_m);
    return std::sqrt(std::max(0.0, (1.0 - level) * (1.0 + level)));
}

// Waves lift what a level mirror would show of the horizon.
double lifted_mirror_rad(double up, double slope_variance) {
    return std::asin(std::min(1.0, std::hypot(up, std::sqrt(slope_variance))));
}

// Of the surface under the dark sky, where the straight ray meets it.
glm::vec3 dark_ground_cd_m2(const SkyLight& light, double straight_rad, double azimuth_rad) {
    const auto diffuse = static_cast<float>(light.ground_albedo / std::numbers::pi);
    const glm::vec3 scattered = diffuse * light.night->ground_rgb_lux();
    if (light.sea == nullptr) return scattered;
    const double up = sine_from_ground(light, straight_rad);
    const double mirrored_rad = lifted_mirror_rad(up, light.sea->variance().total());
    return scattered + static_cast<float>(light.sea->mean_reflectance(up)) *
                           light.night->sky_rgb(mirrored_rad - light.straight_horizon_rad, azimuth_rad);
}

glm::vec3 dark_sky(const SkyLight& light, double straight_rad, double azimuth_rad, bool ground) {
    if (light.night == nullptr) return glm::vec3{0.0F};
    const double above_rad = straight_rad - light.straight_horizon_rad;
    const float share = light.night_share * light.night_clouded.share(above_rad);
    return share * (ground ? light.night->before_ground(dark_ground_cd_m2(light, straight_rad, azimuth_rad),
                                                        above_rad)
                           : light.night->sky_rgb(above_rad, azimuth_rad));
}

// What the air leaves of the ground's light.
float passed_from_ground(const SkyLight& light, double elevation_rad) {
    const double away_m = std::max(light.eye_height_m, 0.0) / std::max(-std::sin(elevation_rad), 1e-4);
    return static_cast<float>(std::exp(-light.near_extinction_per_m * away_m));
}

// Of the air alike all round; the ground fades into it.
glm::vec3 flash_cd_m2(const SkyLight& light, double elevation_rad, bool ground) {
    if (!ground || light.flash == cloud::FlashLight{}) return light.flash.sky_cd_m2;
    const float passed = passed_from_ground(light, elevation_rad);
    const auto diffuse = static_cast<float>(light.ground_albedo / std::numbers::pi);
    return passed * diffuse * light.flash.ground_lux + (1.0F - passed) * light.flash.sky_cd_m2;
}

// Of the sky, in water over ground that is not level everywhere.
glm::vec3 film_cd_m2(const SkyLight& light, double elevation_rad, double azimuth_rad) {
    const double up = sine_from_ground(light, light.straight_elevation_rad(elevation_rad));
    const double mirrored_rad = lifted_mirror_rad(up, shaders64::film_slope_variance());
    return static_cast<float>(light.film * shaders64::film_reflectance(up)) *
           passed_from_ground(light, elevation_rad) *
           light.covered_rgb_cd_m2(mirrored_rad, azimuth_rad, Side::kSky);
}

}  // namespace

LitBelt lit_belt(const Scene& scene, const night::MilkyWayMap& map, double night_share) noexcept {
    return {&map, night::galactic_from_gcrs() * glm::transpose(scene.stars.enu_from_gcrs),
            static_cast<float>(night_share * night::starlight_share(scene.night))};
}

float CloudedAir::near_part(double above_horizon_rad) noexcept {
    constexpr double kFade_rad = 0.05;
    return static_cast<float>(std::exp(-std::abs(above_horizon_rad) / kFade_rad));
}

float CloudedAir::share(double above_horizon_rad) const noexcept {
    if (at_eye == 1.0F && at_ground == 1.0F) return 1.0F;
    const float far = above_horizon_rad >= 0.0 ? 1.0F : (1.0F - covered) * at_ground;
    return far + near_part(above_horizon_rad) * (at_eye - far);
}

double SkyLight::straight_elevation_rad(double elevation_rad) const noexcept {
    return render::straight_elevation_rad(elevation_rad, horizon_elevation_rad, straight_horizon_rad);
}

glm::vec3 SkyLight::smooth_rgb_cd_m2(double elevation_rad, double azimuth_rad, Side side) const noexcept {
    const double straight_rad = straight_elevation_rad(elevation_rad);
    const bool ground =
        side == Side::kGround || (side == Side::kByElevation && elevation_rad < horizon_elevation_rad);
    const glm::vec3 clear = clear_rgb_cd_m2(straight_rad, elevation_rad, azimuth_rad, ground);
    return veil != nullptr ? veiled(clear, straight_rad, azimuth_rad, ground) : clear;
}

glm::vec3 SkyLight::covered_rgb_cd_m2(double elevation_rad, double azimuth_rad, Side side) const noexcept {
    const double straight_rad = straight_elevation_rad(elevation_rad);
    const bool ground =
        side == Side::kGround || (side == Side::kByElevation && elevation_rad < horizon_elevation_rad);
    const glm::vec3 clear = clear_rgb_cd_m2(straight_rad, elevation_rad, azimuth_rad, ground);
    const glm::vec3 behind = ground ? clear : overhead * clear;
    return veil != nullptr ? veiled(behind, straight_rad, azimuth_rad, ground) : behind;
}

glm::vec3 SkyLight::clear_rgb_cd_m2(double straight_rad, double elevation_rad, double azimuth_rad,
                                    bool ground) const noexcept {
    const double above_rad = straight_rad - straight_horizon_rad;
    const bool under = even_cd_m2 != glm::vec3{0.0F};
    const glm::vec3 passes = under && ground
                                 ? glm::vec3{shaders64::veil_air_passes(-std::max(eye_height_m, 0.0),
                                                                        end_m(straight_rad, true), front_air)}
                                 : glm::vec3{1.0F};
    const glm::vec3 of_air = ground ? 1.0F - passes : glm::vec3{CloudedAir::near_part(above_rad)};
    const glm::vec3 rgb = source_rgb(sun, above_rad, azimuth_rad, ground, passes) +
                          source_rgb(moon, above_rad, azimuth_rad, ground, passes) + of_air * even_cd_m2 +
                          dark_sky(*this, straight_rad, azimuth_rad, ground) +
                          flash_cd_m2(*this, elevation_rad, ground);
    return ground && film > 0.0 ? rgb + film_cd_m2(*this, elevation_rad, azimuth_rad) : rgb;
}

// Of the straight ray: the ground's, or past all veils.
double SkyLight::end_m(double straight_rad, bool ground) const noexcept {
    if (!ground) return fog::Veil::kEndless_m;
    constexpr sky::Shell kEarth{kEarthRadius_m, 0.0};
    return kEarth.distance_to_ground_m(std::max(eye_height_m, 0.0),
                                       std::sin(std::min(straight_rad, straight_horizon_rad)));
}

shaders64::VeilSum SkyLight::veil_sum(double straight_rad, double azimuth_rad, bool ground) const noexcept {
    // From one side of the horizon only, as the tables are asked.
    const double own_rad =
        ground ? std::min(straight_rad, straight_horizon_rad) : std::max(straight_rad, straight_horizon_rad);
    return veil->sum(direction_of({own_rad, azimuth_rad}), end_m(straight_rad, ground));
}

// Behind the veil the ground lies in what light it leaves. Before a veil far away lies clear air: of the
// sky's own light in that direction as much as there is of all its air, before the ground as at the horizon.
glm::vec3 SkyLight::veiled(const glm::vec3& clear_cd_m2, double straight_rad, double azimuth_rad,
                           bool ground) const noexcept {
    constexpr double kSeenThrough = 1e-3;
    const shaders64::VeilSum sum = veil_sum(straight_rad, azimuth_rad, ground);
    const double sine = std::sin(straight_rad);
    glm::dvec3 behind{clear_cd_m2};
    if (ground) {
        const glm::dvec3 shown =
            shaders64::veil_air_passes(-std::max(eye_height_m, 0.0), end_m(straight_rad, true), front_air);
        behind *= 1.0 + shown * (veil->ground_share() - 1.0);
    }
    const glm::dvec3 passes = shaders64::veil_air_passes_before(sum, {sine, veil->eye_radius_m()}, front_air);
    glm::dvec3 endless{clear_cd_m2};
    if (!ground) {
        // A ray that goes down first meets all of it.
        const double down = std::clamp(-sine / 0.02, 0.0, 1.0);
        endless /=
            glm::max(1.0 - shaders64::veil_all_air_passes(sine, front_air), glm::dvec3{std::max(down, 1e-6)});
    } else if ((1.0 - passes.z) * shaders64::veil_lost(sum.cut_depth) > kSeenThrough) {
        endless =
            glm::dvec3{clear_rgb_cd_m2(straight_horizon_rad, horizon_elevation_rad, azimuth_rad, false)};
    }
    return glm::vec3{shaders64::veil_in_air(sum, passes, endless, behind)};
}

double SkyLight::veil_passes(double straight_rad) const noexcept {
    return veil != nullptr ? veil->passed(std::sin(std::max(straight_rad, straight_horizon_rad))) : 1.0;
}

glm::vec3 SkyLight::rgb_cd_m2(double elevation_rad, double azimuth_rad, Side side) const noexcept {
    const glm::vec3 smooth = smooth_rgb_cd_m2(elevation_rad, azimuth_rad, side);
    if (milky_way.map == nullptr || side == Side::kGround) return smooth;
    const double shown = belt_above_horizon(elevation_rad);
    if (!(shown > 0.0)) return smooth;
    const double belt_cd_m2 = milky_way.map->luminance_cd_m2(milky_way.galactic_from_enu *
                                                             direction_of({elevation_rad, azimuth_rad}));
    return smooth + static_cast<float>(shown * belt_cd_m2) * belt_passes(elevation_rad);
}

glm::vec3 SkyLight::belt_passes(double elevation_rad) const noexcept {
    if (night == nullptr) return glm::vec3{0.0F};
    const double above_rad = straight_elevation_rad(elevation_rad) - straight_horizon_rad;
    const glm::vec3 clear =
        milky_way.share * night->transmittance(above_rad) * glm::vec3{night::natural_colours().starlight};
    if (veil == nullptr) return clear;
    return static_cast<float>(std::exp(-veil_sum(above_rad + straight_horizon_rad, 0.0, false).cut_depth)) *
           clear;
}

double SkyLight::belt_above_horizon(double elevation_rad) const noexcept {
    return std::clamp((std::sin(elevation_rad) - std::sin(horizon_elevation_rad)) / kBeltEdge, 0.0, 1.0);
}

const LitAir& SkyLight::glittering() const noexcept {
    // Moonlight fades in below this.
    constexpr double kNight_rad = -0.052;
    return sun.view != nullptr && (moon.view == nullptr || sun.source.elevation_rad > kNight_rad) ? sun
                                                                                                  : moon;
}

SlopeLight SkyLight::of_slopes(double elevation_rad, double azimuth_rad) const noexcept {
    const double above_rad = straight_elevation_rad(elevation_rad) - straight_horizon_rad;
    SlopeLight sum;
    for (const LitAir* lit : {&sun, &moon}) {
        if (lit->view == nullptr || lit->sea == nullptr) continue;
        const auto slopes = lit->sea->of_slopes(lit->sea->horizon_elevation_rad() + above_rad, azimuth_rad,
                                                lit->source.azimuth_rad);
        const float share = lit->clouded.share(above_rad) + lit->clouded.of_ground();
        sum.east += rec709_from_xyz(share * lit->scale_xyz * slopes.east_xyz);
        sum.north += rec709_from_xyz(share * lit->scale_xyz * slopes.north_xyz);
        sum.bend_cd_m2 += share * lit->scale_xyz.y * slopes.bend;
        if (lit != &glittering()) continue;
        sum.glitter = rec709_from_xyz(std::min(lit->beam_share, share) * lit->scale_xyz * slopes.glitter_xyz);
        sum.density = slopes.density;
    }
    if (veil != nullptr) {
        const auto passed = static_cast<float>(
            std::exp(-veil_sum(above_rad + straight_horizon_rad, azimuth_rad, true).cut_depth));
        for (glm::vec3* part : {&sum.east, &sum.north, &sum.bend_cd_m2, &sum.glitter})
            *part *= passed;
    }
    return sum;
}

}  // namespace skyig::render
