// What rain and snow reach of another renderer's things: a roof over a floor, against plain geometry.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "render/gl/texture.h"
#include "render/precipitation/exposure.h"
#include "render/precipitation/fall.h"
#include "render/sky_frame.h"
#include "render/sky_veil.h"
#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;
using precipitation::ExposureView;

constexpr int kWidth = 320;
constexpr int kHeight = 256;
constexpr double kFar_m = 200.0;
constexpr double kEye_m = 12.0;
constexpr double kAlbedo = 0.1;

// Metres from the eye: a floor, and a flat roof 5 m over it, seen from above.
constexpr double kRoof_m = 5.0 - kEye_m;
constexpr glm::dvec2 kRoofLow{-8.0, 25.0};
constexpr glm::dvec2 kRoofHigh{9.0, 37.0};

bool on_roof(const glm::dvec2& at) {
    return at.x > kRoofLow.x && at.x < kRoofHigh.x && at.y > kRoofLow.y && at.y < kRoofHigh.y;
}

// How far a ray goes until it meets roof or floor; 0: neither.
double met_m(const glm::dvec3& from, const glm::dvec3& ray) {
    if (!(ray.z < 0.0)) return 0.0;
    const double roof_m = (kRoof_m - from.z) / ray.z;
    if (roof_m > 0.0 && on_roof(glm::dvec2{from + roof_m * ray})) return roof_m;
    return (-kEye_m - from.z) / ray.z;
}

class Exposure : public GlTest {
  protected:
    static Scene scene_with(const glm::dvec3& wind_m_s) {
        Scene scene = make_scene(35.0, 180.0, -30.0, 40.0, kEye_m);
        scene.weather.precipitations[0] = {Precipitation::Kind::kRain, 5.0, 3000.0};
        scene.weather.precipitation_count = 1;
        scene.weather.wind_m_s = wind_m_s;
        add_view(scene, symmetric_frustum(30.0, kWidth, kHeight), view_from_enu(0.0, -20.0, 0.0));
        return scene;
    }
    static glm::dvec3 ray_at(const Scene& scene, int x, int row) {
        return glm::transpose(scene.views[0].view_from_enu) * view_direction({"only", kWidth, kHeight},
                                                                             scene.views[0].frustum, x + 0.5,
                                                                             kHeight - row - 0.5);
    }
    void put_things(const Scene& scene, double white_cd_m2) {
        std::vector<float> depths;
        for (int row = kHeight - 1; row >= 0; --row) {
            for (int x = 0; x < kWidth; ++x) {
                const glm::dvec3 ray = ray_at(scene, x, row);
                const double distance_m = met_m(glm::dvec3{0.0}, ray);
                const double along = -(scene.views[0].view_from_enu * ray).z;
                depths.push_back(distance_m > 0.0 ? static_cast<float>(distance_m * along / kFar_m) : 1.0F);
            }
        }
        depth_.update(depths);
        colour_.update(
            std::vector<float>(std::size_t{kWidth} * kHeight * 4, static_cast<float>(kAlbedo * white_cd_m2)));
    }
    // As another renderer would: a ray a texel.
    void put_map(const ExposureView& view) {
        const glm::dmat4 enu_m_from_clip = glm::inverse(view.clip_from_enu_m);
        std::vector<float> depths;
        for (int row = 0; row < ExposureView::kSize_px; ++row) {
            for (int column = 0; column < ExposureView::kSize_px; ++column) {
                const glm::dvec2 at =
                    2.0 * glm::dvec2{column + 0.5, row + 0.5} / static_cast<double>(ExposureView::kSize_px) -
                    1.0;
                const glm::dvec3 from{enu_m_from_clip * glm::dvec4{at, -1.0, 1.0}};
                depths.push_back(static_cast<float>(met_m(from, view.fall_enu) / ExposureView::kDepth_m));
            }
        }
        map_.update(depths);
    }
    std::vector<float> light(Renderer& renderer, const Scene& scene, bool mapped) {
        std::vector<float> rgb(std::size_t{kWidth} * kHeight * 3);
        renderer.prepare(scene);
        renderer.draw_scene(0, {colour_.name(), depth_.name(), kFar_m, false, mapped ? map_.name() : 0});
        renderer.read_luminance(0, rgb);
        return rgb;
    }

    gl::Texture colour_{gl::TexelFormat::kRgba32F, kWidth, kHeight};
    gl::Texture depth_{gl::TexelFormat::kR32F, kWidth, kHeight};
    gl::Texture map_{gl::TexelFormat::kR32F, ExposureView::kSize_px, ExposureView::kSize_px};
};

TEST_F(Exposure, TheViewLooksAlongTheFallAndStandsOnTheEarth) {
    Scene scene = scene_with({6.0, -3.0, 0.0});
    const ExposureView view = precipitation::exposure_view(scene);
    const double fall_m_s = precipitation::fall_speed_m_s(Precipitation::Kind::kRain, 5.0, 0.0);
    EXPECT_NEAR(glm::length(glm::cross(view.fall_enu, glm::normalize(glm::dvec3{6.0, -3.0, -fall_m_s}))), 0.0,
                1e-12);
    // The eye moves on: a stone on the ground stays at its place in its texel.
    const glm::dvec3 stone_m{10.0, 20.0, -kEye_m};
    const auto texel_of = [](const ExposureView& map, const glm::dvec3& at_m) {
        return glm::dvec2{map.clip_from_enu_m * glm::dvec4{at_m, 1.0}} * (0.5 * ExposureView::kSize_px);
    };
    const glm::dvec2 before = texel_of(view, stone_m);
    scene.eye.height_m += 3.21;
    const glm::dvec2 moved =
        texel_of(precipitation::exposure_view(scene), stone_m - glm::dvec3{0.0, 0.0, 3.21}) - before;
    EXPECT_NEAR(moved.x, std::round(moved.x), 1e-6);
    EXPECT_NEAR(moved.y, std::round(moved.y), 1e-6);
    scene.weather.precipitation_count = 0;
    EXPECT_EQ(precipitation::exposure_view(scene).fall_enu, glm::dvec3(0.0, 0.0, -1.0));
}

