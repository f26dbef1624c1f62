// The dark sky, twilight and moonlight against what is known of them by number, asked through the light that
// is drawn.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "render/night/airglow.h"
#include "render/night/milky_way_map.h"
#include "render/night/natural_light.h"
#include "render/night/starlight.h"
#include "render/night/zodiacal_light.h"
#include "render/still_light.h"
#include "tests/csv.h"
#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using namespace tests;
using skyig::tests::read_csv;

constexpr double kPi = std::numbers::pi;

double magnitude(double cd_m2) {
    return -2.5 * std::log10(cd_m2 / 1.0807e5);
}

struct Drawn {
    Scene scene = make_scene(-40.0, 0.0, -40.0, 180.0, 0.0);

    Drawn() { scene.night.model = NightModel::kMean; }

    const StillLight& now() {
        still.settle(scene);
        return still;
    }
    double zenith_cd_m2() { return now().zenith_cd_m2(); }

    StillLight still;
};

double anchor(const std::string& name) {
    for (const auto& row : read_csv(SKYIG_TEST_DATA "/night/natural_night.csv")) {
        if (row.text("case") == name) return row.number("luminance_cd_m2_or_lux");
    }
    ADD_FAILURE() << "no anchor " << name;
    return 1.0;
}

void expect_anchor(const std::string& name, double ours) {
    const double off = magnitude(ours) - magnitude(anchor(name));
    std::printf("%-50s %.3g, known %.3g: %+.2f mag\n", name.c_str(), ours, anchor(name), off);
    EXPECT_NEAR(off, 0.0, 0.3) << name;
}

TEST(NaturalNight, AnchorsAreMetWithinThreeTenthsOfAMagnitude) {
    Drawn drawn;
    expect_anchor("natural zenith dark site typical", drawn.zenith_cd_m2());
    expect_anchor("horizontal illuminance clear moonless natural", drawn.now().sky_lux());
    const auto zodiacal = [](double longitude_deg, double latitude_deg) {
        return night::kS10_cd_m2 * night::zodiacal_s10(longitude_deg * kDegree, latitude_deg * kDegree);
    };
    expect_anchor("ecliptic pole zodiacal only", zodiacal(90.0, 90.0));
    expect_anchor("gegenschein zodiacal only", zodiacal(180.0, 0.0));
    expect_anchor("zodiacal cone 45 deg from the Sun on the ecliptic", zodiacal(45.0, 0.0));
    const night::Starlight pole = night::starlight_s10(0.0, 0.5 * kPi);
    expect_anchor("galactic pole starlight only", night::kS10_cd_m2 * (pole.even + pole.belt));
    night::MilkyWayMap map;
    map.begin(1.0, 1);
    map.build_rows(night::MilkyWayMap::kHeight);
    expect_anchor("Milky Way l=0 b=-4", night::mean_starlight_cd_m2(map, 0.0, -4.0 * kDegree, 2.0 * kDegree));
    expect_anchor("airglow zenith solar minimum", night::kS10_cd_m2 * night::airglow_zenith_s10(0.0) *
                                                      night::airglow_path(0.5 * kPi, 0.0, false).far);
}

TEST(NaturalNight, TownsMakeTheirZenith) {
    Drawn drawn;
    drawn.scene.night.city_count = 1;
    const double natural = drawn.zenith_cd_m2();
    for (const char* name : {"Bortle 4 rural zenith", "Bortle 6 suburban zenith", "Bortle 8 city zenith"}) {
        drawn.scene.night.cities[0] = {.latitude_deg = drawn.scene.eye.latitude_deg,
                                       .longitude_deg = drawn.scene.eye.longitude_deg,
                                       .zenith_cd_m2 = anchor(name) - natural};
        expect_anchor(name, drawn.zenith_cd_m2());
    }
}

// The seed's sum of constants is 22.2 mag/arcsec2.
TEST(NaturalNight, SeedsConstantsMakeANaturalSky) {
    Drawn drawn;
    drawn.scene.night.model = NightModel::kSeed;
    const double ours = magnitude(drawn.zenith_cd_m2());
    std::printf("zenith by the seed's constants %.2f mag/arcsec2\n", ours);
    EXPECT_NEAR(ours, 22.2, 0.3);
}

TEST(Twilight, DrawnZenithFollowsMeasurements) {
    Drawn drawn;
    double sum = 0.0, squares = 0.0;
    int count = 0, missed = 0;
    for (const auto& row : read_csv(SKYIG_TEST_DATA "/night/twilight_sky_luminance.csv")) {
        const double sun_deg = row.number("sun_alt_deg");
        if (row.text("view") != "zenith" || sun_deg > 0.0) continue;
        const std::string& site = row.text("site");
        drawn.scene.eye.height_m = site.find("Maryland") != std::string::npos     ? 30.0
                                   : site.find("Sacramento") != std::string::npos ? 2800.0
                                                                                  : 2635.0;
        drawn.scene.sun.direction_enu = at(sun_deg, 0.0);
        const double off = magnitude(drawn.zenith_cd_m2()) - row.number("mag_arcsec2");
        std::printf("sun %5.1f deg, %-32s %+.2f mag\n", sun_deg, site.c_str(), off);
        sum += off;
        squares += off * off;
        ++count;
        missed += std::abs(off) > 0.5 ? 1 : 0;
        EXPECT_NEAR(off, 0.0, 0.53);
    }
    ASSERT_GE(count, 15);
    std::printf("%d points: mean %+.2f mag, rms %.2f, %d beyond 0.5 mag\n", count, sum / count,
                std::sqrt(squares / count), missed);
    EXPECT_LE(missed, 1);
    EXPECT_NEAR(sum / count, 0.0, 0.15);
    const auto at_sun = [&](double sun_deg) {
        drawn.scene.sun.direction_enu = at(sun_deg, 0.0);
        return magnitude(drawn.zenith_cd_m2());
    };
    drawn.scene.eye.height_m = 2635.0;
    const double slope = (at_sun(-10.0) - at_sun(-5.0)) / 5.0;
    std::printf("slope %.2f mag/deg, measured 1.23\n", slope);
    EXPECT_NEAR(slope, 1.23, 0.123);
}

