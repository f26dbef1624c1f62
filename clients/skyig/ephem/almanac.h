// What happens in the sky over some days, told to people or to programs.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/ephemeris/events/eclipses.h"
#include "server/ephemeris/events/events.h"

namespace skyig::clients::ephem {

/// "2026-06-01..2026-06-30", both days included, or times in place of days. Nothing when it has another form,
/// ends before it begins, or leaves the years that are known.
[[nodiscard]] std::optional<server::ephemeris::events::TimeSpan> parse_span(std::string_view text);

struct AlmanacRequest {
    server::ephemeris::events::TimeSpan span;
    /// Without it phases and seasons only.
    std::optional<server::ephemeris::Geodetic> site;
    /// Whose rise, set and transit.
    std::vector<server::ephemeris::Body> bodies;
    /// Airless elevation of the upper limb at rise and set.
    double horizon_rad = server::ephemeris::events::kAlmanacHorizon_rad;
    server::ephemeris::Model model = server::ephemeris::Model::kSeries;
};

struct Almanac {
    AlmanacRequest request;
    std::vector<server::ephemeris::events::Event> events;
    std::vector<server::ephemeris::events::SolarEclipse> solar_eclipses;
    std::vector<server::ephemeris::events::LunarEclipse> lunar_eclipses;
};

[[nodiscard]] Almanac make_almanac(const AlmanacRequest& request);
[[nodiscard]] std::string to_text(const Almanac& almanac);
[[nodiscard]] std::string to_json(const Almanac& almanac);

}  // namespace skyig::clients::ephem
