#include "server/ephemeris/earth_orientation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "tests/server/ephemeris/largest.h"
#include "tests/server/ephemeris/leap_seconds.h"
#include "tests/support/allocation_count.h"

namespace skyig::server::ephemeris {
namespace {

using testing::HasSubstr;

constexpr double kRadPerArcsec = std::numbers::pi / (180.0 * 3600.0);
constexpr double kSecondsPerDay = 86400.0;

/// The first days of 1973 as the IERS rapid service has them, and two days that it has not predicted.
constexpr std::string_view kFinals =
    "73 1 2 41684.00 I  0.120733 0.009786  0.136966 0.015902  I 0.8084178 0.0002710  0.0000 0.1916  P    "
    "-0.766    0.199    -0.720    0.300   .143000   .137000   .8075000   -18.637    -3.667  \n"
    "73 1 3 41685.00 I  0.118980 0.011039  0.135656 0.013616  I 0.8056163 0.0002710  3.5563 0.1916  P    "
    "-0.751    0.199    -0.701    0.300   .141000   .134000   .8044000   -18.636    -3.571  \n"
    "73 1 4 41686.00 I -0.117227 0.011039  0.134348 0.013616  I-0.8027895 0.0002710  2.6599 0.1916  P    "
    "-0.738    0.199    -0.662    0.300   .139000   .131000   .8012000   -18.669    -3.621  \n"
    "73 1 5 41687.00                                                                                       \n"
    "73 1 6 41688.00\n";

/// The last days of a file of the IERS' long-term series.
constexpr std::string_view kC04 =
    "# EARTH ORIENTATION PARAMETER (EOP) PRODUCT CENTER\n"
    "# YR  MM  DD  HH       MJD        x(\")        y(\")  UT1-UTC(s)       dX(\")       dY(\")\n"
    "2026   8  19   0  61271.00    0.220748    0.350298   0.0068712    0.000321   -0.000170   -0.000968   "
    "-0.000838   0.0002427    0.000037    0.000040   0.0000183    0.000054    0.000073    0.000053    "
    "0.000095   0.0000068\n"
    "2026   8  20   0  61272.00    0.219593    0.349538   0.0067351    0.000357   -0.000102   -0.001160   "
    "-0.000765   0.0000465    0.000037    0.000041   0.0000204    0.000135    0.000370    0.000069    "
    "0.000091   0.0000069\n"
    "2026   8  21   0  61273.00    0.218568    0.348760   0.0067540    0.000394   -0.000051   -0.001007   "
    "-0.000845  -0.0000771    0.000039    0.000042   0.0000237    0.000152    0.000431    0.000070    "
    "0.000111   0.0000092\n";

constexpr std::string_view kHeading = "mjd,ut1_minus_utc_s,x_arcsec,y_arcsec\n";

/// Over the leap second of 2016: 57753 is 31 December.
constexpr std::string_view kLeap =
    "57751,-0.4045,0.090,0.270\n57752,-0.4056,0.088,0.269\n57753,-0.4069,0.086,0.268\n"
    "57754,0.5916,0.084,0.267\n57755,0.5900,0.082,0.266\n";

UtcClockTime at(std::string_view text) {
    return parse_utc(text).value();
}

EarthOrientation read(std::string_view text) {
    EarthOrientationResult result = parse_earth_orientation(text, "eop.txt");
    EXPECT_TRUE(result) << result.error;
    return result.orientation.value_or(EarthOrientation{});
}

EarthOrientation read_rows(std::string_view rows) {
    return read(std::string(kHeading) + std::string(rows));
}

/// The one line that is said about a text.
std::string error_of(std::string_view text) {
    const EarthOrientationResult result = parse_earth_orientation(text, "eop.txt");
    EXPECT_FALSE(result) << text;
    EXPECT_EQ(result.error.find('\n'), std::string::npos);
    std::printf("  %s\n", result.error.c_str());
    return result.error;
}

void expect_offsets(const TimeOffsets& offsets, double ut1_minus_utc_s, double x_arcsec, double y_arcsec) {
    ASSERT_TRUE(offsets.ut1_minus_utc_s.has_value());
    EXPECT_NEAR(*offsets.ut1_minus_utc_s, ut1_minus_utc_s, 1e-9);
    EXPECT_NEAR(offsets.polar_x_rad / kRadPerArcsec, x_arcsec, 1e-9);
    EXPECT_NEAR(offsets.polar_y_rad / kRadPerArcsec, y_arcsec, 1e-9);
    EXPECT_FALSE(offsets.tt_minus_utc_s.has_value());
}

double difference_s(const JulianDate& later, const JulianDate& earlier) {
    return ((later.day - earlier.day) + (later.fraction - earlier.fraction)) * kSecondsPerDay;
}

TEST(EarthOrientation, ReadsFixedColumns) {
    const EarthOrientation orientation = read(kFinals);
    EXPECT_EQ(orientation.size(), 3U);
    EXPECT_EQ(orientation.first_mjd(), 41684.0);
    EXPECT_EQ(orientation.last_mjd(), 41686.0);
    expect_offsets(orientation.at(at("1973-01-02T00:00:00Z")), 0.8084178, 0.120733, 0.136966);
    // Negative numbers fill their columns to the letter before them.
    expect_offsets(orientation.at(at("1973-01-04T00:00:00Z")), -0.8027895, -0.117227, 0.134348);
}

TEST(EarthOrientation, ReadsTextColumns) {
    const EarthOrientation orientation = read(kC04);
    EXPECT_EQ(orientation.size(), 3U);
    expect_offsets(orientation.at(at("2026-08-20T00:00:00Z")), 0.0067351, 0.219593, 0.349538);
    expect_offsets(orientation.at(at("2026-08-20T12:00:00Z")), 0.5 * (0.0067351 + 0.0067540),
                   0.5 * (0.219593 + 0.218568), 0.5 * (0.349538 + 0.348760));
}

TEST(EarthOrientation, ReadsCommasWithCommentsBlanksAndForeignLineEnds) {
    const EarthOrientation orientation = read(
        "# ours\r\nmjd,ut1_minus_utc_s,x_arcsec,y_arcsec\r\n\r\n# from here\r\n"
        "61271, 0.0068712 ,0.220748,0.350298\r\n61272.5,0.0067,0.21,0.34");
    EXPECT_EQ(orientation.size(), 2U);
    expect_offsets(orientation.at(at("2026-08-20T12:00:00Z")), 0.0067, 0.21, 0.34);
}

TEST(EarthOrientation, InterpolatesThroughALeapSecond) {
    const EarthOrientation orientation = read_rows(kLeap);
    expect_offsets(orientation.at(at("2016-12-31T00:00:00Z")), -0.4069, 0.086, 0.268);
    expect_offsets(orientation.at(at("2017-01-01T00:00:00Z")), 0.5916, 0.084, 0.267);
    // The day has 86401 s, over which UT1 - TAI goes from -36.4069 to -36.4084.
    const double part = 86400.5 / 86401.0;
    expect_offsets(orientation.at(at("2016-12-31T23:59:60.5Z")), -0.4069 - 0.0015 * part,
                   0.086 - 0.002 * part, 0.268 - 0.001 * part);

    UtcClockTime time = at("2016-12-31T23:59:58Z");
    Instant before = make_instant(time, orientation.at(time));
    double largest_s = 0.0;
    constexpr double kStep_s = 0.001;
    for (int step = 0; step < 4000; ++step) {
        time.advance(kStep_s);
        const Instant now = make_instant(time, orientation.at(time));
        tests::raise(largest_s, difference_s(now.ut1, before.ut1) - kStep_s);
        tests::raise(largest_s, difference_s(now.tt, before.tt) - kStep_s);
        before = now;
    }
    std::printf("UT1 from a file through a leap second, steps of 1 ms: max error %.1e s\n", largest_s);
    EXPECT_LE(largest_s, 1e-9);
}

TEST(EarthOrientation, EveryLeapSecondIsCrossedWithoutAStep) {
    double largest_s = 0.0;
    for (const std::string_view day : tests::kLeapSecondDays) {
        // A file as the tables would write it, rounded to 0.1 ms.
        std::string rows;
        UtcClockTime time = at(std::string(day) + "T00:00:00Z");
        for (int i = 0; i < 3; ++i) {
            const double rounded_s = std::round(known_offsets(time).ut1_minus_utc_s * 1e4) * 1e-4;
            rows += std::to_string(time.mjd()) + "," + std::to_string(rounded_s) + ",0,0\n";
            time.advance(kSecondsPerDay + (i == 0 ? 1.0 : 0.0));
        }
        const EarthOrientation orientation = read_rows(rows);
        for (const char* second : {"T12:00:00Z", "T23:59:59.999Z", "T23:59:60Z", "T23:59:60.999Z"}) {
            const UtcClockTime moment = at(std::string(day) + second);
            const TimeOffsets offsets = orientation.at(moment);
            ASSERT_TRUE(offsets.ut1_minus_utc_s.has_value());
            tests::raise(largest_s, *offsets.ut1_minus_utc_s - known_offsets(moment).ut1_minus_utc_s);
        }
    }
    std::printf("interpolated UT1-UTC on 27 leap second days: max %.5f s from what the file was made of\n",
                largest_s);
    EXPECT_LE(largest_s, 2e-4);
}

TEST(EarthOrientation, GoesOverToTheTablesWithinADay) {
    const EarthOrientation orientation = read_rows(kLeap);
    // Two days before and after: nothing, so what the tables say.
    for (const char* text : {"2016-12-27T23:00:00Z", "2017-01-03T00:00:01Z", "1950-01-01T00:00:00Z",
                             "2090-01-01T00:00:00Z", "9999-12-31T00:00:00Z", "0001-01-01T00:00:00Z"})
        EXPECT_EQ(orientation.at(at(text)), TimeOffsets{}) << text;
    const UtcClockTime half = at("2017-01-02T12:00:00Z");
    const UtcClockTime end = at("2017-01-02T00:00:00Z");
    const double correction_s = 0.5900 - known_offsets(end).ut1_minus_utc_s;
    EXPECT_GT(std::abs(correction_s), 1e-4);
    expect_offsets(orientation.at(half), known_offsets(half).ut1_minus_utc_s + 0.5 * correction_s, 0.041,
                   0.133);

    UtcClockTime time = at("2016-12-27T12:00:00Z");
    Instant before = make_instant(time, orientation.at(time));
    double largest_s = 0.0;
    double pole_step_rad = 0.0;
    constexpr double kStep_s = 10.0;
    for (int step = 0; step < 8 * 8640; ++step) {
        time.advance(kStep_s);
        const Instant now = make_instant(time, orientation.at(time));
        tests::raise(largest_s, difference_s(now.ut1, before.ut1) - kStep_s);
        tests::raise(pole_step_rad, now.polar_y_rad - before.polar_y_rad);
        before = now;
    }
    std::printf(
        "over both ends of a file in steps of 10 s: UT1 steps within %.1e s, pole within %.1e arcsec\n",
        largest_s, pole_step_rad / kRadPerArcsec);
    EXPECT_LE(largest_s, 1e-5);
    EXPECT_LE(pole_step_rad / kRadPerArcsec, 1e-4);
}

TEST(EarthOrientation, GivesOnlyThePoleWhileTheClockMeansUt1) {
    const EarthOrientation early = read_rows("37665,0.0326,-0.0127,0.2130\n37666,0.0321,-0.0159,0.2141\n");
    const TimeOffsets offsets = early.at(at("1962-01-01T12:00:00Z"));
    EXPECT_FALSE(offsets.ut1_minus_utc_s.has_value());
    EXPECT_NEAR(offsets.polar_x_rad / kRadPerArcsec, -0.0143, 1e-9);

    const EarthOrientation both = read_rows(
        "41315,0.2,0.1,0.1\n41316,0.2,0.1,0.1\n41317,-0.0454859,0.1,0.1\n"
        "41318,-0.0487,0.1,0.1\n");
    EXPECT_FALSE(both.at(at("1971-12-30T12:00:00Z")).ut1_minus_utc_s.has_value());
    EXPECT_NEAR(both.at(at("1972-01-01T00:00:00Z")).ut1_minus_utc_s.value(), -0.0454859, 1e-9);
    // 0.2 is what the broadcast UTC of 1971 was off; the clock's is not.
    EXPECT_NEAR(both.at(at("1971-12-31T23:59:59Z")).ut1_minus_utc_s.value(), -0.0454859, 1e-6);
}

TEST(EarthOrientation, KnowsNothingWithoutRows) {
    const EarthOrientation none;
    EXPECT_TRUE(none.empty());
    EXPECT_EQ(none.at(at("2020-01-01T00:00:00Z")), TimeOffsets{});
    EXPECT_TRUE(EarthOrientation({{57753.0, 0.1, 0.1, 0.1}}).empty());
}

TEST(EarthOrientationFile, SaysWhereAndWhatWouldBeRight) {
    const std::string heading(kHeading);
    EXPECT_THAT(error_of(""), HasSubstr("eop.txt: holds none of the at least two days"));
    EXPECT_THAT(error_of("# nothing\n\n"), HasSubstr("holds none"));
    EXPECT_THAT(error_of(heading + "57753,0,0,0\n"), HasSubstr("holds one"));
    EXPECT_THAT(error_of("mjd,dut1\n1,2\n"), HasSubstr("eop.txt:1: is no file of Earth orientation"));
    EXPECT_THAT(error_of("\x7f"
                         "ELF\x01\x02\n"),
                HasSubstr("eop.txt:1: is no file"));
    EXPECT_THAT(error_of(heading + "57753,0,0,0\n57754,zero,0,0\n"),
                HasSubstr("eop.txt:3: UT1-UTC in s is \"zero\"; it must be a number -1..1"));
    EXPECT_THAT(error_of(heading + "57753,0,0\n"), HasSubstr("pole y in arcsec is \"\""));
    EXPECT_THAT(error_of(heading + "57753,0,0,0,7\n"), HasSubstr("pole y in arcsec is \"0,7\""));
    EXPECT_THAT(error_of(heading + "57753,1.5,0,0\n"), HasSubstr("UT1-UTC in s is \"1.5\""));
    EXPECT_THAT(error_of(heading + "57753,nan,0,0\n"), HasSubstr("UT1-UTC in s is \"nan\""));
    EXPECT_THAT(error_of(heading + "57753,0,inf,0\n"), HasSubstr("pole x in arcsec is \"inf\""));
    EXPECT_THAT(error_of(heading + "57753,0,0,1e400\n"), HasSubstr("pole y"));
    EXPECT_THAT(error_of(heading + "2016-12-31,0,0,0\n"), HasSubstr("mjd is \"2016-12-31\""));
    EXPECT_THAT(error_of(heading + "1,0,0,0\n"), HasSubstr("it must be a number 15020..88434"));
    EXPECT_THAT(error_of(heading + "57753,0,0,0\n57753,0,0,0\n"), HasSubstr("eop.txt:3: mjd is 57753 after"));
    EXPECT_THAT(error_of(heading + "57753,0,0,0\n57785,0,0,0\n"), HasSubstr("ascend by at most 31"));
    EXPECT_THAT(error_of(heading + "57753,0,0,0\n57752,0,0,0\n"), HasSubstr("days must ascend"));
    std::string spoilt(kFinals);
    spoilt.replace(spoilt.find("0.8056163"), 9, "0.80x6163");
    EXPECT_THAT(error_of(spoilt), HasSubstr("eop.txt:2: UT1-UTC in s is \"0.80x6163\""));
    // The older C04 has no hours.
    EXPECT_THAT(error_of("1962   1   1  37665  -0.012700   0.213000   0.0326338   0.0017230  0.0  0.0\n"),
                HasSubstr("eop.txt:1: mjd is"));
}

TEST(EarthOrientationFile, IsReadFromDisk) {
    const std::filesystem::path directory(testing::TempDir());
    const std::string path = (directory / "skyig_eop.csv").string();
    std::ofstream(path) << kHeading << kLeap;
    const EarthOrientationResult result = read_earth_orientation(path);
    ASSERT_TRUE(result) << result.error;
    EXPECT_EQ(result.orientation->size(), 5U);
    std::filesystem::remove(path);
    EXPECT_THAT(read_earth_orientation(path).error, HasSubstr(path + ": cannot be opened: No such file"));
    EXPECT_THAT(read_earth_orientation(directory.string()).error, HasSubstr("cannot be read"));
}

TEST(EarthOrientationFile, SurvivesDamage) {
    std::mt19937 random(20260821);
    int refused = 0;
    constexpr int kFiles = 3000;
    for (int i = 0; i < kFiles; ++i) {
        std::string text(i % 3 == 0   ? kFinals
                         : i % 3 == 1 ? kC04
                                      : std::string(kHeading) + std::string(kLeap));
        for (int change = 0; change < 4; ++change) {
            const std::size_t where = random() % text.size();
            if (random() % 3 == 0) {
                text.resize(where + 1);
            } else {
                text[where] = static_cast<char>(random() % 256);
            }
        }
        const EarthOrientationResult result = parse_earth_orientation(text, "eop.txt");
        if (!result) {
            ++refused;
            EXPECT_FALSE(result.error.empty());
            continue;
        }
        for (const char* moment :
             {"1973-01-03T07:00:00Z", "2016-12-31T23:59:60.5Z", "2026-08-20T12:00:00Z"}) {
            const Instant instant = make_instant(at(moment), result.orientation->at(at(moment)));
            EXPECT_TRUE(std::isfinite(instant.ut1.fraction + instant.polar_x_rad + instant.polar_y_rad));
        }
    }
    std::printf("%d of %d damaged files refused\n", refused, kFiles);
    EXPECT_GT(refused, kFiles / 2);
    EXPECT_LT(refused, kFiles);
}

TEST(EarthOrientation, IsLookedUpWithoutAllocation) {
    std::vector<EarthOrientationRow> rows;
    constexpr int kDays = 20000;
    for (int day = 0; day < kDays; ++day)
        rows.push_back({41317.0 + day, 0.1, 0.1, 0.2});
    const EarthOrientation orientation(rows);
    UtcClockTime time = at("1972-01-01T00:00:00Z");
    constexpr int kLookups = 100'000;
    double sum = 0.0;
    const std::uint64_t before = tests::allocation_count();
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kLookups; ++i) {
        sum += orientation.at(time).polar_x_rad;
        time.advance(kDays * kSecondsPerDay / kLookups);
    }
    const auto end = std::chrono::steady_clock::now();
    EXPECT_EQ(tests::allocation_count() - before, 0U);
    EXPECT_GT(sum, 0.0);
    const double each_ns = std::chrono::duration<double, std::nano>(end - begin).count() / kLookups;
    std::printf("look-up among %d days: %.0f ns\n", kDays, each_ns);
    RecordProperty("lookup_ns", static_cast<int>(each_ns));
}

}  // namespace
}  // namespace skyig::server::ephemeris