TEST_F(Exposure, SnowLiesOnTheRoofAndRoundItsLeeAndNotBelowIt) {
    for (const glm::dvec3& wind : {glm::dvec3{0.0}, glm::dvec3{5.0, -4.0, 0.0}}) {
        Scene scene = scene_with(wind);
        scene.ground.snow = 1.0;
        Renderer renderer({{"only", kWidth, kHeight}}, without_glare(), {}, Target::kLuminance);
        renderer.prepare(scene);
        ASSERT_TRUE(renderer.exposure_view());
        const ExposureView map = *renderer.exposure_view();
        put_map(map);
        put_things(scene, 0.0);
        const glm::dvec3 shift = map.fall_enu / map.fall_enu.z * (-kEye_m - kRoof_m);
        // Streaks before things are in all three alike.
        const std::vector<float> open = light(renderer, scene, false);
        const std::vector<float> kept = light(renderer, scene, true);
        Scene bare = scene;
        bare.ground.snow = 0.0;
        const std::vector<float> none = light(renderer, bare, false);
        int sheltered = 0, wrong = 0, looked = 0;
        double farthest_m = 0.0;
        // A texel of the map as it lies on the ground.
        const double texel_m = ExposureView::kTexel_m / -map.fall_enu.z;
        for (int row = 2; row + 2 < kHeight; ++row) {
            for (int x = 2; x + 2 < kWidth; ++x) {
                const glm::dvec3 ray = ray_at(scene, x, row);
                const double away_m = met_m(glm::dvec3{0.0}, ray);
                if (!(away_m > 0.0) || away_m > 60.0) continue;
                const glm::dvec3 place = away_m * ray;
                // Edges of the roof have no normal; snow is softened there.
                const bool roof = place.z > -kEye_m + 1.0;
                const glm::dvec2 under = roof ? glm::dvec2{0.0} : glm::dvec2{place - shift};
                const glm::dvec2 into = glm::min(under - kRoofLow, kRoofHigh - under);
                const double inside_m = roof ? -100.0 : std::min(into.x, into.y);
                const auto i = (static_cast<std::size_t>(row) * kWidth + static_cast<std::size_t>(x)) * 3 + 1;
                if (!(open[i] > 2.0F * none[i])) continue;
                const double cover = static_cast<double>((kept[i] - none[i]) / (open[i] - none[i]));
                ++looked;
                sheltered += inside_m > 0.0;
                if ((cover < 0.5) != (inside_m > 0.0)) {
                    ++wrong;
                    farthest_m = std::max(farthest_m, std::abs(inside_m));
                }
            }
        }
        std::printf(
            "wind %.0f m/s: of %d pixels %d sheltered; %d on the wrong side of the edge, by %.2f m at "
            "most, a texel being %.2f m\n",
            glm::length(wind), looked, sheltered, wrong, farthest_m, texel_m);
        EXPECT_GT(sheltered, 200);
        EXPECT_GT(looked, 5 * sheltered);
        EXPECT_LT(farthest_m, texel_m);
    }
}

TEST_F(Exposure, SnowIsAsBrightAsThatOfOurOwnGroundAndWaterDarkens) {
    for (const double coverage : {0.0, 1.0}) {
        Scene scene = scene_with({0.0, 0.0, 0.0});
        scene.weather.precipitation_count = 0;
        scene.weather.clouds[0].coverage = coverage;
        scene.weather.clouds[0].genus = CloudGenus::kStratus;
        scene.weather.cloud_count = coverage > 0.0 ? 1 : 0;
        scene.air.visibility_m = 50e3;
        scene.ground.snow = 1.0;
        SkyFrame frame({}, {}, {}, Target::kLuminance);
        frame.prepare(scene, 1e-3);
        const double white = white_ground_cd_m2(scene, frame.air(), frame.light()).y;
        put_things(scene, white);
        Renderer renderer({{"only", kWidth, kHeight}}, without_glare(), {}, Target::kLuminance);
        const std::vector<float> snow = light(renderer, scene, false);
        // The lowest row's middle: the floor.
        const int x = kWidth / 2, row = kHeight - 4;
        const auto i = (std::size_t{row} * kWidth + std::size_t{x}) * 3 + 1;
        const Horizontal at = horizontal_of(ray_at(scene, x, row));
        const double ground =
            static_cast<double>(frame.light().rgb_cd_m2(at.elevation_rad, at.azimuth_rad, Side::kGround).y);
        scene.ground.snow = 0.0;
        const double dry = static_cast<double>(light(renderer, scene, false)[i]);
        scene.ground.wet = 1.0;
        const double wet = static_cast<double>(light(renderer, scene, false)[i]);
        std::printf(
            "coverage %.0f: snow on the floor %.0f cd/m2, on our own ground %.0f; floor of albedo 0.1 "
            "dry %.0f, wet %.0f\n",
            coverage, static_cast<double>(snow[i]), ground, dry, wet);
        EXPECT_NEAR(static_cast<double>(snow[i]) / ground, 1.0, 0.02);
        EXPECT_NEAR(dry / (kAlbedo * white), 1.0, 0.02);
        EXPECT_GT(wet / dry, 0.45);
        EXPECT_LT(wet / dry, 0.75) << "the film mirrors some sky";
    }
}

}  // namespace
}  // namespace skyig::render
