#include "clients/skyig/ephem/almanac.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "clients/row_time.h"
#include "clients/skyig/ephem/told_event.h"

namespace skyig::clients::ephem {

using namespace server::ephemeris;
using Json = nlohmann::ordered_json;

namespace {

constexpr std::size_t kDateLength = 10;

std::optional<UtcClockTime> parse_end(std::string_view text, bool whole_day) {
    if (text.size() != kDateLength) return parse_utc(text);
    std::optional<UtcClockTime> day = parse_utc(fmt::format("{}T00:00:00Z", text));
    if (day && whole_day) {
        // By the clock, not by seconds: a day may have one more.
        const std::int32_t mjd = day->mjd();
        day->advance(86400.5);
        if (day->mjd() == mjd) day->advance(1.0);
        day->advance(-day->second_of_day());
    }
    return day;
}

/// A moment of an eclipse as a line; the eclipsed body's elevation says whether it is seen.
struct Line {
    UtcClockTime time;
    std::string text;
};

void add_contact(std::vector<Line>& lines, std::string_view body, const events::Contact& contact,
                 const std::string& what) {
    lines.push_back({contact.time, fmt::format("{}  {:<8} {:<46}elevation {:5.1f}\n", told_time(contact.time),
                                               body, what, contact.elevation_deg)});
}

void add_lines(std::vector<Line>& lines, const events::SolarEclipse& eclipse) {
    const std::string_view kind = events::kSolarEclipseNames[static_cast<std::size_t>(eclipse.kind)];
    add_contact(lines, "sun", eclipse.first, fmt::format("{} eclipse begins", kind));
    if (eclipse.second) add_contact(lines, "sun", *eclipse.second, fmt::format("{} phase begins", kind));
    add_contact(lines, "sun", eclipse.maximum,
                fmt::format("eclipse maximum {:.3f}, {:.1f} % covered", eclipse.magnitude,
                            100.0 * eclipse.obscuration));
    if (eclipse.third) add_contact(lines, "sun", *eclipse.third, fmt::format("{} phase ends", kind));
    add_contact(lines, "sun", eclipse.fourth, "eclipse ends");
}

void add_lines(std::vector<Line>& lines, const events::LunarEclipse& eclipse) {
    const std::string_view kind = events::kLunarEclipseNames[static_cast<std::size_t>(eclipse.kind)];
    const auto add = [&lines](const std::optional<events::Contact>& contact, const std::string& what) {
        if (contact) add_contact(lines, "moon", *contact, what);
    };
    add(eclipse.penumbra_begins, fmt::format("{} eclipse, penumbra begins", kind));
    add(eclipse.umbra_begins, "umbra begins");
    add(eclipse.totality_begins, "totality begins");
    add(eclipse.maximum, fmt::format("eclipse maximum, umbra {:.3f} penumbra {:.3f}",
                                     eclipse.umbral_magnitude, eclipse.penumbral_magnitude));
    add(eclipse.totality_ends, "totality ends");
    add(eclipse.umbra_ends, "umbra ends");
    add(eclipse.penumbra_ends, "penumbra ends");
}

Json contact_json(const events::Contact& contact) {
    return {{"utc", told_time(contact.time)}, {"elevation_deg", contact.elevation_deg}};
}

Json contact_json(const std::optional<events::Contact>& contact) {
    return contact ? contact_json(*contact) : Json(nullptr);
}

Json eclipse_json(const events::SolarEclipse& eclipse) {
    return {{"kind", events::kSolarEclipseNames[static_cast<std::size_t>(eclipse.kind)]},
            {"first_contact", contact_json(eclipse.first)},
            {"second_contact", contact_json(eclipse.second)},
            {"maximum", contact_json(eclipse.maximum)},
            {"third_contact", contact_json(eclipse.third)},
            {"fourth_contact", contact_json(eclipse.fourth)},
            {"magnitude", eclipse.magnitude},
            {"obscuration", eclipse.obscuration},
            {"seen_obscuration", eclipse.seen_obscuration}};
}

Json eclipse_json(const events::LunarEclipse& eclipse) {
    return {{"kind", events::kLunarEclipseNames[static_cast<std::size_t>(eclipse.kind)]},
            {"penumbra_begins", contact_json(eclipse.penumbra_begins)},
            {"umbra_begins", contact_json(eclipse.umbra_begins)},
            {"totality_begins", contact_json(eclipse.totality_begins)},
            {"maximum", contact_json(eclipse.maximum)},
            {"totality_ends", contact_json(eclipse.totality_ends)},
            {"umbra_ends", contact_json(eclipse.umbra_ends)},
            {"penumbra_ends", contact_json(eclipse.penumbra_ends)},
            {"umbral_magnitude", eclipse.umbral_magnitude},
            {"penumbral_magnitude", eclipse.penumbral_magnitude}};
}

template <typename T>
Json all_json(const std::vector<T>& things, Json (*one)(const T&)) {
    Json list = Json::array();
    for (const T& thing : things)
        list.push_back(one(thing));
    return list;
}

}  // namespace

std::optional<events::TimeSpan> parse_span(std::string_view text) {
    const std::size_t dots = text.find("..");
    if (dots == std::string_view::npos) return std::nullopt;
    const std::optional<UtcClockTime> from = parse_end(text.substr(0, dots), false);
    const std::optional<UtcClockTime> to = parse_end(text.substr(dots + 2), true);
    if (!from || !to || seconds_between(*from, *to) <= 0.0) return std::nullopt;
    UtcClockTime last = *to;
    last.advance(-1.0);
    if (make_instant(*from).clamped || make_instant(last).clamped) return std::nullopt;
    return events::TimeSpan{*from, *to};
}

Almanac make_almanac(const AlmanacRequest& request) {
    Almanac almanac;
    almanac.request = request;
    if (request.site) {
        almanac.events = events::find_local_events(
            request.span, *request.site,
            {.bodies = request.bodies, .twilights = true, .horizon_rad = request.horizon_rad}, request.model);
        almanac.solar_eclipses = events::find_solar_eclipses(request.span, *request.site, request.model);
        almanac.lunar_eclipses = events::find_lunar_eclipses(request.span, *request.site, request.model);
    }
    for (const auto& more : {events::find_moon_phases(request.span, request.model),
                             events::find_seasons(request.span, request.model)})
        almanac.events.insert(almanac.events.end(), more.begin(), more.end());
    std::stable_sort(
        almanac.events.begin(), almanac.events.end(),
        [](const events::Event& a, const events::Event& b) { return seconds_between(a.time, b.time) > 0.0; });
    return almanac;
}

std::string to_text(const Almanac& almanac) {
    std::vector<Line> lines;
    for (const events::Event& event : almanac.events)
        lines.push_back({event.time, event_line(event)});
    for (const events::SolarEclipse& eclipse : almanac.solar_eclipses)
        add_lines(lines, eclipse);
    for (const events::LunarEclipse& eclipse : almanac.lunar_eclipses)
        add_lines(lines, eclipse);
    std::stable_sort(lines.begin(), lines.end(),
                     [](const Line& a, const Line& b) { return seconds_between(a.time, b.time) > 0.0; });
    std::string text;
    for (const Line& line : lines)
        text += line.text;
    return text;
}

std::string to_json(const Almanac& almanac) {
    Json json{{"from", told_time(almanac.request.span.from)}, {"to", told_time(almanac.request.span.to)}};
    json["model"] = kModelNames[static_cast<std::size_t>(almanac.request.model)];
    json["site"] = nullptr;
    if (almanac.request.site) {
        json["site"] = {{"latitude_deg", almanac.request.site->latitude_deg},
                        {"longitude_deg", almanac.request.site->longitude_deg},
                        {"height_m", almanac.request.site->height_m}};
    }
    json["events"] = all_json(almanac.events, event_json);
    json["solar_eclipses"] = all_json<events::SolarEclipse>(almanac.solar_eclipses, eclipse_json);
    json["lunar_eclipses"] = all_json<events::LunarEclipse>(almanac.lunar_eclipses, eclipse_json);
    return json.dump(2) + '\n';
}

}  // namespace skyig::clients::ephem
