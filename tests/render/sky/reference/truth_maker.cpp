// Runs the reference solver over whole tables, which takes minutes: no test, a command (see
// tests/data/sky_scene/README.md).
//   sky_truth_maker tables DIR [THREADS]   every row of the tables of tests/data/sky in DIR; figures on
//   stdout sky_truth_maker scene [THREADS]        tests/data/sky_scene/scene.csv on stdout
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "render/sky/reference/sky_solver.h"
#include "tests/render/sky/reference/table_rows.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky::reference {
namespace {

void print_agreement(const char* file, const Agreement& agreement) {
    std::printf(
        "%-20s %3zu rows: %5.1f %% within 3 sigma or 1 %%; rms %.2f %%, of rows known to 1 %%: %.2f %%; "
        "error over "
        "sigma: rms %.2f, mean %+.2f; xy distance median %.5f; single, largest %.3f %%\n",
        file, agreement.rows, 100.0 * agreement.share_within(), 100.0 * agreement.all.rms(),
        100.0 * agreement.certain.rms(), agreement.sigmas.rms(), agreement.mean_sigmas(),
        agreement.chromaticity.quantile(0.5), 100.0 * agreement.single.largest());
    std::fflush(stdout);
}

bool check_ground_light(const std::string& folder, const char* file, const AirLaw& law) {
    const SkySolver solver(law);
    const Table table = read_table(folder + "/" + file);
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const double sun_deg = table.number(row, "sun_zenith_deg");
        const GroundLight light = solver.ground_light(sun_deg * kDeg, {0.003, 300 * kPathsARound, 3});
        const double diffuse = table.number(row, "diffuse_horizontal_lux");
        const double sigma = std::hypot(table.number(row, "rel_se_diffuse"), light.diffuse_error / diffuse);
        std::printf("%-20s sun zenith %g: direct %.5g lx of %.5g, diffuse %+.2f %%, sigma %.2f %%\n", file,
                    sun_deg, light.direct_normal_xyz.y, table.number(row, "direct_normal_lux"),
                    100.0 * (light.diffuse_xyz.y / diffuse - 1.0), 100.0 * sigma);
        std::fflush(stdout);
    }
    return !table.rows.empty();
}

int check_tables(const std::string& folder, unsigned threads) {
    const Effort effort{0.003, 40 * kPathsARound, 5};
    for (const char* file : {"ground_A.csv", "ground_B.csv", "air_B_10000m.csv", "air_B_400000m.csv"}) {
        const bool is_a = std::string(file).find("_A.") != std::string::npos;
        const SkySolver solver(is_a ? atmosphere_a_law() : atmosphere_b_law());
        const Table table = read_table(folder + "/" + file);
        if (table.rows.empty()) return 1;
        print_agreement(file, compare_with(table, every_row(table, 1), solver, effort, threads));
    }
    const bool complete = check_ground_light(folder, "irradiance_A.csv", atmosphere_a_law()) &&
                          check_ground_light(folder, "irradiance_B.csv", atmosphere_b_law());
    return complete ? 0 : 1;
}

std::vector<View> scene_views() {
    std::vector<View> views;
    for (const double height_m : {0.0, 3000.0, 12000.0}) {
        for (const double sun_deg : {60.0, 85.0, 92.0}) {
            for (const double zenith_deg : {0.0, 45.0, 75.0, 85.0, 89.0, 95.0, 120.0}) {
                if (zenith_deg > 90.0 && height_m == 0.0) continue;
                for (const double azimuth_deg : {0.0, 90.0, 180.0}) {
                    const bool few = zenith_deg == 0.0 || zenith_deg == 120.0;
                    if (few && azimuth_deg != 90.0) continue;
                    views.push_back({height_m, sun_deg * kDeg, zenith_deg * kDeg, azimuth_deg * kDeg});
                }
            }
        }
    }
    return views;
}

int make_scene(unsigned threads) {
    std::puts(
        "visibility_m,altitude_m,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg,Y_cd_m2,rel_se_Y,x,y,"
        "Y_single_cd_m2");
    const Effort effort{0.005, 48 * kPathsARound, 11};
    const std::vector<View> views = scene_views();
    for (const double visibility_m : {5e3, 10e3, 23e3, 50e3, 80e3, 200e3}) {
        Air air;
        air.visibility_m = visibility_m;
        const std::vector<Radiance> radiances = SkySolver(air_law(air)).radiances(views, effort, threads);
        for (std::size_t i = 0; i < views.size(); ++i) {
            const View& v = views[i];
            const Radiance& r = radiances[i];
            const double sum = r.xyz.x + r.xyz.y + r.xyz.z;
            std::printf("%g,%g,%g,%g,%g,%.5g,%.2g,%.5f,%.5f,%.5g\n", visibility_m, v.eye_height_m,
                        v.sun_zenith_rad / kDeg, v.view_zenith_rad / kDeg, v.relative_azimuth_rad / kDeg,
                        r.xyz.y, r.luminance_error / r.xyz.y, r.xyz.x / sum, r.xyz.y / sum,
                        r.single_luminance);
        }
        std::fflush(stdout);
    }
    return 0;
}

int run(int count, char** arguments) {
    const std::string what = count > 1 ? arguments[1] : "";
    const auto threads_at = [&](int i) {
        return count > i ? static_cast<unsigned>(std::atoi(arguments[i])) : 1U;
    };
    if (what == "tables" && count > 2) return check_tables(arguments[2], threads_at(3));
    if (what == "scene") return make_scene(threads_at(2));
    std::fputs("sky_truth_maker tables DIR [THREADS] | scene [THREADS]\n", stderr);
    return 2;
}

}  // namespace
}  // namespace skyig::render::sky::reference

int main(int count, char** arguments) {
    return skyig::render::sky::reference::run(count, arguments);
}
