#include "server/weather/weather_builder.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "config/warp/grey_map.h"
#include "render/cloud/field/texture.h"
#include "render/fog/patches.h"
#include "render/weather_area.h"
#include "render/weather_ramp.h"
#include "server/start_weather/layers.h"
#include "server/weather/day_keyframes.h"

namespace skyig::server::weather {
namespace {

using render::CloudGenus;
using render::CloudLayer;
using render::Obscurant;
using render::Precipitation;
using render::WeatherArea;

constexpr glm::dvec2 kEye{0.0};
/// The thickest air that the renderer's tables are made for.
constexpr double kThickestAir_m = 1000.0;
/// What the air dims beyond it lies as haze does, which thins by e every 1200 m.
constexpr double kThickTop_m = 300.0;
constexpr double kThickBand_m = 1800.0;
/// The eye's velocity is that over so long a time; faster, it was put elsewhere.
constexpr double kEyeTime_s = 0.25;
constexpr double kFastestEye_m_s = 10'000.0;
/// Every four seconds another.
constexpr double kLooksADay = 21'600.0;

static_assert(
    static_cast<int>(config::CloudModel::kAuto) == static_cast<int>(render::CloudModel::kAuto) &&
        static_cast<int>(config::CloudModel::kLayer) == static_cast<int>(render::CloudModel::kLayer) &&
        static_cast<int>(config::CloudModel::kImpostor) == static_cast<int>(render::CloudModel::kImpostor) &&
        static_cast<int>(config::CloudModel::kVolume) == static_cast<int>(render::CloudModel::kVolume),
    "one order of cloud models in settings and scene");

/// Unlike layers have unlike clouds; the same layer has the same ones in every daemon.
std::uint32_t seed_of(const LayerKey& key) noexcept {
    std::uint32_t seed = key.place * 2654435761U ^ (static_cast<std::uint32_t>(key.family) << 8U) ^ key.kind;
    seed ^= seed >> 16U;
    seed *= 0x7feb352dU;
    seed ^= seed >> 15U;
    return seed;
}

double weight_at_eye(const std::optional<WeatherArea>& area) noexcept {
    return area ? render::area_weight(*area, kEye) : 1.0;
}

/// 1 from base to top, falling to 0 over the bands.
double weight_at_height(const LayerState& state, double height_m) noexcept {
    const double top_m = state.base_m + state.thickness_m;
    const double outside_m = std::max({state.base_m - height_m, height_m - top_m, 0.0});
    const double band_m = height_m < state.base_m ? state.bottom_band_m : state.top_band_m;
    if (outside_m <= 0.0) return 1.0;
    return outside_m < band_m ? 1.0 - outside_m / band_m : 0.0;
}

Obscurant obscurant_of(const ShownLayer& layer, Obscurant::Kind kind, const glm::dvec2& drift_m,
                       const std::optional<WeatherArea>& area) noexcept {
    const LayerState& state = layer.state;
    Obscurant obscurant;
    obscurant.kind = kind;
    obscurant.base_m = state.base_m;
    obscurant.top_m = state.base_m + state.thickness_m;
    obscurant.bottom_band_m = state.bottom_band_m;
    obscurant.top_band_m = state.top_band_m;
    obscurant.extinction_per_m = state.extinction_per_m * layer.uncovered;
    obscurant.drift_m = drift_m;
    obscurant.seed = seed_of(layer.told.key);
    obscurant.area = area;
    return obscurant;
}

static_assert(static_cast<int>(config::CloudNoise::kPuffs) == static_cast<int>(render::CloudNoise::kPuffs) &&
                  static_cast<int>(config::CloudNoise::kFibres) ==
                      static_cast<int>(render::CloudNoise::kFibres),
              "one order of noises in settings and scene");

render::CloudLook look_of(const config::WeatherSheet& sheet) {
    render::CloudLook look;
    for (render::CloudLook::Tile& tile : look.tiles)
        tile.weight = 0.0;
    for (std::size_t i = 0; i < std::min(sheet.textures.size(), look.tiles.size()); ++i) {
        const config::WeatherTexture& texture = sheet.textures[i];
        render::CloudLook::Tile& tile = look.tiles[i];
        if (texture.image) {
            tile.picture = std::make_shared<render::cloud::field::Texture>(texture.image->width_px,
                                                                           texture.image->values);
        }
        tile.noise = static_cast<render::CloudNoise>(texture.noise);
        tile.times = std::max(static_cast<int>(std::lround(config::kTexturesRepeat_m / texture.size_m)), 1);
        tile.scroll_m_s = wind_towards_m_s(texture.scroll_m_s, texture.scroll_from_deg);
        tile.weight = texture.weight;
    }
    look.density_offset = sheet.density_offset;
    look.self_shadow = sheet.self_shadow;
    look.colour = {sheet.colour[0], sheet.colour[1], sheet.colour[2]};
    return look;
}

}  // namespace

WeatherSettings weather_settings(const config::Weather& weather) {
    WeatherSettings settings;
    settings.transition_s = weather.transition_s;
    settings.elevation_m = weather.elevation_m;
    settings.clouds = static_cast<render::CloudModel>(weather.clouds);
    for (const config::WeatherSheet& sheet : weather.sheets)
        settings.looks[static_cast<std::size_t>(genus_of(sheet.type))] = look_of(sheet);
    if (weather.driver == config::WeatherDriver::kKeyframes) settings.keyframes = weather.keyframes;
    return settings;
}

WeatherBuilder::WeatherBuilder(const WeatherSettings& settings)
    : settings_(settings), ramps_(settings.transition_s) {}

void WeatherBuilder::build(const world::World& world, render::Scene& scene) {
    render::Weather& weather = scene.weather;
    if (world.resets() != resets_) {
        drifts_.forget();
        ground_.clear();
    }
    const bool at_once = jumped(world, scene.time_s);
    const EyePlane plane(scene.eye);
    if (settings_.keyframes) {
        // In steps, so that tables made of a look are finished before the next.
        const double day = solar_day(world.clock().utc().second_of_day(), scene.eye.longitude_deg);
        const config::Keyframe look =
            look_at(*settings_.keyframes, std::floor(day * kLooksADay) / kLooksADay);
        put_look(look, scene);
        cloud_cover_ = look.cloud_cover;
    }
    const double contrast = scene.air.visibility_contrast;
    const Meaning meaning{-std::log(contrast) / std::max(scene.air.visibility_m, 1.0), contrast,
                          settings_.elevation_m, scene.air.temperature_c};
    ramps_.advance(gatherer_.gather(world, plane, meaning), scene.time_s, at_once);
    carry(world.air(), scene.time_s);
    left_out_ = gatherer_.left_out();
    settle_air(scene, at_once);
    reaching_ = {};
    show(plane, scene, weather);
    cover_ground(scene, at_once);
    weather.wind_m_s = wind_at_eye(world, plane, scene.eye);
    move_eye(scene.eye, scene.time_s, at_once, weather);
    time_s_ = scene.time_s;
}

bool WeatherBuilder::jumped(const world::World& world, double time_s) noexcept {
    const bool reset = world.resets() != resets_;
    resets_ = world.resets();
    return reset || !time_s_ || time_s < *time_s_ || time_s - *time_s_ > world::World::kClockJump_s;
}

void WeatherBuilder::settle_air(render::Scene& scene, bool at_once) noexcept {
    render::Air& air = scene.air;
    const double depth = -std::log(air.visibility_contrast);
    const double told_per_m = depth / std::max(air.visibility_m, 1.0);
    using Scale = render::ExtinctionScale;
    if (at_once) {
        air_place_.set(Scale::place_of(told_per_m));
    } else {
        air_place_.aim(Scale::place_of(told_per_m), *time_s_, settings_.transition_s);
    }
    // A settled visibility goes through untouched.
    if (!air_place_.settled(scene.time_s, settings_.transition_s))
        air.visibility_m = depth / Scale::value_at(air_place_.at(scene.time_s, settings_.transition_s));
    if (!air.model_enabled || air.visibility_m >= kThickestAir_m) return;
    Obscurant& fog = scene.weather.obscurants[scene.weather.obscurant_count++];
    fog = {};
    fog.kind = Obscurant::Kind::kFog;
    fog.top_m = settings_.elevation_m + kThickTop_m;
    fog.top_band_m = kThickBand_m;
    fog.extinction_per_m = depth / std::max(air.visibility_m, 5.0) - depth / kThickestAir_m;
    air.visibility_m = kThickestAir_m;
}

void WeatherBuilder::move_eye(const render::Eye& eye, double time_s, bool at_once,
                              render::Weather& weather) noexcept {
    const ephemeris::Geodetic place{eye.latitude_deg, eye.longitude_deg, eye.height_m};
    const glm::dvec3 ecef_m = world::ecef_of(place);
    const double step_s = time_s - time_s_.value_or(time_s);
    const glm::dvec3 moved_m = ecef_m - std::exchange(eye_ecef_m_, ecef_m);
    if (at_once || glm::length(moved_m) > kFastestEye_m_s * step_s) {
        eye_velocity_ecef_m_s_ = glm::dvec3{0.0};
        eye_moves_ = false;
    } else if (step_s > 0.0) {
        const double part = std::exchange(eye_moves_, true) ? -std::expm1(-step_s / kEyeTime_s) : 1.0;
        eye_velocity_ecef_m_s_ += part * (moved_m / step_s - eye_velocity_ecef_m_s_);
    }
    const auto along = [&](const glm::dvec3& enu) {
        return glm::dot(eye_velocity_ecef_m_s_, world::ecef_from_enu(place, enu));
    };
    weather.eye_velocity_m_s = {along({1.0, 0.0, 0.0}), along({0.0, 1.0, 0.0}), along({0.0, 0.0, 1.0})};
}

void WeatherBuilder::show(const EyePlane& plane, const render::Scene& scene,
                          render::Weather& weather) noexcept {
    const std::span<ShownLayer> shown = ramps_.shown();
    std::array<std::optional<WeatherArea>, Ramps::kMost> areas;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        order_[i] = static_cast<std::uint8_t>(i);
        distance_m_[i] = 0.0;
        if (!shown[i].area) continue;
        areas[i] = plane.place(*shown[i].area);
        distance_m_[i] = std::max(render::area_distance_m(*areas[i], kEye) - areas[i]->perimeter_m, 0.0);
    }
    std::sort(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(shown.size()),
              [&](std::uint8_t a, std::uint8_t b) {
                  if (distance_m_[a] != distance_m_[b]) return distance_m_[a] < distance_m_[b];
                  return shown[a].told.key.place < shown[b].told.key.place ||
                         (shown[a].told.key.place == shown[b].told.key.place && a < b);
              });
    for (std::size_t n = 0; n < shown.size(); ++n) {
        const ShownLayer& layer = shown[order_[n]];
        const std::optional<WeatherArea>& area = areas[order_[n]];
        switch (layer.told.key.family) {
            case Family::kCloud:
                show_cloud(layer, scene, area, weather);
                break;
            case Family::kObscurant:
                show_obscurant(layer, scene, area, weather);
                break;
            case Family::kFalling:
                show_falling(layer, scene, area, weather);
                break;
        }
    }
}

