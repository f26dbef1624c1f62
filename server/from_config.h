// The site's settings in the words of those that work with them.
#pragma once

#include <string>
#include <vector>

#include "config/config.h"
#include "render/channel.h"
#include "render/display.h"
#include "render/quality.h"
#include "render/scene.h"
#include "server/clock.h"
#include "server/ephemeris/bodies.h"
#include "server/ephemeris/earth_orientation.h"
#include "server/ephemeris/time.h"

namespace skyig::server {

/// The instant that a configured start means: that one, or the system's where the settings say "now".
[[nodiscard]] ephemeris::UtcClockTime start_time(const config::Start& start, const Clock& clock);

[[nodiscard]] std::vector<render::Channel> render_channels(const config::Config& config);

/// Those of a machine of a rig: the others are drawn elsewhere. An empty name: all are its own.
[[nodiscard]] std::vector<render::Channel> render_channels(const config::Config& config,
                                                           const std::string& node);

[[nodiscard]] ephemeris::Model ephemeris_model(const config::Config& config) noexcept;

/// The file that the settings name, read and checked; without one, one that knows nothing. Its error is a
/// line that names the key too; `settings_file` only names the settings in it.
[[nodiscard]] ephemeris::EarthOrientationResult load_earth_orientation(const config::Config& config,
                                                                       const std::string& settings_file);

[[nodiscard]] render::SkySettings sky_settings(const config::Sky& sky) noexcept;

[[nodiscard]] render::NightSettings night_settings(const config::Night& night) noexcept;

/// What the settings say of the ground; wind and waves are the world's.
[[nodiscard]] render::Ground ground_settings(const config::Ground& ground) noexcept;

/// Air of a description without a world around it.
[[nodiscard]] render::Air air_settings(const config::Air& air) noexcept;

[[nodiscard]] render::DisplaySettings display_settings(const config::Config& config);

[[nodiscard]] render::Quality quality(const config::Config& config);

[[nodiscard]] render::Thin thin_of(config::Thinning thinning) noexcept;

}  // namespace skyig::server
