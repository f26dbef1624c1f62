// The three ways to give a frustum, held against plain geometry in double.
#include "config/flat_screen.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/glm.hpp>
#include <random>

#include "config/config.h"
#include "render/channel.h"
#include "tests/config/texts.h"

namespace skyig::config {
namespace {

using testing::HasSubstr;
using tests::error_of;

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;
constexpr int kWidth_px = 1920;
constexpr int kHeight_px = 1200;

Channel looking(const Aim& aim) {
    Channel channel;
    channel.width_px = kWidth_px;
    channel.height_px = kHeight_px;
    channel.left_deg = aim.left_deg;
    channel.right_deg = aim.right_deg;
    channel.bottom_deg = aim.bottom_deg;
    channel.top_deg = aim.top_deg;
    channel.yaw_deg = aim.yaw_deg;
    channel.pitch_deg = aim.pitch_deg;
    channel.roll_deg = aim.roll_deg;
    return channel;
}

/// Where a direction of the body's axes is drawn, pixels from the lower left corner: as the renderer does it.
glm::dvec2 drawn_at_px(const Channel& channel, const glm::dvec3& direction_body) {
    const glm::dmat3 axes = render::body_from_ned(
        channel.yaw_deg * kRadPerDeg, channel.pitch_deg * kRadPerDeg, channel.roll_deg * kRadPerDeg);
    const glm::dvec3 view = render::view_from_body() * axes * direction_body;
    const render::ImagePlane plane =
        render::image_plane({channel.left_deg * kRadPerDeg, channel.right_deg * kRadPerDeg,
                             channel.bottom_deg * kRadPerDeg, channel.top_deg * kRadPerDeg});
    return {(view.x / -view.z - plane.left) / (plane.right - plane.left) * channel.width_px,
            (view.y / -view.z - plane.bottom) / (plane.top - plane.bottom) * channel.height_px};
}

Channel channel_of(const std::string& keys) {
    const LoadResult result = parse_config(
        "version = 1\n[[channel]]\nname = \"a\"\nwidth_px = 1920\n"
        "height_px = 1200\n" +
            keys,
        "site.toml");
    EXPECT_TRUE(result) << keys << to_text(result.errors.empty() ? ConfigError{} : result.errors.front());
    return result ? result.config->channels[0] : Channel{};
}

/// A rectangle of any attitude before an eye anywhere in front of it.
struct RandomScreen {
    FlatScreen screen;
    glm::dvec3 eye_m{0.0};
    glm::dvec3 corner_m{0.0}, across_m{0.0}, upward_m{0.0};
};

glm::dvec3 random_direction(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)});
}

BodyPoint point(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

RandomScreen random_screen(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const glm::dvec3 right = random_direction(random);
    const glm::dvec3 up = glm::normalize(glm::cross(random_direction(random), right));
    RandomScreen out;
    out.across_m = right * (0.2 + 5.0 * unit(random));
    out.upward_m = up * (0.2 + 3.0 * unit(random));
    out.corner_m = 10.0 * (unit(random) - 0.5) * random_direction(random);
    // Up x right points from the eye to the screen, since down is the third axis.
    const glm::dvec3 foot_m =
        out.corner_m + out.across_m * (3.0 * unit(random) - 1.0) + out.upward_m * (3.0 * unit(random) - 1.0);
    out.eye_m = foot_m - glm::cross(up, right) * (0.4 + 4.0 * unit(random));
    out.screen = {point(out.corner_m), point(out.corner_m + out.across_m),
                  point(out.corner_m + out.upward_m)};
    return out;
}

TEST(FlatScreen, EveryPointBehindItIsDrawnWhereTheLineOfSightMeetsIt) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double largest_px = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const RandomScreen it = random_screen(random);
        const AimResult result = aim_at(it.screen, point(it.eye_m));
        ASSERT_TRUE(result.aim) << i << " " << result.refusal;
        const Channel channel = looking(*result.aim);
        for (int k = 0; k < 10; ++k) {
            const glm::dvec2 part{unit(random), unit(random)};
            const glm::dvec3 seen_m = it.corner_m + part.x * it.across_m + part.y * it.upward_m - it.eye_m;
            const glm::dvec2 wanted_px{part.x * kWidth_px, part.y * kHeight_px};
            largest_px = std::max(largest_px, glm::distance(drawn_at_px(channel, seen_m), wanted_px));
        }
    }
    std::printf("flat screens: largest error %.2g px\n", largest_px);
    EXPECT_LE(largest_px, 1e-6);
}

TEST(FlatScreen, OnTheCeilingAndOnTheFloorHasItsTurnInTheRoll) {
    for (const double height_m : {-2.0, 2.0}) {
        // Above: one who looks up with his feet forward has the top behind him.
        const double towards_top = height_m < 0.0 ? -1.0 : 1.0;
        const glm::dvec3 corner_m{-towards_top, -1.0, height_m};
        const FlatScreen screen{point(corner_m), point(corner_m + glm::dvec3{0.0, 2.0, 0.0}),
                                point(corner_m + glm::dvec3{2.0 * towards_top, 0.0, 0.0})};
        const AimResult result = aim_at(screen, {});
        ASSERT_TRUE(result.aim) << result.refusal;
        EXPECT_NEAR(result.aim->pitch_deg, height_m < 0.0 ? 90.0 : -90.0, 1e-9);
        const glm::dvec2 at_px =
            drawn_at_px(looking(*result.aim), corner_m + glm::dvec3{0.5 * towards_top, 0.5, 0.0});
        EXPECT_NEAR(at_px.x, 0.25 * kWidth_px, 1e-6);
        EXPECT_NEAR(at_px.y, 0.25 * kHeight_px, 1e-6);
    }
}

