// Spans of days, and what is told of them.
#include "clients/skyig/ephem/almanac.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace skyig::clients::ephem {
namespace {

using namespace server::ephemeris;
using Json = nlohmann::json;
using ::testing::HasSubstr;

TEST(EphemAlmanac, SpansHoldBothDays) {
    const events::TimeSpan span = parse_span("2026-06-01..2026-06-30").value();
    EXPECT_EQ(to_iso(span.from), "2026-06-01T00:00:00Z");
    EXPECT_EQ(to_iso(span.to), "2026-07-01T00:00:00Z");
    EXPECT_EQ(to_iso(parse_span("2016-12-31..2016-12-31").value().to), "2017-01-01T00:00:00Z");
    EXPECT_EQ(seconds_between(parse_span("2016-12-31..2016-12-31").value().from,
                              parse_span("2016-12-31..2016-12-31").value().to),
              86401.0);
    const events::TimeSpan hours = parse_span("2026-06-01T12:00:00Z..2026-06-01T13:00:00Z").value();
    EXPECT_EQ(seconds_between(hours.from, hours.to), 3600.0);
    EXPECT_TRUE(parse_span("1900-01-01..2100-12-31").has_value());
    for (const char* text : {"", "2026-06-01", "2026-06-02..2026-06-01", "2026-06-31..2026-07-01",
                             "1899-12-31..1900-01-01", "2100-12-31..2101-01-01", "..", "a..b"})
        EXPECT_FALSE(parse_span(text).has_value()) << text;
}

AlmanacRequest april_2024() {
    return {.span = parse_span("2024-04-08..2024-04-08").value(),
            .site = Geodetic{41.0341, -83.6523, 0.0},
            .bodies = {Body::kSun, Body::kMoon}};
}

TEST(EphemAlmanac, TextIsInOrderAndTellsEclipsesWithTheRest) {
    const std::string text = to_text(make_almanac(april_2024()));
    for (const char* part : {"sun      rise", "moon     new moon", "sun      total eclipse begins",
                             "total phase begins", "eclipse maximum 1.054, 100.0 % covered", "eclipse ends"})
        EXPECT_THAT(text, HasSubstr(part));
    std::string before;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(before, line.substr(0, 20));
        before = line.substr(0, 20);
    }
}

TEST(EphemAlmanac, JsonTellsContactsAndMissingOnesAsNull) {
    const Json json = Json::parse(to_json(make_almanac(april_2024())));
    EXPECT_EQ(json["from"], "2024-04-08T00:00:00Z");
    ASSERT_EQ(json["solar_eclipses"].size(), 1U);
    EXPECT_EQ(json["solar_eclipses"][0]["kind"], "total");
    EXPECT_THAT(json["solar_eclipses"][0]["second_contact"]["utc"].get<std::string>(),
                HasSubstr("2024-04-08T19:10:4"));
    EXPECT_TRUE(json["lunar_eclipses"].empty());
    AlmanacRequest elsewhere = april_2024();
    elsewhere.site = Geodetic{40.713, -74.006, 10.0};
    const Json partial = Json::parse(to_json(make_almanac(elsewhere)));
    EXPECT_TRUE(partial["solar_eclipses"][0]["second_contact"].is_null());
}

TEST(EphemAlmanac, WithoutASiteThereArePhasesAndSeasons) {
    AlmanacRequest request = april_2024();
    request.span = parse_span("2024-03-01..2024-03-31").value();
    request.site.reset();
    const Almanac almanac = make_almanac(request);
    ASSERT_EQ(almanac.events.size(), 5U);
    EXPECT_THAT(to_text(almanac), HasSubstr("2024-03-20T03:06"));
    EXPECT_TRUE(almanac.solar_eclipses.empty());
}

}  // namespace
}  // namespace skyig::clients::ephem