void WeatherBuilder::show_cloud(const ShownLayer& layer, const render::Scene& scene,
                                const std::optional<WeatherArea>& area, render::Weather& weather) noexcept {
    const LayerState& state = layer.state;
    const double coverage = std::min(state.coverage * layer.uncovered * cloud_cover_, 1.0);
    if (coverage <= 0.0) return;
    if (weather.cloud_count == render::Weather::kMaxClouds) {
        ++left_out_;
        return;
    }
    if (state.flashes_per_min > 0.0 && weather.lightning_count < render::Weather::kMaxLightnings) {
        weather.lightnings[weather.lightning_count++] = {weather.cloud_count, state.flashes_per_min,
                                                         seed_of(layer.told.key)};
    }
    CloudLayer& cloud = weather.clouds[weather.cloud_count++];
    cloud.genus = static_cast<CloudGenus>(layer.told.key.kind);
    cloud.model = settings_.clouds;
    cloud.base_m = state.base_m;
    cloud.thickness_m = state.thickness_m;
    cloud.bottom_band_m = state.bottom_band_m;
    cloud.top_band_m = state.top_band_m;
    cloud.coverage = coverage;
    cloud.extinction_per_m = state.extinction_per_m;
    cloud.drift_m = drifts_.at(layer.told.key.place);
    cloud.age_s = scene.time_s;
    cloud.bottom_scud = state.bottom_scud;
    cloud.top_scud = state.top_scud;
    cloud.severity = state.severity;
    cloud.seed = seed_of(layer.told.key);
    cloud.area = area;
    cloud.look = settings_.looks[layer.told.key.kind];
}

