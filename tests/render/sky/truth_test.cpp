// The sky as the renderer looks it up, against the Monte Carlo truth.
#include <gtest/gtest.h>

#include <cstdio>

#include "render/sky/sky_view.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky {
namespace {

struct Range {
    double first_deg;
    double last_deg;
    double largest_rms;
    double largest_dxy;  // of the median
};

struct Case {
    const char* file;
    bool is_a;
    std::vector<Range> ranges;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.file;
}

class SkyTruth : public testing::TestWithParam<Case> {
  protected:
    static const AirTables& tables(bool is_a) {
        static const AirTables a(atmosphere_a());
        static const AirTables b(atmosphere_b());
        return is_a ? a : b;
    }
};

struct RangeErrors {
    Errors luminance;
    Errors chromaticity;
};

// Truth rows worse than 3 % themselves say nothing.
RangeErrors measure(const Table& table, const AirTables& tables, const Range& range, SkyView& view) {
    RangeErrors errors;
    double built_deg = -1.0;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const double sun_deg = table.number(row, "sun_zenith_deg");
        const double luminance = table.number(row, "Y_cd_m2");
        if (sun_deg < range.first_deg || sun_deg > range.last_deg) continue;
        if (!(luminance > 0.0) || table.number(row, "rel_se_Y") > 0.03) continue;
        if (sun_deg != built_deg) {
            view.begin(tables, table.number(row, "altitude_m") + 0.01, (90.0 - sun_deg) * kDeg);
            view.build_all();
            built_deg = sun_deg;
        }
        const double elevation = (90.0 - table.number(row, "view_zenith_deg")) * kDeg;
        const glm::dvec3 xyz = view.xyz(static_cast<float>(elevation),
                                        static_cast<float>(table.number(row, "rel_azimuth_deg") * kDeg));
        const double sum = xyz.x + xyz.y + xyz.z;
        errors.luminance.add(xyz.y / luminance - 1.0);
        errors.chromaticity.add(
            std::hypot(xyz.x / sum - table.number(row, "x"), xyz.y / sum - table.number(row, "y")));
    }
    return errors;
}

