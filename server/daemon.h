// The daemon put together from its parts, and run.
#pragma once

#include <cstdint>
#include <string>

#include "config/config.h"
#include "server/ephemeris/earth_orientation.h"

namespace skyig::server {

struct DaemonOptions {
    std::string config_path;
    /// Only check the settings.
    bool check = false;
    /// Frames to draw before a clean end; 0 = until a signal comes.
    std::uint64_t frames = 0;
    /// Directory for the channels' images; empty = none.
    std::string out_directory;
    /// Every how many frames images are written, at least 1.
    std::uint64_t out_every = 1;
    /// File for the report as JSON; empty = none.
    std::string report_path;
};

/// Runs until the frames asked for are done or SIGINT or SIGTERM comes; then tells the report on stdout.
/// \param orientation  what load_earth_orientation() gives
/// \return the exit status: 0, or 1 after one line on stderr when something the work needs is missing (a
/// port, a display, a directory)
[[nodiscard]] int run_daemon(const DaemonOptions& options, const config::Config& config,
                             ephemeris::EarthOrientation orientation = {});

}  // namespace skyig::server
