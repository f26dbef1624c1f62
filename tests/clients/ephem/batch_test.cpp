// Tables as people have them: what is read, what is told of bad rows, what comes out.
#include "clients/skyig/ephem/batch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "clients/csv.h"
#include "clients/skyig/ephem/body_place.h"
#include "clients/skyig/ephem/told_angle.h"

namespace skyig::clients::ephem {
namespace {

using server::ephemeris::Body;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Outcome {
    BatchCount count;
    std::string text;
    std::string errors;
    std::vector<CsvRecord> records;

    /// A field of a row (from 0) by its column's name.
    [[nodiscard]] std::string field(std::size_t row, std::string_view column) const {
        const std::vector<std::string>& names = records.at(0).fields;
        const auto at = std::find(names.begin(), names.end(), column) - names.begin();
        return records.at(row + 1).fields.at(static_cast<std::size_t>(at));
    }
    [[nodiscard]] double number(std::size_t row, std::string_view column) const {
        return std::stod(field(row, column));
    }
};

Outcome run(const std::string& table, BatchSettings settings = {}) {
    settings.input_name = "in.csv";
    std::istringstream input(table);
    std::ostringstream output;
    std::ostringstream errors;
    Outcome outcome;
    outcome.count = run_batch(
        input, [&]() -> std::ostream& { return output; }, errors, settings);
    outcome.text = output.str();
    outcome.errors = errors.str();
    std::istringstream again(outcome.text);
    CsvReader reader(again);
    while (std::optional<CsvRecord> record = reader.next())
        outcome.records.push_back(std::move(*record));
    return outcome;
}

void expect_refused(const std::string& table, const std::string& part, const BatchSettings& settings = {}) {
    try {
        run(table, settings);
        ADD_FAILURE() << "taken: " << table;
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr(part));
        EXPECT_THAT(error.what(), HasSubstr("in.csv"));
    }
}

TEST(Batch, EveryColumnStaysAndTheNewOnesFollowInOrder) {
    const Outcome outcome =
        run("# truth\n\nnote,utc,body,lat_deg,lon_deg,h_m\r\n"
            "\"a, b\",2024-04-08T19:12:34Z,moon,41.0341,-83.6523,0\r\n");
    EXPECT_EQ(outcome.count.rows, 1U);
    EXPECT_EQ(outcome.errors, "");
    EXPECT_THAT(outcome.text,
                StartsWith("note,utc,body,lat_deg,lon_deg,h_m,skyig_ra_deg,skyig_dec_deg,skyig_az_deg,"
                           "skyig_el_deg,skyig_el_refracted_deg,skyig_range_km,skyig_semidiameter_arcsec,"
                           "skyig_phase_angle_deg,skyig_illuminated_fraction,skyig_bright_limb_deg,"
                           "skyig_magnitude,skyig_subearth_lon_deg,skyig_subearth_lat_deg,"
                           "skyig_subsolar_lon_deg,skyig_subsolar_lat_deg,skyig_axis_pa_deg\r\n"
                           "\"a, b\",2024-04-08T19:12:34Z,moon,41.0341,-83.6523,0,"));
    ASSERT_EQ(outcome.records.size(), 2U);
    EXPECT_EQ(outcome.records[1].fields.size(), 6U + kBatchColumns.size());
    EXPECT_NEAR(outcome.number(0, "skyig_el_deg"), 50.304, 0.001);
    EXPECT_NEAR(outcome.number(0, "skyig_el_refracted_deg") - outcome.number(0, "skyig_el_deg"), 0.0137,
                0.001);
}

TEST(Batch, OnlyTheMoonHasAFaceAndTheSunNoLimb) {
    const Outcome outcome =
        run("utc,body,lat_deg,lon_deg\n2024-04-08T19:12:34Z,Sun,41,-83\n2024-04-08T19:12:34Z,MARS,41,-83\n");
    for (const char* column : {"skyig_subearth_lon_deg", "skyig_subsolar_lat_deg", "skyig_axis_pa_deg"}) {
        EXPECT_EQ(outcome.field(0, column), "");
        EXPECT_EQ(outcome.field(1, column), "");
    }
    EXPECT_EQ(outcome.field(0, "skyig_bright_limb_deg"), "");
    EXPECT_NE(outcome.field(1, "skyig_bright_limb_deg"), "");
    EXPECT_EQ(outcome.number(0, "skyig_illuminated_fraction"), 1.0);
}

TEST(Batch, JulianDatesAreSeenFromTheEarthsCentre) {
    const Outcome outcome = run("jd_tt,body,lat_deg,lon_deg\n2451545.0000,sun,50,10\n");
    EXPECT_EQ(outcome.field(0, "skyig_az_deg"), "");
    EXPECT_EQ(outcome.field(0, "skyig_el_deg"), "");
    EXPECT_EQ(outcome.field(0, "skyig_el_refracted_deg"), "");
    EXPECT_NEAR(outcome.number(0, "skyig_ra_deg"), 281.277570, 3e-6);
}

TEST(Batch, WithoutPlaceOrBodyTheSettingsSayThem) {
    const std::string table = "utc,quarter\n2024-04-08T18:21Z,new\n";
    const Outcome bare = run(table);
    EXPECT_THAT(bare.errors, HasSubstr("in.csv: no column 'body'"));
    EXPECT_EQ(bare.count.bad_rows, 0U);
    EXPECT_EQ(bare.field(0, "skyig_el_deg"), "");
    EXPECT_NE(bare.field(0, "skyig_subearth_lon_deg"), "");
    BatchSettings settings;
    settings.body = Body::kJupiter;
    settings.site = server::ephemeris::Geodetic{20.0, 30.0, 0.0};
    const Outcome told = run(table, settings);
    EXPECT_EQ(told.errors, "");
    EXPECT_NE(told.field(0, "skyig_el_deg"), "");
    EXPECT_LT(told.number(0, "skyig_magnitude"), -1.5);
}

TEST(Batch, AnyColumnOfTimesCanBeNamed) {
    BatchSettings settings;
    settings.time_column = "dusk";
    settings.body = Body::kSun;
    const Outcome outcome = run("lat_deg,lon_deg,dusk\n28.538,-81.379,2021-11-07T23:00Z\n", settings);
    EXPECT_NEAR(outcome.number(0, "skyig_el_deg"), -6.0, 0.2);
    settings.time_column = "jd_tt";
    EXPECT_EQ(run("utc,jd_tt\n,2451545.0\n", settings).errors, "");
    settings.time_column = "dawn";
    expect_refused("lat_deg,lon_deg,dusk\n", "no column 'dawn'", settings);
}

TEST(Batch, BadRowsAreToldAndTheOthersStillDone) {
    const Outcome outcome =
        run("utc,body,lat_deg,lon_deg,h_m,tt_minus_utc_s\n"
            "2024-04-08T19:12:34Z,moon,41,-83,0,\n"          // 2
            "2024-13-08T19:12:34Z,moon,41,-83,0,69.184\n"    // 3
            "2024-04-08T19:12:34Z,pluto,41,-83,0,69.184\n"   // 4
            "2024-04-08T19:12:34Z,moon,91,-83,0,69.184\n"    // 5
            "2024-04-08T19:12:34Z,moon,41,east,0,69.184\n"   // 6
            "2024-04-08T19:12:34Z,moon,41,-83,,69.184\n"     // 7
            "2024-04-08T19:12:34Z,moon,41,-83,0,nan\n"       // 8
            "2024-04-08T19:12:34Z,moon,41\n"                 // 9
            "1899-12-31T19:12:34Z,moon,41,-83,0,69.184\n"    // 10
            "2101-01-01T19:12:34Z,moon,41,-83,0,\n"          // 11
            "2024-04-08T19:12:34Z,\"moon,41,-83,0,69.184\n"  // 12
            "2024-04-08T19:12:34Z,moon,41,-83,0,69.184\n");  // 13
    EXPECT_EQ(outcome.count.rows, 12U);
    EXPECT_EQ(outcome.count.bad_rows, 10U);
    for (const char* line :
         {"in.csv:3: utc: '2024-13-08T19:12:34Z' is no time; write it as 2026-06-21T19:30:00Z\n",
          "in.csv:4: body: 'pluto' is none of sun, moon, mercury, venus, mars, jupiter, saturn\n",
          "in.csv:5: lat_deg: '91' is not a number in [-90, 90]\n",
          "in.csv:6: lon_deg: 'east' is not a number in [-360, 360]\n",
          "in.csv:7: h_m: '' is not a number in", "in.csv:8: tt_minus_utc_s: 'nan' is not a number in",
          "in.csv:9: 3 fields where the heading has 6\n",
          "in.csv:10: utc: '1899-12-31T19:12:34Z' is outside the years 1900..2100",
          "in.csv:11: utc: ", "in.csv:12: a quote is not closed"})
        EXPECT_THAT(outcome.errors, HasSubstr(line));
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 10);
    // Rows 9 and 12 cannot be given columns; the others keep theirs, and the new ones are empty.
    ASSERT_EQ(outcome.records.size(), 1U + 10U);
    EXPECT_EQ(outcome.field(1, "skyig_ra_deg"), "");
    EXPECT_EQ(outcome.records[2].fields.size(), outcome.records[0].fields.size());
    EXPECT_NEAR(outcome.number(9, "skyig_ra_deg"), outcome.number(0, "skyig_ra_deg"), 1e-6);
}

