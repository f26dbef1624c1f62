// The light of the sky has no visible step from frame to frame while Sun or Moon sink.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/render/light_tables_steps.h"

namespace skyig::render {
namespace {

using tests::luminance;
using tests::make_scene;
using tests::step;

TEST(LightTables, MoonlightNeverPopsInTwilight) {
    // The descent of the Sun at twenty times its pace, where a table is replaced every few frames; the dome
    // fades each in.
    double last = 0.0;
    LightTables tables;
    for (double sun = -2.5; sun > -6.5; sun -= 0.0028) {
        const double now = luminance(step(tables, make_scene(sun, 270, 30, 90, 0)), 40, 0);
        if (last > 0.0) {
            EXPECT_LT(std::abs(std::log10(now / last)), 0.025) << sun;
        }
        last = now;
    }
}

// No direction of the sky changes by more than a little from one frame to the next while Sun or Moon sink.
void expect_no_pop(double from_deg, double to_deg, bool moon_sinks) {
    LightTables tables;
    std::vector<double> last;
    double worst = 0.0;
    for (double at = from_deg; at > to_deg; at -= 0.0028) {
        const SkyLight light = moon_sinks ? step(tables, make_scene(-40, 90, at, 270, 0))
                                          : step(tables, make_scene(at, 270, 30, 90, 0));
        std::vector<double> now;
        for (const double elevation : {-10.0, -1.0, 0.3, 1.0, 2.0, 5.0, 20.0, 60.0}) {
            for (const double azimuth : {0.0, 180.0, 270.0})
                now.push_back(luminance(light, elevation, azimuth));
        }
        for (std::size_t i = 0; i < last.size(); ++i)
            worst = std::max(worst, std::abs(std::log10(now[i] / last[i])));
        last = now;
    }
    std::printf("largest step of a frame: %.4f decades\n", worst);
    EXPECT_LT(worst, 0.02);
}

TEST(LightTables, SunlightEndsWithoutAPop) {
    expect_no_pop(-17.0, -22.0, false);
}
TEST(LightTables, MoonlightEndsWithoutAPop) {
    expect_no_pop(-5.0, -11.0, true);
}

}  // namespace
}  // namespace skyig::render
