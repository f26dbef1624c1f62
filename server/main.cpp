#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/config.h"
#include "config/key_log.h"
#include "config/reference/effective.h"
#include "server/bus_input.h"
#include "server/daemon.h"
#include "server/from_config.h"
#include "server/rig_part.h"
#include "server/standard_output.h"
#include "server/start_weather/start_weather.h"

namespace {

using skyig::server::DaemonOptions;

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

void declare(CLI::App& app, DaemonOptions& options) {
    app.add_option("--config", options.config_path, "the site's settings (TOML)")
        ->required()
        ->type_name("FILE");
    app.add_option("--node", options.node, "be this machine of the settings' rig, with its channels alone")
        ->type_name("NAME");
    app.add_flag("--check", options.check, "check the settings, say all that is wrong, and end");
    app.add_flag("--print-config", options.print_config,
                 "print the settings that hold, defaults as comments, and end");
    app.add_flag("--headless", options.headless, "no windows, whatever the settings say");
    app.add_option("--pattern", options.pattern,
                   "show this test pattern in all channels until the host asks for another")
        ->check(CLI::IsMember(std::vector<std::string>(skyig::config::kPatternNames.begin(),
                                                       skyig::config::kPatternNames.end())))
        ->type_name("NAME");
    app.add_option("--frames", options.frames, "end after N frames (0: run until SIGINT or SIGTERM)")
        // As signed numbers: a negative one would wrap to a count without end.
        ->check(CLI::Range(std::int64_t{0}, std::int64_t{1'000'000'000'000}))
        ->type_name("N");
    CLI::Option* out =
        app.add_option("--out", options.out_directory, "write the channels' images here")->type_name("DIR");
    app.add_option("--out-every", options.out_every, "write the images of every N-th frame only (1)")
        ->check(CLI::Range(1, 1'000'000'000))
        ->needs(out)
        ->type_name("N");
    app.add_option("--out-format", options.out_format,
                   "what they are: pictures as shown (png), or each pixel's light in cd/m2 (exr, pfm)")
        ->check(CLI::IsMember(
            std::vector<std::string>(skyig::server::kOutFormats.begin(), skyig::server::kOutFormats.end())))
        ->needs(out)
        ->type_name("NAME");
    app.add_option("--report", options.report_path, "write the report of the run here as JSON")
        ->type_name("FILE");
    CLI::Option* replay = app.add_option("--replay", options.replay_path,
                                         "run a recording (pcapng, pcap, candump log) instead of listening")
                              ->type_name("FILE");
    app.add_option("--speed", options.replay_speed,
                   "replay at so many times the recorded pace (0: as fast as it goes)")
        ->check(CLI::Range(0.0, 1000.0))
        ->needs(replay)
        ->type_name("X");
    app.add_option("--record", options.record_path, "record all input here as pcapng")->type_name("FILE");
    app.add_option("--hashes", options.hashes_path, "write a hash of each picture here, a line each")
        ->type_name("FILE");
    app.add_option("--times", options.times_path, "write each frame's times here, a line of CSV each")
        ->type_name("FILE");
    app.add_option("--events", options.events_path, "write the log here too, each line with its frame")
        ->type_name("FILE");
    app.add_flag("--log-json", options.log_json, "the log on stderr as JSON, an object a line");
    app.set_version_flag("--version", std::string("skyigd " SKYIG_VERSION));
    app.footer("Exit status: 0 done, 1 the work failed, 2 wrong usage or settings.");
}

/// The options, or the status to leave with after the text has been printed.
std::optional<DaemonOptions> read_command_line(int argc, char** argv, int& exit_status) {
    CLI::App app("skyigd: the sky of a flight simulator, served to a CIGI host.", "skyigd");
    DaemonOptions options;
    declare(app, options);
    try {
        app.parse(argc, argv);
        return options;
    } catch (const CLI::CallForHelp&) {
        fmt::print("{}", app.help());
    } catch (const CLI::CallForVersion& version) {
        fmt::print("{}\n", version.what());
    } catch (const CLI::ParseError& error) {
        fmt::print(stderr, "skyigd: {} (skyigd --help tells the options)\n", error.what());
        exit_status = kWrongUsage;
    }
    return std::nullopt;
}

int run(int argc, char** argv) {
    int exit_status = kDone;
    const std::optional<DaemonOptions> options = read_command_line(argc, argv, exit_status);
    if (!options) return exit_status;

    skyig::config::KeyLog keys;
    skyig::config::LoadResult loaded = skyig::config::load_config(options->config_path, &keys);
    for (const skyig::config::ConfigError& error : loaded.errors)
        fmt::print(stderr, "{}\n", skyig::config::to_text(error));
    if (!loaded.config) return kWrongUsage;
    if (!options->pattern.empty()) skyig::config::show_pattern(*loaded.config, options->pattern);
    skyig::server::ephemeris::EarthOrientationResult orientation =
        skyig::server::load_earth_orientation(*loaded.config, options->config_path);
    if (!orientation) {
        fmt::print(stderr, "{}\n", orientation.error);
        return kWrongUsage;
    }
    if (const std::string fault = skyig::server::identifier_fault(*loaded.config); !fault.empty()) {
        fmt::print(stderr, "{}: {}\n", options->config_path, fault);
        return kWrongUsage;
    }
    if (const std::string fault =
            skyig::server::RigPart::fault(*loaded.config, options->node, !options->replay_path.empty());
        !fault.empty()) {
        fmt::print(stderr, "{}: {}\n", options->config_path, fault);
        return kWrongUsage;
    }
    if (const std::string fault = skyig::server::metar_fault(*loaded.config, options->config_path);
        !fault.empty()) {
        fmt::print(stderr, "{}\n", fault);
        return kWrongUsage;
    }
    if (const std::string left_out = skyig::server::metar_left_out(*loaded.config, options->config_path);
        !left_out.empty()) {
        fmt::print(stderr, "warning: {}\n", left_out);
    }
    if (options->print_config) {
        fmt::print("# {} as skyigd {} reads it; comments hold what is left out\n{}", options->config_path,
                   SKYIG_VERSION, skyig::config::reference::effective_text(keys));
        return kDone;
    }
    if (options->check) {
        fmt::print("{}\n", skyig::config::describe(*loaded.config));
        return kDone;
    }
    return skyig::server::run_daemon(*options, *loaded.config, keys, std::move(*orientation.orientation));
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return skyig::server::finish_standard_output("skyigd", run(argc, argv));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "skyigd: %s\n", error.what());
        return kFailed;
    }
}
