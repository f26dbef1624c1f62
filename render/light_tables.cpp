#include "render/light_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "render/night/moon_light.h"

namespace skyig::render {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// Beyond these steps the picture in use is wrong rather than late.
bool is_jump(const sky::SkyView& view, double elevation_rad, double height_m) {
    return std::abs(view.source_elevation_rad() - elevation_rad) > 0.5 * kDegree ||
           std::abs(view.eye_height_m() - height_m) > 200.0 + 0.2 * std::abs(view.eye_height_m());
}

double sunlight_lux(const sky::AirModel& model) {
    double sum = 0.0;
    for (const float part : model.sunlight_xyz_lux[1])
        sum += static_cast<double>(part);
    return sum;
}

// Moonlit air fades in while the Sun sinks from 3 to 6 degrees: before, it is less than a display code.
double moon_weight(double sun_elevation_rad) {
    const double t = std::clamp((-sun_elevation_rad / kDegree - 3.0) / 3.0, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

sky::AirTables make_air(Air air) {
    return sky::AirTables(sky::air_model(air));
}

}  // namespace

LightTables::LightTables() = default;

LightTables::~LightTables() {
    if (next_air_.valid()) next_air_.wait();
}

Held LightTables::held() const noexcept {
    Held held;
    held.air_valid = air_.has_value();
    held.air = air_state_;
    held.sun_sky_valid = sun_.front_air != 0 && sun_.front_air == air_revision_;
    held.moon_sky_valid = moon_.front_air != 0 && moon_.front_air == air_revision_;
    if (sun_.front_air != 0) {
        held.sun_sky_elevation_rad = sun_.front.source_elevation_rad();
        held.sun_sky_height_m = sun_.front.eye_height_m();
    }
    if (moon_.front_air != 0) {
        held.moon_sky_elevation_rad = moon_.front.source_elevation_rad();
        held.moon_sky_height_m = moon_.front.eye_height_m();
    }
    return held;
}

void LightTables::update_air(const Scene& scene, const Plan& plan) {
    if (!air_) {
        air_ = make_air(scene.air);
        air_state_ = scene.air;
        ++air_revision_;
        return;
    }
    if (next_air_.valid()) {
        if (++next_air_age_ < kAirLatencyFrames) return;
        air_ = next_air_.get();
        air_state_ = next_air_state_;
        ++air_revision_;
        return;
    }
    if (!plan.needs(Pass::kAirTables)) return;
    next_air_state_ = scene.air;
    next_air_age_ = 0;
    next_air_ = std::async(std::launch::async, make_air, scene.air);
}

void LightTables::update_view(View& view, bool needed, double elevation_rad, double height_m) {
    const auto take_over = [&] {
        std::swap(view.front, view.back);
        view.front_air = view.back_air;
        view.building = false;
        ++revision_;
    };
    const bool lost =
        view.front_air == 0 || is_jump(view.building ? view.back : view.front, elevation_rad, height_m);
    if (needed && lost) {
        view.back.begin(*air_, height_m, elevation_rad);
        view.back_air = air_revision_;
        view.back.build_all();
        take_over();
        return;
    }
    if (!view.building && needed) {
        view.back.begin(*air_, height_m, elevation_rad);
        view.back_air = air_revision_;
        view.building = true;
    }
    if (view.building && view.back.build_rows(kRowsAFrame)) take_over();
}

void LightTables::update(const Scene& scene, const Plan& plan) {
    update_air(scene, plan);
    const double sun_rad = horizontal_of(scene.sun.direction_enu).elevation_rad;
    const double moon_rad = horizontal_of(scene.moon.direction_enu).elevation_rad;
    update_view(sun_, plan.needs(Pass::kSunSky), sun_rad, scene.eye.height_m);
    update_view(moon_, plan.needs(Pass::kMoonSky), moon_rad, scene.eye.height_m);
}

SkyLight LightTables::light(const Scene& scene, const Plan& plan) const noexcept {
    SkyLight light;
    light.eye_height_m = scene.eye.height_m;
    const Horizontal sun = horizontal_of(scene.sun.direction_enu);
    const double radius_m = air_->model().ground_radius_m;
    const double h = std::max(scene.eye.height_m, 0.0);
    light.horizon_elevation_rad = -std::atan2(std::sqrt(h * (2.0 * radius_m + h)), radius_m);
    if (plan.moon_lights_air && moon_.front_air != 0) {
        const double share = night::moon_illuminance_lux(scene.moon.phase_angle_rad, scene.moon.distance_km) /
                             sunlight_lux(air_->model()) * moon_weight(sun.elevation_rad);
        const glm::dvec3 tint = night::moon_tint_rgb();
        light.moon = {&moon_.front, horizontal_of(scene.moon.direction_enu).azimuth_rad,
                      glm::vec3{glm::dvec3{0.5 * (tint.x + tint.y), 1.0, tint.z} * share}};
        light.horizon_elevation_rad = moon_.front.horizon_elevation_rad();
    }
    if (plan.sun_lights_air && sun_.front_air != 0) {
        const double share = scene.sun.unobscured / (scene.sun.distance_au * scene.sun.distance_au);
        light.sun = {&sun_.front, sun.azimuth_rad, glm::vec3{static_cast<float>(share)}};
        light.horizon_elevation_rad = sun_.front.horizon_elevation_rad();
    }
    return light;
}

}  // namespace skyig::render
