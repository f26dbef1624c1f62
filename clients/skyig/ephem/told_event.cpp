#include "clients/skyig/ephem/told_event.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clients/skyig/ephem/told_angle.h"

namespace skyig::clients::ephem {

using namespace server::ephemeris;

std::string told_time(const UtcClockTime& time) {
    UtcClockTime rounded = time;
    rounded.advance(0.5);
    return to_iso(rounded);
}

std::string event_line(const events::Event& event) {
    std::string kind(events::name_of(event.kind));
    std::replace(kind.begin(), kind.end(), '_', ' ');
    std::string text = fmt::format("{}  {:<8} {:<18}", told_time(event.time), name_of(event.body), kind);
    if (std::isfinite(event.azimuth_deg))
        text += fmt::format("azimuth {}  elevation {:5.1f}", told_in_circle(event.azimuth_deg, 1, 5),
                            event.elevation_deg);
    text.erase(text.find_last_not_of(' ') + 1);
    return text + '\n';
}

nlohmann::ordered_json event_json(const events::Event& event) {
    nlohmann::ordered_json json{{"utc", told_time(event.time)},
                                {"event", events::name_of(event.kind)},
                                {"body", name_of(event.body)}};
    if (std::isfinite(event.azimuth_deg)) {
        json["azimuth_deg"] = event.azimuth_deg;
        json["elevation_deg"] = event.elevation_deg;
    }
    return json;
}

}  // namespace skyig::clients::ephem
