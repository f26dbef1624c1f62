// One moment without a network: the settings as the options change them, and the scene that follows.
#pragma once

#include "clients/skyig/options.h"
#include "config/config.h"
#include "render/scene.h"
#include "server/clock.h"
#include "server/ephemeris/time.h"

namespace skyig::clients {

struct Still {
    config::Config config;
    server::ephemeris::UtcClockTime utc;
    render::Scene scene;
    bool leap_seconds_assumed = false;
};

/// The settings are wrong; each error has been told on stderr: exit status 2.
struct StillErrors {};

/// Tells on stderr when the date is beyond the ephemeris. \throws StillErrors
[[nodiscard]] Still make_still(const StillOptions& options, const server::Clock& clock);

}  // namespace skyig::clients
