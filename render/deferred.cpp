#include "render/deferred.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/colour.h"
#include "render/sky/staleness.h"

namespace skyig::render {

namespace {

constexpr double kDegree = glm::radians(1.0);
constexpr double kFreshElevation_rad = 0.02 * kDegree;
constexpr double kLostElevation_rad = 0.5 * kDegree;

using Body = DeferredAir::Body;
constexpr std::array kBodies{Body::kSun, Body::kMoon};

const LitAir& air_of(Body body, const SkyLight& light) noexcept {
    return body == Body::kSun ? light.sun : light.moon;
}

const glm::dvec3& direction_of(Body body, const Scene& scene) noexcept {
    return body == Body::kSun ? scene.sun.direction_enu : scene.moon.direction_enu;
}

bool shines(Body body, const Plan& plan, const SkyLight& light) noexcept {
    return air_of(body, light).view != nullptr &&
           (body == Body::kSun ? plan.sun_share : plan.moon_share) > 0.0;
}

}  // namespace

bool DeferredAir::same_bodies(const Made& a, const Made& b) noexcept {
    return std::equal(a.lights.begin(), a.lights.begin() + a.count, b.lights.begin(),
                      b.lights.begin() + b.count,
                      [](const Light& x, const Light& y) { return x.body == y.body; });
}

// Of the lights that both have.
double DeferredAir::largest_step_rad(const Made& a, const Made& b) noexcept {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.count; ++i) {
        for (std::size_t k = 0; k < b.count; ++k) {
            if (a.lights[i].body == b.lights[k].body)
                largest = std::max(largest, std::abs(a.lights[i].elevation_rad - b.lights[k].elevation_rad));
        }
    }
    return largest;
}

void DeferredAir::begin(const Made& wanted, const LightTables& tables) {
    back_made_ = wanted;
    std::array<double, sky::models::AerialTable::kMaxLights> elevations_rad{};
    for (std::size_t i = 0; i < wanted.count; ++i)
        elevations_rad[i] = wanted.lights[i].elevation_rad;
    back_.begin(wanted.sky, tables.air(), wanted.height_m, {elevations_rad.data(), wanted.count});
    building_ = true;
}

void DeferredAir::update(const Scene& scene, const Plan& plan, const LightTables& tables,
                         const SkyLight& light) {
    Made wanted{tables.air().share(), tables.sky(), scene.eye.height_m, {}, 0};
    for (const Body body : kBodies) {
        if (!shines(body, plan, light)) continue;
        wanted.lights[wanted.count++] = {body, horizontal_of(direction_of(body, scene)).elevation_rad};
    }
    even_cd_m2_ = glm::dvec3{light.even_cd_m2};
    if (light.night != nullptr) even_cd_m2_ += glm::dvec3{light.night_share * light.night->horizon_rgb()};

    const Made& latest = building_ ? back_made_ : front_made_;
    const double step_rad = largest_step_rad(latest, wanted);
    const bool lost = latest.air == nullptr || tables.jumped() || step_rad > kLostElevation_rad ||
                      std::abs(latest.height_m - wanted.height_m) > 200.0 + 0.2 * std::abs(latest.height_m);
    const bool stale = latest.air != wanted.air || !(latest.sky == wanted.sky) ||
                       !same_bodies(latest, wanted) || step_rad > kFreshElevation_rad ||
                       sky::height_is_stale(wanted.height_m, latest.height_m);
    if (lost || (stale && !building_)) begin(wanted, tables);
    if (building_ && back_.build_rows(lost ? sky::models::AerialTable::kRows : kRowsAFrame)) {
        std::swap(front_, back_);
        front_made_ = back_made_;
        building_ = false;
        ++revision_;
    }
    tell_sources(scene, plan, light);
    tell_veil(light);
}

// The lights of the table in use: one that has gone out adds nothing, one that has just come is not in it
// yet, and fades in from nothing anyway.
void DeferredAir::tell_sources(const Scene& scene, const Plan& plan, const SkyLight& light) noexcept {
    source_count_ = front_made_.count;
    for (std::size_t i = 0; i < source_count_; ++i) {
        const Body body = front_made_.lights[i].body;
        const LitAir& lit = air_of(body, light);
        const glm::dvec3 scale_xyz{shines(body, plan, light) ? lit.clouded.at_eye * lit.scale_xyz
                                                             : glm::vec3{0.0F}};
        const glm::dmat3 scale{scale_xyz.x, 0.0, 0.0, 0.0, scale_xyz.y, 0.0, 0.0, 0.0, scale_xyz.z};
        sources_[i] = {direction_of(body, scene), kRec709FromXyz * scale * kXyzFromRec709};
    }
}