void WeatherBuilder::show_obscurant(const ShownLayer& layer, const render::Scene& scene,
                                    const std::optional<WeatherArea>& area,
                                    render::Weather& weather) noexcept {
    const LayerKey& key = layer.told.key;
    Obscurant made = obscurant_of(layer, static_cast<Obscurant::Kind>(key.kind), drifts_.at(key.place), area);
    made.coverage = layer.state.coverage;
    const render::fog::PatchedFog fog = render::fog::in_patches(made, std::min(scene.eye.height_m, 0.0));
    if (fog.patches.coverage > 0.0 && fog.patches.extinction_per_m > 0.0) {
        // Where there is no place for them their mean is shown.
        if (weather.cloud_count == render::Weather::kMaxClouds) {
            add(made, weather);
            return;
        }
        weather.clouds[weather.cloud_count++] = fog.patches;
    }
    add(fog.even, weather);
}

void WeatherBuilder::add(const Obscurant& made, render::Weather& weather) noexcept {
    if (made.extinction_per_m <= 0.0) return;
    if (weather.obscurant_count == render::Weather::kMaxObscurants) {
        ++left_out_;
        return;
    }
    weather.obscurants[weather.obscurant_count++] = made;
}

void WeatherBuilder::show_falling(const ShownLayer& layer, const render::Scene& scene,
                                  const std::optional<WeatherArea>& area, render::Weather& weather) noexcept {
    const auto kind = static_cast<Precipitation::Kind>(layer.told.key.kind);
    const bool snow = kind == Precipitation::Kind::kSnow;
    const Obscurant made = obscurant_of(layer, snow ? Obscurant::Kind::kSnow : Obscurant::Kind::kRain,
                                        drifts_.at(layer.told.key.place), area);
    add(made, weather);
    const double below_eye_mm_h = layer.state.rate_mm_h * layer.uncovered * weight_at_eye(area);
    const double as_snow = snow ? 1.0 : kind == Precipitation::Kind::kSleet ? 0.5 : 0.0;
    if (kind != Precipitation::Kind::kHail) {
        reaching_.snow_mm_h += as_snow * below_eye_mm_h;
        reaching_.rain_mm_h += (1.0 - as_snow) * below_eye_mm_h;
    }
    const double rate_mm_h = below_eye_mm_h * weight_at_height(layer.state, scene.eye.height_m);
    if (rate_mm_h <= 0.0) return;
    // One of each kind: there is room for all.
    const auto all = std::span(weather.precipitations).first(weather.precipitation_count);
    const auto same =
        std::find_if(all.begin(), all.end(), [kind](const Precipitation& p) { return p.kind == kind; });
    if (same != all.end()) {
        same->rate_mm_h += rate_mm_h;
        same->top_m = std::max(same->top_m, made.top_m);
        return;
    }
    weather.precipitations[weather.precipitation_count++] = {kind, rate_mm_h, made.top_m};
}