TEST(Batch, OfSeveralTimesTheFirstIsReadAlone) {
    const Outcome outcome = run("jd_tt,utc,body\n2451545.0,,sun\n2451545.0,2024-04-08T19:12:34Z,sun\n");
    EXPECT_EQ(outcome.count.bad_rows, 1U);
    EXPECT_THAT(outcome.errors, HasSubstr("in.csv:2: utc: '' is no time"));
    EXPECT_NEAR(outcome.number(1, "skyig_ra_deg"), 17.9, 0.2);
}

TEST(Batch, HeadingsMayBeInCapitals) {
    const Outcome outcome =
        run("UTC,Body,LAT_deg,Lon_Deg,H_M,TT_minus_utc_s\n2024-04-08T19:12:34Z,sun,41,-83,100,69.184\n");
    EXPECT_EQ(outcome.errors, "");
    EXPECT_NEAR(outcome.number(0, "skyig_ra_deg"), 17.9, 0.2);
    EXPECT_NE(outcome.field(0, "skyig_el_deg"), "");
    expect_refused("utc,SKYIG_RA_DEG\n", "is there already");
}

TEST(Batch, WhatTheTableSaysComesBeforeTheSettings) {
    BatchSettings settings;
    settings.body = Body::kMars;
    settings.site = server::ephemeris::Geodetic{-30.0, 100.0, 5000.0};
    const std::string table = "utc,body,lat_deg,lon_deg\n2024-04-08T19:12:34Z,sun,41,-83\n";
    EXPECT_EQ(run(table, settings).text, run(table).text);
}

