#include "server/ephemeris/events/eclipses.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "server/ephemeris/angles.h"
#include "server/ephemeris/events/event_sky.h"
#include "server/ephemeris/events/roots.h"

namespace skyig::server::ephemeris::events {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kTimeTolerance_s = 0.01;
/// Parallax moves the eclipse of a site by up to two hours from the new moon; an eclipse lasts six at most.
constexpr double kReach_s = 5.0 * 3600.0;
constexpr double kStep_s = 300.0;

double elevation_deg(const glm::dvec3& direction_enu) noexcept {
    return horizontal_of(direction_enu).elevation_rad * kDegPerRad;
}

/// Where the two limbs touch from outside, the sum of the radii is left; and so on.
struct Discs {
    double separation_rad = 0.0;
    double sun_rad = 0.0;
    double moon_rad = 0.0;
    double obscured = 0.0;
    double sun_elevation_deg = 0.0;

    [[nodiscard]] bool sun_is_up() const noexcept {
        return (sun_elevation_deg / kDegPerRad) + sun_rad >= kAlmanacHorizon_rad;
    }
};

Discs discs_at(EventSky& sky, double seconds) noexcept {
    const SkyState state = sky.state_at(seconds);
    return {.separation_rad = angle_between_rad(state.sun.direction_enu, state.moon.direction_enu),
            .sun_rad = state.sun.angular_radius_rad,
            .moon_rad = state.moon.angular_radius_rad,
            .obscured = state.sun.obscured,
            .sun_elevation_deg = elevation_deg(state.sun.direction_enu)};
}

/// The Moon in the Earth's shadow, in radii of the Moon.
struct Shadowing {
    double axis_distance = 0.0;
    double umbra = 0.0;
    double penumbra = 0.0;
    double moon_elevation_deg = 0.0;
    double moon_rad = 0.0;

