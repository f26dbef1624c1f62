#include "render/channel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using tests::kDegree;

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double bound) {
    EXPECT_LT(glm::length(a - b), bound);
}

glm::dvec3 forward_enu(double yaw_deg, double pitch_deg, double roll_deg, double view_yaw_deg = 0.0) {
    return glm::transpose(tests::view_from_enu(yaw_deg, pitch_deg, roll_deg, view_yaw_deg)) *
           glm::dvec3{0, 0, -1};
}

TEST(ChannelFrames, YawTurnsFromNorthToEast) {
    expect_near(forward_enu(0, 0, 0), {0, 1, 0}, 1e-15);
    expect_near(forward_enu(90, 0, 0), {1, 0, 0}, 1e-15);
    expect_near(forward_enu(180, 0, 0), {0, -1, 0}, 1e-15);
}

TEST(ChannelFrames, PitchLooksUpWhateverTheHeading) {
    EXPECT_NEAR(forward_enu(37, 20, 0).z, std::sin(20 * kDegree), 1e-15);
    EXPECT_NEAR(forward_enu(37, 20, 80).z, std::sin(20 * kDegree), 1e-15);
}

TEST(ChannelFrames, RollRightDropsTheRightWingInThePicture) {
    // Flying north with the right wing down, the zenith moves to the left of the picture.
    const glm::dvec3 zenith = tests::view_from_enu(0, 0, 30) * glm::dvec3{0, 0, 1};
    expect_near(zenith, {-0.5, std::sqrt(0.75), 0}, 1e-15);
}

TEST(ChannelFrames, LeftChannelLooksLeftOfTheNose) {
    expect_near(forward_enu(10, 0, 0, -60), tests::at(0, -50), 1e-15);
}

TEST(ChannelFrames, RotationsAreProper) {
    const glm::dmat3 r = tests::view_from_enu(211, -14, 77, 33);
    EXPECT_NEAR(glm::determinant(r), 1.0, 1e-14);
    const glm::dmat3 identity = r * glm::transpose(r);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            EXPECT_NEAR(identity[i][j], i == j ? 1.0 : 0.0, 1e-15);
}

TEST(EquatorialAxes, PoleStandsAtTheLatitudeAndTheMeridianIsTheSiderealTimes) {
    const glm::dmat3 enu = enu_from_equatorial(-0.6, 1.3);
    const Horizontal pole = horizontal_of(enu * glm::dvec3{0.0, 0.0, 1.0});
    EXPECT_NEAR(pole.elevation_rad, -0.6, 1e-12);
    EXPECT_NEAR(pole.azimuth_rad, 0.0, 1e-12);
    const Horizontal equator = horizontal_of(enu * glm::dvec3{std::cos(1.3), std::sin(1.3), 0.0});
    EXPECT_NEAR(equator.elevation_rad, 0.5 * std::numbers::pi - 0.6, 1e-12);
    EXPECT_NEAR(equator.azimuth_rad, 0.0, 1e-12) << "north of a southern site";
    // Right ascension grows to the east.
    EXPECT_GT((enu * glm::dvec3{std::cos(1.5), std::sin(1.5), 0.0}).x, 0.0);
}

TEST(ViewDirection, CornersOfAnOffAxisFrustumLieOnItsSidePlanes) {
    const Channel channel{"off", 640, 480};
    const Frustum frustum{-10 * kDegree, 50 * kDegree, -40 * kDegree, 5 * kDegree};
    const glm::dvec3 low_left = view_direction(channel, frustum, 0, 0);
    const glm::dvec3 high_right = view_direction(channel, frustum, 640, 480);
    EXPECT_NEAR(std::atan2(low_left.x, -low_left.z), -10 * kDegree, 1e-15);
    EXPECT_NEAR(std::atan2(low_left.y, -low_left.z), -40 * kDegree, 1e-15);
    EXPECT_NEAR(std::atan2(high_right.x, -high_right.z), 50 * kDegree, 1e-15);
    EXPECT_NEAR(std::atan2(high_right.y, -high_right.z), 5 * kDegree, 1e-15);
    EXPECT_NEAR(glm::length(low_left), 1.0, 1e-15);
}

TEST(ViewDirection, ExtremeFrustaStayFinite) {
    for (const double half_deg : {0.5, 85.0}) {
        const Channel channel{"x", 1280, 1024};
        const Frustum frustum{-half_deg * kDegree, half_deg * kDegree, -half_deg * kDegree,
                              half_deg * kDegree};
        const glm::dvec3 corner = view_direction(channel, frustum, 0, 0);
        EXPECT_NEAR(glm::length(corner), 1.0, 1e-14);
        EXPECT_GT(pixel_angle_rad(channel, frustum), 0.0);
    }
}

TEST(SmallestPixel, LiesInTheFarthestCornerOfTheFinestChannel) {
    const std::vector<Channel> channels{{"wide", 64, 48}, {"off", 640, 480}, {"dark", 4000, 4000}};
    const std::vector<ChannelView> views{{tests::symmetric_frustum(60.0, 64, 48)},
                                         {Frustum{-10 * kDegree, 70 * kDegree, -60 * kDegree, 5 * kDegree}},
                                         {Frustum{}}};
    // Area of the spherical quadrangle that its corners span, small enough to be flat.
    const auto pixel_sr = [&](std::size_t i, double x, double y) {
        const auto corner = [&](double dx, double dy) {
            return view_direction(channels[i], views[i].frustum, x + dx, y + dy);
        };
        return 0.5 * glm::length(glm::cross(corner(1, 1) - corner(0, 0), corner(0, 1) - corner(1, 0)));
    };
    const double right_low = pixel_sr(1, 639, 0);
    for (const auto& [x, y] : {std::pair{0, 0}, std::pair{0, 479}, std::pair{639, 479}, std::pair{320, 240}})
        EXPECT_GT(pixel_sr(1, x, y), right_low);
    EXPECT_NEAR(smallest_pixel_sr(channels, views) / right_low, 1.0, 0.02);
    const std::span<const Channel> wide{channels.data(), 1};
    EXPECT_NEAR(smallest_pixel_sr(wide, views) / pixel_sr(0, 0, 0), 1.0, 0.1);
    EXPECT_EQ(smallest_pixel_sr({}, views), 4e-4);
}

}  // namespace
}  // namespace skyig::render
