#include "render/light_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "render/colour.h"
#include "render/night/moon_light.h"
#include "render/sky/staleness.h"
#include "render/sky_veil.h"

namespace skyig::render {

namespace {

constexpr double kDegree = glm::radians(1.0);

// In the Moon's shadow the sky is lit from beyond it: of a full day's light a few ten-thousandths at
// mid-totality (Sharp, Silverman and Lloyd 1971 measured 1e-4 to 1e-3).
constexpr double kFromBeyondShadow = 2e-4;

// What the Earth's air bends into its shadow, of the full Moon's light: the mean over the umbra of
// shaders::sun_in_shadow().
constexpr double kFromUmbra = 4e-5;

// Slopes that differ by less are drawn alike.
bool alike(const sky::SlopeVariance& a, const sky::SlopeVariance& b) {
    constexpr double kStep = 0.01;
    const double least = kStep * std::min(a.total(), b.total());
    return std::abs(a.east_east - b.east_east) < least && std::abs(a.north_north - b.north_north) < least &&
           std::abs(a.east_north - b.east_north) < least;
}

double sunlight_lux(const sky::AirModel& model) {
    double sum = 0.0;
    for (const float part : model.sunlight_xyz_lux[1])
        sum += static_cast<double>(part);
    return sum;
}

// Beyond these steps between frames the clock was set, or the eye was carried to another place.
constexpr double kJump_rad = 0.5 * kDegree;

bool is_jump(const glm::dvec3& a, const glm::dvec3& b) noexcept {
    return glm::dot(a, b) < 0.0 || glm::length(glm::cross(a, b)) > kJump_rad;
}

bool is_height_jump(double from_m, double to_m) noexcept {
    return std::abs(from_m - to_m) > 200.0 + 0.2 * std::abs(from_m);
}

// Straight down the air adds little, and about what endless air does.
glm::vec3 land_cd_m2(const SkyLight& light, const LitAir& lit) noexcept {
    constexpr float kDown_rad = static_cast<float>(-0.5 * std::numbers::pi);
    const double height_m = std::max(light.eye_height_m, 0.0);
    const glm::vec3 passes{shaders64::veil_air_passes(-height_m, height_m, light.front_air)};
    const auto horizon_rad = static_cast<float>(lit.view->horizon_elevation_rad());
    const glm::vec3 endless = rec709_from_xyz(lit.scale_xyz * lit.view->xyz_above(horizon_rad, 0.0F));
    const glm::vec3 seen = rec709_from_xyz(lit.scale_xyz * lit.view->xyz_below(kDown_rad, 0.0F));
    return glm::max(seen - (1.0F - passes) * endless, 0.0F) / glm::max(passes, 1e-6F);
}

}  // namespace

glm::vec3 moon_scale_xyz(const Scene& scene, const sky::AirModel& model, double share) noexcept {
    const double sunlit = std::max(scene.moon.sunlit, kFromUmbra);
    const double lux = sunlit * night::moon_illuminance_lux(scene.moon, scene.sun.distance_au);
    return glm::vec3{night::moon_tint_xyz() * (share * lux / sunlight_lux(model))};
}

LightTables::LightTables(const sky::SkyViewSize& size) : sun_(size), moon_(size) {}

sky::RefractionRow LightTables::refraction(const Scene& scene) const noexcept {
    const double pressure_hpa = scene.air.model_enabled ? scene.air.pressure_hpa : 0.0;
    return refraction_.at(scene.eye.height_m, pressure_hpa, scene.air.temperature_c);
}

Held LightTables::held(const Scene& scene) const noexcept {
    Held held;
    held.air_valid = air_.has_value();
    // Compared as the model sees it: temperature, or a visibility beyond its range, makes no new air.
    held.air_fresh = air_.has_value() && air_->orders() == sky::models::orders_of(scene.sky.model) &&
                     air_->model() == sky::air_model(scene.air, scene.ground);
    const SkySettings wanted = fitting(scene.sky);
    held.sun_sky_valid = sun_.front_made.air != 0 && sun_.front_made.air == air_revision_;
    held.moon_sky_valid = moon_.front_made.air != 0 && moon_.front_made.air == air_revision_;
    held.sun_sky_model = sun_.front_made.sky == wanted && same_sea(sun_.front_made, scene);
    held.moon_sky_model = moon_.front_made.sky == wanted && same_sea(moon_.front_made, scene);
    held.sun_sky_elevation_rad = sun_.front_made.elevation_rad;
    held.sun_sky_height_m = sun_.front_made.height_m;
    held.moon_sky_elevation_rad = moon_.front_made.elevation_rad;
    held.moon_sky_height_m = moon_.front_made.height_m;
    return held;
}

SkySettings LightTables::fitting(const SkySettings& asked) const noexcept {
    return air_ && air_->orders() != sky::models::orders_of(asked.model) ? sky_ : asked;
}

void LightTables::update_air(const Scene& scene, const Plan& plan) {
    ++air_rests_;
    if (!air_) {
        air_.emplace(sky::air_model(scene.air, scene.ground), sky::models::orders_of(scene.sky.model));
        ++air_revision_;
        return;
    }
    if (next_air_age_) {
        if (++*next_air_age_ < kAirLatencyFrames) return;
        next_air_age_.reset();
        if (auto tables = builder_.take()) {
            air_ = std::move(tables);
            ++air_revision_;
            ++revision_;
        }
        return;
    }
    if (!plan.needs(Pass::kAirTables)) {
        last_wanted_.reset();
        return;
    }
    const sky::AirModel wanted = sky::air_model(scene.air, scene.ground);
    const bool settled = last_wanted_ == wanted;
    last_wanted_ = wanted;
    if (!settled && air_rests_ < kAirIntervalFrames) return;
    builder_.request(wanted, sky::models::orders_of(scene.sky.model));
    next_air_age_ = 0;
    air_rests_ = 0;
}

void LightTables::Trend::follow(double now) noexcept {
    const double step = started_ ? now - last_ : 0.0;
    started_ = true;
    a_frame_ = step * step_ > 0.0 ? std::copysign(std::min(std::abs(step), std::abs(step_)), step) : 0.0;
    step_ = step;
    last_ = now;
}

double LightTables::Trend::ahead(double step) const noexcept {
    constexpr double kBuildFrames = 6.0;
    constexpr double kFarthestFrames = 300.0;
    return kBuildFrames * a_frame_ + std::clamp(kFarthestFrames * a_frame_, -0.8 * step, 0.8 * step);
}

void LightTables::update_sea(const Scene& scene) noexcept {
    if (air_->model().ground_mirror_albedo <= 0.0F) {
        sea_.reset();
        return;
    }
    const sky::SlopeVariance slopes = sky::slope_variance(scene.ground, scene.sea.all_waves());
    if (!sea_ || !alike(sea_->variance(), sky::roughened(slopes))) {
        sea_.emplace(slopes);
        ++revision_;
    }
}

bool LightTables::same_sea(const Made& made, const Scene& scene) const noexcept {
    if (made.air == 0 || !air_) return true;
    if (air_->model().ground_mirror_albedo <= 0.0F) return !made.sea;
    const sky::SlopeVariance slopes = sky::slope_variance(scene.ground, scene.sea.all_waves());
    return made.sea && alike(*made.sea, sky::roughened(slopes));
}

void LightTables::update_view(View& view, const Wanted& wanted) {
    const auto begin = [&](double elevation_rad, double height_m) {
        view.back.begin(sky_, *air_, height_m, elevation_rad, wanted.by_sun);
        if (sea_) view.back_sea.begin(*air_, *sea_, height_m, elevation_rad);
        view.back_made = {air_revision_, sky_, sea_ ? std::optional(sea_->variance()) : std::nullopt,
                          elevation_rad, height_m};
        view.building = true;
    };
    const auto take_over = [&] {
        std::swap(view.front, view.back);
        std::swap(view.front_sea, view.back_sea);
        view.front_made = view.back_made;
        view.building = false;
        ++revision_;
    };
    // Beyond these steps the picture in use is wrong rather than late.
    const Made& latest = view.building ? view.back_made : view.front_made;
    const bool lost = latest.air == 0 || std::abs(latest.elevation_rad - wanted.elevation_rad) > kJump_rad ||
                      is_height_jump(latest.height_m, wanted.height_m);
    if (wanted.needed && lost) {
        begin(wanted.elevation_rad, wanted.height_m);
        if (!wanted.matters) view.front_made.air = 0;
        if (wanted.matters) {
            view.back.build_all();
            if (view.back_made.sea) view.back_sea.build_rows(sky::SeaView::kRows);
            take_over();
            jumped_ = true;
            return;
        }
    } else if (wanted.needed && !view.building) {
        begin(wanted.elevation_rad + wanted.elevation_ahead_rad, wanted.height_m + wanted.height_ahead_m);
    }
    if (!view.building) return;
    const bool sky_done = view.back.build_rows(kRowsAFrame);
    const bool sea_done = !view.back_made.sea || view.back_sea.build_rows(kSeaRowsAFrame);
    if (sky_done && sea_done) take_over();
}

bool LightTables::has_jumped(const Scene& scene) const noexcept {
    if (!last_) return false;
    return is_jump(last_->sun_enu, scene.sun.direction_enu) ||
           is_jump(last_->moon_enu, scene.moon.direction_enu) ||
           is_height_jump(last_->height_m, scene.eye.height_m);
}

// Of one source: what is left of it below clouds, weighed by what a clear sky would bring.
void LightTables::shade(const Scene& scene, const CloudShade& clouds, SkyLight& light, LitAir& lit,
                        Overhead& overhead) const noexcept {
    const double sine = std::sin(lit.source.elevation_rad);
    const glm::dvec3 beam_xyz_lux = std::max(sine, 0.0) * air_->direct_sun_xyz(0.0, lit.source.elevation_rad);
    const glm::dvec3 sky_xyz_lux = air_->ground_diffuse_xyz(lit.source.elevation_rad);
    const double beam_lux = beam_xyz_lux.y, sky_lux = sky_xyz_lux.y;
    const double all_lux = std::max(beam_lux + sky_lux, 1e-12);
    const auto mean = [&](const CloudShare& share) {
        return (beam_lux * static_cast<double>(share.beam) + sky_lux * static_cast<double>(share.sky)) /
               all_lux;
    };
    const CloudShare ground = clouds.at(0.0, sine);
    const CloudShare eye = clouds.at(scene.eye.height_m, sine);
    // Of air under cover the part that no beam meets is lit by cloud and ground from all sides, with the mean
    // of both.
    const double direct = static_cast<double>(eye.direct);
    const double covered = 1.0 - direct;
    const glm::dvec3 even_xyz_lux = (static_cast<double>(eye.beam) - direct) * beam_xyz_lux +
                                    std::max(static_cast<double>(eye.sky) - direct, 0.0) * sky_xyz_lux;
    const double even = 0.5 * (1.0 + light.ground_albedo) / std::numbers::pi;
    light.even_cd_m2 += rec709_from_xyz(lit.scale_xyz * glm::vec3{even * even_xyz_lux});
    lit.clouded = {eye.direct, static_cast<float>(mean(ground)), static_cast<float>(covered)};
    if (covered > 0.0 && lit.view != nullptr && lit.sea == nullptr) lit.land_cd_m2 = land_cd_m2(light, lit);
    lit.beam_share = ground.direct;
    const double weight = static_cast<double>(lit.scale_xyz.y);
    const double scattered = static_cast<double>(eye.beam - eye.direct);
    overhead.clear_lux += weight * sky_lux;
    overhead.covered_lux += weight * (sky_lux * static_cast<double>(eye.sky) + beam_lux * scattered);
}

void LightTables::update(const Scene& scene, const Plan& plan) {
    jumped_ = has_jumped(scene);
    last_ = {scene.sun.direction_enu, scene.moon.direction_enu, scene.eye.height_m};
    update_air(scene, plan);
    update_sea(scene);
    sky_ = fitting(scene.sky);
    const double sun_rad = horizontal_of(scene.sun.direction_enu).elevation_rad;
    const double moon_rad = horizontal_of(scene.moon.direction_enu).elevation_rad;
    const double height_m = scene.eye.height_m;
    sun_trend_.follow(sun_rad);
    moon_trend_.follow(moon_rad);
    height_trend_.follow(height_m);
    const double height_ahead_m = height_trend_.ahead(sky::height_step_m(height_m));
    update_view(sun_, {plan.needs(Pass::kSunSky), plan.sun_share > 0.0, true, sun_rad,
                       sun_trend_.ahead(sky::source_step_rad(sun_rad)), height_m, height_ahead_m});
    update_view(moon_, {plan.needs(Pass::kMoonSky), plan.moon_share > 0.0, false, moon_rad,
                        moon_trend_.ahead(sky::source_step_rad(moon_rad)), height_m, height_ahead_m});
    if (plan.needs(Pass::kNightSky) && night_.update(scene, *air_)) ++revision_;
}

SkyLight LightTables::light(const Scene& scene, const Plan& plan,
                            const sky::RefractionRow& refraction) const noexcept {
    SkyLight light;
    light.refraction = refraction;
    light.eye_height_m = scene.eye.height_m;
    light.front_air = front_air(air_->model(), scene.eye.height_m);
    light.horizon_elevation_rad = refraction.horizon_elevation_rad();
    light.straight_horizon_rad = horizon_elevation_rad(scene.eye.height_m);
    sky::Spectrum diffuse = air_->model().ground_albedo;
    for (float& albedo : diffuse)
        albedo -= air_->model().ground_mirror_albedo;
    light.ground_albedo = sky::luminous_albedo(air_->model(), diffuse);
    light.sea = sea_ ? &*sea_ : nullptr;
    if (plan.needs(Pass::kNightSky)) {
        light.night = &night_;
        light.night_share = static_cast<float>(plan.night_share);
    }
    const auto reflected = [](const View& view) { return view.front_made.sea ? &view.front_sea : nullptr; };
    if (plan.sun_share > 0.0 && sun_.front_made.air != 0) {
        const double unobscured = std::max(scene.sun.unobscured, kFromBeyondShadow);
        const double share = plan.sun_share * unobscured / (scene.sun.distance_au * scene.sun.distance_au);
        light.sun = {&sun_.front,
                     horizontal_of(scene.sun.direction_enu),
                     glm::vec3{static_cast<float>(share)},
                     reflected(sun_),
                     {},
                     1.0F};
    }
    if (plan.moon_share > 0.0 && moon_.front_made.air != 0) {
        light.moon = {&moon_.front,
                      horizontal_of(scene.moon.direction_enu),
                      moon_scale_xyz(scene, air_->model(), plan.moon_share),
                      reflected(moon_),
                      {},
                      1.0F};
    }
    if (const CloudShade clouds(scene.weather, light.ground_albedo); clouds.any()) {
        const float dark = clouds.at(scene.eye.height_m, 0.0).sky;
        light.night_clouded = {dark, clouds.at(0.0, 0.0).sky};
        Overhead overhead;
        if (light.night != nullptr) {
            overhead.clear_lux = static_cast<double>(light.night_share * light.night->ground_rgb_lux().y);
            overhead.covered_lux = overhead.clear_lux * static_cast<double>(dark);
        }
        shade(scene, clouds, light, light.sun, overhead);
        shade(scene, clouds, light, light.moon, overhead);
        light.overhead =
            overhead.clear_lux > 0.0 ? static_cast<float>(overhead.covered_lux / overhead.clear_lux) : dark;
    }
    return light;
}

}  // namespace skyig::render