TEST_P(SkyTruth, LookUpAgreesWithMonteCarlo) {
    const Case& c = GetParam();
    const Table table = read_table(std::string(SKYIG_TEST_DATA "/sky/") + c.file);
    ASSERT_FALSE(table.rows.empty());
    SkyView view;
    for (const Range& range : c.ranges) {
        const RangeErrors errors = measure(table, tables(c.is_a), range, view);
        ASSERT_GT(errors.luminance.count(), 5U);
        std::printf(
            "%s, sun zenith %g..%g: %zu rows, luminance rms %.2f %%, largest %.1f %%; dxy median %.4f, "
            "largest %.4f\n",
            c.file, range.first_deg, range.last_deg, errors.luminance.count(), 100.0 * errors.luminance.rms(),
            100.0 * errors.luminance.largest(), errors.chromaticity.quantile(0.5),
            errors.chromaticity.largest());
        EXPECT_LT(errors.luminance.rms(), range.largest_rms);
        EXPECT_LT(errors.chromaticity.quantile(0.5), range.largest_dxy);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Tables, SkyTruth,
    testing::Values(Case{"ground_A.csv",
                         true,
                         {{0, 80, 0.008, 0.001},
                          {84, 88.5, 0.012, 0.001},
                          {89, 92.5, 0.015, 0.002},
                          {93, 97, 0.06, 0.006}}},
                    Case{"ground_B.csv",
                         false,
                         {{0, 80, 0.005, 0.001},
                          {84, 88.5, 0.006, 0.001},
                          {89, 92.5, 0.01, 0.002},
                          {93, 97, 0.04, 0.012}}},
                    Case{"air_B_10000m.csv",
                         false,
                         {{0, 80, 0.006, 0.001}, {84, 88.5, 0.006, 0.002}, {93, 97, 0.04, 0.006}}},
                    Case{"air_B_400000m.csv", false, {{0, 80, 0.02, 0.001}, {84, 88.5, 0.01, 0.001}}}));

// Log-linear between the carried wavelengths, as the coefficients are smooth.
double at_wavelength(const Spectrum& spectrum, double nm) {
    const double place = (nm - kFirstWavelengthNm) / kWavelengthStepNm;
    const auto low = static_cast<std::size_t>(place);
    const double part = place - static_cast<double>(low);
    return std::exp((1.0 - part) * std::log(static_cast<double>(spectrum[low])) +
                    part * std::log(static_cast<double>(spectrum[low + 1])));
}

double integrated_diffuse_lux(const SkyView& view) {
    constexpr int kElevations = 240;
    constexpr int kAzimuths = 90;
    double sum = 0.0;
    for (int i = 0; i < kElevations; ++i) {
        // Even in the square of the sine: the measure of a level surface, so that all samples weigh the same.
        const double elevation = std::asin(std::sqrt((i + 0.5) / kElevations));
        for (int j = 0; j < kAzimuths; ++j) {
            const double azimuth = (j + 0.5) / kAzimuths * 180.0 * kDeg;
            sum +=
                static_cast<double>(view.xyz(static_cast<float>(elevation), static_cast<float>(azimuth)).y);
        }
    }
    return sum * 180.0 * kDeg / (kElevations * kAzimuths);
}

class Irradiance : public SkyTruth {};

TEST_P(Irradiance, DirectAndDiffuseAgreeWithMonteCarlo) {
    const Case& c = GetParam();
    const AirTables& air = tables(c.is_a);
    const Table table = read_table(std::string(SKYIG_TEST_DATA "/sky/") + c.file);
    ASSERT_FALSE(table.rows.empty());
    SkyView view;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const double sun_deg = table.number(row, "sun_zenith_deg");
        if (sun_deg > 92.5) continue;
        const double elevation = (90.0 - sun_deg) * kDeg;
        // Half the disc is up when its centre is on the horizon; the truth's sun is a point.
        const double visible = sun_deg == 90.0 ? 0.5 : 1.0;
        const double direct = air.direct_sun_xyz(0.01, elevation).y / visible;
        const double direct_truth = table.number(row, "direct_normal_lux");
        view.begin(air, 0.01, elevation);
        view.build_all();
        const double diffuse = integrated_diffuse_lux(view);
        const double diffuse_truth = table.number(row, "diffuse_horizontal_lux");
        const double from_table = air.ground_diffuse_xyz(elevation).y;
        std::printf(
            "%s, sun zenith %g: direct %.5g (truth %.5g), diffuse from view %.5g, from table %.5g (truth "
            "%.5g)\n",
            c.file, sun_deg, direct, direct_truth, diffuse, from_table, diffuse_truth);
        EXPECT_NEAR(diffuse / diffuse_truth, 1.0, 0.02);
        EXPECT_NEAR(from_table / diffuse_truth, 1.0, 0.04);
        if (direct_truth <= 0.0) continue;
        EXPECT_NEAR(direct / direct_truth, 1.0, sun_deg < 89.0 ? 0.003 : 0.05);
        if (sun_deg > 85.0) continue;
        const Spectrum spectrum = air.transmittance(0.01, elevation);
        for (const auto& [nm, name] :
             {std::pair{440.0, "Tsun_440"}, std::pair{550.0, "Tsun_550"}, std::pair{680.0, "Tsun_680"}}) {
            EXPECT_NEAR(at_wavelength(spectrum, nm) / table.number(row, name), 1.0, 0.02)
                << name << ' ' << sun_deg;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Tables, Irradiance,
                         testing::Values(Case{"irradiance_A.csv", true, {}},
                                         Case{"irradiance_B.csv", false, {}}));

}  // namespace
}  // namespace skyig::render::sky
