// Stars: the whole apparent place against ERFA's chain, and what the renderer's one matrix leaves out of it.
#include "server/ephemeris/star_place.h"

#include <erfa.h>
#include <erfam.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <string_view>

#include "render/night/star_catalogue.h"
#include "tests/server/ephemeris/largest.h"
#include "tests/server/ephemeris/truth.h"

namespace skyig::server::ephemeris {
namespace {

using tests::separation_arcsec;

constexpr Geodetic kEye{-33.9, 151.2, 3000.0};
constexpr std::array<std::string_view, 5> kEpochs{"1900-02-03T04:05:06Z", "1950-06-10T12:00:00Z",
                                                  "2000-01-01T12:00:00Z", "2026-09-30T20:15:00Z",
                                                  "2100-12-01T01:00:00Z"};

/// Parallaxes of Hipparcos, arcsec, of naked-eye stars under 4 parsecs: they bound what parallax does.
struct NearStar {
    int hr;
    double parallax_arcsec;
};
constexpr std::array kNearStars{NearStar{5459, 0.742}, NearStar{2491, 0.379}, NearStar{1084, 0.311},
                                NearStar{8085, 0.287}, NearStar{2943, 0.286}, NearStar{8387, 0.276},
                                NearStar{509, 0.274}};

Instant instant_at(std::string_view utc) {
    return make_instant(parse_utc(utc).value());
}

double parallax_arcsec_of(const render::night::CatalogueStar& star) {
    for (const NearStar& near : kNearStars) {
        if (near.hr == star.hr) return near.parallax_arcsec;
    }
    return 0.0;
}

Star star_of(const render::night::CatalogueStar& catalogued) {
    return {.direction_gcrs = glm::normalize(glm::dvec3(catalogued.direction_gcrs)),
            .proper_motion_rad_yr = glm::dvec3(catalogued.proper_motion_rad_yr),
            .parallax_rad = parallax_arcsec_of(catalogued) * ERFA_DAS2R};
}

/// ERFA's independent chain with the whole IAU 2006/2000A.
class Chain {
  public:
    Chain(const Instant& instant, const Geodetic& eye) {
        double earth_barycentric[2][3]{};
        double earth_heliocentric[2][3]{};
        double matrix[3][3]{};
        eraEpv00(instant.tt.day, instant.tt.fraction, earth_heliocentric, earth_barycentric);
        eraC2i06a(instant.tt.day, instant.tt.fraction, matrix);
        const double locator = eraS06(instant.tt.day, instant.tt.fraction, matrix[2][0], matrix[2][1]);
        eraApco(instant.tt.day, instant.tt.fraction, earth_barycentric, earth_heliocentric[0], matrix[2][0],
                matrix[2][1], locator, eraEra00(instant.ut1.day, instant.ut1.fraction),
                eye.longitude_deg * tests::kRadPerDeg, eye.latitude_deg * tests::kRadPerDeg, eye.height_m,
                instant.polar_x_rad, instant.polar_y_rad, 0.0, 0.0, 0.0, &astrometry_);
    }

    [[nodiscard]] glm::dvec3 direction_enu(const Star& star) {
        const glm::dvec3& p = star.direction_gcrs;
        const double ra = std::atan2(p.y, p.x);
        const double dec = std::atan2(p.z, std::hypot(p.x, p.y));
        const glm::dvec3 east(-std::sin(ra), std::cos(ra), 0.0);
        const glm::dvec3 north = glm::cross(p, east);
        const double ra_rate = glm::dot(star.proper_motion_rad_yr, east) / std::cos(dec);
        const double dec_rate = glm::dot(star.proper_motion_rad_yr, north);
        double intermediate_ra = 0.0;
        double intermediate_dec = 0.0;
        eraAtciq(ra, dec, ra_rate, dec_rate, star.parallax_rad * ERFA_DR2AS, 0.0, &astrometry_,
                 &intermediate_ra, &intermediate_dec);
        double azimuth = 0.0;
        double zenith = 0.0;
        double unused[3]{};
        eraAtioq(intermediate_ra, intermediate_dec, &astrometry_, &azimuth, &zenith, &unused[0], &unused[1],
                 &unused[2]);
        return {std::sin(azimuth) * std::sin(zenith), std::cos(azimuth) * std::sin(zenith), std::cos(zenith)};
    }