    [[nodiscard]] bool moon_is_up() const noexcept {
        return (moon_elevation_deg / kDegPerRad) + moon_rad >= kAlmanacHorizon_rad;
    }
};

Shadowing shadowing_at(EventSky& sky, double seconds) noexcept {
    const MoonState moon = sky.state_at(seconds).moon;
    return {.axis_distance = glm::length(moon.shadow_axis_enu),
            .umbra = moon.umbra_radius,
            .penumbra = moon.penumbra_radius,
            .moon_elevation_deg = elevation_deg(moon.direction_enu),
            .moon_rad = moon.angular_radius_rad};
}

/// Least value of `f` near 0: on a grid first, since parallax may bend it, then closely.
template <typename Function>
double least_near_zero(const Function& f) {
    double best_s = -kReach_s;
    double best = f(best_s);
    for (double seconds = -kReach_s + kStep_s; seconds <= kReach_s; seconds += kStep_s) {
        const double value = f(seconds);
        if (value < best) {
            best = value;
            best_s = seconds;
        }
    }
    return minimum_between(f, best_s - kStep_s, best_s + kStep_s, kTimeTolerance_s);
}

/// Times at which `outside` (negative between them, its least value at `middle_s`) is zero.
struct Crossings {
    double from_s = 0.0;
    double to_s = 0.0;
};

template <typename Function>
std::optional<Crossings> crossings_around(const Function& outside, double middle_s) {
    const double inner = outside(middle_s);
    if (!(inner < 0.0)) return std::nullopt;
    const auto side = [&](double step_s) {
        double near_s = middle_s;
        double near = inner;
        for (double far_s = middle_s + step_s; std::abs(far_s - middle_s) < 2.0 * kReach_s; far_s += step_s) {
            const double far = outside(far_s);
            if (far >= 0.0) return zero_between(outside, near_s, near, far_s, far, kTimeTolerance_s);
            near_s = far_s;
            near = far;
        }
        return near_s;
    };
    return Crossings{side(-kStep_s), side(kStep_s)};
}

Contact solar_contact(EventSky& sky, double seconds) noexcept {
    return {sky.time_at(seconds), discs_at(sky, seconds).sun_elevation_deg};
}

Contact lunar_contact(EventSky& sky, double seconds) noexcept {
    return {sky.time_at(seconds), shadowing_at(sky, seconds).moon_elevation_deg};
}

/// Largest obscuration with the Sun up between the outer contacts.
double seen_obscuration(EventSky& sky, const Crossings& outer, double maximum_s) {
    double seen = 0.0;
    const auto look = [&](double seconds) {
        const Discs discs = discs_at(sky, seconds);
        if (discs.sun_is_up()) seen = std::max(seen, discs.obscured);
    };
    look(maximum_s);
    constexpr double kLook_s = 10.0;
    for (double seconds = outer.from_s; seconds <= outer.to_s; seconds += kLook_s)
        look(seconds);
    return seen;
}

std::optional<SolarEclipse> solar_eclipse_at(EventSky& sky) {
    const auto separation = [&](double seconds) { return discs_at(sky, seconds).separation_rad; };
    const double maximum_s = least_near_zero(separation);
    const auto outside = [&](double seconds) {
        const Discs discs = discs_at(sky, seconds);
        return discs.separation_rad - discs.sun_rad - discs.moon_rad;
    };
    const std::optional<Crossings> outer = crossings_around(outside, maximum_s);
    if (!outer) return std::nullopt;

    SolarEclipse eclipse;
    eclipse.seen_obscuration = seen_obscuration(sky, *outer, maximum_s);
    if (eclipse.seen_obscuration <= 0.0) return std::nullopt;
    eclipse.first = solar_contact(sky, outer->from_s);
    eclipse.maximum = solar_contact(sky, maximum_s);
    eclipse.fourth = solar_contact(sky, outer->to_s);
    const Discs discs = discs_at(sky, maximum_s);
    eclipse.obscuration = discs.obscured;
    eclipse.magnitude = (discs.sun_rad + discs.moon_rad - discs.separation_rad) / (2.0 * discs.sun_rad);

    const auto not_inside = [&](double seconds) {
        const Discs at = discs_at(sky, seconds);
        return at.separation_rad - std::abs(at.sun_rad - at.moon_rad);
    };
    if (const std::optional<Crossings> inner = crossings_around(not_inside, maximum_s)) {
        eclipse.second = solar_contact(sky, inner->from_s);
        eclipse.third = solar_contact(sky, inner->to_s);
        eclipse.magnitude = discs.moon_rad / discs.sun_rad;
        eclipse.kind = eclipse.magnitude >= 1.0 ? SolarEclipseKind::kTotal : SolarEclipseKind::kAnnular;
    }
    return eclipse;
}

bool moon_is_seen(EventSky& sky, const Crossings& between) {
    for (double seconds = between.from_s; seconds < between.to_s; seconds += kStep_s) {
        if (shadowing_at(sky, seconds).moon_is_up()) return true;
    }
    return shadowing_at(sky, between.to_s).moon_is_up();
}

/// Zero where a body of the Moon's size touches the circle: `wide` = 1 from outside, -1 from inside.
template <typename Radius>
std::optional<Crossings> shadow_crossings(EventSky& sky, double maximum_s, double wide,
                                          const Radius& radius) {
    const auto outside = [&](double seconds) {
        const Shadowing at = shadowing_at(sky, seconds);
        return at.axis_distance - radius(at) - wide;
    };
    return crossings_around(outside, maximum_s);
}

std::optional<LunarEclipse> lunar_eclipse_at(EventSky& sky) {
    const auto umbra = [](const Shadowing& at) { return at.umbra; };
    const auto penumbra = [](const Shadowing& at) { return at.penumbra; };
    const double maximum_s =
        least_near_zero([&](double seconds) { return shadowing_at(sky, seconds).axis_distance; });
    const std::optional<Crossings> outer = shadow_crossings(sky, maximum_s, 1.0, penumbra);
    if (!outer || !moon_is_seen(sky, *outer)) return std::nullopt;

    LunarEclipse eclipse;
    eclipse.penumbra_begins = lunar_contact(sky, outer->from_s);
    eclipse.maximum = lunar_contact(sky, maximum_s);
    eclipse.penumbra_ends = lunar_contact(sky, outer->to_s);
    const Shadowing at = shadowing_at(sky, maximum_s);
    eclipse.umbral_magnitude = (at.umbra + 1.0 - at.axis_distance) / 2.0;
    eclipse.penumbral_magnitude = (at.penumbra + 1.0 - at.axis_distance) / 2.0;
    if (const std::optional<Crossings> partial = shadow_crossings(sky, maximum_s, 1.0, umbra)) {
        eclipse.kind = LunarEclipseKind::kPartial;
        eclipse.umbra_begins = lunar_contact(sky, partial->from_s);
        eclipse.umbra_ends = lunar_contact(sky, partial->to_s);
    }
    if (const std::optional<Crossings> total = shadow_crossings(sky, maximum_s, -1.0, umbra)) {
        eclipse.kind = LunarEclipseKind::kTotal;
        eclipse.totality_begins = lunar_contact(sky, total->from_s);
        eclipse.totality_ends = lunar_contact(sky, total->to_s);
    }
    return eclipse;
}

/// Tries every phase of `kind` in or near the span with a sky that counts its seconds from there.
template <typename Eclipse, typename Try>
std::vector<Eclipse> find_at_phases(const TimeSpan& span, const Geodetic& site, Model model, EventKind kind,
                                    const Try& eclipse_at) {
    TimeSpan wider = span;
    wider.from.advance(-kReach_s);
    wider.to.advance(kReach_s);
    std::vector<Eclipse> found;
    for (const Event& phase : find_moon_phases(wider, model)) {
        if (phase.kind != kind) continue;
        EventSky sky(phase.time, site, model, Knots::kTenMinutes);
        const std::optional<Eclipse> eclipse = eclipse_at(sky);
        if (eclipse && seconds_between(span.from, eclipse->maximum.time) >= 0.0 &&
            seconds_between(eclipse->maximum.time, span.to) > 0.0)
            found.push_back(*eclipse);
    }
    return found;
}

}  // namespace

std::vector<SolarEclipse> find_solar_eclipses(const TimeSpan& span, const Geodetic& site, Model model) {
    return find_at_phases<SolarEclipse>(span, site, model, EventKind::kNewMoon, solar_eclipse_at);
}

std::vector<LunarEclipse> find_lunar_eclipses(const TimeSpan& span, const Geodetic& site, Model model) {
    return find_at_phases<LunarEclipse>(span, site, model, EventKind::kFullMoon, lunar_eclipse_at);
}

}  // namespace skyig::server::ephemeris::events
