#include "clients/skyig/shot.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "config/config.h"
#include "render/output/png.h"
#include "server/clock.h"
#include "server/from_config.h"
#include "server/gl_painter.h"
#include "server/log.h"
#include "server/scene_builder.h"
#include "server/world/world.h"

namespace skyig::clients {

namespace ephemeris = server::ephemeris;

namespace {

/// What is wrong has been told line by line: exit status 2.
struct ConfigErrors {};

struct Picture {
    std::string channel;
    std::string path;
    int width_px = 0;
    int height_px = 0;
};

struct Shot {
    std::vector<Picture> pictures;
    std::string utc;
    std::string ephemeris;
    bool leap_seconds_assumed = false;
    double tables_ms = 0.0;
    double draw_ms = 0.0;
    server::SkyAngles sky;
    double adaptation_cd_m2 = 0.0;
    std::string renderer;
};

config::Config base_config(const ShotOptions& options) {
    if (options.config_path.empty()) {
        config::Config config = config::default_config();
        config::Channel& channel = config.channels.front();
        channel.width_px = options.width_px;
        channel.height_px = options.height_px;
        channel.right_deg = options.fov_deg / 2.0;
        channel.left_deg = -channel.right_deg;
        const double top = std::tan(glm::radians(channel.right_deg)) * options.height_px / options.width_px;
        channel.top_deg = glm::degrees(std::atan(top));
        channel.bottom_deg = -channel.top_deg;
        return config;
    }
    config::LoadResult loaded = config::load_config(options.config_path);
    for (const config::ConfigError& error : loaded.errors)
        fmt::print(stderr, "{}\n", config::to_text(error));
    if (!loaded.config) throw ConfigErrors{};
    return std::move(*loaded.config);
}

config::Config shot_config(const ShotOptions& options) {
    config::Config config = base_config(options);
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
    return config;
}

ephemeris::UtcClockTime shot_time(const ShotOptions& options, const config::Config& config,
                                  const server::Clock& clock) {
    if (const auto asked = ephemeris::parse_utc(options.utc)) return *asked;
    return server::start_time(config.start, clock);
}

/// The file as asked for; with several channels their names go before the extension.
std::string picture_path(const std::string& out_path, const config::Config& config, std::size_t channel) {
    if (config.channels.size() == 1) return out_path;
    const std::filesystem::path path(out_path);
    const std::string name = fmt::format("{}_{}{}", path.stem().string(), config.channels[channel].name,
                                         path.extension().string());
    return (path.parent_path() / name).string();
}

Picture write_picture(server::GlPainter& painter, const ShotOptions& options, const config::Config& config,
                      std::size_t channel) {
    const config::Channel& settings = config.channels[channel];
    Picture picture{settings.name, picture_path(options.out_path, config, channel), settings.width_px,
                    settings.height_px};
    std::vector<std::byte> rgba(static_cast<std::size_t>(picture.width_px) *
                                static_cast<std::size_t>(picture.height_px) * 4);
    painter.read_back(channel, rgba);
    std::string error;
    if (!render::output::write_png(picture.path, picture.width_px, picture.height_px, rgba, error,
                                   config.display.gamma))
        throw std::runtime_error(error);
    return picture;
}

server::SceneBuilder scene_builder(const ShotOptions& options, const config::Config& config) {
    ephemeris::EarthOrientationResult orientation =
        server::load_earth_orientation(config, options.config_path);
    if (!orientation) {
        fmt::print(stderr, "{}\n", orientation.error);
        throw ConfigErrors{};
    }
    return server::SceneBuilder(server::ephemeris_model(config), std::move(*orientation.orientation),
                                server::sky_settings(config.sky));
}

Shot take_shot(const ShotOptions& options) {
    const server::SystemClock clock;
    server::Log log(clock, server::Severity::kWarning);
    const config::Config config = shot_config(options);
    const ephemeris::UtcClockTime utc = shot_time(options, config, clock);
    server::SceneBuilder scenes = scene_builder(options, config);
    const server::world::World world(config, utc, log);
    server::GlPainter painter(server::render_channels(config), server::display_settings(config));

    const std::int64_t begin_ns = clock.monotonic_ns();
    const render::Scene scene = scenes.build(world, 1);
    if (scenes.date_clamped())
        log.warning("{} is beyond the ephemeris: the nearest year it knows is drawn", ephemeris::to_iso(utc));
    painter.prepare(scene);
    const std::int64_t tables_ns = clock.monotonic_ns();
    Shot shot;
    for (std::size_t channel = 0; channel < config.channels.size(); ++channel)
        painter.draw(channel);
    shot.tables_ms = static_cast<double>(tables_ns - begin_ns) * 1e-6;
    shot.draw_ms = static_cast<double>(clock.monotonic_ns() - tables_ns) * 1e-6;
    for (std::size_t channel = 0; channel < config.channels.size(); ++channel)
        shot.pictures.push_back(write_picture(painter, options, config, channel));
    shot.utc = ephemeris::to_iso(utc);
    shot.ephemeris = ephemeris::name_of(server::ephemeris_model(config));
    shot.leap_seconds_assumed = scenes.leap_seconds_assumed();
    shot.sky = server::sky_angles(scene);
    shot.adaptation_cd_m2 = painter.adaptation_cd_m2();
    shot.renderer = painter.description();
    return shot;
}

void print_text(const Shot& shot) {
    for (const Picture& picture : shot.pictures)
        fmt::print("{}  {}x{}\n", picture.path, picture.width_px, picture.height_px);
    fmt::print("took        {:.1f} ms for the tables of this air, {:.1f} ms to draw\n", shot.tables_ms,
               shot.draw_ms);
    fmt::print("OpenGL      {}\n", shot.renderer);
    fmt::print("UTC         {}{}\n", shot.utc,
               shot.leap_seconds_assumed ? ", beyond the announced leap seconds" : "");
    fmt::print("ephemeris   {}\n", shot.ephemeris);
    fmt::print("Sun         elevation {:.2f} deg, azimuth {:.2f} deg\n", shot.sky.sun_elevation_deg,
               shot.sky.sun_azimuth_deg);
    fmt::print("Moon        elevation {:.2f} deg, azimuth {:.2f} deg, {:.0f} % lit\n",
               shot.sky.moon_elevation_deg, shot.sky.moon_azimuth_deg, shot.sky.moon_lit_fraction * 100.0);
    fmt::print("adaptation  {:.4g} cd/m2\n", shot.adaptation_cd_m2);
}

void print_json(const Shot& shot) {
    nlohmann::ordered_json json;
    json["pictures"] = nlohmann::ordered_json::array();
    for (const Picture& picture : shot.pictures) {
        json["pictures"].push_back({{"channel", picture.channel},
                                    {"path", picture.path},
                                    {"width_px", picture.width_px},
                                    {"height_px", picture.height_px}});
    }
    json["tables_ms"] = shot.tables_ms;
    json["draw_ms"] = shot.draw_ms;
    json["renderer"] = shot.renderer;
    json["utc"] = shot.utc;
    json["ephemeris"] = {{"model", shot.ephemeris}, {"leap_seconds_assumed", shot.leap_seconds_assumed}};
    json["sun"] = {{"elevation_deg", shot.sky.sun_elevation_deg}, {"azimuth_deg", shot.sky.sun_azimuth_deg}};
    json["moon"] = {{"elevation_deg", shot.sky.moon_elevation_deg},
                    {"azimuth_deg", shot.sky.moon_azimuth_deg},
                    {"lit_fraction", shot.sky.moon_lit_fraction}};
    json["adaptation_cd_m2"] = shot.adaptation_cd_m2;
    fmt::print("{}\n", json.dump(2));
}

}  // namespace

int run_shot(const ShotOptions& options) {
    try {
        const Shot shot = take_shot(options);
        options.json ? print_json(shot) : print_text(shot);
        return 0;
    } catch (const ConfigErrors&) {
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig shot: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
