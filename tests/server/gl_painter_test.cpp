#include "server/gl_painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string_view>
#include <utility>
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

Scene two_views() {
    Scene scene = looking(20.0, 0.0);
    render::tests::add_view(scene, render::tests::symmetric_frustum(30.0, kWidth_px, kHeight_px),
                            render::tests::view_from_enu(150.0, 10.0, 0.0));
    return scene;
}

std::vector<std::vector<std::byte>> pictures(GlPainter& painter, const Scene& scene, std::size_t count) {
    std::vector<std::vector<std::byte>> all(count,
                                            std::vector<std::byte>(std::size_t{kWidth_px} * kHeight_px * 4));
    painter.prepare(scene);
    for (std::size_t i = 0; i < count; ++i)
        painter.draw(i);
    for (std::size_t i = 0; i < count; ++i)
        painter.read_back(i, all[i]);
    return all;
}

/// Parts of a picture that are bright red, and any red.
std::pair<double, double> red_parts(const std::vector<std::byte>& rgba) {
    std::size_t bright = 0, any = 0;
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        const int r = std::to_integer<int>(rgba[i]), g = std::to_integer<int>(rgba[i + 1]);
        any += r > 50 && g == 0 ? 1 : 0;
        bright += r > 200 && g == 0 ? 1 : 0;
    }
    const auto count = static_cast<double>(rgba.size()) / 4.0;
    return {static_cast<double>(bright) / count, static_cast<double>(any) / count};
}

TEST(GlPainter, AChannelThatFailsIsCrossedOutAndTheOthersGoOn) {
    GlSeatSettings settings = one_channel();
    settings.channels.push_back({"right", kWidth_px, kHeight_px});
    GlPainter painter(settings);
    const Scene scene = two_views();
    const auto good = pictures(painter, scene, 2);
    painter.inject_errors(0, 3);
    int crossed = 0, frames = 0;
    do {
        const auto now = pictures(painter, scene, 2);
        EXPECT_EQ(now[1], good[1]);
        if (!painter.health(0).failed) break;
        const auto [bright, any] = red_parts(now[0]);
        EXPECT_EQ(any, 1.0);
        EXPECT_GT(bright, 0.04);
        EXPECT_LT(bright, 0.2);
        ++crossed;
    } while (++frames < 100);
    // Three tries fail, in frames 1, 2 and 4; the next is in frame 8.
    EXPECT_EQ(crossed, 7);
    EXPECT_EQ(painter.health(0).failures, 3U);
    EXPECT_EQ(painter.health(0).reason(), "OpenGL reported an error");
    EXPECT_FALSE(painter.health(1).failed);
    EXPECT_EQ(painter.health(1).failures, 0U);
    EXPECT_EQ(pictures(painter, scene, 2), good);
    painter.prepare(scene);
    EXPECT_EQ(painter.gl_errors(), 3U);
}

TEST(GlPainter, AChannelThatFailedIsTriedAtOnceAfterAResetOfTheDevice) {
    GlPainter painter(one_channel());
    const Scene scene = looking(20.0, 0.0);
    const auto good = picture(painter, scene);
    painter.inject_errors(0, 4);
    // Tries 1, 2, 4 and 8 fail; the next would be that of frame 16.
    for (int frame = 1; frame <= 8; ++frame)
        picture(painter, scene);
    ASSERT_EQ(painter.health(0).failures, 4U);
    painter.inject_reset();
    EXPECT_LE(largest_step(picture(painter, scene), good), 1);
    EXPECT_FALSE(painter.health(0).failed);
}

TEST(GlPainter, AChannelWithoutAPictureIsRedAndTheOthersAreDrawn) {
    GlSeatSettings settings = one_channel();
    const Scene scene = two_views();
    GlPainter alone(settings);
    const auto good = picture(alone, looking(20.0, 0.0));
    // Wider than any driver allows; what is read of it here is a part.
    settings.channels.push_back({"right", 1 << 20, kHeight_px});
    GlPainter painter(settings);
    std::vector<std::vector<std::byte>> now;
    for (int i = 0; i < 5; ++i)
        now = pictures(painter, scene, 2);
    const auto [bright, any] = red_parts(now[1]);
    EXPECT_EQ(bright, 1.0);
    EXPECT_EQ(any, 1.0);
    EXPECT_LE(largest_step(now[0], good), 1);
    EXPECT_TRUE(painter.health(1).failed);
    EXPECT_NE(painter.health(1).reason().find("1048576x120"), std::string_view::npos)
        << painter.health(1).reason();
    EXPECT_GE(painter.health(1).failures, 3U);
    EXPECT_FALSE(painter.health(0).failed);
    // None that can be drawn at all is no painter.
    settings.channels.erase(settings.channels.begin());
    EXPECT_THROW(GlPainter{settings}, std::runtime_error);
}

TEST(ChannelGuard, TriesEverMoreRarelyAndAtOnceAgainAfterASuccess) {
    ChannelGuard guard;
    std::vector<int> tries;
    for (int frame = 1; frame <= 200; ++frame) {
        if (!guard.try_now()) continue;
        tries.push_back(frame);
        guard.failed("no", true);
    }
    EXPECT_EQ(tries, (std::vector<int>{1, 2, 4, 8, 16, 32, 64, 128, 192}));
    while (!guard.try_now()) {
    }
    guard.drawn();
    EXPECT_FALSE(guard.health().failed);
    EXPECT_TRUE(guard.try_now());
    guard.failed("again", true);
    EXPECT_TRUE(guard.try_now());
    EXPECT_EQ(guard.health().failures, 10U);
}

}  // namespace
}  // namespace skyig::server
