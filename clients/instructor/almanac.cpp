#include "clients/instructor/almanac.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "server/ephemeris/events/event_sky.h"
#include "server/ephemeris/events/events.h"

namespace skyig::clients::instructor {

namespace ephemeris = server::ephemeris;
namespace events = server::ephemeris::events;
using Json = nlohmann::ordered_json;

namespace {

constexpr double kDay_s = 86'400.0;
constexpr int kStep_min = 15;

double elevation_deg(const glm::dvec3& direction_enu) noexcept {
    const double degrees =
        180.0 / std::numbers::pi * std::atan2(direction_enu.z, std::hypot(direction_enu.x, direction_enu.y));
    return std::round(degrees * 100.0) / 100.0;
}

}  // namespace

std::string almanac_text(const ephemeris::UtcClockTime& day, const ephemeris::Geodetic& site) {
    events::TimeSpan span{day, day};
    span.from.advance(-day.second_of_day());
    span.to = span.from;
    span.to.advance(kDay_s);
    constexpr std::array kBodies{ephemeris::Body::kSun, ephemeris::Body::kMoon};
    Json json{{"type", "almanac"},
              {"date", ephemeris::to_iso(span.from).substr(0, 10)},
              {"latitude_deg", site.latitude_deg},
              {"longitude_deg", site.longitude_deg},
              {"solar_h", site.longitude_deg / 15.0},
              {"step_min", kStep_min},
              {"events", Json::array()},
              {"sun", Json::array()},
              {"moon", Json::array()}};
    for (const events::Event& event : events::find_local_events(span, site, {kBodies, true}))
        json["events"].push_back({{"utc", ephemeris::to_iso(event.time)},
                                  {"body", ephemeris::name_of(event.body)},
                                  {"kind", events::name_of(event.kind)}});
    events::EventSky sky(span.from, site, ephemeris::Model::kErfa);
    for (int minute = 0; minute <= 24 * 60; minute += kStep_min) {
        const ephemeris::SkyState state = sky.state_at(60.0 * minute);
        json["sun"].push_back(elevation_deg(state.sun.direction_enu));
        json["moon"].push_back(elevation_deg(state.moon.direction_enu));
    }
    return json.dump();
}

}  // namespace skyig::clients::instructor
