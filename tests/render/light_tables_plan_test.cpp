// What the plan promises of the tables, where that takes long to see.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/eye/tone_curve.h"
#include "render/light_tables.h"
#include "render/sky/sky_view.h"
#include "tests/render/light_tables_steps.h"

namespace skyig::render {
namespace {

using tests::luminance;
using tests::make_scene;
using tests::step;

TEST(LightTables, AirThatChangesInEveryFrameIsMadeOnceInAWhile) {
    LightTables tables;
    Scene scene = make_scene(40, 180, -20, 0, 1000);
    std::uint64_t airs = 0;
    std::uint64_t last = 0;
    for (int i = 0; i < 400; ++i) {
        step(tables, scene);
        if (i < 300) scene.air.visibility_m *= 0.999;
        airs += tables.air_in_use() != last ? 1 : 0;
        last = tables.air_in_use();
    }
    EXPECT_LE(airs, 300 / LightTables::kAirIntervalFrames + 3);
    EXPECT_TRUE(tables.held(scene).air_fresh) << "the last change was forgotten";
}

// Largest error of a direction table of the planned size, display codes, against one three times as fine.
double table_error_codes(const Scene& scene, const sky::SkyViewSize& size) {
    LightTables tables;
    SkyLight drawn = step(tables, scene);
    const auto tone =
        eye::single_precision(eye::tone_parameters({}, std::max(0.01, luminance(drawn, 20, 0))));
    const auto built = [&](const sky::SkyViewSize& wanted) {
        sky::SkyView view(wanted);
        view.begin(tables.air(), scene.eye.height_m, drawn.sun.source.elevation_rad);
        view.build_all();
        return view;
    };
    const sky::SkyView coarse = built(size);
    const sky::SkyView fine = built({100, 50, 81, 120});
    SkyLight exact = drawn;
    drawn.sun.view = &coarse;
    exact.sun.view = &fine;
    float largest = 0.0F;
    for (double share = 0.01; share < 1.0; share += 0.02) {
        for (double azimuth = 0.1; azimuth < 3.2; azimuth += 0.15) {
            for (const Side side : {Side::kSky, Side::kGround}) {
                const double above = (side == Side::kSky ? 1.5 : -1.5) * share * share;
                const auto shown = [&](const SkyLight& light) {
                    return shaders32::shown(light.rgb_cd_m2(light.horizon_elevation_rad + above,
                                                            light.sun.source.azimuth_rad + azimuth, side),
                                            tone);
                };
                const glm::vec3 off = 255.0F * glm::abs(shown(drawn) - shown(exact));
                largest = std::max({largest, off.x, off.y, off.z});
            }
        }
    }
    return static_cast<double>(largest);
}

TEST(LightTables, TableOfEachSizeErrsAsThePlanSays) {
    Scene haze = make_scene(10, 180, -20, 0, 300);
    haze.air.visibility_m = 5000;
    const Scene dusk = make_scene(-5, 180, -20, 0, 300);
    for (const double budget : {0.25, 0.5, 4.0}) {
        Quality quality;
        quality.error_codes = budget;
        const sky::SkyViewSize size = direction_table_size(quality);
        const double measured = std::max(table_error_codes(haze, size), table_error_codes(dusk, size));
        std::printf("table of %d x %d: %.1f codes, said %.1f\n", size.sky_rows + size.ground_rows,
                    size.columns, measured, direction_table_error_codes(size));
        EXPECT_LT(measured, 1.1 * direction_table_error_codes(size));
        EXPECT_GT(measured, 0.5 * direction_table_error_codes(size));
    }
}

}  // namespace
}  // namespace skyig::render
