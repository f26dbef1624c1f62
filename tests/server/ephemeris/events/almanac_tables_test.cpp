// Events against the printed almanacs, where the clone has their tables: US Naval Observatory, whole minutes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "server/ephemeris/events/events.h"
#include "tests/csv.h"
#include "tests/server/ephemeris/largest.h"

namespace skyig::server::ephemeris::events {
namespace {

using tests::CsvRow;

/// The tables' last year with measured time scales; later ones assume another delta-T.
constexpr int kLastMeasuredYear = 2020;
constexpr double kMinute_s = 60.0;

struct MinuteErrors {
    double max_measured_s = 0.0;
    double max_later_s = 0.0;
    std::size_t count = 0;

    void add(int year, double error_s) {
        double& max_s = year <= kLastMeasuredYear ? max_measured_s : max_later_s;
        tests::raise(max_s, error_s);
        ++count;
    }
    void expect_within_a_minute(const char* what) const {
        std::printf("%s: %zu rows, max %.0f s up to 2020, %.0f s after\n", what, count, max_measured_s,
                    max_later_s);
        EXPECT_LE(max_measured_s, kMinute_s);
        EXPECT_LE(max_later_s, 2.0 * kMinute_s);
    }
};

std::vector<CsvRow> reference(const std::string& name) {
    return tests::read_csv(std::string(SKYIG_REFERENCE "/ephemeris/") + name);
}

TimeSpan around(const UtcClockTime& time, double reach_s) {
    TimeSpan span{time, time};
    span.from.advance(-reach_s);
    span.to.advance(reach_s);
    return span;
}

/// Seconds by which the nearest event of the kind is late; infinite when there is none.
double lateness_s(const std::vector<Event>& events, EventKind kind, const UtcClockTime& printed) {
    double nearest_s = std::numeric_limits<double>::infinity();
    for (const Event& event : events) {
        const double late_s = seconds_between(printed, event.time);
        if (event.kind == kind && std::abs(late_s) < std::abs(nearest_s)) nearest_s = late_s;
    }
    return nearest_s;
}

UtcClockTime printed_time(const CsvRow& row, const char* column = "utc") {
    const std::optional<UtcClockTime> time = parse_utc(row.text(column));
    EXPECT_TRUE(time.has_value()) << row.text(column);
    return time.value_or(UtcClockTime{});
}

TEST(AlmanacTables, MoonPhasesAreWithinAMinute) {
    const std::vector<CsvRow> rows = reference("moon_phases.csv");
    if (rows.empty()) GTEST_SKIP() << "the table moon_phases.csv is not part of this clone";
    const std::map<std::string, EventKind> kinds{{"new", EventKind::kNewMoon},
                                                 {"first", EventKind::kFirstQuarter},
                                                 {"full", EventKind::kFullMoon},
                                                 {"last", EventKind::kLastQuarter}};
    MinuteErrors errors;
    for (const CsvRow& row : rows) {
        const UtcClockTime printed = printed_time(row);
        const double late_s =
            lateness_s(find_moon_phases(around(printed, 3600.0)), kinds.at(row.text("quarter")), printed);
        errors.add(printed.civil().year, late_s);
    }
    errors.expect_within_a_minute("moon_phases");
}

TEST(AlmanacTables, SeasonsAreWithinAMinute) {
    const std::vector<CsvRow> rows = reference("seasons.csv");
    if (rows.empty()) GTEST_SKIP() << "the table seasons.csv is not part of this clone";
    MinuteErrors seasons;
    MinuteErrors apsides;
    for (const CsvRow& row : rows) {
        const UtcClockTime printed = printed_time(row);
        const auto kind = static_cast<EventKind>(
            std::find(kEventNames.begin(), kEventNames.end(), row.text("event")) - kEventNames.begin());
        const double late_s = lateness_s(find_seasons(around(printed, 3600.0)), kind, printed);
        const bool apsis = kind == EventKind::kPerihelion || kind == EventKind::kAphelion;
        (apsis ? apsides : seasons).add(printed.civil().year, late_s);
    }
    seasons.expect_within_a_minute("equinoxes and solstices");
    apsides.expect_within_a_minute("perihelia and aphelia");
}

TEST(AlmanacTables, RiseAndSetAreWithinAMinuteUpToThePoles) {
    const std::vector<CsvRow> rows = reference("riseset.csv");
    if (rows.empty()) GTEST_SKIP() << "the table riseset.csv is not part of this clone";
    MinuteErrors errors;
    MinuteErrors polar;
    for (const CsvRow& row : rows) {
        const UtcClockTime printed = printed_time(row);
        const Geodetic site{row.number("lat_deg"), row.number("lon_deg"), 0.0};
        const std::array bodies{row.text("body") == "sun" ? Body::kSun : Body::kMoon};
        const double late_s = lateness_s(
            find_local_events(around(printed, 7200.0), site, {.bodies = bodies, .twilights = false}),
            row.text("event") == "rise" ? EventKind::kRise : EventKind::kSet, printed);
        (std::abs(site.latitude_deg) > 80.0 ? polar : errors).add(printed.civil().year, late_s);
    }
    errors.expect_within_a_minute("rise and set up to 80 degrees");
    polar.expect_within_a_minute("rise and set from 80 degrees to the poles");
}

TEST(AlmanacTables, TwilightsAreWithinAMinute) {
    const std::vector<CsvRow> rows = reference("twilight.csv");
    if (rows.empty()) GTEST_SKIP() << "the table twilight.csv is not part of this clone";
    MinuteErrors errors;
    for (const CsvRow& row : rows) {
        const Geodetic site{row.number("lat_deg"), row.number("lon_deg"), 0.0};
        for (const EventKind kind :
             {EventKind::kAstronomicalDawn, EventKind::kNauticalDawn, EventKind::kCivilDawn,
              EventKind::kCivilDusk, EventKind::kNauticalDusk, EventKind::kAstronomicalDusk}) {
            const UtcClockTime printed = printed_time(row, std::string(name_of(kind)).c_str());
            errors.add(printed.civil().year,
                       lateness_s(find_local_events(around(printed, 7200.0), site, {}), kind, printed));
        }
    }
    EXPECT_LE(errors.max_later_s, kMinute_s);
    errors.expect_within_a_minute("twilights");
}

}  // namespace
}  // namespace skyig::server::ephemeris::events
