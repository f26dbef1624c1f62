// Things in fog: what another renderer draws at a distance has the contrast that the visibility set promises.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "render/cloud/field/cloud_field.h"
#include "render/cloud/field/shapes.h"
#include "render/clouds.h"
#include "render/gl/texture.h"
#include "render/weather_ramp.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/light_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kWidth = 160;
constexpr int kHeight = 128;

class DeferredFog : public GlTest {};

// A black wall over the lower part of the picture, up to a little above the level, all of it that far along
// the view's axis.
struct Wall {
    gl::Texture colour{gl::TexelFormat::kRgba32F, kWidth, kHeight};
    gl::Texture depth{gl::TexelFormat::kR32F, kWidth, kHeight};
    double far_m;

    Wall(double distance_m, int rows, float cd_m2) : far_m(4.0 * distance_m) {
        std::vector<float> depths(std::size_t{kWidth} * kHeight, 1.0F);
        std::fill_n(depths.begin(), std::size_t{kWidth} * static_cast<std::size_t>(rows), 0.25F);
        depth.update(depths);
        colour.update(std::vector<float>(std::size_t{kWidth} * kHeight * 4, cd_m2));
    }
    bool shadows = true;

    [[nodiscard]] DeferredInput input() const { return {colour.name(), depth.name(), far_m, shadows}; }
};

std::vector<float> light_of(Renderer& renderer, const Scene& scene, const Wall& wall) {
    std::vector<float> rgb(std::size_t{kWidth} * kHeight * 3);
    renderer.prepare(scene);
    renderer.draw_scene(0, wall.input());
    renderer.read_luminance(0, rgb);
    return rgb;
}

double luminance_at(const std::vector<float>& rgb, int x, int row_from_top) {
    const float* p = &rgb[static_cast<std::size_t>((row_from_top * kWidth + x) * 3)];
    return static_cast<double>(shaders32::luminance_709(glm::vec3{p[0], p[1], p[2]}));
}

void add_fog(Scene& scene, double top_m, double visibility_m, Obscurant::Kind kind = Obscurant::Kind::kFog) {
    scene.weather.obscurants[scene.weather.obscurant_count++] =
        Obscurant{.kind = kind, .top_m = top_m, .top_band_m = 50.0, .extinction_per_m = 2.996 / visibility_m};
}

// The regulation asks at 2,000, 1,500 and 1,000 ft and on the ground.
TEST_F(DeferredFog, ABlackTargetAtTheSetVisibilityHasItsContrast) {
    constexpr double kFoot_m = 0.3048;
    double largest = 0.0;
    for (const double eye_m : {2000.0 * kFoot_m, 1500.0 * kFoot_m, 1000.0 * kFoot_m, 2.0}) {
        for (const double visibility_m : {300.0, 5000.0}) {
            for (const double contrast : {0.05, 0.02}) {
                if (contrast < 0.05 && eye_m > 10.0 && eye_m < 600.0) continue;
                Scene scene = make_scene(35.0, 200.0, -40.0, 0.0, eye_m);
                scene.sun.enabled = scene.moon.enabled = scene.stars.enabled = false;
                scene.air.visibility_m = 60e3;
                // What fog has to add to the air's own extinction, which thins out with height.
                const double air_per_m = (2.996 / 60e3 - 1.16e-5) * std::exp(-eye_m / 1200.0) + 1.15e-5;
                add_fog(scene, 900.0, visibility_m);
                Obscurant& fog = scene.weather.obscurants[0];
                fog.extinction_per_m = -std::log(contrast) / visibility_m - air_per_m;
                add_view(scene, symmetric_frustum(4.0, kWidth, kHeight), view_from_enu(60.0, 0.0, 0.0));
                Renderer renderer({{"only", kWidth, kHeight}}, {}, {}, Target::kLuminance);
                // Just above the level, with the wall and without.
                const Wall wall(visibility_m, kHeight / 2 + 3, 0.0F);
                const double target =
                    luminance_at(light_of(renderer, scene, wall), kWidth / 2, kHeight / 2 - 2);
                const Wall none(visibility_m, 0, 0.0F);
                const double behind =
                    luminance_at(light_of(renderer, scene, none), kWidth / 2, kHeight / 2 - 2);
                const double got = (behind - target) / behind;
                std::printf("eye %5.0f m, %5.0f m at %.0f %%: contrast %.4f\n", eye_m, visibility_m,
                            100.0 * contrast, got);
                // Where the air's own light is mixed in too: what the dome has and what stands before a thing
                // come from different tables.
                EXPECT_NEAR(got, contrast, 0.03 * contrast);
                largest = std::max(largest, std::abs(got / contrast - 1.0));
            }
        }
    }
    RecordProperty("largest_relative_error", std::to_string(largest));
    std::printf("largest relative error of contrast %.3f\n", largest);
}

