// One moment, told to people and to programs.
#include "clients/skyig/ephem/report.h"

#include <erfa.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "render/night/star_catalogue.h"
#include "server/ephemeris/angles.h"

namespace skyig::clients::ephem {
namespace {

using namespace server::ephemeris;
using Json = nlohmann::json;
using ::testing::HasSubstr;

ReportRequest eclipse_request() {
    return {.utc = parse_utc("2024-04-08T19:12:34Z").value(),
            .site = Geodetic{41.0341, -83.6523, 0.0},
            .bodies = {kBodies.begin(), kBodies.end()},
            .stars = {parse_star("sirius").value(), parse_star("HR 424").value()}};
}

TEST(EphemReport, JsonHasEveryBodyWithStableKeys) {
    const Json json = Json::parse(to_json(make_report(eclipse_request())));
    EXPECT_EQ(json["utc"], "2024-04-08T19:12:34.000Z");
    EXPECT_EQ(json["model"], "series");
    EXPECT_EQ(json["site"]["latitude_deg"], 41.0341);
    ASSERT_EQ(json["bodies"].size(), 7U);
    for (const Json& body : json["bodies"]) {
        for (const char* key : {"right_ascension_deg", "declination_deg", "azimuth_deg", "elevation_deg",
                                "elevation_refracted_deg", "range_km", "semidiameter_arcsec",
                                "phase_angle_deg", "illuminated_fraction", "magnitude"})
            EXPECT_TRUE(body.at(key).is_number()) << body["body"] << key;
        EXPECT_EQ(body.contains("axis_position_angle_deg"), body["body"] == "moon");
        EXPECT_EQ(body.contains("bright_limb_deg"), body["body"] != "sun");
    }
    EXPECT_EQ(json["sun_obscured"], 1.0);
    EXPECT_EQ(json["moon_sunlit"], 1.0);
    ASSERT_EQ(json["stars"].size(), 2U);
    EXPECT_EQ(json["stars"][0]["name"], "Sirius");
    EXPECT_EQ(json["stars"][1]["name"], "Polaris");
    EXPECT_EQ(json["next"].size(), 12U);
}

Equatorial catalogue_place(const StarPlace& place) {
    return equatorial_of(render::night::direction_at(*render::night::find_star(place.star.hr),
                                                     (2460409.3 - 2451545.0) / 365.25));
}

glm::dvec3 direction(double longitude_rad, double latitude_rad) {
    return {std::cos(latitude_rad) * std::cos(longitude_rad),
            std::cos(latitude_rad) * std::sin(longitude_rad), std::sin(latitude_rad)};
}

constexpr double kArcsecPerRad = 206264.806;
constexpr double kStarBound_arcsec = 0.005;

TEST(EphemReport, StarsFromTheEarthsCentreStandWhereErfaHasThem) {
    ReportRequest request = eclipse_request();
    request.site.reset();
    const Report report = make_report(request);
    for (const StarPlace& place : report.stars) {
        const Equatorial icrs = catalogue_place(place);
        double cirs_rad = 0.0;
        double declination_rad = 0.0;
        double origins_rad = 0.0;
        eraAtci13(icrs.right_ascension_rad, icrs.declination_rad, 0.0, 0.0, 0.0, 0.0, report.instant.tt.day,
                  report.instant.tt.fraction, &cirs_rad, &declination_rad, &origins_rad);
        const double off_arcsec =
            kArcsecPerRad * angle_between_rad(direction(cirs_rad - origins_rad, declination_rad),
                                              direction(glm::radians(place.right_ascension_deg),
                                                        glm::radians(place.declination_deg)));
        std::printf("%s: %.4f arcsec\n", place.star.name.c_str(), off_arcsec);
        EXPECT_LE(off_arcsec, kStarBound_arcsec);
    }
}

TEST(EphemReport, StarsFromASiteStandWhereErfaHasThem) {
    const ReportRequest request = eclipse_request();
    const Report report = make_report(request);
    for (const StarPlace& place : report.stars) {
        const Equatorial icrs = catalogue_place(place);
        double azimuth_rad = 0.0;
        double zenith_distance_rad = 0.0;
        double hour_angle_rad = 0.0;
        double declination_rad = 0.0;
        double cirs_rad = 0.0;
        double origins_rad = 0.0;
        ASSERT_EQ(eraAtco13(icrs.right_ascension_rad, icrs.declination_rad, 0.0, 0.0, 0.0, 0.0,
                            2400000.5 + request.utc.mjd(), request.utc.second_of_day() / 86400.0,
                            report.offsets.ut1_minus_utc_s, glm::radians(request.site->longitude_deg),
                            glm::radians(request.site->latitude_deg), request.site->height_m, 0.0, 0.0, 0.0,
                            0.0, 0.0, 0.5, &azimuth_rad, &zenith_distance_rad, &hour_angle_rad,
                            &declination_rad, &cirs_rad, &origins_rad),
                  0);
        const double sky_off_arcsec =
            kArcsecPerRad *
            angle_between_rad(direction(azimuth_rad, std::numbers::pi / 2.0 - zenith_distance_rad),
                              direction(glm::radians(place.horizontal->azimuth_deg),
                                        glm::radians(place.horizontal->elevation_deg)));
        std::printf("%s: %.4f arcsec\n", place.star.name.c_str(), sky_off_arcsec);
        EXPECT_LE(sky_off_arcsec, kStarBound_arcsec);
    }
}

TEST(EphemReport, LongNamesKeepTheColumns) {
    ReportRequest request = eclipse_request();
    request.stars.push_back(parse_star("Rigil Kentaurus").value());
    std::istringstream lines(to_text(make_report(request)));
    std::size_t heading_hours = std::string::npos;
    int told = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.find("RA of date") != std::string::npos) heading_hours = line.find("RA of date");
        if (heading_hours == std::string::npos || line.find("\u00b0") == std::string::npos) continue;
        EXPECT_EQ(line.find_first_of('h', heading_hours), heading_hours + 2) << line;
        ++told;
    }
    EXPECT_EQ(told, 10);
}

