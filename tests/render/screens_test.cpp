// Channels of one rig before different screens: each as on its own, and neighbours in agreement once what
// their screens do is undone; and how much a day that runs fast changes from frame to frame.
#include "render/screens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/eye/tone_curve.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/steadiness.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kWidth = 320;
constexpr int kHeight = 256;

Screen bright_screen() {
    return {350.0, 175.0, true, 2.2, 0.0, 0.0};
}

Screen dim_screen() {
    return {100.0, 40.0, false, 2.4, 0.3, 0.2};
}

std::vector<Channel> two_channels() {
    return {{"left", kWidth, kHeight, bright_screen()}, {"right", kWidth, kHeight, dim_screen()}};
}

class ScreensTest : public GlTest {};

TEST_F(ScreensTest, LikeScreensAreOne) {
    const DisplaySettings usual;
    const std::vector<Channel> channels{
        {"a", 8, 8}, {"b", 8, 8, dim_screen()}, {"c", 8, 8, Screen{}}, {"d", 8, 8, dim_screen()}};
    const Screens screens = screens_of(channels, usual);
    EXPECT_EQ(screens.distinct, (std::vector<Screen>{usual, dim_screen()}));
    EXPECT_EQ(screens.of_channel, (std::vector<std::size_t>{0, 1, 0, 1}));
}

int largest_difference(const Picture& a, const Picture& b) {
    int worst = 0;
    for (int y = 0; y < a.height_px; ++y)
        for (int x = 0; x < a.width_px; ++x)
            worst = std::max(worst, difference(a.at(x, y), b.at(x, y)));
    return worst;
}

TEST_F(ScreensTest, AChannelLooksAsItDoesWithoutTheOtherScreen) {
    for (const auto& [name, scene] : four_times()) {
        const double yaw_deg = name == "dawn" ? 120.0 : name == "dusk" ? 100.0 : 170.0;
        const double pitch_deg = name == "noon" ? 40.0 : name == "night" ? 30.0 : 8.0;
        Scene one = scene;
        add_view(one, symmetric_frustum(30.0, kWidth, kHeight), view_from_enu(yaw_deg, pitch_deg, 5.0));
        Scene two = one;
        add_view(two, one.views[0].frustum, one.views[0].view_from_enu);
        const auto channels = two_channels();
        const auto together = draw(channels, two, undithered());
        int worst = 0;
        for (std::size_t i = 0; i < channels.size(); ++i) {
            const auto alone = draw({channels[i]}, one, undithered());
            worst = std::max(worst, largest_difference(together[i], alone[0]));
        }
        std::printf("%-6s with its discs and stars: %d codes from each channel alone, %d between them\n",
                    name.c_str(), worst, largest_difference(together[0], together[1]));
        EXPECT_LE(worst, 1) << name;
        EXPECT_GT(largest_difference(together[0], together[1]), 5) << "the screens differ in nothing";
    }
}

// Codes of one screen as another shows the same light; without shoulder.
class Undone {
  public:
    Undone(const DisplaySettings& eye, const Screen& from, const Screen& to, double adaptation_cd_m2)
        : from_(eye::tone_parameters(before_screen(eye, from), adaptation_cd_m2)),
          to_(eye::tone_parameters(before_screen(eye, to), adaptation_cd_m2)) {}

    /// Nothing below 0 and above 255 is known.
    [[nodiscard]] glm::dvec3 other_code(const glm::dvec3& code) const {
        const glm::dvec3 display = decoded(glm::clamp(code / 255.0, 0.0, 1.0)) + from_.ambient;
        const double luminance = shaders64::luminance_709(display);
        const double world_log2 =
            (std::log2(luminance / from_.inv_display_max) - from_.log2_gain) / from_.exponent;
        const double other = std::exp2(to_.log2_gain + to_.exponent * world_log2) * to_.inv_display_max;
        return 255.0 * shaders64::encoded(display * (other / luminance), to_);
    }

  private:
    [[nodiscard]] glm::dvec3 decoded(const glm::dvec3& n) const {
        if (from_.encode_power > 0.0) return glm::pow(n, glm::dvec3{1.0 / from_.encode_power});
        glm::dvec3 linear{};
        for (int i = 0; i < 3; ++i)
            linear[i] = n[i] <= 0.04045 ? n[i] / 12.92 : std::pow((n[i] + 0.055) / 1.055, 2.4);
        return linear;
    }

    shaders64::ToneParameters from_, to_;
};

struct SeamDifference {
    double codes = 0.0;
    int compared = 0;
};