// Fog that comes in a minute, from the ground and over it: its first seconds, when the horizon goes.
TEST_F(DeferredFog, FogComesWithoutASteppingPicture) {
    for (const double eye_m : {2.0, 300.0}) {
        Scene scene = make_scene(30.0, 200.0, -40.0, 0.0, eye_m);
        scene.sun.enabled = false;
        add_view(scene, symmetric_frustum(30.0, kWidth, kHeight), view_from_enu(180.0, 2.0, 0.0));
        Renderer renderer({{"only", kWidth, kHeight}}, undithered());
        std::vector<std::byte> last(std::size_t{kWidth} * kHeight * 4);
        std::vector<std::byte> now(last.size());
        scene.weather.obscurant_count = 1;
        int largest = 0;
        int at_frame = 0;
        for (int frame = 0; frame < 240; ++frame) {
            scene.time_s = frame / 60.0;
            scene.weather.obscurants[0] =
                Obscurant{.top_m = 100.0,
                          .top_band_m = 20.0,
                          .extinction_per_m = between<ExtinctionScale>(0.0, 0.01, scene.time_s / 60.0)};
            renderer.prepare(scene);
            renderer.draw(0);
            renderer.read_back(0, now);
            for (std::size_t k = 0; frame > 0 && k < now.size(); ++k) {
                const int step = std::abs(std::to_integer<int>(now[k]) - std::to_integer<int>(last[k]));
                if (step <= largest) continue;
                largest = step;
                at_frame = frame;
            }
            std::swap(last, now);
        }
        std::printf("eye %3.0f m: largest step %d codes, in frame %d\n", eye_m, largest, at_frame);
        EXPECT_LE(largest, 2);
    }
}

// The shader against the same text in double, over layers that overlap, from in, above and below them.
TEST_F(DeferredFog, TheShaderDrawsWhatDoubleSays) {
    double largest = 0.0;
    for (const double eye_m : {2.0, 120.0, 700.0, 3000.0}) {
        for (const double sun_deg : {40.0, -4.0}) {
            Scene scene = make_scene(sun_deg, 100.0, -40.0, 0.0, eye_m);
            scene.sun.enabled = scene.stars.enabled = false;
            add_fog(scene, 80.0, 400.0);
            add_fog(scene, 500.0, 6000.0, Obscurant::Kind::kSmoke);
            scene.weather.obscurants[1].base_m = 60.0;
            scene.weather.obscurants[1].bottom_band_m = 30.0;
            add_view(scene, symmetric_frustum(25.0, kWidth, kHeight), view_from_enu(95.0, -6.0, 5.0));
            Renderer renderer({{"only", kWidth, kHeight}}, undithered());
            for (const double distance_m : {5.0, 300.0, 4000.0, 40e3}) {
                const Wall wall(distance_m, kHeight, 100.0F);
                renderer.prepare(scene);
                renderer.draw_scene(0, wall.input());
                Picture picture{kWidth, kHeight, std::vector<std::byte>(std::size_t{kWidth} * kHeight * 4)};
                renderer.read_back(0, picture.rgba);
                for (int y = 2; y < kHeight; y += 9) {
                    for (int x = 2; x < kWidth; x += 13) {
                        const glm::dvec3 in_view = view_direction(
                            {"only", kWidth, kHeight}, scene.views[0].frustum, x + 0.5, kHeight - y - 0.5);
                        const glm::dvec3 exact =
                            renderer.reference_colour(glm::transpose(scene.views[0].view_from_enu) * in_view,
                                                      distance_m / -in_view.z, glm::dvec3{100.0});
                        const Rgb drawn = picture.at(x, y);
                        const glm::dvec3 off =
                            glm::abs(glm::dvec3{drawn.r, drawn.g, drawn.b} - 255.0 * exact);
                        largest = std::max({largest, off.x, off.y, off.z});
                    }
                }
            }
        }
    }
    std::printf("largest difference %.2f codes\n", largest);
    EXPECT_LT(largest, 0.9);
}

