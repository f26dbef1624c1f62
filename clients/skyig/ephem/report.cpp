#include "clients/skyig/ephem/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <utility>

#include "render/night/star_catalogue.h"
#include "render/sky/refraction.h"
#include "server/ephemeris/angles.h"
#include "server/ephemeris/places.h"
#include "server/ephemeris/star_place.h"

namespace skyig::clients::ephem {

using namespace server::ephemeris;

namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

/// All that moves a star but its parallax, which the catalogue lacks.
StarPlace place_star(const NamedStar& named, const SkyState& state, bool from_site) {
    const render::night::CatalogueStar& star = *render::night::find_star(named.hr);
    const glm::dvec3 seen = star_direction({.direction_gcrs = glm::dvec3(star.direction_gcrs),
                                            .proper_motion_rad_yr = glm::dvec3(star.proper_motion_rad_yr)},
                                           state);
    const Equatorial equatorial = equatorial_of_date(state, seen);
    StarPlace place;
    place.star = named;
    place.right_ascension_deg = in_circle_deg(equatorial.right_ascension_rad);
    place.declination_deg = equatorial.declination_rad * kDegPerRad;
    place.magnitude = static_cast<double>(star.vmag);
    if (from_site) {
        const Horizontal horizontal = horizontal_of(seen);
        place.horizontal = {in_circle_deg(horizontal.azimuth_rad), horizontal.elevation_rad * kDegPerRad};
    }
    return place;
}

/// The first of each kind and body, in order of time.
std::vector<events::Event> next_events(const ReportRequest& request) {
    constexpr std::array kBodiesAhead{Body::kSun, Body::kMoon};
    events::TimeSpan span{request.utc, request.utc};
    span.to.advance(kLookAhead_s);
    std::vector<events::Event> next;
    for (const events::Event& event :
         events::find_local_events(span, *request.site, {.bodies = kBodiesAhead}, request.model)) {
        const auto same = [&](const events::Event& other) {
            return other.kind == event.kind && other.body == event.body;
        };
        if (std::none_of(next.begin(), next.end(), same)) next.push_back(event);
    }
    return next;
}

}  // namespace

Report make_report(const ReportRequest& request) {
    Report report;
    report.request = request;
    report.offsets = known_offsets(request.utc);
    report.instant = make_instant(request.utc);
    SkyState state = sky_of(report.instant, request.site, request.model);
    // The Earth's centre is an eye that moves with it.
    if (!request.site) state.eye_velocity_c = state.earth_velocity_c;
    for (const Body body : request.bodies)
        report.bodies.push_back(place_in(state, body, request.site.has_value()));
    for (const NamedStar& star : request.stars)
        report.stars.push_back(place_star(star, state, request.site.has_value()));
    report.sun_obscured = state.sun.obscured;
    report.moon_sunlit = state.moon.sunlit;
    if (!request.site) return report;

    const render::sky::RefractionRow row = render::sky::Refraction().at(
        request.site->height_m, request.air.pressure_hpa, request.air.temperature_c);
    const auto refracted_deg = [&row](double elevation_deg) {
        return row.apparent_from_true(elevation_deg / kDegPerRad) * kDegPerRad;
    };
    for (const BodyPlace& place : report.bodies)
        report.refracted_elevations_deg.push_back(refracted_deg(place.horizontal->elevation_deg));
    for (StarPlace& place : report.stars)
        place.refracted_elevation_deg = refracted_deg(place.horizontal->elevation_deg);
    report.next = next_events(request);
    return report;
}

}  // namespace skyig::clients::ephem