// How far the right channel's seam is from what the left one's codes would be there, a code more or less:
// half a code of rounding, and half of one that the mesh may err by. The horizon's soft edge is left out:
// each screen mixes sky and ground in its own codes there.
SeamDifference seam_difference(const Picture& left, const Picture& right, const Scene& scene,
                               const Undone& undone) {
    const Channel channel{"left", kWidth, kHeight};
    const double horizon_rad = refraction_of(scene).horizon_elevation_rad();
    const double edge_rad = 1.5 * pixel_angle_rad(channel, scene.views[0].frustum);
    const auto code = [](const Rgb& c) { return glm::dvec3{c.r, c.g, c.b}; };
    SeamDifference out;
    for (int y = 0; y < left.height_px; ++y) {
        const glm::dvec3 direction =
            glm::transpose(scene.views[0].view_from_enu) *
            view_direction(channel, scene.views[0].frustum, kWidth - 0.5, kHeight - y - 0.5);
        if (std::abs(std::asin(direction.z) - horizon_rad) < edge_rad) continue;
        const glm::dvec3 a = code(left.at(left.width_px - 1, y));
        const glm::dvec3 b = code(right.at(0, y));
        // What both can show, and where the mesh has no kink at white.
        if (std::min({a.x, a.y, a.z, b.x, b.y, b.z}) < 1.0 ||
            std::max({a.x, a.y, a.z, b.x, b.y, b.z}) > 245.0)
            continue;
        const glm::dvec3 low = undone.other_code(a - 1.0);
        const glm::dvec3 high = undone.other_code(a + 1.0);
        const glm::dvec3 outside = glm::max(glm::max(low - b, b - high), glm::dvec3{0.0});
        out.codes = std::max({out.codes, outside.x, outside.y, outside.z});
        ++out.compared;
    }
    return out;
}

TEST_F(ScreensTest, NeighboursAgreeOnceTheirScreensAreUndoneAlsoWhileTheEyeAdapts) {
    const double x = std::tan(30.0 * kDegree) * kWidth / (kWidth - 1);
    const double y = x * kHeight / kWidth;
    const Frustum frustum{-std::atan(x), std::atan(x), -std::atan(y), std::atan(y)};
    DisplaySettings eye = undithered();
    eye.shoulder = 1.0;
    for (auto& [name, scene] : four_times()) {
        scene.sun.enabled = scene.moon.enabled = scene.stars.enabled = false;
        const double yaw_deg = name == "dusk" ? 235.0 : 150.0;
        for (const double turn_deg : {-30.0, 30.0})
            add_view(scene, frustum, view_from_enu(yaw_deg, 12.0, 4.0, turn_deg));
        const auto channels = two_channels();
        Renderer renderer(channels, eye);
        double settled_cd_m2 = 0.0;
        for (int step = 0; step < 3; ++step) {
            // An eclipse: darker at once in each, and the eye follows slowly.
            scene.sun.unobscured = scene.moon.sunlit = 1.0 - 0.3 * step;
            for (int frame = 0; step > 0 && frame < 10; ++frame) {
                scene.time_s += 1.0 / 30.0;
                renderer.prepare(scene);
            }
            const auto pictures = draw(renderer, scene);
            const double adaptation = renderer.prepare(scene).adaptation_cd_m2;
            if (step == 0) settled_cd_m2 = adaptation;
            const SeamDifference seam = seam_difference(
                pictures[0], pictures[1], scene, {eye, *channels[0].screen, *channels[1].screen, adaptation});
            std::printf(
                "%-6s adapted to %.4g cd/m2: %.2f codes beyond what the left one may err by, %d pixels\n",
                name.c_str(), adaptation, seam.codes, seam.compared);
            EXPECT_GT(seam.compared, 60) << name;
            EXPECT_LE(seam.codes, 1.0) << name;
            if (step == 2) {
                EXPECT_LT(adaptation, 0.99 * settled_cd_m2) << name;
            }
        }
    }
}

TEST_F(ScreensTest, SunsetAtSixtyTimesItsPacePlaysWithoutAJump) {
    Flight sunset{"sunset at 60 times its pace"};
    sunset.sun_deg = 1.0;
    sunset.sun_deg_per_s = -15.0 / 60.0;
    sunset.climb_m_s = 0.0;
    const Steps steps = largest_step(sunset, 0, 360);
    std::printf("%s: brightness of a channel %.2f codes a frame at most, a pixel %d at frame %d\n",
                sunset.name.c_str(), steps.brightness, steps.largest, steps.at_frame);
    EXPECT_LE(steps.brightness, 0.5);
    // Beside the Sun the glow itself sets by three codes a frame.
    EXPECT_LE(steps.largest, 10);
}

}  // namespace
}  // namespace skyig::render
