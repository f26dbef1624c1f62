#include "clients/skyig/still/still.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "config/presets.h"
#include "server/from_config.h"
#include "server/log.h"
#include "server/scene_builder.h"
#include "server/start_weather/start_weather.h"
#include "server/world/world.h"

namespace skyig::clients {

namespace ephemeris = server::ephemeris;

namespace {

config::Config base_config(const StillOptions& options) {
    if (options.config_path.empty()) {
        config::Config config = config::default_config();
        config::Channel& channel = config.channels.front();
        channel.width_px = options.width_px;
        channel.height_px = options.height_px;
        channel.right_deg = options.fov_deg / 2.0;
        channel.left_deg = -channel.right_deg;
        channel.top_deg =
            config::matching_field_deg(options.fov_deg, options.width_px, options.height_px) / 2.0;
        channel.bottom_deg = -channel.top_deg;
        return config;
    }
    config::LoadResult loaded = config::load_config(options.config_path);
    for (const config::ConfigError& error : loaded.errors)
        fmt::print(stderr, "{}\n", config::to_text(error));
    if (!loaded.config) throw StillErrors{};
    return std::move(*loaded.config);
}

void take_weather(const StillOptions& options, config::Config& config) {
    const auto fail = [](const std::string& fault) {
        fmt::print(stderr, "{}\n", fault);
        throw StillErrors{};
    };
    config.weather.elevation_m = options.elevation_m.value_or(config.weather.elevation_m);
    if (!options.weather_preset.empty()) {
        const std::string fault = config::apply_preset(options.weather_preset, config);
        if (!fault.empty()) fail("--weather: " + fault);
    }
    if (!options.metar.empty()) {
        config.weather.preset.clear();
        config.weather.layers.clear();
        config.weather.areas.clear();
        config.weather.metar = options.metar;
    }
    const std::string source = options.metar.empty() ? options.config_path : "--metar";
    if (const std::string fault = server::metar_fault(config, source); !fault.empty()) fail(fault);
    if (const std::string left_out = server::metar_left_out(config, source); !left_out.empty())
        fmt::print(stderr, "warning: {}\n", left_out);
}

config::Config still_config(const StillOptions& options) {
    config::Config config = base_config(options);
    take_weather(options, config);
    config::Start& start = config.start;
    start.running = false;
    start.latitude_deg = options.latitude_deg.value_or(start.latitude_deg);
    start.longitude_deg = std::remainder(options.longitude_deg.value_or(start.longitude_deg), 360.0);
    start.height_m = options.height_m.value_or(start.height_m);
    start.yaw_deg = options.heading_deg.value_or(start.yaw_deg);
    start.pitch_deg = options.pitch_deg.value_or(start.pitch_deg);
    start.roll_deg = options.roll_deg.value_or(start.roll_deg);
    config.air.visibility_m = options.visibility_m.value_or(config.air.visibility_m);
    config.sky.model = options.sky_model.value_or(config.sky.model);
    if (!options.pattern.empty()) config::show_pattern(config, options.pattern);
    return config;
}

ephemeris::UtcClockTime still_time(const StillOptions& options, const config::Config& config,
                                   const server::Clock& clock) {
    if (const auto asked = ephemeris::parse_utc(options.utc)) return *asked;
    return server::start_time(config.start, clock);
}

server::SceneBuilder scene_builder(const StillOptions& options, const config::Config& config) {
    ephemeris::EarthOrientationResult orientation =
        server::load_earth_orientation(config, options.config_path);
    if (!orientation) {
        fmt::print(stderr, "{}\n", orientation.error);
        throw StillErrors{};
    }
    return server::SceneBuilder(server::ephemeris_model(config), std::move(*orientation.orientation),
                                server::sky_settings(config.sky), server::ground_settings(config.ground),
                                server::night_settings(config.night),
                                server::weather::weather_settings(config.weather));
}

}  // namespace

Still make_still(const StillOptions& options, const server::Clock& clock) {
    server::Log log(clock, server::Severity::kWarning);
    Still still;
    still.config = still_config(options);
    still.utc = still_time(options, still.config, clock);
    server::SceneBuilder scenes = scene_builder(options, still.config);
    const server::world::World world(still.config, still.utc, log);
    still.scene = scenes.build(world, 1);
    const double heading_rad = glm::radians(still.config.start.yaw_deg);
    still.scene.weather.eye_velocity_m_s =
        options.speed_m_s * glm::dvec3{std::sin(heading_rad), std::cos(heading_rad), 0.0};
    still.leap_seconds_assumed = scenes.leap_seconds_assumed();
    if (scenes.date_clamped()) {
        log.warning("{} is beyond the ephemeris: the nearest year it knows is drawn",
                    ephemeris::to_iso(still.utc));
    }
    return still;
}

}  // namespace skyig::clients
