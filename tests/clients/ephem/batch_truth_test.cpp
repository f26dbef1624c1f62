// The truth tables sent through --batch as they are, and what comes out held against them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "clients/skyig/ephem/batch.h"
#include "tests/csv.h"
#include "tests/server/ephemeris/truth.h"

namespace skyig::clients::ephem {
namespace {

using tests::CsvRow;
using tests::ErrorStatistics;

/// The table with its new columns; no rows when it is not there.
std::vector<CsvRow> filled_in(const std::string& path, const BatchSettings& settings = {}) {
    std::ifstream input(path);
    if (!input) return {};
    const std::filesystem::path filled =
        std::filesystem::temp_directory_path() /
        fmt::format("skyig_filled_{}_{}", ::getpid(), std::filesystem::path(path).filename().string());
    std::ostringstream errors;
    {
        std::ofstream output(filled);
        const BatchCount count = run_batch(
            input, [&]() -> std::ostream& { return output; }, errors, settings);
        EXPECT_EQ(count.bad_rows, 0U) << errors.str();
    }
    std::vector<CsvRow> rows = tests::read_csv(filled.string());
    std::filesystem::remove(filled);
    return rows;
}

double separation_arcsec(const CsvRow& row, const char* lon, const char* lat, const char* our_lon,
                         const char* our_lat) {
    return tests::separation_arcsec(tests::direction_of(row.number(lon), row.number(lat)),
                                    tests::direction_of(row.number(our_lon), row.number(our_lat)));
}

double bound_arcsec(const std::string& body) {
    if (body == "sun") return 0.1;
    return body == "moon" ? 0.6 : 1.5;
}

void expect_within_bounds(const char* what, const std::map<std::string, ErrorStatistics>& errors,
                          std::size_t bodies = server::ephemeris::kBodyCount, double allowance_arcsec = 0.0) {
    EXPECT_EQ(errors.size(), bodies) << what;
    for (const auto& [body, error] : errors) {
        std::printf("%s %s: %zu rows max %.3f rms %.3f arcsec\n", what, body.c_str(), error.count, error.max,
                    error.rms());
        EXPECT_LE(error.max, bound_arcsec(body) + allowance_arcsec) << body;
    }
}

TEST(BatchTruth, TopocentricPlacesHold) {
    std::map<std::string, ErrorStatistics> equatorial;
    std::map<std::string, ErrorStatistics> horizontal;
    ErrorStatistics phase_deg;
    ErrorStatistics semidiameter_arcsec;
    for (const CsvRow& row : filled_in(SKYIG_TEST_DATA "/ephemeris/topo_truth.csv")) {
        equatorial[row.text("body")].add(
            separation_arcsec(row, "ra_app_deg", "dec_app_deg", "skyig_ra_deg", "skyig_dec_deg"));
        horizontal[row.text("body")].add(
            separation_arcsec(row, "az_deg", "el_deg", "skyig_az_deg", "skyig_el_deg"));
        phase_deg.add(row.number("phase_angle_deg") - row.number("skyig_phase_angle_deg"));
        semidiameter_arcsec.add(row.number("semidiam_arcsec") - row.number("skyig_semidiameter_arcsec"));
    }
    expect_within_bounds("topo RA/Dec", equatorial);
    expect_within_bounds("topo az/el", horizontal);
    EXPECT_LE(phase_deg.max, 0.001);
    EXPECT_LE(semidiameter_arcsec.max, 0.01);
}

TEST(BatchTruth, GeocentricPlacesHold) {
    std::map<std::string, ErrorStatistics> equatorial;
    for (const CsvRow& row : filled_in(SKYIG_TEST_DATA "/ephemeris/geo_truth.csv"))
        equatorial[row.text("body")].add(
            separation_arcsec(row, "ra_app_deg", "dec_app_deg", "skyig_ra_deg", "skyig_dec_deg"));
    expect_within_bounds("geo RA/Dec", equatorial);
}

TEST(BatchTruth, HorizonsHolds) {
    const std::vector<CsvRow> rows = filled_in(SKYIG_REFERENCE "/ephemeris/horizons_airless.csv");
    if (rows.empty()) GTEST_SKIP() << "the table horizons_airless.csv is not part of this clone";
    EXPECT_EQ(rows.size(), 468U);
    std::map<std::string, ErrorStatistics> horizontal;
    for (const CsvRow& row : rows)
        horizontal[row.text("body")].add(
            separation_arcsec(row, "hz_az_deg", "hz_el_deg", "skyig_az_deg", "skyig_el_deg"));
    constexpr std::size_t kSunMoonJupiter = 3;
    expect_within_bounds("Horizons az/el", horizontal, kSunMoonJupiter, 0.3);
}

TEST(BatchTruth, LibrationHolds) {
    const std::vector<CsvRow> rows = filled_in(SKYIG_REFERENCE "/ephemeris/libration.csv");
    if (rows.empty()) GTEST_SKIP() << "the table libration.csv is not part of this clone";
    EXPECT_EQ(rows.size(), 173U);
    for (const char* column :
         {"subsolar_lon_deg", "subsolar_lat_deg", "subearth_lon_deg", "subearth_lat_deg", "axis_pa_deg"}) {
        ErrorStatistics error_deg;
        for (const CsvRow& row : rows)
            error_deg.add(
                std::remainder(row.number(column) - row.number(std::string("skyig_") + column), 360.0));
        std::printf("libration %s: max %.4f rms %.4f deg\n", column, error_deg.max, error_deg.rms());
        EXPECT_LE(error_deg.max, 0.06) << column;
    }
}

TEST(BatchTruth, MagnitudesHold) {
    const std::vector<CsvRow> rows = filled_in(SKYIG_REFERENCE "/ephemeris/horizons_mag_phase.csv");
    if (rows.empty()) GTEST_SKIP() << "the table horizons_mag_phase.csv is not part of this clone";
    std::map<std::string, ErrorStatistics> magnitude;
    EXPECT_EQ(rows.size(), 293U);
    std::size_t without_magnitude = 0;
    for (const CsvRow& row : rows) {
        if (row.text("v_mag").empty()) {
            ++without_magnitude;
            continue;
        }
        magnitude[row.text("body")].add(row.number("v_mag") - row.number("skyig_magnitude"));
    }
    EXPECT_EQ(without_magnitude, 4U);
    for (const auto& [body, error] : magnitude) {
        std::printf("magnitude of %s: max %.3f\n", body.c_str(), error.max);
        EXPECT_LE(error.max, 0.1) << body;
    }
}

TEST(BatchTruth, EveryTableGoesInAsItIs) {
    const std::string folder = SKYIG_REFERENCE "/ephemeris/";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the reference tables are not part of this clone";
    for (const char* name :
         {"eclipse_greatest", "eclipse_sites", "horizons_topo", "moon_phases", "riseset", "seasons"}) {
        BatchSettings settings;
        settings.body = server::ephemeris::Body::kSun;
        const std::vector<CsvRow> rows = filled_in(folder + name + ".csv", settings);
        EXPECT_GT(rows.size(), 50U) << name;
        for (const CsvRow& row : rows)
            EXPECT_FALSE(row.text("skyig_dec_deg").empty()) << name;
    }
}

}  // namespace
}  // namespace skyig::clients::ephem