void DeferredAir::tell_veil(const SkyLight& light) noexcept {
    veil_ = light.veil;
    if (veil_ == nullptr) return;
    front_air_ = light.front_air;
    const fog::VeilSources& sources = veil_->sources();
    glm::dvec3 level = sources.above_cd_m2;
    for (const fog::VeilSources::Beam& beam : sources.beams)
        level += beam.lux * (std::max(beam.direction_enu.z, 0.0) / std::numbers::pi);
    beyond_veil_cd_m2_ = {sources.above_cd_m2, sources.ground_albedo * level * veil_->ground_share()};
}

// Of air that does not end, towards there.
glm::dvec3 DeferredAir::endless_cd_m2(const Horizontal& view) const noexcept {
    constexpr double kEndless_m = 1e8;
    glm::dvec3 sum = even_cd_m2_;
    for (std::size_t i = 0; i < source_count_; ++i) {
        const double azimuth_rad = view.azimuth_rad - horizontal_of(sources_[i].direction_enu).azimuth_rad;
        const auto seen = front_.between(view.elevation_rad, azimuth_rad, kEndless_m, i);
        sum += sources_[i].rgb * (seen.added_rgb / glm::max(1.0 - seen.passed_rgb, glm::dvec3{1e-12}));
    }
    return sum;
}

sky::models::AirBetween DeferredAir::clear_between(const glm::dvec3& direction_enu,
                                                   double distance_m) const noexcept {
    const Horizontal view = horizontal_of(direction_enu);
    sky::models::AirBetween all;
    for (std::size_t i = 0; i < std::max<std::size_t>(source_count_, 1); ++i) {
        const double azimuth_rad = view.azimuth_rad - horizontal_of(sources_[i].direction_enu).azimuth_rad;
        const auto seen = front_.between(view.elevation_rad, azimuth_rad, distance_m, i);
        all.passed_rgb = seen.passed_rgb;
        if (i < source_count_) all.added_rgb += sources_[i].rgb * seen.added_rgb;
    }
    all.added_rgb += even_cd_m2_ * (1.0 - all.passed_rgb);
    return all;
}

fog::Veil::Both DeferredAir::veil_along(const glm::dvec3& ray_enu, double distance_m) const noexcept {
    const shaders64::VeilRay ray{ray_enu.z, veil_->eye_radius_m()};
    const auto ground_m = shaders64::veil_below_m(veil_->segments().front().low_m, ray);
    const bool meets = ray_enu.z < 0.0 && ground_m.y > ground_m.x;
    return veil_->along(ray_enu, distance_m, meets ? ground_m.x : fog::Veil::kEndless_m);
}

glm::dvec3 DeferredAir::veil_in_air(const shaders64::VeilSum& sum, const glm::dvec3& ray_enu,
                                    const glm::dvec3& endless_cd_m2,
                                    const glm::dvec3& behind_cd_m2) const noexcept {
    const glm::dvec3 passes =
        shaders64::veil_air_passes_before(sum, {ray_enu.z, veil_->eye_radius_m()}, front_air_);
    return shaders64::veil_in_air(sum, passes, endless_cd_m2, behind_cd_m2);
}

sky::models::AirBetween DeferredAir::between(const glm::dvec3& direction_enu,
                                             double distance_m) const noexcept {
    const sky::models::AirBetween air = clear_between(direction_enu, distance_m);
    if (veil_ == nullptr || !(distance_m > 0.0)) return air;
    const Horizontal view = horizontal_of(direction_enu);
    const shaders64::VeilSum near = veil_along(direction_enu, distance_m).near;
    return {air.passed_rgb * std::exp(-near.cut_depth),
            veil_in_air(near, direction_enu, endless_cd_m2(view), air.added_rgb)};
}

glm::dvec3 DeferredAir::under_air(const glm::dvec3& rgb_cd_m2, const glm::dvec3& direction_enu,
                                  double distance_m) const noexcept {
    const sky::models::AirBetween air = clear_between(direction_enu, distance_m);
    if (veil_ == nullptr || !(distance_m > 0.0)) return rgb_cd_m2 * air.passed_rgb + air.added_rgb;
    const glm::dvec3 endless = endless_cd_m2(horizontal_of(direction_enu));
    const fog::Veil::Both sums = veil_along(direction_enu, distance_m);
    const glm::dvec3 before =
        veil_in_air(sums.near, direction_enu, endless,
                    shaders64::veil_own_air(air.added_rgb, air.passed_rgb, endless, sums.near));
    const glm::dvec3 without =
        veil_in_air(sums.whole, direction_enu, endless, beyond_veil_cd_m2_[direction_enu.z < 0.0 ? 1 : 0]);
    return rgb_cd_m2 * air.passed_rgb * std::exp(-sums.near.depth) +
           shaders64::veil_before(before, without, sums.near);
}

}  // namespace skyig::render
