// Events as lines and JSON, the same wherever they are told.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "server/ephemeris/events/events.h"
#include "server/ephemeris/time.h"

namespace skyig::clients::ephem {

/// "2026-06-21T19:30:00Z", to the nearest second.
[[nodiscard]] std::string told_time(const server::ephemeris::UtcClockTime& time);

/// Time, body, what happens, and where at the site; ends with a line end.
[[nodiscard]] std::string event_line(const server::ephemeris::events::Event& event);

[[nodiscard]] nlohmann::ordered_json event_json(const server::ephemeris::events::Event& event);

}  // namespace skyig::clients::ephem
