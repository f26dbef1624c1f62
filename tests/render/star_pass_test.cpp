// Stars: position, energy and colour of what is drawn, independent of field of view and sub-pixel offset.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/night/star_catalogue.h"
#include "render/star_field.h"
#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

class StarPass : public GlTest {};

// A moonless night with one star straight ahead: the view is turned to it.
Scene night_towards(const glm::dvec3& direction_enu) {
    Scene scene = make_scene(-40.0, 0.0, -40.0, 90.0, 0.0);
    const Horizontal at = horizontal_of(direction_enu);
    const glm::dmat3 view = view_from_enu(at.azimuth_rad / kDegree, at.elevation_rad / kDegree, 0.0);
    add_view(scene, symmetric_frustum(5.0, 128, 128), view);
    return scene;
}

// The brightest star of the fixture's sky that is well above the horizon.
glm::dvec3 brightest_direction() {
    const Scene scene = make_scene(-40.0, 0.0, -40.0, 90.0, 0.0);
    const night::CatalogueStar* best = nullptr;
    for (const auto& star : night::star_catalogue()) {
        const glm::dvec3 d = scene.stars.enu_from_gcrs * glm::dvec3{star.direction_gcrs};
        if (d.z > 0.5 && (best == nullptr || star.vmag < best->vmag)) best = &star;
    }
    return glm::normalize(scene.stars.enu_from_gcrs * glm::dvec3{best->direction_gcrs});
}

TEST_F(StarPass, StarStandsWhereItsDirectionIs) {
    const Scene scene = night_towards(brightest_direction());
    const auto picture = draw({{"only", 128, 128}}, scene, undithered())[0];
    double sum = 0.0, x = 0.0, y = 0.0;
    const Rgb sky = picture.at(3, 3);
    for (int row = 56; row < 72; ++row) {
        for (int column = 56; column < 72; ++column) {
            const double light = std::max(0, picture.at(column, row).g - sky.g - 1);
            sum += light;
            x += light * (column + 0.5);
            y += light * (row + 0.5);
        }
    }
    ASSERT_GT(sum, 100.0);
    EXPECT_NEAR(x / sum, 64.0, 0.1);
    EXPECT_NEAR(y / sum, 64.0, 0.1);
}

// Sum over pixels of what a Gaussian of this angle gives, as the shader computes it: closed form in double.
TEST_F(StarPass, FootprintKeepsItsEnergyAtEverySubPixelOffset) {
    const Channel channel{"c", 1280, 1024};
    const Frustum frustum = symmetric_frustum(30.0, channel.width_px, channel.height_px);
    const double sigma = 0.7 * pixel_angle_rad(channel, frustum);
    double worst = 0.0;
    for (const auto& [cx, cy] : {std::pair{640.0, 512.0}, std::pair{640.3, 512.7}, std::pair{20.4, 30.2},
                                 std::pair{1270.1, 1010.9}, std::pair{900.5, 100.5}}) {
        const glm::dvec3 star = view_direction(channel, frustum, cx, cy);
        double sum = 0.0;
        for (int dy = -8; dy <= 8; ++dy) {
            for (int dx = -8; dx <= 8; ++dx) {
                const double px = std::floor(cx) + dx + 0.5;
                const double py = std::floor(cy) + dy + 0.5;
                const glm::dvec3 here = view_direction(channel, frustum, px, py);
                const double chord = glm::length(here - star) / sigma;
                const ImagePlane p = image_plane(frustum);
                const double pixel =
                    (p.right - p.left) / channel.width_px * (p.top - p.bottom) / channel.height_px;
                sum += std::exp(-0.5 * chord * chord) / (2.0 * std::numbers::pi * sigma * sigma) * pixel *
                       std::pow(-here.z, 3.0);
            }
        }
        worst = std::max(worst, std::abs(sum - 1.0));
    }
    std::printf("largest loss or gain of a footprint: %.2g\n", worst);
    EXPECT_LT(worst, 3e-3);
}

TEST_F(StarPass, ZoomMakesStarsStandOutAndLeavesTheSkyAlone) {
    const glm::dvec3 star = brightest_direction();
    Scene near = night_towards(star);
    Scene far = near;
    near.views[0].frustum = symmetric_frustum(1.0, 128, 128);
    far.views[0].frustum = symmetric_frustum(40.0, 128, 128);
    const auto zoomed = draw({{"only", 128, 128}}, near, undithered())[0];
    const auto wide = draw({{"only", 128, 128}}, far, undithered())[0];
    EXPECT_GE(zoomed.at(64, 64).g, wide.at(64, 64).g);
    EXPECT_NEAR(zoomed.at(4, 64).g, wide.at(64, 56).g, 12);
}

TEST_F(StarPass, SwitchAndIntensityAreObeyed) {
    Scene scene = night_towards(brightest_direction());
    const int full = draw({{"only", 128, 128}}, scene, undithered())[0].at(64, 64).g;
    scene.stars.intensity = 0.02;
    const int faint = draw({{"only", 128, 128}}, scene, undithered())[0].at(64, 64).g;
    scene.stars.enabled = false;
    const int off = draw({{"only", 128, 128}}, scene, undithered())[0].at(64, 64).g;
    EXPECT_GT(full, faint);
    EXPECT_GT(faint, off);
}

TEST_F(StarPass, StarsFadeThroughDuskAndAreGoneByDay) {
    std::size_t last = 20000;
    for (const double sun : {-20.0, -12.0, -6.0, -3.0, 5.0}) {
        Scene scene = make_scene(sun, 0.0, -40.0, 90.0, 0.0);
        add_view(scene, symmetric_frustum(30.0, 64, 64), view_from_enu(0.0, 40.0, 0.0));
        Renderer renderer({{"only", 64, 64}}, undithered());
        renderer.prepare(scene);
        const std::size_t drawn = renderer.prepare(scene).stars_drawn;
        std::printf("sun %5.1f deg: %zu stars\n", sun, drawn);
        EXPECT_LE(drawn, last) << sun;
        last = drawn;
    }
    EXPECT_EQ(last, 0U);
}

}  // namespace
}  // namespace skyig::render
