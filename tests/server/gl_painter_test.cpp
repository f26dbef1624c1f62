#include "server/gl_painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/render/scenes.h"

namespace skyig::server {
namespace {

using render::Scene;

constexpr int kWidth_px = 160;
constexpr int kHeight_px = 120;

GlSeatSettings one_channel() {
    GlSeatSettings settings{.channels = {{"centre", kWidth_px, kHeight_px}}};
    settings.display.dither = false;
    return settings;
}

Scene looking(double elevation_deg, double time_s) {
    Scene scene = render::tests::make_scene(30.0, 180.0, -40.0, 0.0, 1000.0);
    render::tests::add_view(scene, render::tests::symmetric_frustum(30.0, kWidth_px, kHeight_px),
                            render::tests::view_from_enu(180.0, elevation_deg, 0.0));
    scene.time_s = time_s;
    return scene;
}

std::vector<std::byte> picture(GlPainter& painter, const Scene& scene) {
    std::vector<std::byte> rgba(std::size_t{kWidth_px} * kHeight_px * 4);
    painter.prepare(scene);
    painter.draw(0);
    painter.read_back(0, rgba);
    return rgba;
}

int largest_step(const std::vector<std::byte>& a, const std::vector<std::byte>& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::abs(std::to_integer<int>(a[i]) - std::to_integer<int>(b[i])));
    return largest;
}

TEST(GlPainter, DrawsTheSamePictureAfterAResetOfTheDevice) {
    GlPainter painter(one_channel());
    picture(painter, looking(20.0, 0.0));
    const std::vector<std::byte> before = picture(painter, looking(20.0, 0.1));
    EXPECT_EQ(painter.resets(), 0U);
    for (int reset = 1; reset <= 3; ++reset) {
        painter.inject_reset();
        const std::vector<std::byte> after = picture(painter, looking(20.0, 0.1));
        EXPECT_LE(largest_step(before, after), 1) << reset;
        EXPECT_EQ(painter.resets(), static_cast<std::uint64_t>(reset));
    }
    EXPECT_EQ(painter.gl_errors(), 0U);
    // The picture holds something: sky from dark to bright.
    const auto [darkest, brightest] = std::minmax_element(before.begin(), before.end());
    EXPECT_GT(std::to_integer<int>(*brightest) - std::to_integer<int>(*darkest), 40);
}

TEST(GlPainter, EyesStayAdaptedThroughAReset) {
    GlSeatSettings settings = one_channel();
    settings.display.adapt_to = render::AdaptationSource::kViewMean;
    GlPainter painter(settings);
    picture(painter, looking(30.0, 0.0));
    // From the Sun to the dark ground: eyes take minutes.
    picture(painter, looking(-60.0, 0.1));
    const double before_cd_m2 = painter.adaptation_cd_m2();
    GlPainter settled(settings);
    picture(settled, looking(-60.0, 0.1));
    ASSERT_GT(before_cd_m2, 1.5 * settled.adaptation_cd_m2());

    painter.inject_reset();
    picture(painter, looking(-60.0, 3.1));
    GlPainter steady(settings);
    picture(steady, looking(30.0, 0.0));
    for (int i = 1; i <= 31; ++i)
        picture(steady, looking(-60.0, 0.1 * i));
    std::printf(
        "adaptation %.1f before, three seconds later %.1f after a reset, %.1f without, %.1f in the end\n",
        before_cd_m2, painter.adaptation_cd_m2(), steady.adaptation_cd_m2(), settled.adaptation_cd_m2());
    EXPECT_NEAR(painter.adaptation_cd_m2(), steady.adaptation_cd_m2(), 0.02 * steady.adaptation_cd_m2());
}

}  // namespace
}  // namespace skyig::server
