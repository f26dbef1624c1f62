// The sky as the renderer looks it up in the air of scenes, against the reference solver, by visibility.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <string>

#include "render/sky/sky_view.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky {
namespace {

struct Bound {
    double visibility_m;
    double largest_rms;     // relative, of the luminance
    double largest_single;  // of one row
    double largest_dxy;     // of the median
};

void PrintTo(const Bound& bound, std::ostream* out) {
    *out << bound.visibility_m;
}

struct SceneErrors {
    Errors luminance;
    Errors chromaticity;
    std::map<std::string, Errors> parts;
    double sum = 0.0;
    double worst = 0.0;
    std::string worst_row;
};

std::string row_name(const Table& table, std::size_t row) {
    return "eye " + table.rows[row][table.column("altitude_m")] + " m, sun " +
           table.rows[row][table.column("sun_zenith_deg")] + ", view " +
           table.rows[row][table.column("view_zenith_deg")] + ", azimuth " +
           table.rows[row][table.column("rel_azimuth_deg")];
}

SceneErrors measure(const Table& table, double visibility_m) {
    Air air;
    air.visibility_m = visibility_m;
    const AirTables tables(straight(air_model(air)));
    SkyView view;
    std::string built;
    SceneErrors errors;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        if (table.number(row, "visibility_m") != visibility_m) continue;
        if (table.number(row, "rel_se_Y") > 0.02) continue;
        const std::string eye = "eye " + table.rows[row][table.column("altitude_m")] + " m";
        const std::string sun = "sun " + table.rows[row][table.column("sun_zenith_deg")];
        if (eye + sun != built) {
            view.begin(tables, table.number(row, "altitude_m") + 0.01,
                       (90.0 - table.number(row, "sun_zenith_deg")) * kDeg);
            view.build_all();
            built = eye + sun;
        }
        const glm::dvec3 xyz = view.xyz(f32((90.0 - table.number(row, "view_zenith_deg")) * kDeg),
                                        f32(table.number(row, "rel_azimuth_deg") * kDeg));
        const double error = xyz.y / table.number(row, "Y_cd_m2") - 1.0;
        const double sum = xyz.x + xyz.y + xyz.z;
        errors.luminance.add(error);
        errors.sum += error;
        errors.chromaticity.add(
            std::hypot(xyz.x / sum - table.number(row, "x"), xyz.y / sum - table.number(row, "y")));
        errors.parts[eye].add(error);
        errors.parts[sun].add(error);
        if (std::abs(error) <= std::abs(errors.worst)) continue;
        errors.worst = error;
        errors.worst_row = row_name(table, row);
    }
    return errors;
}

class SceneTruth : public testing::TestWithParam<Bound> {};

TEST_P(SceneTruth, LookUpAgreesWithTheReferenceSolver) {
    const Table table = read_table(SKYIG_TEST_DATA "/sky_scene/scene.csv");
    const Bound& bound = GetParam();
    const SceneErrors errors = measure(table, bound.visibility_m);
    ASSERT_GT(errors.luminance.count(), 100U);
    std::printf(
        "visibility %.0f km: %zu rows, rms %.2f %%, mean %+.2f %%, dxy median %.4f; worst %+.1f %%: %s\n",
        1e-3 * bound.visibility_m, errors.luminance.count(), 100.0 * errors.luminance.rms(),
        100.0 * errors.sum / static_cast<double>(errors.luminance.count()), errors.chromaticity.quantile(0.5),
        100.0 * errors.worst, errors.worst_row.c_str());
    for (const auto& [name, part] : errors.parts)
        std::printf("    %-12s rms %.2f %%, largest %.1f %%\n", name.c_str(), 100.0 * part.rms(),
                    100.0 * part.largest());
    EXPECT_LT(errors.luminance.rms(), bound.largest_rms);
    EXPECT_LT(errors.luminance.largest(), bound.largest_single);
    EXPECT_LT(errors.chromaticity.quantile(0.5), bound.largest_dxy);
}

INSTANTIATE_TEST_SUITE_P(Visibilities, SceneTruth,
                         testing::Values(Bound{5e3, 0.04, 0.14, 0.002}, Bound{10e3, 0.03, 0.125, 0.002},
                                         Bound{23e3, 0.021, 0.13, 0.002}, Bound{50e3, 0.013, 0.05, 0.002},
                                         Bound{80e3, 0.01, 0.05, 0.002}, Bound{200e3, 0.01, 0.05, 0.002}));

}  // namespace
}  // namespace skyig::render::sky