  private:
    eraASTROM astrometry_{};
};

/// What the renderer's vertex shader does with the same star.
glm::dvec3 drawn(const render::night::CatalogueStar& star, const SkyState& state) {
    const glm::dvec3 moved = render::night::direction_at(star, state.years_since_j2000);
    return state.enu_from_gcrs * glm::normalize(moved + state.earth_velocity_c);
}

double from_sun_deg(const glm::dvec3& direction_enu, const SkyState& state) {
    return angle_between_rad(direction_enu, state.sun.direction_enu) / tests::kRadPerDeg;
}

TEST(StarPlace, IsErfasChainForEveryStarOfTheCatalogue) {
    for (const std::string_view utc : kEpochs) {
        const Instant instant = instant_at(utc);
        const SkyState state = compute_sky_state(instant, kEye);
        Chain chain(instant, kEye);
        tests::ErrorStatistics error_arcsec;
        for (const render::night::CatalogueStar& catalogued : render::night::star_catalogue()) {
            const Star star = star_of(catalogued);
            const glm::dvec3 seen = star_direction(star, state);
            error_arcsec.add(separation_arcsec(seen, chain.direction_enu(star)));
        }
        std::printf("%s: %zu stars against ERFA's chain, max %.5f rms %.5f arcsec\n",
                    std::string(utc).c_str(), error_arcsec.count, error_arcsec.max, error_arcsec.rms());
        ASSERT_EQ(error_arcsec.count, render::night::kCatalogueStarCount);
        EXPECT_LE(error_arcsec.max, 0.01);
    }
}

TEST(StarPlace, OneMatrixLeavesUnderAnArcsecondOut) {
    for (const std::string_view utc : kEpochs) {
        const Instant instant = instant_at(utc);
        const SkyState state = compute_sky_state(instant, kEye);
        Chain chain(instant, kEye);
        tests::ErrorStatistics far_arcsec;
        tests::ErrorStatistics near_sun_arcsec;
        for (const render::night::CatalogueStar& catalogued : render::night::star_catalogue()) {
            const glm::dvec3 truth = chain.direction_enu(star_of(catalogued));
            const double left_out_arcsec = separation_arcsec(drawn(catalogued, state), truth);
            (from_sun_deg(truth, state) < 10.0 ? near_sun_arcsec : far_arcsec).add(left_out_arcsec);
        }
        std::printf(
            "%s: left out by the one matrix, max %.3f rms %.3f arcsec (%zu within 10 deg of the Sun: %.3f)\n",
            std::string(utc).c_str(), far_arcsec.max, far_arcsec.rms(), near_sun_arcsec.count,
            near_sun_arcsec.max);
        EXPECT_LE(far_arcsec.max, 1.2);
        EXPECT_LE(far_arcsec.rms(), 0.3);
        EXPECT_LE(near_sun_arcsec.max, 2.2);
    }
}

TEST(StarPlace, PolarMotionTurnsStarsAndSiteTogether) {
    Instant instant = instant_at("2020-05-05T03:00:00Z");
    instant.polar_x_rad = 0.3 * ERFA_DAS2R;
    instant.polar_y_rad = 0.45 * ERFA_DAS2R;
    const SkyState state = compute_sky_state(instant, kEye);
    const SkyState without = compute_sky_state(instant_at("2020-05-05T03:00:00Z"), kEye);
    Chain chain(instant, kEye);
    double largest_arcsec = 0.0;
    double largest_shift_arcsec = 0.0;
    for (const int hr : {2491, 2326, 424, 5459, 7001}) {
        const Star star = star_of(*render::night::find_star(hr));
        const glm::dvec3 seen = star_direction(star, state);
        tests::raise(largest_arcsec, separation_arcsec(seen, chain.direction_enu(star)));
        tests::raise(largest_shift_arcsec, separation_arcsec(seen, star_direction(star, without)));
    }
    std::printf("polar motion shifts by %.3f arcsec, against ERFA %.5f\n", largest_shift_arcsec,
                largest_arcsec);
    EXPECT_GT(largest_shift_arcsec, 0.3);
    EXPECT_LE(largest_arcsec, 0.01);
}

TEST(StarPlace, BendsTheLightOfAStarBesideTheSun) {
    // Half a degree off the Sun's centre a star stands 0.93 arcsec further out; before the disc's middle the
    // formula has no pole.
    const SkyState state = compute_sky_state(instant_at("2026-06-21T12:00:00Z"), kEye);
    const glm::dvec3 to_sun = -glm::normalize(state.earth_heliocentric_au);
    const glm::dvec3 aside = glm::normalize(glm::cross(to_sun, glm::dvec3(0.0, 0.0, 1.0)));
    SkyState still = state;
    still.eye_velocity_c = glm::dvec3(0.0);
    const auto shift_arcsec = [&](double off_deg) {
        const double off = off_deg * tests::kRadPerDeg;
        const Star star{.direction_gcrs = std::cos(off) * to_sun + std::sin(off) * aside};
        return separation_arcsec(star_direction(star, still), still.enu_from_gcrs * star.direction_gcrs);
    };
    std::printf("bent by %.4f arcsec at 0.5 deg, %.4f at 10 deg, %.4f at 90 deg\n", shift_arcsec(0.5),
                shift_arcsec(10.0), shift_arcsec(90.0));
    const double r_au = glm::length(state.earth_heliocentric_au);
    EXPECT_NEAR(shift_arcsec(0.5) * r_au, 0.00407 / std::tan(0.25 * tests::kRadPerDeg), 0.003);
    EXPECT_NEAR(shift_arcsec(90.0) * r_au, 0.00407, 1e-5);
    EXPECT_LE(shift_arcsec(0.0), 1e-6);
    EXPECT_LE(shift_arcsec(0.01), 10.0);
}

}  // namespace
}  // namespace skyig::server::ephemeris
