#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "server/ephemeris/earth_frame.h"
#include "server/ephemeris/events/event_sky.h"
#include "server/ephemeris/events/events.h"
#include "server/ephemeris/events/roots.h"
#include "server/ephemeris/places.h"

namespace skyig::server::ephemeris::events {
namespace {

constexpr double kDay_s = 86400.0;
constexpr double kTimeTolerance_s = 0.01;
constexpr double kQuarter_rad = std::numbers::pi / 2.0;

/// Apparent, geocentric, true ecliptic and equinox of date.
struct EclipticLongitudes {
    double sun_rad = 0.0;
    double moon_rad = 0.0;
};

EclipticLongitudes ecliptic_longitudes(const JulianDate& tt, Model model) noexcept {
    const GeocentricPlaces places = compute_geocentric(tt, model);
    const double obliquity_rad = earth_frame(tt, model).true_obliquity_rad;
    const double sine = std::sin(obliquity_rad);
    const double cosine = std::cos(obliquity_rad);
    const auto longitude_rad = [sine, cosine](const glm::dvec3& equatorial) {
        return std::atan2(equatorial.y * cosine + equatorial.z * sine, equatorial.x);
    };
    return {longitude_rad(places.of(Body::kSun).direction), longitude_rad(places.of(Body::kMoon).direction)};
}

/// Steps through the span and one step beyond either end; `visit(from_s, to_s)`.
template <typename Visit>
void walk(double length_s, double step_s, const Visit& visit) {
    const auto steps = static_cast<std::int64_t>(std::ceil(length_s / step_s)) + 1;
    for (std::int64_t step = -1; step < steps; ++step)
        visit(static_cast<double>(step) * step_s, static_cast<double>(step + 1) * step_s);
}

/// Where `angle_rad(seconds)` is a whole number of quarter turns; the angle grows, and by less than half a
/// turn a step.
template <typename Angle>
void find_quarters(EventSky& sky, double length_s, double step_s, const Angle& angle_rad,
                   const std::array<EventKind, 4>& kinds, Body body, std::vector<Event>& found) {
    double from_rad = angle_rad(-step_s);
    walk(length_s, step_s, [&](double from_s, double to_s) {
        const double to_rad = angle_rad(to_s);
        for (std::size_t quarter = 0; quarter < kinds.size(); ++quarter) {
            const double target_rad = static_cast<double>(quarter) * kQuarter_rad;
            const auto off = [&](double angle) {
                return std::remainder(angle - target_rad, 2.0 * std::numbers::pi);
            };
            const bool passed =
                off(from_rad) < 0.0 && off(to_rad) >= 0.0 && off(to_rad) - off(from_rad) < std::numbers::pi;
            if (!passed) continue;
            const auto off_at = [&](double seconds) { return off(angle_rad(seconds)); };
            const double seconds =
                zero_between(off_at, from_s, off(from_rad), to_s, off(to_rad), kTimeTolerance_s);
            found.push_back({.time = sky.time_at(seconds), .kind = kinds[quarter], .body = body});
        }
        from_rad = to_rad;
    });
}

/// Speed at which the Sun goes away from the Earth's centre, km/s.
double sun_recession_km_s(const EventSky& sky, double seconds) {
    constexpr double kHalf_s = 3600.0;
    const auto distance_km = [&](double at_s) {
        const JulianDate tt = sky.instant_at(at_s).tt;
        return glm::length(evaluate_slow_sky(tt, sky.model()).sun_km);
    };
    return (distance_km(seconds + kHalf_s) - distance_km(seconds - kHalf_s)) / (2.0 * kHalf_s);
}

void find_apsides(EventSky& sky, double length_s, std::vector<Event>& found) {
    const auto recession = [&](double seconds) { return sun_recession_km_s(sky, seconds); };
    walk(length_s, 3.0 * kDay_s, [&](double from_s, double to_s) {
        const double from = recession(from_s);
        const double to = recession(to_s);
        if (std::signbit(from) == std::signbit(to)) return;
        const EventKind kind = std::signbit(from) ? EventKind::kPerihelion : EventKind::kAphelion;
        const double seconds = zero_between(recession, from_s, from, to_s, to, kTimeTolerance_s);
        found.push_back({.time = sky.time_at(seconds), .kind = kind, .body = Body::kSun});
    });
}

std::vector<Event> in_span(std::vector<Event> found, const TimeSpan& span) {
    std::erase_if(found, [&](const Event& event) {
        return seconds_between(span.from, event.time) < 0.0 || seconds_between(event.time, span.to) <= 0.0;
    });
    std::sort(found.begin(), found.end(),
              [](const Event& a, const Event& b) { return seconds_between(a.time, b.time) > 0.0; });
    return found;
}

}  // namespace

std::vector<Event> find_moon_phases(const TimeSpan& span, Model model) {
    EventSky sky(span.from, {}, model);
    std::vector<Event> found;
    const auto lead_rad = [&](double seconds) {
        const EclipticLongitudes longitudes = ecliptic_longitudes(sky.instant_at(seconds).tt, model);
        return longitudes.moon_rad - longitudes.sun_rad;
    };
    find_quarters(
        sky, seconds_between(span.from, span.to), kDay_s, lead_rad,
        {EventKind::kNewMoon, EventKind::kFirstQuarter, EventKind::kFullMoon, EventKind::kLastQuarter},
        Body::kMoon, found);
    return in_span(std::move(found), span);
}

std::vector<Event> find_seasons(const TimeSpan& span, Model model) {
    EventSky sky(span.from, {}, model);
    std::vector<Event> found;
    const double length_s = seconds_between(span.from, span.to);
    const auto longitude_rad = [&](double seconds) {
        return ecliptic_longitudes(sky.instant_at(seconds).tt, model).sun_rad;
    };
    find_quarters(sky, length_s, 3.0 * kDay_s, longitude_rad,
                  {EventKind::kMarchEquinox, EventKind::kJuneSolstice, EventKind::kSeptemberEquinox,
                   EventKind::kDecemberSolstice},
                  Body::kSun, found);
    find_apsides(sky, length_s, found);
    return in_span(std::move(found), span);
}

}  // namespace skyig::server::ephemeris::events
