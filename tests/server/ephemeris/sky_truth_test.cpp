// Sun, Moon and planets against places computed from DE441 and, where the clone has it, against JPL Horizons:
// every model, every row, with the bound that is promised for it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/ephemeris/places.h"
#include "server/ephemeris/sky_clockwork.h"
#include "server/ephemeris/sky_state.h"
#include "tests/server/ephemeris/truth.h"

namespace skyig::server::ephemeris {
namespace {

using tests::CsvRow;
using tests::ErrorStatistics;
using tests::kArcsecPerRad;
using tests::kRadPerDeg;
using tests::separation_arcsec;

constexpr std::array kModels{Model::kAlmanac, Model::kErfa, Model::kSeries};

/// Largest error allowed, arcsec, in the order of Body.
struct Bounds {
    std::array<double, kBodyCount> arcsec;
};

constexpr std::array<Bounds, 3> kBounds{Bounds{{60.0, 1300.0, 60.0, 120.0, 350.0, 900.0, 1600.0}},
                                        Bounds{{0.1, 12.0, 3.0, 15.0, 65.0, 100.0, 110.0}},
                                        Bounds{{0.1, 0.6, 1.5, 1.5, 1.5, 1.5, 1.5}}};

const Bounds& bounds_of(Model model) {
    return kBounds[static_cast<std::size_t>(model)];
}

struct PlaceErrors {
    std::array<ErrorStatistics, kBodyCount> arcsec;

