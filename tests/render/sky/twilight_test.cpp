// Twilight against published measurements. They differ between sites by a factor of two at one sun
// depression.
#include <gtest/gtest.h>

#include <cstdio>

#include "render/sky/sky_view.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky {
namespace {

constexpr double kNaturalNight = 1.7e-4;  // cd/m2 at the zenith; the model leaves it to others

double site_height_m(const std::string& site) {
    if (site.find("Maryland") != std::string::npos) return 30.0;
    return site.find("Sacramento") != std::string::npos ? 2800.0 : 2635.0;
}

double zenith_magnitude(SkyView& view, const AirTables& tables, double height_m, double source_deg) {
    view.begin(tables, height_m, source_deg * kDeg);
    view.build_all();
    const auto luminance = static_cast<double>(view.xyz(static_cast<float>(90.0 * kDeg), 0.0F).y);
    return -2.5 * std::log10((luminance + kNaturalNight) / 1.0807e5);
}

TEST(Twilight, ZenithFollowsMeasurements) {
    const Table table = read_table(SKYIG_REFERENCE "/night/twilight_sky_luminance.csv");
    if (table.rows.empty())
        GTEST_SKIP() << "the table of published twilight measurements is not in this clone";
    const AirTables tables(air_model({}));
    SkyView view;
    Errors errors;
    double sum = 0.0;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const double source_deg = table.number(row, "sun_alt_deg");
        if (table.rows[row][table.column("view")] != "zenith" || source_deg < -12.0) continue;
        const std::string& site = table.rows[row][table.column("site")];
        const double ours = zenith_magnitude(view, tables, site_height_m(site), source_deg);
        const double theirs = -2.5 * std::log10(table.number(row, "luminance_cd_m2") / 1.0807e5);
        std::printf("sun %5.1f deg, %-32s: %.2f mag, measured %.2f, difference %+.2f\n", source_deg,
                    site.c_str(), ours, theirs, ours - theirs);
        errors.add(ours - theirs);
        sum += ours - theirs;
        EXPECT_NEAR(ours, theirs, 0.55);
    }
    ASSERT_GT(errors.count(), 8U);
    std::printf("rms %.2f mag, mean %+.2f mag\n", errors.rms(), sum / static_cast<double>(errors.count()));
    EXPECT_LT(errors.rms(), 0.4);
}

TEST(Twilight, ZenithFadesAtTheMeasuredRate) {
    const AirTables tables(air_model({}));
    SkyView view;
    const double at_5 = zenith_magnitude(view, tables, 2635.0, -5.0);
    const double at_10 = zenith_magnitude(view, tables, 2635.0, -10.0);
    const double slope = (at_10 - at_5) / 5.0;
    std::printf("slope %.2f mag/deg between -5 and -10 deg; measured 1.23\n", slope);
    EXPECT_NEAR(slope, 1.23, 0.123);
}

}  // namespace
}  // namespace skyig::render::sky
