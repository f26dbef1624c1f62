#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clients/skyig/ephem/report.h"
#include "clients/skyig/ephem/told_angle.h"
#include "clients/skyig/ephem/told_event.h"

namespace skyig::clients::ephem {

using namespace server::ephemeris;

namespace {

std::string hours(double angle_deg) {
    const auto tenths = static_cast<long>(std::lround(angle_deg / 15.0 * 36000.0)) % 864000L;
    return fmt::format("{:02}h{:02}m{:04.1f}s", tenths / 36000, tenths / 600 % 60,
                       static_cast<double>(tenths % 600) / 10.0);
}

std::string degrees(double angle_deg) {
    const auto seconds = static_cast<long>(std::lround(std::abs(angle_deg) * 3600.0));
    return fmt::format("{}{:02}\u00b0{:02}'{:02}\"", angle_deg < 0.0 ? '-' : '+', seconds / 3600,
                       seconds / 60 % 60, seconds % 60);
}

std::string horizontal_text(const std::optional<BodyPlace::Horizontal>& place, double seen_deg) {
    if (!place) return {};
    return fmt::format("{} {:9.3f} {:9.3f}  ", told_in_circle(place->azimuth_deg, 3, 9), place->elevation_deg,
                       seen_deg);
}

/// Wide enough for every name.
std::size_t name_width(const Report& report) {
    std::size_t width = 10;
    for (const StarPlace& place : report.stars)
        width = std::max(width, place.star.name.size() + 1);
    return width;
}

std::string body_line(const Report& report, std::size_t index, std::size_t width) {
    const BodyPlace& place = report.bodies[index];
    const double seen_deg = place.horizontal ? report.refracted_elevations_deg[index] : 0.0;
    return fmt::format("{:<{}}{}{} {}  {:>14.0f} {:9.1f} {:6.2f} {:7.2f}\n", name_of(place.body), width,
                       horizontal_text(place.horizontal, seen_deg), hours(place.right_ascension_deg),
                       degrees(place.declination_deg), place.range_km, 2.0 * place.semidiameter_arcsec,
                       100.0 * place.illuminated_fraction, place.magnitude);
}

std::string star_line(const StarPlace& place, std::size_t width) {
    return fmt::format("{:<{}}{}{} {}  {:>14} {:>9} {:>6} {:7.2f}\n", place.star.name, width,
                       horizontal_text(place.horizontal, place.refracted_elevation_deg.value_or(0.0)),
                       hours(place.right_ascension_deg), degrees(place.declination_deg), "", "", "",
                       place.magnitude);
}

std::string site_line(const std::optional<Geodetic>& site) {
    if (!site) return "from the Earth's centre\n";
    return fmt::format("from {:.6f}\u00b0 {} {:.6f}\u00b0 {}, {:.0f} m above the ellipsoid\n",
                       std::abs(site->latitude_deg), site->latitude_deg < 0.0 ? 'S' : 'N',
                       std::abs(site->longitude_deg), site->longitude_deg < 0.0 ? 'W' : 'E', site->height_m);
}

std::string next_lines(const Report& report) {
    if (!report.request.site) return {};
    std::string text = fmt::format("\nwithin {:.0f} hours\n", kLookAhead_s / 3600.0);
    for (const events::Event& event : report.next)
        text += event_line(event);
    if (report.next.empty()) text += "nothing rises or sets\n";
    return text;
}

}  // namespace

std::string to_text(const Report& report) {
    std::string text =
        fmt::format("{}  TT-UTC {:.3f} s  UT1-UTC {:+.3f} s  model {}\n", to_iso(report.request.utc, 3),
                    report.offsets.tt_minus_utc_s, report.offsets.ut1_minus_utc_s,
                    kModelNames[static_cast<std::size_t>(report.request.model)]);
    text += site_line(report.request.site);
    const std::string_view sky = report.request.site ? "  azimuth elevation   seen at  " : "";
    const std::size_t width = name_width(report);
    text += fmt::format("\n{:<{}}{}{:<12}{:<12} {:>14} {:>9} {:>6} {:>7}\n", "", width, sky, "RA of date",
                        "Dec of date", "km", "diam \"", "lit %", "mag");
    for (std::size_t i = 0; i < report.bodies.size(); ++i)
        text += body_line(report, i, width);
    for (const StarPlace& place : report.stars)
        text += star_line(place, width);
    if (report.sun_obscured > 0.0)
        text += fmt::format("\nThe Moon covers {:.2f} % of the Sun.\n", 100.0 * report.sun_obscured);
    if (report.moon_sunlit < 1.0)
        text += fmt::format("\nThe Earth's shadow leaves {:.2f} % of its sunlight to the Moon.\n",
                            100.0 * report.moon_sunlit);
    return text + next_lines(report);
}

}  // namespace skyig::clients::ephem
