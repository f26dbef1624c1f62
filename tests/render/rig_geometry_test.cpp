// What channels cover, against counting directions and against closed forms.
#include "render/rig_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace skyig::render {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

/// \param yaw_deg  to the right
ChannelView view(double half_across_deg, double half_upright_deg, double yaw_deg, double pitch_deg = 0.0,
                 double roll_deg = 0.0) {
    return {{-half_across_deg * kDegree, half_across_deg * kDegree, -half_upright_deg * kDegree,
             half_upright_deg * kDegree},
            view_from_body() * body_from_ned(yaw_deg * kDegree, pitch_deg * kDegree, roll_deg * kDegree) *
                ned_from_enu()};
}

bool sees(const ChannelView& view, const glm::dvec3& direction) {
    const glm::dvec3 d = view.view_from_enu * direction;
    const ImagePlane plane = image_plane(view.frustum);
    return d.z < 0.0 && d.x >= plane.left * -d.z && d.x <= plane.right * -d.z && d.y >= plane.bottom * -d.z &&
           d.y <= plane.top * -d.z;
}

RigField of(const std::vector<ChannelView>& views) {
    return rig_field(std::vector<Channel>(views.size(), {"a", 1280, 1024}), views);
}

TEST(RigGeometry, OneChannelsFieldIsThatOfItsRectangle) {
    const RigField rig = of({view(30.0, 20.0, 77.0, 40.0, 12.0)});
    // 4 asin(sin a sin b) of half angles a and b measured at the eye.
    const double wanted_sr = 4.0 * std::asin(std::sin(30.0 * kDegree) * std::sin(20.0 * kDegree));
    EXPECT_NEAR(rig.channels[0].solid_angle_sr, wanted_sr, 1e-12);
    EXPECT_NEAR(rig.solid_angle_sr, wanted_sr, 1e-12);
    EXPECT_NEAR(rig.channels[0].across_rad, 60.0 * kDegree, 1e-12);
    EXPECT_NEAR(rig.channels[0].centre_pixel_rad, 2.0 * std::tan(30.0 * kDegree) / 1280.0, 1e-9);
    for (const double corner_rad : rig.channels[0].corner_pixel_rad)
        EXPECT_LT(corner_rad, rig.channels[0].centre_pixel_rad);
}

TEST(RigGeometry, NeighboursThatShareAnEdgeNeitherOverlapNorGape) {
    const RigField rig = of({view(30.0, 25.0, -60.0), view(30.0, 25.0, 0.0), view(30.0, 25.0, 60.0)});
    ASSERT_EQ(rig.pairs.size(), 3U);
    for (const std::size_t i : {0U, 2U}) {
        EXPECT_LT(rig.pairs[i].overlap_rad, 1e-8);
        EXPECT_LT(rig.pairs[i].gap_rad, 1e-8);
    }
    EXPECT_NEAR(rig.solid_angle_sr, 3.0 * rig.channels[0].solid_angle_sr, 1e-9);
}

TEST(RigGeometry, OverlapAndGapAreTheAngleBetweenTheEdges) {
    const RigField near = of({view(30.0, 25.0, 0.0), view(30.0, 25.0, 58.5)});
    EXPECT_NEAR(near.pairs[0].overlap_rad, 1.5 * kDegree, 1e-9);
    EXPECT_EQ(near.pairs[0].gap_rad, 0.0);
    EXPECT_NEAR(near.solid_angle_sr, 2.0 * near.channels[0].solid_angle_sr - near.pairs[0].overlap_sr, 1e-12);
    const RigField far = of({view(30.0, 25.0, 0.0), view(30.0, 25.0, 61.0)});
    EXPECT_EQ(far.pairs[0].overlap_sr, 0.0);
    // Two upright great circles come closest at the corners.
    const double corner_rad = std::atan(std::tan(25.0 * kDegree) * std::cos(30.0 * kDegree));
    const double wanted_rad = 2.0 * std::asin(std::sin(0.5 * kDegree) * std::cos(corner_rad));
    EXPECT_NEAR(far.pairs[0].gap_rad, wanted_rad, 1e-6);
}

TEST(RigGeometry, OneChannelInsideAnotherAddsNothing) {
    const RigField rig = of({view(40.0, 40.0, 10.0), view(10.0, 10.0, 15.0, 5.0, 30.0)});
    EXPECT_NEAR(rig.pairs[0].overlap_sr, rig.channels[1].solid_angle_sr, 1e-12);
    EXPECT_NEAR(rig.solid_angle_sr, rig.channels[0].solid_angle_sr, 1e-12);
}

TEST(RigGeometry, RandomRigsCoverWhatCountingDirectionsFinds) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> half_deg(8.0, 75.0), turn_deg(-180.0, 180.0),
        tilt_deg(-80.0, 80.0);
    constexpr int kDirections = 40'000;
    double largest_sr = 0.0;
    for (int rig = 0; rig < 30; ++rig) {
        std::vector<ChannelView> views;
        for (int i = 0; i < 4; ++i)
            views.push_back(view(half_deg(random), half_deg(random), turn_deg(random), tilt_deg(random),
                                 turn_deg(random)));
        int any = 0, both = 0;
        for (int i = 0; i < kDirections; ++i) {
            // Even over the sphere: a spiral of the golden angle.
            const double z = 1.0 - (2.0 * i + 1.0) / kDirections;
            const double azimuth = i * 2.399963229728653;
            const glm::dvec3 d{std::sqrt(1.0 - z * z) * std::cos(azimuth),
                               std::sqrt(1.0 - z * z) * std::sin(azimuth), z};
            int seen = 0;
            for (const ChannelView& v : views)
                seen += sees(v, d) ? 1 : 0;
            any += seen > 0 ? 1 : 0;
            both += sees(views[0], d) && sees(views[1], d) ? 1 : 0;
        }
        const RigField field = of(views);
        const double unit_sr = 4.0 * kPi / kDirections;
        largest_sr = std::max({largest_sr, std::abs(field.solid_angle_sr - any * unit_sr),
                               std::abs(field.pairs[0].overlap_sr - both * unit_sr)});
        EXPECT_EQ(field.pairs[0].overlap_sr > 1e-3, both > 3) << rig;
        EXPECT_FALSE(field.pairs[0].overlap_sr > 0.0 && field.pairs[0].gap_rad > 0.0);
    }
    std::printf("rigs: largest difference from counting %.4f sr\n", largest_sr);
    EXPECT_LT(largest_sr, 0.02);
}

}  // namespace
}  // namespace skyig::render
