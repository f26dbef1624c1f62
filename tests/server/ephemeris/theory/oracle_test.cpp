// The theories against the whole of VSOP87 and ELP2000-82B as libnova carries them. That library keeps its
// last answers in unguarded statics: one thread, and only its calls at the level of the series.
#include <gtest/gtest.h>
#include <libnova/libnova.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/server/ephemeris/theory/theory_cases.h"

namespace {

using namespace skyig::server::ephemeris;
using namespace skyig::tests;

double one_date_jd(const JulianDate& tt) {
    return tt.day + tt.fraction;
}

/// From ecliptic to equator of J2000 (FK5), 0.02 arcsec from the ICRS.
glm::dvec3 equatorial(const glm::dvec3& ecliptic) {
    constexpr double kObliquity_rad = 84381.448 / kArcsecondsPerRadian;
    const double sine = std::sin(kObliquity_rad);
    const double cosine = std::cos(kObliquity_rad);
    return {ecliptic.x, ecliptic.y * cosine - ecliptic.z * sine, ecliptic.y * sine + ecliptic.z * cosine};
}

/// Heliocentric, in au: libnova turns VSOP87 to the FK5 ecliptic of J2000 itself.
glm::dvec3 libnova_planet_au(void (*planet)(double, ln_helio_posn*), const JulianDate& tt) {
    ln_helio_posn at{};
    planet(one_date_jd(tt), &at);
    const double longitude_rad = at.L * std::numbers::pi / 180.0;
    const double latitude_rad = at.B * std::numbers::pi / 180.0;
    return equatorial(at.R * glm::dvec3(std::cos(latitude_rad) * std::cos(longitude_rad),
                                        std::cos(latitude_rad) * std::sin(longitude_rad),
                                        std::sin(latitude_rad)));
}

struct PlanetOracle {
    Body body;
    void (*whole_theory)(double, ln_helio_posn*);
    // arcsec, and au
    double series_bound_arcsec;
    double series_bound_au;
    double plan94_bound_arcsec;
    double elements_bound_arcsec;
};

constexpr std::array<PlanetOracle, kPlanetCount> kPlanetOracles{{
    {Body::kMercury, ln_get_mercury_helio_coords, 0.4, 1e-6, 8.0, 40.0},
    {Body::kVenus, ln_get_venus_helio_coords, 0.3, 1e-6, 10.0, 60.0},
    {Body::kMars, ln_get_mars_helio_coords, 0.4, 2e-6, 40.0, 200.0},
    {Body::kJupiter, ln_get_jupiter_helio_coords, 0.4, 3e-6, 80.0, 720.0},
    {Body::kSaturn, ln_get_saturn_helio_coords, 0.5, 3e-6, 100.0, 1400.0},
}};

TEST(TheoryOracle, PlanetsFollowTheWholeOfVsop87) {
    for (const PlanetOracle& oracle : kPlanetOracles) {
        const std::string name(name_of(oracle.body));
        ErrorTally series;
        ErrorTally distance;
        ErrorTally plan94;
        ErrorTally elements;
        for (const JulianDate& tt : dates_1900_2100(300)) {
            const glm::dvec3 truth_au = libnova_planet_au(oracle.whole_theory, tt);
            const glm::dvec3 series_au =
                theory::planet_vsop87(oracle.body, tt).position_km / kKilometresPerAu;
            series.add(angle_arcsec(series_au, truth_au));
            distance.add(std::abs(glm::length(series_au) - glm::length(truth_au)));
            plan94.add(angle_arcsec(theory::planet_plan94(oracle.body, tt).position_km, truth_au));
            elements.add(angle_arcsec(theory::planet_elements(oracle.body, tt).position_km, truth_au));
        }
        series.print(name + " vsop87", "arcsec");
        distance.print(name + " vsop87 distance", "au");
        plan94.print(name + " plan94", "arcsec");
        elements.print(name + " elements", "arcsec");
        EXPECT_LE(series.greatest(), oracle.series_bound_arcsec) << name;
        EXPECT_LE(distance.greatest(), oracle.series_bound_au) << name;
        EXPECT_LE(plan94.greatest(), oracle.plan94_bound_arcsec) << name;
        EXPECT_LE(elements.greatest(), oracle.elements_bound_arcsec) << name;
    }
}

TEST(TheoryOracle, EarthFollowsTheWholeOfVsop87) {
    ErrorTally epv00;
    ErrorTally almanac;
    ErrorTally almanac_distance;
    for (const JulianDate& tt : dates_1900_2100(300)) {
        const glm::dvec3 truth_au = libnova_planet_au(ln_get_earth_helio_coords, tt);
        const glm::dvec3 almanac_km = theory::earth_almanac(tt).heliocentric.position_km;
        epv00.add(angle_arcsec(theory::earth_epv00(tt).heliocentric.position_km, truth_au));
        almanac.add(angle_arcsec(almanac_km, truth_au));
        almanac_distance.add(std::abs(glm::length(almanac_km) / kKilometresPerAu - glm::length(truth_au)));
    }
    epv00.print("earth epv00", "arcsec");
    almanac.print("earth almanac", "arcsec");
    almanac_distance.print("earth almanac distance", "au");
    EXPECT_LE(epv00.greatest(), 0.05);
    EXPECT_LE(almanac.greatest(), 60.0);
    EXPECT_LE(almanac_distance.greatest(), 2e-4);
}

TEST(TheoryOracle, MoonFollowsTheWholeOfElp2000) {
    ErrorTally series;
    ErrorTally distance;
    ErrorTally moon98;
    ErrorTally almanac;
    ErrorTally almanac_distance;
    for (const JulianDate& tt : dates_1900_2100(60)) {
        ln_rect_posn at{};
        constexpr double kEveryTerm = 0.0;
        ln_get_lunar_geo_posn(one_date_jd(tt), &at, kEveryTerm);
        const glm::dvec3 truth_km = equatorial({at.X, at.Y, at.Z});
        const glm::dvec3 series_km = theory::moon_elpmpp02(tt).position_km;
        const glm::dvec3 almanac_km = theory::moon_almanac(tt).position_km;
        series.add(angle_arcsec(series_km, truth_km));
        distance.add(std::abs(glm::length(series_km) - glm::length(truth_km)));
        moon98.add(angle_arcsec(theory::moon_moon98(tt).position_km, truth_km));
        almanac.add(angle_arcsec(almanac_km, truth_km));
        almanac_distance.add(std::abs(glm::length(almanac_km) - glm::length(truth_km)));
    }
    series.print("moon elpmpp02", "arcsec");
    distance.print("moon elpmpp02 distance", "km");
    moon98.print("moon moon98", "arcsec");
    almanac.print("moon almanac", "arcsec");
    almanac_distance.print("moon almanac distance", "km");
    // The oracle itself is 1.5 arcsec off in 1900 and 2100.
    EXPECT_LE(series.greatest(), 2.0);
    EXPECT_LE(series.rms(), 0.7);
    EXPECT_LE(distance.greatest(), 0.5);
    EXPECT_LE(moon98.greatest(), 12.0);
    EXPECT_LE(almanac.greatest(), 1400.0);
    EXPECT_LE(almanac_distance.greatest(), 1500.0);
}

}  // namespace
