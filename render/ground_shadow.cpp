#include "render/ground_shadow.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "render/cloud_shade.h"
#include "render/colour.h"
#include "render/geometry.h"
#include "render/sky_veil.h"

namespace skyig::render {

namespace {

// Shadows grow longer and fade into the mean as the source goes down.
constexpr double kLowest_rad = glm::radians(0.5);
constexpr double kHigh_rad = glm::radians(3.0);

// Of the beam: shadows that are off the mean by less do not show.
constexpr float kFaint = 0.01F;

struct Falling {
    glm::dvec3 beam_lux{0.0};  // on level ground under a clear sky
    glm::dvec3 sky_lux{0.0};
    glm::dvec3 source_enu{0.0, 0.0, 1.0};
    double share = 0.0;
};

Falling falling(const LitAir& lit, const glm::dvec3& direction_enu, const sky::AirTables& air,
                const SkyLight& light) noexcept {
    Falling from;
    if (lit.view == nullptr) return from;
    const Horizontal airless = horizontal_of(direction_enu);
    const double seen_rad = light.refraction.apparent_from_true(airless.elevation_rad);
    from.share = smooth_step(kLowest_rad, kHigh_rad, seen_rad);
    if (!(from.share > 0.0)) return from;
    from.source_enu = direction_of({seen_rad, airless.azimuth_rad});
    const glm::dvec3 scale{lit.scale_xyz};
    from.beam_lux = from.source_enu.z * (kRec709FromXyz * (scale * air.direct_sun_xyz(0.0, seen_rad)));
    from.sky_lux = kRec709FromXyz * (scale * air.ground_diffuse_xyz(airless.elevation_rad));
    return from;
}

}  // namespace

void GroundShadow::stop() noexcept {
    map_.stop();
    shown_ = false;
    begun_ = true;
}

void GroundShadow::update(cloud::CloudMaker& maker, const cloud::CloudMoment& moment,
                          const sky::AirTables& air, const SkyLight& light, bool jumped) {
    map_.reserve();
    // A first scene has its shadows; later ones come in from the mean.
    const bool at_once = !std::exchange(begun_, true) || jumped;
    const Scene& scene = moment.scene;
    const Falling sun = falling(light.sun, scene.sun.direction_enu, air, light);
    const Falling moon = falling(light.moon, scene.moon.direction_enu, air, light);
    const bool of_moon = moon.share * moon.beam_lux.y > sun.share * sun.beam_lux.y;
    const Falling& from = of_moon ? moon : sun;
    if (!(from.share * from.beam_lux.y > 0.0)) {
        stop();
        return;
    }
    const bool turned = of_moon != of_moon_;
    of_moon_ = of_moon;
    source_enu_ = from.source_enu;
    const CloudShare mean = CloudShade(scene.weather, light.ground_albedo).at(0.0, from.source_enu.z);
    const double radius_rad = of_moon ? scene.moon.angular_radius_rad : scene.sun.angular_radius_rad;
    if (turned) map_.stop();
    map_.update(maker,
                {moment, from.source_enu, 2.0 * radius_rad, static_cast<double>(mean.direct), at_once});
    ++frames_;
    height_m_ = std::max(moment.eye.height_m, 0.5);
    heights_m_ = {1e6, 0.0};
    for (const CloudLayer& cloud : scene.weather.all_clouds()) {
        if (!(cloud.coverage > 0.0)) continue;
        heights_m_.x = std::min(heights_m_.x, cloud.base_m);
        heights_m_.y = std::max(heights_m_.y, cloud.base_m + cloud.thickness_m);
    }
    const double radius_m = kEarthRadius_m + height_m_;
    const double excess_m2 = height_m_ * (2.0 * kEarthRadius_m + height_m_);
    excess_m_ = static_cast<float>(excess_m2 / radius_m);
    excess_ = static_cast<float>(excess_m2 / (radius_m * radius_m));
    radius_m_ = static_cast<float>(radius_m);
    const glm::dvec3 albedo =
        rgb_of(air.model().ground_albedo) - static_cast<double>(air.model().ground_mirror_albedo);
    sunlit_cd_m2_ = from.share / std::numbers::pi * albedo * from.beam_lux;
    const glm::dvec3 mean_lux =
        static_cast<double>(mean.beam) * from.beam_lux + static_cast<double>(mean.sky) * from.sky_lux;
    beam_over_mean_ = from.share * from.beam_lux / glm::max(mean_lux, 1e-12);
    shown_ = static_cast<float>(from.share) * map_.contrast() > kFaint;
}

bool GroundShadow::meets(const glm::vec3& direction_enu, float ray_rad, Place& place) const noexcept {
    const float inverse = 1.0F / glm::length(direction_enu);
    const float sine = direction_enu.z * inverse;
    const float met = sine * sine - excess_;
    if (!(sine < 0.0F) || !(met > 0.0F)) return false;
    place.distance_m = excess_m_ / (std::sqrt(met) - sine);
    const float scale = place.distance_m * inverse * (static_cast<float>(kEarthRadius_m) / radius_m_);
    place.at_m = scale * glm::vec2{direction_enu};
    const float reach_m = cloud::ShadowMap::kReach_m;
    const float level_m2 = glm::dot(place.at_m, place.at_m);
    if (!(level_m2 < reach_m * reach_m)) return false;
    // By how much the distance grows over half of the angle.
    const float grown_m = 0.5F * ray_rad * place.distance_m / std::sqrt(met);
    place.half_m = place.at_m * (grown_m / std::max(std::sqrt(level_m2), 1.0F));
    return true;
}

cloud::ShadowCells GroundShadow::cells(float ray_rad) const noexcept {
    cloud::ShadowCells cells = map_.as_cells();
    cells.ray_rad = ray_rad;
    cells.excess_m = excess_m_;
    cells.excess = excess_;
    cells.level_share = static_cast<float>(kEarthRadius_m) / radius_m_;
    return cells;
}

double GroundShadow::nearest_m(const cloud::Cone& cone) const noexcept {
    if (!shown_) return 0.0;
    // Straight down, or towards the edge of the cone that is nearest to that.
    const double level = std::sqrt(std::max(1.0 - cone.axis.z * cone.axis.z, 0.0));
    const bool below = -cone.axis.z > cone.cosine;
    const double sine = below ? 1.0 : std::clamp(level * cone.sine - cone.axis.z * cone.cosine, -1.0, 1.0);
    Place place;
    const glm::dvec3 steepest{std::sqrt(1.0 - sine * sine), 0.0, -sine};
    return meets(glm::vec3{steepest}, 0.0F, place) ? static_cast<double>(place.distance_m) : 0.0;
}

glm::dvec3 GroundShadow::seen_sunlit_cd_m2(const DeferredAir& air,
                                           const glm::dvec3& direction_enu) const noexcept {
    Place place;
    if (!meets(glm::vec3{direction_enu}, 0.0F, place)) return glm::dvec3{0.0};
    const auto distance_m = static_cast<double>(place.distance_m);
    return sunlit_cd_m2_ * air.between(glm::normalize(direction_enu), distance_m).passed_rgb;
}

glm::dvec3 GroundShadow::change_cd_m2(const DeferredAir& air, const glm::dvec3& direction_enu,
                                      double ray_rad) const noexcept {
    Place place;
    if (!shown_ || !meets(glm::vec3{direction_enu}, static_cast<float>(ray_rad), place))
        return glm::dvec3{0.0};
    return static_cast<double>(over_mean(place)) * seen_sunlit_cd_m2(air, direction_enu);
}

glm::dvec3 GroundShadow::on_thing(const glm::dvec3& at_m) const noexcept {
    if (!shown_) return glm::dvec3{1.0};
    const double height_m = shaders64::height_over_ground(at_m, height_m_);
    const glm::vec2 place{shaders64::shadow_place(at_m, height_m, source_enu_)};
    const double strength = shaders64::shadow_strength(height_m, heights_m_.x, heights_m_.y);
    const double change = strength * static_cast<double>(map_.at(place) - map_.mean());
    return glm::max(1.0 + beam_over_mean_ * change, 0.0);
}

bool GroundShadow::serves(const Made& made, double distance_m, int part, double still_rad) const noexcept {
    constexpr std::uint64_t kEvery = 4;
    if (!made.shaded || made.revision < map_.begun()) return false;
    const double moved_m =
        glm::distance(made.origin_m, map_.origin_m()) + std::abs(made.height_m - height_m_);
    if (moved_m > still_rad * distance_m) return false;
    return made.revision == map_.revision() || (frames_ + static_cast<std::uint64_t>(part)) % kEvery != 0;
}

}  // namespace skyig::render
