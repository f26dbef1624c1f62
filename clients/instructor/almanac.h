// Sun and Moon over one day at a site, for a page to draw.
#pragma once

#include <string>

#include "server/ephemeris/sky_state.h"
#include "server/ephemeris/time.h"

namespace skyig::clients::instructor {

/// One JSON object: "date"; "events" of that UTC day in their order (time, body, kind as skyig ephem names
/// them); "step_min" and elevations of "sun" and "moon" from 0 h on (airless, degrees); "solar_h", how far
/// the site's mean time is before UTC. Ten milliseconds.
[[nodiscard]] std::string almanac_text(const server::ephemeris::UtcClockTime& day,
                                       const server::ephemeris::Geodetic& site);

}  // namespace skyig::clients::instructor
