#include "clients/skyig/still/still_command.h"

#include <algorithm>
#include <string>
#include <vector>

#include "clients/skyig/validators.h"
#include "config/pattern.h"
#include "render/sky_settings.h"

namespace skyig::clients {

void add_still(CLI::App& verb, StillOptions& options) {
    CLI::Option* config =
        verb.add_option("--config", options.config_path, "settings to start from (TOML); all their channels")
            ->type_name("FILE");
    verb.add_option("--lat", options.latitude_deg, "latitude, degrees north")->check(finite_in(-90.0, 90.0));
    verb.add_option("--lon", options.longitude_deg, "longitude, degrees east")
        ->check(finite_in(-360.0, 360.0));
    verb.add_option("--alt", options.height_m, "height above the WGS84 ellipsoid, metres")
        ->check(finite_in(-430.0, 1e8));
    verb.add_option("--utc", options.utc, "UTC, as 2026-06-21T19:30:00Z")
        ->check(utc_time())
        ->type_name("TIME");
    verb.add_option("--heading", options.heading_deg, "degrees from true north")
        ->check(finite_in(-360.0, 360.0));
    verb.add_option("--pitch", options.pitch_deg, "degrees nose up")->check(finite_in(-90.0, 90.0));
    verb.add_option("--roll", options.roll_deg, "degrees right wing down")->check(finite_in(-180.0, 180.0));
    verb.add_option("--speed", options.speed_m_s,
                    "along the heading, metres a second: rain streaks by it (0)")
        ->check(finite_in(0.0, 1000.0));
    verb.add_option("--visibility-m", options.visibility_m, "visibility at the ground, metres")
        ->check(finite_in(10.0, 400'000.0));
    CLI::Option* preset = verb.add_option("--weather", options.weather_preset,
                                          "ready-made weather (cavok, few ... cat3b), or a file of such")
                              ->type_name("PRESET");
    verb.add_option("--metar", options.metar, "a weather report, in quotes")
        ->check(CLI::Validator(
            [](std::string& text) { return text.empty() ? "is empty; it must be a weather report" : ""; },
            {}))
        ->type_name("TEXT")
        ->excludes(preset);
    verb.add_option("--elevation", options.elevation_m,
                    "height that those of a preset or report count from, metres above the ellipsoid")
        ->check(finite_in(-500.0, 9000.0));
    const auto take_model = [&options](const std::string& name) {
        const auto* const at = std::find(render::kSkyModelNames.begin(), render::kSkyModelNames.end(), name);
        options.sky_model = static_cast<config::SkyModel>(at - render::kSkyModelNames.begin());
    };
    verb.add_option_function<std::string>("--sky", take_model,
                                          "model of the day sky (the settings', or multi)")
        ->check(sky_model_name())
        ->type_name("MODEL");
    verb.add_option("--pattern", options.pattern, "a test pattern in place of the sky, in all channels")
        ->check(CLI::IsMember(
            std::vector<std::string>(config::kPatternNames.begin(), config::kPatternNames.end())))
        ->type_name("NAME");
    verb.add_option("--width", options.width_px, "pixels across (1280)")
        ->check(CLI::Range(1, 16384))
        ->excludes(config);
    verb.add_option("--height", options.height_px, "pixels down (1024)")
        ->check(CLI::Range(1, 16384))
        ->excludes(config);
    verb.add_option("--fov", options.fov_deg, "degrees across (60)")
        ->check(finite_in(0.1, 170.0))
        ->excludes(config);
}

}  // namespace skyig::clients
