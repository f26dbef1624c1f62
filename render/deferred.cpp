#include "render/deferred.h"

#include <algorithm>
#include <cmath>

#include "render/colour.h"
#include "render/sky/staleness.h"

namespace skyig::render {

namespace {

constexpr double kDegree = glm::radians(1.0);
constexpr double kFreshElevation_rad = 0.02 * kDegree;
constexpr double kLostElevation_rad = 0.5 * kDegree;

double largest_step(const std::array<double, 2>& a, const std::array<double, 2>& b, std::size_t count) {
    double largest = 0.0;
    for (std::size_t i = 0; i < count; ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

}  // namespace

void DeferredAir::begin(const Made& wanted, const LightTables& tables) {
    back_made_ = wanted;
    back_.begin(wanted.sky, tables.air(), wanted.height_m, {wanted.elevations_rad.data(), wanted.count});
    building_ = true;
}

void DeferredAir::update(const Scene& scene, const Plan& plan, const LightTables& tables,
                         const SkyLight& light) {
    Made wanted{tables.air().share(), tables.sky(), scene.eye.height_m, {}, 0};
    source_count_ = 0;
    for (const LitAir* lit : {&light.sun, &light.moon}) {
        const bool is_sun = lit == &light.sun;
        if (lit->view == nullptr || !((is_sun ? plan.sun_share : plan.moon_share) > 0.0)) continue;
        const glm::dvec3 direction = is_sun ? scene.sun.direction_enu : scene.moon.direction_enu;
        const glm::dmat3 scale{lit->scale_xyz.x, 0.0, 0.0, 0.0, lit->scale_xyz.y, 0.0, 0.0, 0.0,
                               lit->scale_xyz.z};
        sources_[source_count_++] = {direction, kRec709FromXyz * scale * kXyzFromRec709};
        wanted.elevations_rad[wanted.count++] = horizontal_of(direction).elevation_rad;
    }
    night_cd_m2_ =
        light.night != nullptr ? glm::dvec3{light.night_share * light.night->horizon_rgb()} : glm::dvec3{0.0};

    const Made& latest = building_ ? back_made_ : front_made_;
    const double step_rad = largest_step(latest.elevations_rad, wanted.elevations_rad, wanted.count);
    const bool lost = latest.air == nullptr || latest.count != wanted.count ||
                      step_rad > kLostElevation_rad ||
                      std::abs(latest.height_m - wanted.height_m) > 200.0 + 0.2 * std::abs(latest.height_m);
    const bool stale = latest.air != wanted.air || !(latest.sky == wanted.sky) ||
                       step_rad > kFreshElevation_rad ||
                       sky::height_is_stale(wanted.height_m, latest.height_m);
    if (lost || (stale && !building_)) begin(wanted, tables);
    if (!building_ || !back_.build_rows(lost ? sky::models::AerialTable::kRows : kRowsAFrame)) return;
    std::swap(front_, back_);
    front_made_ = back_made_;
    building_ = false;
    ++revision_;
}

glm::dvec3 DeferredAir::under_air(const glm::dvec3& rgb_cd_m2, const glm::dvec3& direction_enu,
                                  double distance_m) const noexcept {
    const Horizontal view = horizontal_of(direction_enu);
    glm::dvec3 passed{1.0};
    glm::dvec3 added{0.0};
    for (std::size_t i = 0; i < std::max<std::size_t>(source_count_, 1); ++i) {
        const double azimuth_rad = view.azimuth_rad - horizontal_of(sources_[i].direction_enu).azimuth_rad;
        const auto seen = front_.between(view.elevation_rad, azimuth_rad, distance_m, i);
        passed = seen.passed_rgb;
        if (i < source_count_) added += sources_[i].rgb * seen.added_rgb;
    }
    return rgb_cd_m2 * passed + added + night_cd_m2_ * (1.0 - passed);
}

}  // namespace skyig::render
