// Every value of a FrameState, one after the other, always in the same order and number: how it is told and
// how it is taken are the two visitors of one list, so that they cannot differ.
#pragma once

#include <cstddef>

#include "server/rig/frame_state.h"

namespace skyig::server::rig {

// A new member of any of these must be visited below; then its size here is set anew.
static_assert(sizeof(render::CloudLook) == 184 && sizeof(render::CloudLayer) == 368);
static_assert(sizeof(render::Obscurant) == 144 && sizeof(render::Precipitation) == 24);
static_assert(sizeof(render::Lightning) == 24 && sizeof(render::WeatherArea) == 56);
static_assert(sizeof(render::Wave) == 56 && sizeof(render::Sea) == 936 && sizeof(render::Ground) == 56);
static_assert(sizeof(render::Sun) == 56 && sizeof(render::Moon) == 200 && sizeof(render::Planet) == 40);
static_assert(sizeof(render::Stars) == 120 && sizeof(render::Air) == 48 && sizeof(render::Eye) == 24);
static_assert(sizeof(render::SkySettings) == 264 && sizeof(render::NightSettings) == 360);
static_assert(sizeof(render::ChannelView) == 128 && sizeof(render::Overlay) == 288);
static_assert(sizeof(render::eye::Adaptation) == 40);

/// `visit` is called with each value: numbers, truth values; and visit.one_of(enum, its number of values),
/// visit.count(number, its largest), visit.text(line), visit.picture(pointer), visit.given(optional), which
/// tells whether its value, then there, follows.
template <class State, class Visit>
class FrameFields {
  public:
    FrameFields(State& state, Visit& visit) : state_(state), visit_(visit) {}

    void all() {
        visit_(state_.scene.frame_number);
        visit_(state_.world_utc_ns);
        visit_(state_.slots);
        thinned();
        state_.eyes.visit(visit_);
        scene(state_.scene);
    }

  private:
    template <class... Values>
    void each(Values&... values) {
        (visit_(values), ...);
    }
    template <class Vector>
    void vector(Vector& value) {
        for (glm::length_t i = 0; i < value.length(); ++i)
            visit_(value[i]);
    }
    template <class Matrix>
    void matrix(Matrix& value) {
        for (glm::length_t i = 0; i < value.length(); ++i)
            vector(value[i]);
    }
    template <class Optional>
    void number(Optional& value) {
        if (visit_.given(value))
            visit_(*value);
        else
            visit_.skip(1);
    }

    void thinned() {
        std::uint64_t bits = state_.thinned.to_ullong();
        visit_.count(bits, (1U << render::kThinCount) - 1);
        state_.thinned = render::Thinned(bits);
    }

    template <class Scene>
    void scene(Scene& scene) {
        visit_(scene.time_s);
        each(scene.eye.latitude_deg, scene.eye.longitude_deg, scene.eye.height_m);
        each(scene.sun.enabled, scene.sun.distance_au, scene.sun.angular_radius_rad, scene.sun.unobscured);
        vector(scene.sun.direction_enu);
        moon(scene.moon);
        each(scene.stars.enabled, scene.stars.intensity, scene.stars.years_since_j2000);
        matrix(scene.stars.enu_from_gcrs);
        vector(scene.stars.earth_velocity_c);
        for (auto& planet : scene.planets) {
            vector(planet.direction_enu);
            each(planet.magnitude, planet.bv);
        }
        auto& air = scene.air;
        each(air.model_enabled, air.visibility_m, air.visibility_contrast, air.temperature_c,
             air.pressure_hpa, air.humidity_pct);
        surface(scene.ground, scene.sea);
        weather(scene.weather);
        sky(scene.sky);
        night(scene.night);
        for (auto& line : scene.overlay.lines)
            visit_.text(line);
        visit_.text(scene.overlay.warning);
        visit_.count(scene.view_count, render::kMaxChannels);
        for (auto& one : scene.views)
            view(one);
    }

    template <class Moon>
    void moon(Moon& moon) {
        each(moon.enabled, moon.distance_km, moon.angular_radius_rad, moon.phase_angle_rad, moon.umbra_radius,
             moon.penumbra_radius, moon.sunlit);
        vector(moon.direction_enu);
        vector(moon.to_sun_enu);
        matrix(moon.enu_from_selenographic);
        vector(moon.shadow_axis_enu);
    }

    template <class Ground, class Sea>
    void surface(Ground& ground, Sea& sea) {
        visit_.one_of(ground.kind, 2);
        number(ground.albedo);
        each(ground.snow, ground.wet, ground.wind_m_s, ground.wind_from_rad);
        each(sea.height_m, sea.temperature_c, sea.clarity, sea.whitecaps);
        visit_.count(sea.wave_count, render::kMaxWaves);
        for (auto& wave : sea.waves) {
            each(wave.height_m, wave.length_m, wave.period_s, wave.direction_rad, wave.phase_rad,
                 wave.leading_rad);
            visit_.one_of(wave.breaker, 3);
        }
    }

