// One moment's sky, told to people or to programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/skyig/ephem/air.h"
#include "clients/skyig/ephem/body_place.h"
#include "clients/skyig/ephem/star_name.h"
#include "server/ephemeris/events/events.h"
#include "server/ephemeris/time.h"

namespace skyig::clients::ephem {

struct ReportRequest {
    server::ephemeris::UtcClockTime utc;
    /// The Earth's centre if not given.
    std::optional<server::ephemeris::Geodetic> site;
    std::vector<server::ephemeris::Body> bodies;
    std::vector<NamedStar> stars;
    server::ephemeris::Model model = server::ephemeris::Model::kSeries;
    AirSettings air{};
};

struct StarPlace {
    NamedStar star;
    double right_ascension_deg = 0.0;
    double declination_deg = 0.0;
    double magnitude = 0.0;
    std::optional<BodyPlace::Horizontal> horizontal;
    std::optional<double> refracted_elevation_deg;
};

struct Report {
    ReportRequest request;
    server::ephemeris::Instant instant;
    server::ephemeris::KnownOffsets offsets;
    std::vector<BodyPlace> bodies;
    /// In the order of `bodies`; empty without a site.
    std::vector<double> refracted_elevations_deg;
    std::vector<StarPlace> stars;
    /// Part of the Sun's disc that the Moon covers.
    double sun_obscured = 0.0;
    /// Part of the sunlight that the Earth's shadow leaves to the Moon.
    double moon_sunlit = 1.0;
    /// The first of each kind for Sun and Moon within kLookAhead_s; empty without a site.
    std::vector<server::ephemeris::events::Event> next;
};

inline constexpr double kLookAhead_s = 36.0 * 3600.0;

[[nodiscard]] Report make_report(const ReportRequest& request);
[[nodiscard]] std::string to_text(const Report& report);
[[nodiscard]] std::string to_json(const Report& report);

}  // namespace skyig::clients::ephem