void WeatherBuilder::cover_ground(const render::Scene& scene, bool at_once) noexcept {
    reaching_.air_c = scene.air.temperature_c;
    if (at_once) {
        ground_.settle(reaching_);
    } else {
        ground_.advance(reaching_, scene.time_s - *time_s_);
    }
}

void WeatherBuilder::carry(const world::AirState& air, double time_s) noexcept {
    drifts_.set_air(wind_towards_m_s(air.wind_horizontal_m_s, air.wind_from_deg), time_s);
    for (const ShownLayer& layer : ramps_.shown()) {
        // One that ends drifts with what has come in its place.
        if (layer.ends) continue;
        const ToldLayer& told = layer.told;
        drifts_.carry(told.key.place, {told.wind_m_s, wind_gain(told.state.base_m - settings_.elevation_m)});
    }
}

glm::dvec3 WeatherBuilder::wind_at_eye(const world::World& world, const EyePlane& plane,
                                       const render::Eye& eye) const noexcept {
    const world::AirState& air = world.air();
    glm::dvec2 wind = wind_gain(eye.height_m - settings_.elevation_m) *
                      wind_towards_m_s(air.wind_horizontal_m_s, air.wind_from_deg);
    glm::dvec2 sum{0.0};
    double weight_sum = 0.0, largest = 0.0;
    for (const ToldLayer& layer : gatherer_.layers()) {
        if (!layer.wind_m_s) continue;
        const double weight = layer.uncovered * weight_at_height(layer.state, eye.height_m) *
                              (layer.area ? render::area_weight(plane.place(*layer.area), kEye) : 1.0);
        sum += weight * *layer.wind_m_s;
        weight_sum += weight;
        largest = std::max(largest, weight);
    }
    if (weight_sum > 0.0) wind += largest * (sum / weight_sum - wind);
    return {wind.x, wind.y, air.wind_vertical_m_s};
}

}  // namespace skyig::server::weather
