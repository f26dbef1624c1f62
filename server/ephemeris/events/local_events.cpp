#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>

#include "server/ephemeris/angles.h"
#include "server/ephemeris/events/event_sky.h"
#include "server/ephemeris/events/events.h"
#include "server/ephemeris/events/roots.h"
#include "server/ephemeris/places.h"

namespace skyig::server::ephemeris::events {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kStep_s = 600.0;
constexpr double kTimeTolerance_s = 0.01;
/// Nearer to its zero than this an extreme is looked at closely: within a step an elevation bends by 0.06
/// degrees at most.
constexpr double kGrazing_rad = 0.2 * kRadPerDeg;

/// A function of the sky that is searched for zeros, and what its rising and falling zeros are called.
struct Track {
    std::function<double(const SkyState&)> value_rad;
    Body body = Body::kSun;
    std::optional<EventKind> upward;
    std::optional<EventKind> downward;
    /// An hour angle: grows all the time but for the jump from pi to -pi, which is no event.
    bool angle = false;
};

Track limb_track(Body body, double horizon_rad) {
    const auto above = [body, horizon_rad](const SkyState& state) {
        const ApparentPlace seen = apparent_place(state, body);
        return horizontal_of(seen.direction).elevation_rad + seen.angular_radius_rad - horizon_rad;
    };
    return {above, body, EventKind::kRise, EventKind::kSet};
}

/// Hour angle by the Earth's axis and the site's meridian, so that it exists at the poles too.
Track transit_track(Body body, const Geodetic& site) {
    const double latitude_rad = site.latitude_deg * kRadPerDeg;
    const glm::dvec3 meridian_enu(0.0, -std::sin(latitude_rad), std::cos(latitude_rad));
    const auto hour_angle = [body, meridian_enu](const SkyState& state) {
        const glm::dvec3 direction = apparent_place(state, body).direction;
        return std::atan2(-direction.x, glm::dot(direction, meridian_enu));
    };
    return {hour_angle, body, EventKind::kTransit, std::nullopt, true};
}

Track twilight_track(double elevation_deg, EventKind dawn, EventKind dusk) {
    const auto above = [elevation_deg](const SkyState& state) {
        return horizontal_of(state.sun.direction_enu).elevation_rad - elevation_deg * kRadPerDeg;
    };
    return {above, Body::kSun, dawn, dusk};
}

std::vector<Track> tracks_of(const LocalSearch& search, const Geodetic& site) {
    std::vector<Track> tracks;
    for (const Body body : search.bodies) {
        tracks.push_back(limb_track(body, search.horizon_rad));
        tracks.push_back(transit_track(body, site));
    }
    if (search.twilights) {
        tracks.push_back(twilight_track(-6.0, EventKind::kCivilDawn, EventKind::kCivilDusk));
        tracks.push_back(twilight_track(-12.0, EventKind::kNauticalDawn, EventKind::kNauticalDusk));
        tracks.push_back(twilight_track(-18.0, EventKind::kAstronomicalDawn, EventKind::kAstronomicalDusk));
    }
    return tracks;
}

struct Sample {
    double seconds = 0.0;
    double value_rad = 0.0;
};

class TrackSearch {
  public:
    TrackSearch(EventSky& sky, const Track& track, std::vector<Event>& found)
        : sky_(sky), track_(track), found_(found) {}

    void add(const Sample& sample) {
        if (count_ > 0) search_between(latest_, sample);
        if (count_ > 1 && !track_.angle) search_extreme(before_, latest_, sample);
        before_ = latest_;
        latest_ = sample;
        ++count_;
    }

  private:
    [[nodiscard]] double value_at(double seconds) const { return track_.value_rad(sky_.state_at(seconds)); }

    void search_between(const Sample& from, const Sample& to) {
        if (std::signbit(from.value_rad) == std::signbit(to.value_rad)) return;
        const bool upward = std::signbit(from.value_rad);
        if (track_.angle && std::abs(to.value_rad - from.value_rad) > std::numbers::pi) return;
        const std::optional<EventKind> kind = upward ? track_.upward : track_.downward;
        if (!kind) return;
        const auto value = [this](double seconds) { return value_at(seconds); };
        record(*kind,
               zero_between(value, from.seconds, from.value_rad, to.seconds, to.value_rad, kTimeTolerance_s));
    }

    /// Two zeros within a step: an extreme on the other side of zero than the samples around it.
    void search_extreme(const Sample& a, const Sample& b, const Sample& c) {
        const bool negative = std::signbit(b.value_rad);
        if (std::signbit(a.value_rad) != negative || std::signbit(c.value_rad) != negative) return;
        const double sign = negative ? -1.0 : 1.0;
        const bool towards_zero =
            sign * b.value_rad <= sign * a.value_rad && sign * b.value_rad < sign * c.value_rad;
        if (!towards_zero || std::abs(b.value_rad) > kGrazing_rad) return;
        const auto distance = [this, sign](double seconds) { return sign * value_at(seconds); };
        const double extreme_s = minimum_between(distance, a.seconds, c.seconds, 1.0);
        const Sample extreme{extreme_s, value_at(extreme_s)};
        if (std::signbit(extreme.value_rad) == negative) return;
        search_between(a, extreme);
        search_between(extreme, c);
    }

    void record(EventKind kind, double seconds) {
        const Horizontal place = horizontal_of(apparent_place(sky_.state_at(seconds), track_.body).direction);
        found_.push_back({.time = sky_.time_at(seconds),
                          .kind = kind,
                          .body = track_.body,
                          .azimuth_deg = place.azimuth_rad / kRadPerDeg,
                          .elevation_deg = place.elevation_rad / kRadPerDeg});
    }

    EventSky& sky_;
    const Track& track_;
    std::vector<Event>& found_;
    Sample before_;
    Sample latest_;
    std::size_t count_ = 0;
};

}  // namespace

std::vector<Event> find_local_events(const TimeSpan& span, const Geodetic& site, const LocalSearch& search,
                                     Model model) {
    EventSky sky(span.from, site, model);
    const std::vector<Track> tracks = tracks_of(search, site);
    std::vector<Event> found;
    std::vector<TrackSearch> searches;
    searches.reserve(tracks.size());
    for (const Track& track : tracks)
        searches.emplace_back(sky, track, found);

    // One step more at either end, for extremes near them.
    const double length_s = seconds_between(span.from, span.to);
    const auto steps = static_cast<std::int64_t>(std::ceil(length_s / kStep_s)) + 1;
    for (std::int64_t step = -1; step <= steps; ++step) {
        const double seconds = static_cast<double>(step) * kStep_s;
        const SkyState state = sky.state_at(seconds);
        for (std::size_t i = 0; i < tracks.size(); ++i)
            searches[i].add({seconds, tracks[i].value_rad(state)});
    }

    std::erase_if(found, [&](const Event& event) {
        return seconds_between(span.from, event.time) < 0.0 || seconds_between(event.time, span.to) <= 0.0;
    });
    std::stable_sort(found.begin(), found.end(),
                     [](const Event& a, const Event& b) { return seconds_between(a.time, b.time) > 0.0; });
    return found;
}

}  // namespace skyig::server::ephemeris::events