TEST(Moonlight, ZenithIsThatOfKrisciunasAndSchaefer) {
    Drawn drawn;
    // The table's air takes 0.172 mag from the zenith, which scenes' default air does at sea level.
    const double extinction_mag = -2.5 * std::log10(drawn.now().air().transmittance_rgb(0.0, 0.5 * kPi).y);
    std::printf("extinction %.3f mag\n", extinction_mag);
    EXPECT_NEAR(extinction_mag, 0.172, 0.03);
    double largest = 0.0;
    for (const auto& row : read_csv(SKYIG_TEST_DATA "/night/moonlit_zenith_sky.csv")) {
        drawn.scene.moon.direction_enu = at(row.number("moon_alt_deg"), 0.0);
        drawn.scene.moon.phase_angle_rad = row.number("phase_angle_deg") * kDegree;
        const double off = magnitude(drawn.zenith_cd_m2()) - row.number("total_mag_arcsec2");
        std::printf("phase %3.0f deg, Moon at %2.0f deg: %+.2f mag\n", row.number("phase_angle_deg"),
                    row.number("moon_alt_deg"), off);
        // Ours brightens by 0.33 mag in opposition, the table's Moon does not.
        const bool opposition = row.number("phase_angle_deg") < 7.0;
        EXPECT_GT(off, opposition ? -0.63 : -0.3);
        EXPECT_LT(off, 0.3);
        if (!opposition) largest = std::max(largest, std::abs(off));
    }
    std::printf("largest %.2f mag, without opposition\n", largest);
}

// The tables are for an average clear sky; scenes' default air is clearer.
TEST(GroundIlluminance, SunsIsTheTablesWithinAFactor) {
    const auto rows = read_csv(SKYIG_TEST_DATA "/night/sun_ground_illuminance.csv");
    for (const double visibility_m : {80e3, 40e3}) {
        Drawn drawn;
        drawn.scene.air.visibility_m = visibility_m;
        double above = 0.0, below = 0.0;
        for (const auto& row : rows) {
            const double sun_deg = row.number("sun_alt_deg");
            drawn.scene.sun.direction_enu = at(sun_deg, 0.0);
            const double ours = drawn.now().sky_lux() + drawn.still.sun_lux();
            const double ratio = ours / row.number("E_h_lux");
            std::printf("%2.0f km, Sun %6.2f deg: %.4g lux, ratio %.2f\n", 1e-3 * visibility_m, sun_deg, ours,
                        ratio);
            double& largest = sun_deg >= -6.0 ? above : below;
            largest = std::max(largest, std::abs(std::log(ratio)));
        }
        std::printf("visibility %.0f km: factor %.2f above -6 deg, %.2f below\n", 1e-3 * visibility_m,
                    std::exp(above), std::exp(below));
        EXPECT_LT(std::exp(above), visibility_m < 50e3 ? 1.35 : 1.43);
        EXPECT_LT(std::exp(below), visibility_m < 50e3 ? 1.68 : 1.6);
    }
}

TEST(GroundIlluminance, MoonsIsTheTablesWithinAFactor) {
    Drawn drawn;
    drawn.scene.night.airglow = drawn.scene.night.zodiacal = false;
    drawn.scene.night.starlight = drawn.scene.night.galactic_light = false;
    drawn.scene.air.visibility_m = 40e3;
    double largest = 0.0;
    for (const auto& row : read_csv(SKYIG_TEST_DATA "/night/moon_ground_illuminance.csv")) {
        const double moon_deg = row.number("moon_alt_deg");
        const double phase_deg = row.number("phase_angle_deg");
        if (phase_deg < 7.0) continue;  // the table leaves the opposition surge out
        drawn.scene.moon.direction_enu = at(moon_deg, 0.0);
        drawn.scene.moon.phase_angle_rad = phase_deg * kDegree;
        const double ratio = (drawn.now().sky_lux() + drawn.still.moon_lux()) / row.number("E_h_lux");
        // Beyond 120 deg the two magnitude laws part, by 0.14 mag at 150.
        const double bound = phase_deg > 120.0 ? 1.7 : 1.4;
        if (phase_deg <= 120.0) largest = std::max(largest, std::abs(std::log(ratio)));
        EXPECT_LT(std::abs(std::log(ratio)), std::log(bound)) << phase_deg << ' ' << moon_deg << ' ' << ratio;
    }
    std::printf("largest factor %.2f up to a phase angle of 120 deg\n", std::exp(largest));
}

}  // namespace
}  // namespace skyig::render