TEST(EphemReport, WithoutASiteItIsTheEarthsCentre) {
    ReportRequest request = eclipse_request();
    request.site.reset();
    const Report report = make_report(request);
    const Json json = Json::parse(to_json(report));
    EXPECT_TRUE(json["site"].is_null());
    EXPECT_FALSE(json["bodies"][0].contains("elevation_deg"));
    EXPECT_TRUE(json["next"].empty());
    EXPECT_THAT(to_text(report), HasSubstr("from the Earth's centre"));
}

TEST(EphemReport, TextTellsPeopleWhatMatters) {
    const std::string text = to_text(make_report(eclipse_request()));
    for (const char* part :
         {"2024-04-08T19:12:34.000Z", "41.034100° N 83.652300° W", "sun ", "saturn", "Sirius",
          "The Moon covers 100.00 % of the Sun.", "nautical dusk", "moon     rise"})
        EXPECT_THAT(text, HasSubstr(part));
    ReportRequest pole = eclipse_request();
    pole.site = Geodetic{90.0, 0.0, 0.0};
    pole.utc = parse_utc("2024-06-21T00:00:00Z").value();
    EXPECT_THAT(to_text(make_report(pole)), HasSubstr("within 36 hours"));
}

TEST(EphemReport, BodiesAreThoseAskedFor) {
    ReportRequest request = eclipse_request();
    request.bodies = {Body::kVenus};
    request.stars.clear();
    const Json json = Json::parse(to_json(make_report(request)));
    ASSERT_EQ(json["bodies"].size(), 1U);
    EXPECT_EQ(json["bodies"][0]["body"], "venus");
}

float magnitude_of(std::string_view name) {
    return render::night::find_star(parse_star(name).value().hr)->vmag;
}

TEST(EphemReport, StarNamesAreThoseOfBrightStars) {
    // A wrong number in the list of names would point at a faint star.
    constexpr double kFirstMagnitude = 1.4;
    constexpr double kThirdMagnitude = 3.3;
    for (const char* name :
         {"Sirius",  "Canopus",  "Rigil Kentaurus", "Arcturus",  "Vega",   "Capella", "Rigel",
          "Procyon", "Achernar", "Betelgeuse",      "Hadar",     "Altair", "Acrux",   "Aldebaran",
          "Antares", "Spica",    "Pollux",          "Fomalhaut", "Deneb",  "Regulus"})
        EXPECT_LT(magnitude_of(name), kFirstMagnitude) << name;
    for (const char* name :
         {"Acamar",      "Adhara",    "Alioth",         "Alkaid",  "Alnair",  "Alnilam",    "Alphard",
          "Alphecca",    "Alpheratz", "Ankaa",          "Atria",   "Avior",   "Bellatrix",  "Castor",
          "Denebola",    "Diphda",    "Dubhe",          "Elnath",  "Eltanin", "Enif",       "Gacrux",
          "Gienah",      "Hamal",     "Kaus Australis", "Kochab",  "Markab",  "Menkar",     "Menkent",
          "Miaplacidus", "Mirfak",    "Nunki",          "Peacock", "Polaris", "Rasalhague", "Sabik",
          "Schedar",     "Shaula",    "Suhail"})
        EXPECT_LT(magnitude_of(name), kThirdMagnitude) << name;
    EXPECT_EQ(parse_star("7001").value().name, "Vega");
    EXPECT_EQ(parse_star("hr2490").value().name, "HR 2490");
    for (const char* text : {"", "HR", "HR x", "0", "9111", "92", "-1", "Siriusb"})
        EXPECT_FALSE(parse_star(text).has_value()) << text;
}

}  // namespace
}  // namespace skyig::clients::ephem