    void add(const CsvRow& row, double error_arcsec) {
        arcsec[index_of(tests::body_of(row))].add(error_arcsec);
    }
    void print(const char* what) const {
        std::printf("%s (max, rms arcsec):", what);
        for (const Body body : kBodies) {
            const ErrorStatistics& errors = arcsec[index_of(body)];
            if (errors.count == 0) continue;
            std::printf(" %s %.3f %.3f,", std::string(name_of(body)).c_str(), errors.max, errors.rms());
        }
        std::printf("\n");
    }
    /// Bodies without a row are those of which the table has none: see `bodies`.
    void expect_within(const Bounds& bounds, std::size_t bodies = kBodyCount,
                       double rounding_arcsec = 0.0) const {
        std::size_t met = 0;
        for (const Body body : kBodies) {
            met += arcsec[index_of(body)].count > 0 ? 1 : 0;
            EXPECT_LE(arcsec[index_of(body)].max, bounds.arcsec[index_of(body)] + rounding_arcsec)
                << name_of(body);
        }
        EXPECT_EQ(met, bodies);
    }
};

const std::vector<CsvRow>& topo_truth() {
    static const std::vector<CsvRow> rows = tests::read_csv(SKYIG_TEST_DATA "/ephemeris/topo_truth.csv");
    return rows;
}

const std::vector<CsvRow>& geo_truth() {
    static const std::vector<CsvRow> rows = tests::read_csv(SKYIG_TEST_DATA "/ephemeris/geo_truth.csv");
    return rows;
}

/// The decimal text is exact: whole days and the rest are read apart.
JulianDate jd_of(const CsvRow& row) {
    const std::string& text = row.text("jd_tt");
    const std::size_t point = text.find('.');
    return {std::stod(text.substr(0, point)), std::stod(text.substr(point))};
}

Instant instant_of(const CsvRow& row) {
    return tests::instant_of(row.text("utc"), row.number("tt_minus_utc_s"), row.number("ut1_minus_utc_s"));
}

glm::dvec3 equatorial_direction(double ra_deg, double dec_deg) {
    const double ra = ra_deg * kRadPerDeg;
    const double dec = dec_deg * kRadPerDeg;
    return {std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec)};
}

glm::dvec3 horizontal_truth(const CsvRow& row) {
    return tests::direction_of(row.number("az_deg"), row.number("el_deg"));
}

class SkyTruth : public testing::TestWithParam<Model> {
  protected:
    [[nodiscard]] std::string titled(const char* what) const {
        return std::string(kModelNames[static_cast<std::size_t>(GetParam())]) + ", " + what;
    }
};

TEST_P(SkyTruth, TopocentricDirectionsHoldInEveryRow) {
    PlaceErrors errors;
    for (const CsvRow& row : topo_truth()) {
        const SkyState state = compute_sky_state(instant_of(row), tests::place_of(row), GetParam());
        const ApparentPlace place = apparent_place(state, tests::body_of(row));
        errors.add(row, separation_arcsec(place.direction, horizontal_truth(row)));
    }
    errors.print(titled("topo_truth az/el").c_str());
    ASSERT_GE(topo_truth().size(), 770U);
    errors.expect_within(bounds_of(GetParam()));
}

TEST_P(SkyTruth, RightAscensionAndDeclinationOfDateHoldInEveryRow) {
    PlaceErrors errors;
    for (const CsvRow& row : topo_truth()) {
        const SkyState state = compute_sky_state(instant_of(row), tests::place_of(row), GetParam());
        const Equatorial seen =
            equatorial_of_date(state, apparent_place(state, tests::body_of(row)).direction);
        errors.add(row, separation_arcsec(
                            equatorial_direction(seen.right_ascension_rad / kRadPerDeg,
                                                 seen.declination_rad / kRadPerDeg),
                            equatorial_direction(row.number("ra_app_deg"), row.number("dec_app_deg"))));
    }
    errors.print(titled("topo_truth RA/Dec").c_str());
    errors.expect_within(bounds_of(GetParam()));
}

TEST_P(SkyTruth, GeocentricDirectionsHoldInEveryRow) {
    PlaceErrors errors;
    for (const CsvRow& row : geo_truth()) {
        const GeocentricPlaces places = compute_geocentric(jd_of(row), GetParam());
        errors.add(row, separation_arcsec(
                            places.of(tests::body_of(row)).direction,
                            equatorial_direction(row.number("ra_app_deg"), row.number("dec_app_deg"))));
    }
    errors.print(titled("geo_truth RA/Dec").c_str());
    ASSERT_GE(geo_truth().size(), 658U);
    errors.expect_within(bounds_of(GetParam()));
}

TEST_P(SkyTruth, HorizonsAgrees) {
    const std::vector<CsvRow> rows = tests::read_csv(SKYIG_REFERENCE "/ephemeris/horizons_airless.csv");
    if (rows.empty()) GTEST_SKIP() << "the table horizons_airless.csv is not part of this clone";
    PlaceErrors errors;
    for (const CsvRow& row : rows) {
        const Instant instant =
            tests::instant_of(row.text("date_ut"), row.number("tt_minus_ut_s"), row.number("ut1_minus_ut_s"));
        const SkyState state = compute_sky_state(instant, tests::place_of(row), GetParam());
        errors.add(row,
                   separation_arcsec(apparent_place(state, tests::body_of(row)).direction,
                                     tests::direction_of(row.number("hz_az_deg"), row.number("hz_el_deg"))));
    }
    errors.print(titled("Horizons airless").c_str());
    // Printed to 0.36 arcsec in each coordinate.
    EXPECT_EQ(rows.size(), 468U);
    constexpr std::size_t kSunMoonJupiter = 3;
    errors.expect_within(bounds_of(GetParam()), kSunMoonJupiter, 0.3);
}

TEST_P(SkyTruth, DistancesAndSemidiametersHold) {
    std::array<ErrorStatistics, kBodyCount> range_ppm;
    std::array<ErrorStatistics, kBodyCount> semidiameter_arcsec;
    for (const CsvRow& row : topo_truth()) {
        const SkyState state = compute_sky_state(instant_of(row), tests::place_of(row), GetParam());
        const Body body = tests::body_of(row);
        const ApparentPlace place = apparent_place(state, body);
        range_ppm[index_of(body)].add((place.distance_km / row.number("range_km") - 1.0) * 1e6);
        semidiameter_arcsec[index_of(body)].add(place.angular_radius_rad * kArcsecPerRad -
                                                row.number("semidiam_arcsec"));
    }
    // The truth's ranges carry six digits, its semidiameters a thousandth of an arcsec.
    constexpr std::array kWorstRange_ppm{6000.0, 500.0, 5.0};
    constexpr std::array kWorstSemidiameter_arcsec{3.0, 0.05, 0.002};
    const std::size_t model = static_cast<std::size_t>(GetParam());
    std::printf("%s (max):", titled("range ppm, semidiameter arcsec").c_str());
    for (const Body body : kBodies) {
        const std::size_t i = index_of(body);
        std::printf(" %s %.1f %.4f,", std::string(name_of(body)).c_str(), range_ppm[i].max,
                    semidiameter_arcsec[i].max);
        EXPECT_LE(range_ppm[i].max, kWorstRange_ppm[model]) << name_of(body);
        EXPECT_LE(semidiameter_arcsec[i].max, kWorstSemidiameter_arcsec[model]) << name_of(body);
    }
    std::printf("\n");
}

TEST_P(SkyTruth, PhaseAnglesAndLitFractionsHold) {
    std::array<ErrorStatistics, kBodyCount> phase_arcsec;
    std::array<ErrorStatistics, kBodyCount> lit_fraction;
    for (const CsvRow& row : topo_truth()) {
        const SkyState state = compute_sky_state(instant_of(row), tests::place_of(row), GetParam());
        const Body body = tests::body_of(row);
        const ApparentPlace place = apparent_place(state, body);
        phase_arcsec[index_of(body)].add(
            (place.phase_angle_rad / kRadPerDeg - row.number("phase_angle_deg")) * 3600.0);
        lit_fraction[index_of(body)].add(place.lit_fraction - row.number("illum_fraction"));
    }
    constexpr std::array kWorstPhase_arcsec{1300.0, 15.0, 1.0};
    constexpr std::array kWorstLit{3e-3, 5e-5, 1e-5};
    const std::size_t model = static_cast<std::size_t>(GetParam());
    std::printf("%s (max):", titled("phase angle arcsec, lit fraction").c_str());
    for (const Body body : kBodies) {
        const std::size_t i = index_of(body);
        std::printf(" %s %.2f %.6f,", std::string(name_of(body)).c_str(), phase_arcsec[i].max,
                    lit_fraction[i].max);
        EXPECT_LE(phase_arcsec[i].max, kWorstPhase_arcsec[model]) << name_of(body);
        EXPECT_LE(lit_fraction[i].max, kWorstLit[model]) << name_of(body);
    }
    std::printf("\n");
}

/// Position angle at `at` of the great circle to `towards`, from the pole through east: the textbook's
/// formula in right ascensions and declinations.
double position_angle_deg(const CsvRow& at, const CsvRow& towards) {
    const double dec = at.number("dec_app_deg") * kRadPerDeg;
    const double dec_towards = towards.number("dec_app_deg") * kRadPerDeg;
    const double east = (towards.number("ra_app_deg") - at.number("ra_app_deg")) * kRadPerDeg;
    return std::atan2(std::cos(dec_towards) * std::sin(east),
                      std::sin(dec_towards) * std::cos(dec) -
                          std::cos(dec_towards) * std::sin(dec) * std::cos(east)) /
           kRadPerDeg;
}

TEST_P(SkyTruth, BrightLimbsPointToTheSunOfTheTable) {
    std::map<std::string, CsvRow> suns;
    const auto key = [](const CsvRow& row) { return row.text("utc") + row.text("site"); };
    for (const CsvRow& row : topo_truth()) {
        if (row.text("body") == "sun") suns.emplace(key(row), row);
    }
    std::array<ErrorStatistics, kBodyCount> error_deg;
    for (const CsvRow& row : topo_truth()) {
        const auto sun = suns.find(key(row));
        if (row.text("body") == "sun" || sun == suns.end()) continue;
        // Next to conjunction and opposition the limb turns with every arcsecond of the places.
        const double from_sun_rad = angle_between_rad(horizontal_truth(row), horizontal_truth(sun->second));
        if (std::sin(from_sun_rad) < 0.25) continue;
        const SkyState state = compute_sky_state(instant_of(row), tests::place_of(row), GetParam());
        const Body body = tests::body_of(row);
        const double limb_deg = apparent_place(state, body).bright_limb_rad / kRadPerDeg;
        error_deg[index_of(body)].add(std::remainder(limb_deg - position_angle_deg(row, sun->second), 360.0));
    }
    // Aberration moves Sun and body apart by up to its 20 arcsec, which the light on the body does not
    // follow.
    constexpr std::array kWorst_deg{1.0, 0.1, 0.05};
    std::printf("%s (max, rows):", titled("bright limb deg").c_str());
    for (const Body body : kBodies) {
        if (body == Body::kSun) continue;
        const ErrorStatistics& errors = error_deg[index_of(body)];
        std::printf(" %s %.4f %zu,", std::string(name_of(body)).c_str(), errors.max, errors.count);
        EXPECT_GE(errors.count, 10U) << name_of(body);
        EXPECT_LE(errors.max, kWorst_deg[static_cast<std::size_t>(GetParam())]) << name_of(body);
    }
    std::printf("\n");
}

INSTANTIATE_TEST_SUITE_P(Models, SkyTruth, testing::ValuesIn(kModels), [](const auto& of) {
    return std::string(kModelNames[static_cast<std::size_t>(of.param)]);
});

TEST(SkyTruthByOurTime, OurOwnTimeScalesLeadToTheSameSky) {
    // UTC from the text and DUT1 from the row; delta-T before 1972 and the held 69.184 s after the table are
    // ours.
    PlaceErrors errors;
    for (const CsvRow& row : topo_truth()) {
        const std::optional<UtcClockTime> utc = UtcClockTime::from_civil(tests::civil_of(row.text("utc")));
        ASSERT_TRUE(utc.has_value()) << row.text("utc");
        const Instant instant = make_instant(*utc, row.number("ut1_minus_utc_s"));
        EXPECT_FALSE(instant.clamped) << row.text("utc");
        const SkyState state = compute_sky_state(instant, tests::place_of(row));
        errors.add(row, separation_arcsec(apparent_place(state, tests::body_of(row)).direction,
                                          horizontal_truth(row)));
    }
    errors.print("topo_truth by our time scales");
    errors.expect_within({{0.15, 1.2, 1.5, 1.5, 1.5, 1.5, 1.5}});
}

}  // namespace
}  // namespace skyig::server::ephemeris