TEST(Batch, LinesTooLongAreToldAndTheOthersStillDone) {
    std::string table = "utc,body\n2024-04-08T19:12:34Z,";
    table.append(2'000'000, 'x').append("\n2024-04-08T19:12:34Z,sun\n");
    const Outcome outcome = run(table);
    EXPECT_EQ(outcome.count.rows, 2U);
    EXPECT_EQ(outcome.count.bad_rows, 1U);
    EXPECT_EQ(outcome.errors, "in.csv:2: the line is longer than 1048576 bytes\n");
    EXPECT_NEAR(outcome.number(0, "skyig_ra_deg"), 17.9, 0.2);
    expect_refused(std::string(2'000'000, 'x'), "longer than");
}

TEST(Batch, NothingIsOpenedForAHeadingThatCannotBeUsed) {
    std::istringstream input("when,body\n");
    std::ostringstream text;
    bool opened = false;
    const auto open = [&]() -> std::ostream& {
        opened = true;
        return text;
    };
    EXPECT_THROW(run_batch(input, open, text, {}), std::runtime_error);
    EXPECT_FALSE(opened);
}

TEST(Batch, AnglesOfTheCircleEndBelow360) {
    EXPECT_EQ(told_in_circle(359.9996, 3), "0.000");
    EXPECT_EQ(told_in_circle(359.9994, 3), "359.999");
    EXPECT_EQ(told_in_circle(359.96, 1, 5), "  0.0");
    EXPECT_EQ(told_in_circle(360.0 - 1e-10, 9), "0.000000000");
    EXPECT_EQ(told_in_circle(0.0, 3), "0.000");
    EXPECT_EQ(in_circle_deg(-1e-300), 0.0);
    EXPECT_EQ(in_circle_deg(-std::numbers::pi / 2.0), 270.0);
    EXPECT_LT(in_circle_deg(std::nextafter(2.0 * std::numbers::pi, 0.0)), 360.0);
}

TEST(Batch, HeadingsThatCannotBeUsedAreToldInOneLine) {
    expect_refused("", "no heading line");
    expect_refused("# nothing\n", "no heading line");
    expect_refused("when,body\n", "no time column");
    expect_refused("utc,lat_deg\n", "lon_deg is missing");
    expect_refused("utc,skyig_ra_deg\n", "'skyig_ra_deg' is there already");
    expect_refused("\"utc,body\n", "quote");
}

TEST(Batch, SecondsToSixtyAndPlacesToTheEndsOfTheirRanges) {
    const Outcome outcome =
        run("utc,body,lat_deg,lon_deg,h_m\n2016-12-31T23:59:60.999Z,sun,90,180,0\n"
            "2016-12-31T23:59:59Z,sun,-90,-180,-430\n1900-01-01 00:00:00,moon,+1e1,3.6E2,4e5\n"
            "2100-12-31T23:59:59.999,saturn,0,-360,3.6e7\n");
    EXPECT_EQ(outcome.errors, "");
    EXPECT_EQ(outcome.count.bad_rows, 0U);
    EXPECT_EQ(outcome.records.size(), 5U);
}

}  // namespace
}  // namespace skyig::clients::ephem
