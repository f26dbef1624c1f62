#include "clients/skyig/shot.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "clients/skyig/still/still.h"
#include "render/output/light_file.h"
#include "render/output/png.h"
#include "server/clock.h"
#include "server/from_config.h"
#include "server/gl_painter.h"
#include "server/scene_builder.h"

namespace skyig::clients {

namespace {

struct Picture {
    std::string channel;
    std::string path;
    int width_px = 0;
    int height_px = 0;
    std::string luminance_path;  // empty: none
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
    Picture picture{settings.name,
                    picture_path(options.out_path, config, channel),
                    settings.width_px,
                    settings.height_px,
                    {}};
    std::vector<std::byte> rgba(static_cast<std::size_t>(picture.width_px) *
                                static_cast<std::size_t>(picture.height_px) * 4);
    painter.read_back(channel, rgba);
    std::string error;
    const std::optional<double> gamma = settings.display ? settings.display->gamma : config.display.gamma;
    if (!render::output::write_png(picture.path, picture.width_px, picture.height_px, rgba, error, gamma))
        throw std::runtime_error(error);
    return picture;
}

/// The same pictures as light.
void write_luminance(const Still& still, const ShotOptions& options, std::vector<Picture>& pictures) {
    const config::Config& config = still.config;
    server::GlPainter painter({.channels = server::render_channels(config),
                               .display = server::display_settings(config),
                               .quality = server::quality(config),
                               .target = render::Target::kLuminance});
    painter.prepare(still.scene);
    std::vector<float> rgb_cd_m2;
    for (std::size_t channel = 0; channel < pictures.size(); ++channel) {
        Picture& picture = pictures[channel];
        picture.luminance_path = picture_path(options.luminance_path, config, channel);
        rgb_cd_m2.resize(static_cast<std::size_t>(picture.width_px) *
                         static_cast<std::size_t>(picture.height_px) * 3);
        painter.draw(channel);
        painter.read_luminance(channel, rgb_cd_m2);
        std::string error;
        if (!render::output::write_light(picture.luminance_path, picture.width_px, picture.height_px,
                                         rgb_cd_m2, error))
            throw std::runtime_error(error);
    }
}

Shot draw_pictures(const Still& still, const ShotOptions& options, const server::Clock& clock) {
    const config::Config& config = still.config;
    server::GlPainter painter({.channels = server::render_channels(config),
                               .display = server::display_settings(config),
                               .quality = server::quality(config)});

    const std::int64_t begin_ns = clock.monotonic_ns();
    painter.prepare(still.scene);
    const std::int64_t tables_ns = clock.monotonic_ns();
    Shot shot;
    for (std::size_t channel = 0; channel < config.channels.size(); ++channel)
        painter.draw(channel);
    shot.tables_ms = static_cast<double>(tables_ns - begin_ns) * 1e-6;
    shot.draw_ms = static_cast<double>(clock.monotonic_ns() - tables_ns) * 1e-6;
    for (std::size_t channel = 0; channel < config.channels.size(); ++channel)
        shot.pictures.push_back(write_picture(painter, options, config, channel));
    shot.adaptation_cd_m2 = painter.adaptation_cd_m2();
    shot.renderer = painter.description();
    return shot;
}

Shot take_shot(const ShotOptions& options) {
    const server::SystemClock clock;
    const Still still = make_still(options.still, clock);
    Shot shot = draw_pictures(still, options, clock);
    if (!options.luminance_path.empty()) write_luminance(still, options, shot.pictures);
    shot.utc = server::ephemeris::to_iso(still.utc);
    shot.ephemeris = server::ephemeris::name_of(server::ephemeris_model(still.config));
    shot.leap_seconds_assumed = still.leap_seconds_assumed;
    shot.sky = server::sky_angles(still.scene);
    return shot;
}

void print_text(const Shot& shot) {
    for (const Picture& picture : shot.pictures) {
        fmt::print("{}  {}x{}\n", picture.path, picture.width_px, picture.height_px);
        if (!picture.luminance_path.empty()) fmt::print("{}\n", picture.luminance_path);
    }
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
        if (!picture.luminance_path.empty()) json["pictures"].back()["luminance"] = picture.luminance_path;
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
    } catch (const StillErrors&) {
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig shot: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