TEST(FlatScreen, OfASettingsFileLooksAsTheSameHalfAngles) {
    // docs/configuration.md: 0.52 m by 0.416 m, 0.45 m ahead, the eye 0.05 m above the middle.
    const Channel channel = channel_of(
        "offset_m = [3, 0, -1]\n[channel.screen]\n"
        "bottom_left_m = [3.45, -0.26, -0.742]\n"
        "bottom_right_m = [3.45, 0.26, -0.742]\n"
        "top_left_m = [3.45, -0.26, -1.158]\n");
    EXPECT_NEAR(channel.left_deg, -30.02, 0.005);
    EXPECT_NEAR(channel.right_deg, 30.02, 0.005);
    EXPECT_NEAR(channel.bottom_deg, -29.83, 0.005);
    EXPECT_NEAR(channel.top_deg, 19.35, 0.005);
    EXPECT_NEAR(channel.yaw_deg, 0.0, 1e-9);
    EXPECT_NEAR(channel.pitch_deg, 0.0, 1e-9);
    EXPECT_NEAR(channel.roll_deg, 0.0, 1e-9);
}

TEST(FieldsOfView, MakeSquarePixelsUnlessBothAreGiven) {
    const Channel one = channel_of("fov_deg = 60\nyaw_deg = 30\n");
    EXPECT_DOUBLE_EQ(one.left_deg, -30.0);
    EXPECT_DOUBLE_EQ(one.right_deg, 30.0);
    EXPECT_NEAR(std::tan(one.top_deg * kRadPerDeg), std::tan(30.0 * kRadPerDeg) * 1200.0 / 1920.0, 1e-12);
    EXPECT_DOUBLE_EQ(one.bottom_deg, -one.top_deg);
    EXPECT_EQ(one.yaw_deg, 30.0);
    const Channel both = channel_of("fov_deg = 60\nfov_vertical_deg = 40\n");
    EXPECT_DOUBLE_EQ(both.top_deg, 20.0);
}

std::string with_channel(const std::string& keys) {
    return "version = 1\n[[channel]]\nname = \"a\"\nwidth_px = 1920\nheight_px = 1200\n" + keys;
}

TEST(Frusta, ThatShowNothingOrAreGivenTwiceAreRefusedWithTheReason) {
    const std::string good = "[channel.screen]\nbottom_left_m = [1, -1, 1]\nbottom_right_m = [1, 1, 1]\n";
    EXPECT_THAT(error_of(with_channel(good + "top_left_m = [1, -1, 1]\n")).message, HasSubstr("no area"));
    EXPECT_THAT(error_of(with_channel(good + "top_left_m = [1, 0, -1]\n")).message, HasSubstr("63.43"));
    EXPECT_THAT(
        error_of(with_channel("offset_m = [1, 0, 0]\n" + good + "top_left_m = [1, -1, -1]\n")).message,
        HasSubstr("one plane with the eye"));
    EXPECT_THAT(
        error_of(with_channel("offset_m = [2, 0, 0]\n" + good + "top_left_m = [1, -1, -1]\n")).message,
        HasSubstr("shows its back"));
    EXPECT_THAT(
        error_of(with_channel("offset_m = [0.99, 0, 0]\n" + good + "top_left_m = [1, -1, -1]\n")).message,
        HasSubstr("reaches 89.43 degrees"));
    EXPECT_EQ(error_of(with_channel(good)).key, "channel[1].screen.top_left_m");
    EXPECT_EQ(error_of(with_channel("yaw_deg = 3\n" + good + "top_left_m = [1, -1, -1]\n")).key,
              "channel[1].yaw_deg");
    EXPECT_THAT(error_of(with_channel("fov_deg = 60\nleft_deg = -3\n")).message,
                HasSubstr("stands beside fov_deg"));
    EXPECT_THAT(error_of(with_channel("fov_deg = 175.5\n")).message, HasSubstr("up to 175"));
    EXPECT_THAT(
        error_of("version = 1\n[[channel]]\nname = \"a\"\nwidth_px = 100\nheight_px = 1000\nfov_deg = 170\n")
            .message,
        HasSubstr("from bottom to top with square pixels"));
    EXPECT_EQ(error_of(with_channel("fov_vertical_deg = 40\n")).key, "channel[1].fov_deg");
    EXPECT_THAT(
        error_of(with_channel("fov_degs = 60\nleft_deg=-1\nright_deg=1\nbottom_deg=-1\ntop_deg=1\n")).message,
        HasSubstr("\"fov_deg\""));
}

}  // namespace
}  // namespace skyig::config