// Fog of 100 m in patches over half of the ground. Along each path the depth is a sum of a metre's steps over
// the field's own value, in double.
struct Patches {
    CloudLayer layer;
    cloud::field::CloudField field{std::make_shared<const cloud::field::Matrix>()};

    Patches() {
        layer.genus = CloudGenus::kFogPatches;
        layer.base_m = 0.0;
        layer.thickness_m = 40.0;
        layer.top_band_m = 10.0;
        layer.coverage = 0.5;
        layer.extinction_per_m = 0.028;
        layer.seed = 5;
        layer.drift_m = {1370.0, 760.0};
    }
    [[nodiscard]] double depth(const Scene& scene, const glm::dvec3& direction, double distance_m) {
        using namespace cloud::field;
        field.freeze(scene, {});
        const Layer& own = field.field().layers[0];
        double sum_m = 0.0;
        Points points{};
        for (double first_m = 0.0; first_m < distance_m; first_m += kRays) {
            for (int i = 0; i < kRays; ++i) {
                const glm::dvec3 at_m = (first_m + i + 0.5) * direction;
                points.north_m[i] = static_cast<float>(at_m.y);
                points.east_m[i] = static_cast<float>(at_m.x) + field.field().closing * points.north_m[i];
                points.height_m[i] = 1.0F;
            }
            kernels().values(own.shape, own.thickness_m, points);
            for (int i = 0; i < kRays && first_m + i < distance_m; ++i) {
                const double x = std::clamp(
                    static_cast<double>((points.value[i] - own.threshold) / own.shape.edge), 0.0, 1.0);
                const double height_m = scene.eye.height_m + (first_m + i + 0.5) * direction.z;
                sum_m += x * x * (3.0 - 2.0 * x) * std::clamp((50.0 - height_m) / 10.0, 0.0, 1.0);
            }
        }
        return layer.extinction_per_m * sum_m;
    }
};

// From the ground and from over the fog.
TEST_F(DeferredFog, ABlackTargetAmongPatchesHasTheContrastOfItsPath) {
    Patches patches;
    double largest = 0.0;
    int compared = 0;
    for (const double eye_m : {3.0, 150.0}) {
        Scene scene = make_scene(35.0, 200.0, -40.0, 0.0, eye_m);
        scene.sun.enabled = scene.moon.enabled = scene.stars.enabled = false;
        scene.air.visibility_m = 200e3;
        scene.weather.clouds[0] = patches.layer;
        scene.weather.cloud_count = 1;
        add_view(scene, symmetric_frustum(8.0, kWidth, kHeight),
                 view_from_enu(110.0, eye_m > 50.0 ? -12.0 : 0.0, 0.0));
        Renderer renderer({{"only", kWidth, kHeight}}, {}, {}, Target::kLuminance);
        renderer.draw_clouds(scene_clouds());
        const double farthest_m = eye_m > 50.0 ? 650.0 : 500.0;
        for (const double distance_m : {0.5 * farthest_m, farthest_m}) {
            // Things are told of patches from the second frame on.
            Wall black(distance_m, kHeight, 0.0F), white(distance_m, kHeight, 1000.0F);
            black.shadows = white.shadows = false;
            static_cast<void>(light_of(renderer, scene, black));
            const std::vector<float> dark = light_of(renderer, scene, black);
            const std::vector<float> bright = light_of(renderer, scene, white);
            for (const int x : {20, 80, 140}) {
                const int y = kHeight / 2 - 4;
                const glm::dvec3 in_view = view_direction({"only", kWidth, kHeight}, scene.views[0].frustum,
                                                          x + 0.5, kHeight - y - 0.5);
                const glm::dvec3 ray = glm::transpose(scene.views[0].view_from_enu) * in_view;
                const double along_m = distance_m / -in_view.z;
                const double passed = std::exp(-patches.depth(scene, ray, along_m));
                if (passed < 0.05) continue;
                const double air = std::exp(-2e-5 * along_m);
                const double got = (luminance_at(bright, x, y) - luminance_at(dark, x, y)) / 1000.0 / air;
                largest = std::max(largest, std::abs(got / passed - 1.0));
                EXPECT_NEAR(got, passed, 0.05 * passed)
                    << "eye " << eye_m << " m, " << distance_m << " m, column " << x;
                ++compared;
            }
        }
    }
    std::printf("%d targets among patches: largest relative error of contrast %.3f\n", compared, largest);
    RecordProperty("largest_relative_error", std::to_string(largest));
    EXPECT_GE(compared, 9);
}

}  // namespace
}  // namespace skyig::render