    template <class Weather>
    void weather(Weather& weather) {
        vector(weather.wind_m_s);
        vector(weather.eye_velocity_m_s);
        visit_.count(weather.cloud_count, weather.kMaxClouds);
        for (auto& layer : weather.clouds)
            cloud(layer);
        visit_.count(weather.obscurant_count, weather.kMaxObscurants);
        for (auto& one : weather.obscurants) {
            visit_.one_of(one.kind, 7);
            each(one.base_m, one.top_m, one.bottom_band_m, one.top_band_m, one.extinction_per_m,
                 one.coverage);
            vector(one.drift_m);
            visit_(one.seed);
            area(one.area);
        }
        visit_.count(weather.precipitation_count, weather.kMaxPrecipitations);
        for (auto& one : weather.precipitations) {
            visit_.one_of(one.kind, 5);
            each(one.rate_mm_h, one.top_m);
        }
        visit_.count(weather.lightning_count, weather.kMaxLightnings);
        for (auto& one : weather.lightnings) {
            visit_.count(one.layer, weather.kMaxClouds - 1);
            each(one.flashes_per_min, one.seed);
        }
    }

    template <class Layer>
    void cloud(Layer& layer) {
        visit_.one_of(layer.genus, 12);
        visit_.one_of(layer.model, 4);
        each(layer.base_m, layer.thickness_m, layer.bottom_band_m, layer.top_band_m, layer.coverage,
             layer.extinction_per_m, layer.age_s, layer.bottom_scud, layer.top_scud, layer.severity,
             layer.seed);
        vector(layer.drift_m);
        area(layer.area);
        if (visit_.given(layer.look))
            look(*layer.look);
        else
            visit_.skip(kLookValues);
    }

    static constexpr std::size_t kLookValues = 3 * 6 + 5;
    template <class Look>
    void look(Look& look) {
        for (auto& tile : look.tiles) {
            visit_.picture(tile.picture);
            visit_.one_of(tile.noise, 4);
            visit_(tile.times);
            vector(tile.scroll_m_s);
            visit_(tile.weight);
        }
        each(look.density_offset, look.self_shadow);
        vector(look.colour);
    }

    static constexpr std::size_t kAreaValues = 7;
    template <class Area>
    void area(Area& area) {
        if (!visit_.given(area)) {
            visit_.skip(kAreaValues);
            return;
        }
        vector(area->centre_m);
        vector(area->half_size_m);
        each(area->axis_rad, area->corner_radius_m, area->perimeter_m);
    }

    template <class Sky>
    void sky(Sky& sky) {
        visit_.one_of(sky.model, 6);
        each(sky.day_cycle.desaturation, sky.cie.type, sky.star_scintillation);
        number(sky.cie.zenith_luminance_cd_m2);
        number(sky.preetham.turbidity);
        visit_(sky.preetham.zenith_of_multi);
        auto& look = sky.windlight;
        vector(look.blue_horizon);
        vector(look.blue_density);
        vector(look.sunlight);
        vector(look.ambient);
        each(look.haze_horizon, look.haze_density, look.density_per_m, look.max_altitude_m, look.glow_size,
             look.glow_floor, look.glow_power, look.horizon_drop, look.unit_cd_m2, look.places_sun,
             look.sun_angle_rad, look.east_angle_rad);
    }

    template <class Night>
    void night(Night& night) {
        visit_.one_of(night.model, 3);
        each(night.airglow, night.zodiacal, night.starlight, night.galactic_light, night.structure,
             night.seed, night.solar_activity);
        visit_.count(night.city_count, render::kMaxCities);
        for (auto& city : night.cities)
            each(city.latitude_deg, city.longitude_deg, city.radius_m, city.zenith_cd_m2, city.population);
    }

    template <class View>
    void view(View& view) {
        each(view.frustum.left_rad, view.frustum.right_rad, view.frustum.bottom_rad, view.frustum.top_rad);
        matrix(view.view_from_enu);
        each(view.showing.mirrored_across, view.showing.mirrored_upright, view.showing.parallel);
        visit_.count(view.showing.repeat_across, render::Showing::kMostRepeated);
        visit_.count(view.showing.repeat_upright, render::Showing::kMostRepeated);
        visit_.one_of(view.pattern, render::kPatternCount);
        each(view.overlay, view.windscreen_m);
    }

    State& state_;
    Visit& visit_;
};

}  // namespace skyig::server::rig
