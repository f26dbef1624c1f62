// Rise, set, transit and twilight where they are hard to find: at the poles, grazing, at the ends of a span.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string_view>
#include <vector>

#include "server/ephemeris/angles.h"
#include "server/ephemeris/events/event_sky.h"
#include "server/ephemeris/events/events.h"
#include "server/ephemeris/places.h"
#include "tests/server/ephemeris/largest.h"

namespace skyig::server::ephemeris::events {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr std::array kSunOnly{Body::kSun};
constexpr std::array kSunAndMoon{Body::kSun, Body::kMoon};

TimeSpan span_of(std::string_view from, std::string_view to) {
    return {parse_utc(from).value(), parse_utc(to).value()};
}

std::size_t count_of(const std::vector<Event>& events, EventKind kind, Body body = Body::kSun) {
    std::size_t count = 0;
    for (const Event& event : events)
        count += event.kind == kind && event.body == body ? 1 : 0;
    return count;
}

TEST(LocalEvents, EveryDayAtMiddleLatitudesHasItsEvents) {
    const std::vector<Event> events = find_local_events(
        span_of("2023-01-01T00:00:00Z", "2024-01-01T00:00:00Z"), {40.0, 0.0, 0.0}, {.bodies = kSunAndMoon});
    EXPECT_EQ(count_of(events, EventKind::kRise), 365U);
    EXPECT_EQ(count_of(events, EventKind::kTransit), 365U);
    EXPECT_EQ(count_of(events, EventKind::kSet), 365U);
    for (const EventKind kind : {EventKind::kAstronomicalDawn, EventKind::kCivilDusk})
        EXPECT_EQ(count_of(events, kind), 365U);
    // A lunar day is 24 h 50 min.
    for (const EventKind kind : {EventKind::kRise, EventKind::kTransit, EventKind::kSet})
        EXPECT_NEAR(static_cast<double>(count_of(events, kind, Body::kMoon)), 352.8, 1.5);
    for (std::size_t i = 1; i < events.size(); ++i)
        EXPECT_GE(seconds_between(events[i - 1].time, events[i].time), 0.0);
}

TEST(LocalEvents, ThePolesHaveOneDayAYear) {
    for (const double latitude_deg : {90.0, -90.0}) {
        const std::vector<Event> events =
            find_local_events(span_of("2023-01-01T00:00:00Z", "2024-01-01T00:00:00Z"),
                              {latitude_deg, 0.0, 0.0}, {.bodies = kSunOnly}, Model::kErfa);
        EXPECT_EQ(count_of(events, EventKind::kRise), 1U) << latitude_deg;
        EXPECT_EQ(count_of(events, EventKind::kSet), 1U) << latitude_deg;
        EXPECT_EQ(count_of(events, EventKind::kCivilDawn), 1U) << latitude_deg;
        EXPECT_EQ(count_of(events, EventKind::kAstronomicalDusk), 1U) << latitude_deg;
    }
}

TEST(LocalEvents, PolarNightAndMidnightSunHaveNoRise) {
    const Geodetic tromso{69.65, 18.96, 0.0};
    const std::vector<Event> winter = find_local_events(
        span_of("2022-12-01T00:00:00Z", "2023-01-10T00:00:00Z"), tromso, {.bodies = kSunOnly});
    EXPECT_EQ(count_of(winter, EventKind::kRise), 0U);
    EXPECT_EQ(count_of(winter, EventKind::kTransit), 40U);
    EXPECT_EQ(count_of(winter, EventKind::kCivilDawn), 40U);
    const std::vector<Event> summer = find_local_events(
        span_of("2023-06-01T00:00:00Z", "2023-07-10T00:00:00Z"), tromso, {.bodies = kSunOnly});
    EXPECT_EQ(count_of(summer, EventKind::kSet), 0U);
    EXPECT_EQ(count_of(summer, EventKind::kCivilDusk), 0U);
}

const Event& the_only(const std::vector<Event>& events, EventKind kind) {
    return *std::find_if(events.begin(), events.end(),
                         [kind](const Event& event) { return event.kind == kind; });
}

/// The Sun's highest limb on a winter noon, near the end of the polar night.
double highest_limb_rad(const TimeSpan& span, const Geodetic& site) {
    EventSky sky(span.from, site, Model::kSeries);
    double highest_rad = -1.0;
    for (double seconds = 0.0; seconds < seconds_between(span.from, span.to); seconds += 1.0) {
        const SunState sun = sky.state_at(seconds).sun;
        highest_rad =
            std::max(highest_rad, horizontal_of(sun.direction_enu).elevation_rad + sun.angular_radius_rad);
    }
    return highest_rad;
}

TEST(LocalEvents, GrazingRiseAndSetAreBothFound) {
    // The horizon is laid just below the Sun's highest point, between two samples of the search.
    const TimeSpan noon = span_of("2023-01-10T09:30:00Z", "2023-01-10T12:30:00Z");
    const Geodetic site{69.0, 18.96, 0.0};
    const double highest_rad = highest_limb_rad(noon, site);
    for (const double below_arcsec : {10.0, 1.0, 0.1, 0.01}) {
        const double horizon_rad = highest_rad - below_arcsec / 3600.0 * kRadPerDeg;
        const std::vector<Event> events = find_local_events(
            noon, site, {.bodies = kSunOnly, .twilights = false, .horizon_rad = horizon_rad});
        ASSERT_EQ(count_of(events, EventKind::kRise), 1U) << below_arcsec;
        ASSERT_EQ(count_of(events, EventKind::kSet), 1U) << below_arcsec;
        const Event& rise = the_only(events, EventKind::kRise);
        const Event& set = the_only(events, EventKind::kSet);
        std::printf("%.2f arcsec under the highest: up for %.1f s\n", below_arcsec,
                    seconds_between(rise.time, set.time));
        EXPECT_GT(seconds_between(rise.time, set.time), 0.0);
        EXPECT_LT(seconds_between(rise.time, set.time), 600.0);
    }
    const std::vector<Event> above = find_local_events(
        noon, site,
        {.bodies = kSunOnly, .twilights = false, .horizon_rad = highest_rad + 0.1 / 3600.0 * kRadPerDeg});
    EXPECT_EQ(count_of(above, EventKind::kRise), 0U);
}

TEST(LocalEvents, SpansThatFollowEachOtherNeitherLoseNorRepeat) {
    const Geodetic site{51.0, 7.0, 100.0};
    const LocalSearch search{.bodies = kSunAndMoon};
    const std::vector<Event> whole =
        find_local_events(span_of("2016-12-30T00:00:00Z", "2017-01-02T00:00:00Z"), site, search);
    std::size_t in_pieces = 0;
    UtcClockTime from = parse_utc("2016-12-30T00:00:00Z").value();
    // Through a leap second, in pieces that fit no grid.
    while (seconds_between(from, parse_utc("2017-01-02T00:00:00Z").value()) > 0.0) {
        UtcClockTime to = from;
        to.advance(4321.0);
        if (seconds_between(to, parse_utc("2017-01-02T00:00:00Z").value()) < 0.0)
            to = parse_utc("2017-01-02T00:00:00Z").value();
        for (const Event& event : find_local_events({from, to}, site, search)) {
            EXPECT_EQ(event.kind, whole.at(in_pieces).kind);
            EXPECT_NEAR(seconds_between(event.time, whole[in_pieces].time), 0.0, 0.1);
            ++in_pieces;
        }
        from = to;
    }
    EXPECT_EQ(in_pieces, whole.size());
    EXPECT_GE(whole.size(), 30U);
}

TEST(LocalEvents, PlanetsRiseTransitAndSet) {
    const std::vector<Event> events =
        find_local_events(span_of("2024-03-01T00:00:00Z", "2024-03-11T00:00:00Z"), {20.0, 50.0, 0.0},
                          {.bodies = kBodies, .twilights = false});
    for (const Body body : kBodies) {
        for (const EventKind kind : {EventKind::kRise, EventKind::kTransit, EventKind::kSet})
            EXPECT_GE(count_of(events, kind, body), 9U) << name_of(body);
    }
    for (const Event& event : events) {
        if (event.kind == EventKind::kTransit)
            EXPECT_NEAR(std::abs(std::remainder(event.azimuth_deg, 180.0)), 0.0, 0.01);
        else
            EXPECT_NEAR(event.elevation_deg, -34.0 / 60.0, 0.3);
    }
}

void expect_close_to_series(Knots knots, const char* what, double moon_bound_arcsec) {
    const Geodetic site{-33.0, 151.0, 20.0};
    EventSky sky(parse_utc("2011-05-05T00:00:00Z").value(), site, Model::kSeries, knots);
    double moon_rad = 0.0;
    double sun_rad = 0.0;
    for (double seconds = 17.0; seconds < 30.0 * 86400.0; seconds += 9907.0) {
        const SkyState close = sky.state_at(seconds);
        const SkyState exact = compute_sky_state(sky.instant_at(seconds), site);
        tests::raise(moon_rad, angle_between_rad(close.moon.direction_enu, exact.moon.direction_enu));
        tests::raise(sun_rad, angle_between_rad(close.sun.direction_enu, exact.sun.direction_enu));
    }
    std::printf("%s: Moon %.4f, Sun %.4f arcsec\n", what, moon_rad / kRadPerDeg * 3600.0,
                sun_rad / kRadPerDeg * 3600.0);
    EXPECT_LE(moon_rad / kRadPerDeg * 3600.0, moon_bound_arcsec);
    EXPECT_LE(sun_rad / kRadPerDeg * 3600.0, 0.001);
}

TEST(LocalEvents, KnotsAreAsGoodAsEvaluatingTheSeries) {
    expect_close_to_series(Knots::kHour, "hourly knots", 0.08);
    expect_close_to_series(Knots::kTenMinutes, "knots every ten minutes", 0.003);
}

TEST(LocalEvents, BadSitesAndEmptySpansEnd) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const TimeSpan day = span_of("2024-03-01T00:00:00Z", "2024-03-02T00:00:00Z");
    EXPECT_LE(find_local_events(day, {nan, nan, nan}, {.bodies = kBodies}).size(), 60U);
    EXPECT_TRUE(find_local_events({day.to, day.from}, {0.0, 0.0, 0.0}, {.bodies = kBodies}).empty());
    EXPECT_TRUE(find_moon_phases({day.from, day.from}).empty());
}

}  // namespace
}  // namespace skyig::server::ephemeris::events
