// The daemon put together from its parts, and run.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "config/config.h"
#include "config/key_log.h"
#include "server/ephemeris/earth_orientation.h"

namespace skyig::server {

/// Pictures as shown, or their light before eye and display. \see LightFiles
inline constexpr std::array<std::string_view, 3> kOutFormats{"png", "exr", "pfm"};

struct DaemonOptions {
    std::string config_path;
    /// Which machine of the settings' rig this one is; empty: it draws all channels itself.
    std::string node;
    /// Only check the settings.
    bool check = false;
    /// Only print the settings that hold.
    bool print_config = false;
    /// No windows, whatever the settings say.
    bool headless = false;
    /// Test pattern that all channels show at first, one of config::kPatternNames; empty: as the settings
    /// say.
    std::string pattern;
    /// Frames to draw before a clean end; 0 = until a signal comes.
    std::uint64_t frames = 0;
    /// Directory for the channels' images; empty = none.
    std::string out_directory;
    /// Every how many frames images are written, at least 1.
    std::uint64_t out_every = 1;
    /// What images are written as, one of kOutFormats.
    std::string out_format = "png";
    /// File for the report as JSON; empty = none.
    std::string report_path;
    /// Recording to run instead of listening; empty = none.
    std::string replay_path;
    /// Of the recorded pace; 0 = as fast as it goes.
    double replay_speed = 0.0;
    /// File that all input is recorded in; empty = none.
    std::string record_path;
    /// File for one line a frame and channel with the picture's hash; empty = none.
    std::string hashes_path;
    /// File for one line of CSV a frame with its times; empty = none.
    std::string times_path;
    /// The log's lines on stderr are objects of JSON.
    bool log_json = false;
    /// File for the log's lines with the frames that they came in; empty = none.
    std::string events_path;
};

/// Runs until the frames asked for are done or SIGINT or SIGTERM comes; then tells the report on stdout.
/// \param keys  those of the settings, to tell later settings from
/// \param orientation  what load_earth_orientation() gives
/// \return the exit status: 0, or 1 after one line on stderr when something the work needs is missing (a
/// port, a display, a directory)
[[nodiscard]] int run_daemon(const DaemonOptions& options, const config::Config& config,
                             const config::KeyLog& keys, ephemeris::EarthOrientation orientation = {});

}  // namespace skyig::server
