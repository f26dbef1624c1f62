// Another renderer's picture under our air: ridges cast on the CPU, drawn on the GPU, held against the
// spectral march of every ray through the tone curve.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "render/cloud/field/field_maker.h"
#include "render/gl/texture.h"
#include "render/sky/geometry.h"
#include "render/sky/ray_light.h"
#include "render/sky_frame.h"
#include "tests/render/fake_clouds.h"
#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kWidth = 320;
constexpr int kHeight = 256;
constexpr double kFar_m = 150e3;

struct Thing {
    double distance_m = std::numeric_limits<double>::infinity();
    glm::dvec3 rgb_cd_m2{0.0};
};

// Ranges of mountains around the eye, of which the farther ones stand higher, on a round Earth.
Thing cast(const glm::dvec3& direction_enu, double eye_m, double lit_cd_m2) {
    const Horizontal view = horizontal_of(direction_enu);
    struct Range {
        double distance_m, height_m, rough;
        glm::dvec3 albedo;
    };
    constexpr std::array kRanges{
        Range{2e3, 120.0, 9.0, {0.05, 0.08, 0.03}}, Range{10e3, 700.0, 7.0, {0.03, 0.06, 0.02}},
        Range{40e3, 2600.0, 11.0, {0.2, 0.15, 0.1}}, Range{100e3, 5200.0, 5.0, {0.0, 0.0, 0.0}}};
    constexpr sky::Shell kEarth{kEarthRadius_m, 120e3};
    const double plain_m = view.elevation_rad < horizon_elevation_rad(eye_m)
                               ? kEarth.distance_to_ground_m(eye_m, direction_enu.z)
                               : std::numeric_limits<double>::infinity();
    const Thing plain{plain_m, glm::dvec3{0.12, 0.14, 0.08} * lit_cd_m2};
    for (const Range& range : kRanges) {
        if (plain_m < range.distance_m) return plain;
        const double shape = 0.6 + 0.25 * std::sin(range.rough * view.azimuth_rad) +
                             0.15 * std::sin(3.7 * range.rough * view.azimuth_rad + 1.0);
        const double drop_m = range.distance_m * range.distance_m / (2.0 * kEarthRadius_m);
        const double top_rad = std::atan2(range.height_m * shape - drop_m - eye_m, range.distance_m);
        const double distance_m = range.distance_m / std::cos(view.elevation_rad);
        if (view.elevation_rad < top_rad && distance_m < plain_m)
            return {distance_m, range.albedo * lit_cd_m2};
    }
    return plain;
}

struct Ground {
    std::vector<Thing> things;
    gl::Texture colour{gl::TexelFormat::kRgba32F, kWidth, kHeight};
    gl::Texture depth{gl::TexelFormat::kR32F, kWidth, kHeight};

    [[nodiscard]] DeferredInput input() const { return {colour.name(), depth.name(), kFar_m}; }
    [[nodiscard]] const Thing& at(int x, int row_from_top) const {
        return things[static_cast<std::size_t>((kHeight - 1 - row_from_top) * kWidth + x)];
    }
};

glm::dvec3 direction_at(const ChannelView& view, int x, int row_from_top) {
    return glm::transpose(view.view_from_enu) *
           view_direction({"only", kWidth, kHeight}, view.frustum, x + 0.5, kHeight - row_from_top - 0.5);
}

Ground draw_ground(const Scene& scene, double lit_cd_m2) {
    Ground ground;
    const ChannelView& view = scene.views[0];
    std::vector<float> colour;
    std::vector<float> depth;
    for (int y = kHeight - 1; y >= 0; --y) {
        for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 direction = direction_at(view, x, y);
            Thing thing = cast(direction, scene.eye.height_m, lit_cd_m2);
            const double along = -(view.view_from_enu * direction).z;
            const double z = std::min(thing.distance_m * along / kFar_m, 1.0);
            depth.push_back(static_cast<float>(z));
            for (int k = 0; k < 3; ++k)
                colour.push_back(static_cast<float>(thing.rgb_cd_m2[k]));
            colour.push_back(1.0F);
            ground.things.push_back(thing);
        }
    }
    ground.colour.update(colour);
    ground.depth.update(depth);
    return ground;
}

class Deferred : public GlTest {
  protected:
    Picture draw_over(Renderer& renderer, const Scene& scene, const DeferredInput& input) {
        renderer.prepare(scene);
        renderer.draw_scene(0, input);
        Picture picture{kWidth, kHeight, std::vector<std::byte>(std::size_t{kWidth} * kHeight * 4)};
        renderer.read_back(0, picture.rgba);
        EXPECT_EQ(renderer.prepare(scene).gl_errors, 0U);
        return picture;
    }
};

double off_by(const Rgb& drawn, const glm::dvec3& exact) {
    return 255.0 * std::max({std::abs(drawn.r / 255.0 - exact.x), std::abs(drawn.g / 255.0 - exact.y),
                             std::abs(drawn.b / 255.0 - exact.z)});
}

struct View {
    const char* name;
    double sun_deg, sun_azimuth_deg, eye_m, visibility_m, yaw_deg, lit_cd_m2;
    Frustum frustum;
};

TEST_F(Deferred, RidgesAreWithinACodeOfTheMarch) {
    const Frustum straight = symmetric_frustum(25.0, kWidth, kHeight);
    const Frustum aside{0.1, 1.1, -0.5, 0.2};
    const std::vector<View> views{{"dawn", 2.0, 110.0, 300.0, 60e3, 95.0, 900.0, straight},
                                  {"noon", 48.0, 185.0, 600.0, 80e3, 30.0, 25e3, straight},
                                  {"haze", 35.0, 185.0, 300.0, 10e3, 160.0, 20e3, straight},
                                  {"off-axis", 20.0, 250.0, 900.0, 40e3, 230.0, 15e3, aside},
                                  {"10 km up", 20.0, 250.0, 10e3, 40e3, 230.0, 15e3, aside}};
    for (const View& v : views) {
        Scene scene = make_scene(v.sun_deg, v.sun_azimuth_deg, -40.0, 0.0, v.eye_m);
        scene.air.visibility_m = v.visibility_m;
        scene.stars.enabled = scene.sun.enabled = scene.moon.enabled = false;
        add_view(scene, v.frustum, view_from_enu(v.yaw_deg, v.eye_m > 5e3 ? -5.0 : 2.0, 4.0));
        const Ground ground = draw_ground(scene, v.lit_cd_m2);
        Renderer renderer({{"only", kWidth, kHeight}}, undithered());
        const Picture picture = draw_over(renderer, scene, ground.input());

        const sky::AirTables tables(sky::air_model(scene.air));
        const Horizontal sun = horizontal_of(scene.sun.direction_enu);
        std::vector<double> to_march;
        double to_table = 0.0;
        for (int y = 0; y < kHeight; y += 4) {
            for (int x = 0; x < kWidth; x += 4) {
                const Thing& thing = ground.at(x, y);
                if (!(thing.distance_m < kFar_m)) continue;
                const glm::dvec3 direction = direction_at(scene.views[0], x, y);
                const Horizontal at = horizontal_of(direction);
                const sky::models::AirBetween air =
                    sky::models::air_between({}, tables,
                                             {v.eye_m, sun.elevation_rad, at.elevation_rad,
                                              at.azimuth_rad - sun.azimuth_rad, thing.distance_m});
                const glm::dvec3 exact = renderer.reference_colour(
                    direction, 0.0, thing.rgb_cd_m2 * air.passed_rgb + air.added_rgb);
                const Rgb drawn = picture.at(x, y);
                to_march.push_back(off_by(drawn, exact));
                to_table = std::max(
                    to_table,
                    off_by(drawn, renderer.reference_colour(direction, thing.distance_m, thing.rgb_cd_m2)));
            }
        }
        ASSERT_GT(to_march.size(), 1000U);
        std::sort(to_march.begin(), to_march.end());
        const double p99 = to_march[to_march.size() * 99 / 100];
        std::printf("%-9s codes from the march: p50 %.2f, p99 %.2f, largest %.2f; from the table %.2f\n",
                    v.name, to_march[to_march.size() / 2], p99, to_march.back(), to_table);
        // Half a code is the rounding to 8 bits.
        EXPECT_LE(p99, 1.0) << v.name;
        EXPECT_LE(to_march.back(), 2.0) << v.name;
        EXPECT_LE(to_table, 0.75) << v.name;
    }
}

TEST_F(Deferred, WhereNothingWasDrawnTheSkyStaysAndBadNumbersAreHarmless) {
    for (auto& [name, scene] : four_times()) {
        if (name == "dawn" || name == "noon") continue;
        add_view(scene, symmetric_frustum(30.0, kWidth, kHeight), view_from_enu(175.0, 8.0, 0.0));
        const Picture sky = draw({{"only", kWidth, kHeight}}, scene, undithered())[0];
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const float inf = std::numeric_limits<float>::infinity();
        // Columns of depths by rows of colours.
        const std::array depths{1.0F, inf, nan, 0.0F, -1.0F, 1e-30F, 0.5F, 0.999F};
        const std::array colours{0.0F, 1.0F, nan, inf, -inf, -5.0F, 1e9F, 1e-38F};
        gl::Texture colour{gl::TexelFormat::kRgba32F, kWidth, kHeight};
        gl::Texture depth{gl::TexelFormat::kR32F, kWidth, kHeight};
        std::vector<float> depth_texels;
        std::vector<float> colour_texels;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                depth_texels.push_back(depths[static_cast<std::size_t>(x * 8 / kWidth)]);
                const float value = colours[static_cast<std::size_t>(y * 8 / kHeight)];
                colour_texels.insert(colour_texels.end(), {value, value, value, 1.0F});
            }
        }
        depth.update(depth_texels);
        colour.update(colour_texels);
        Renderer renderer({{"only", kWidth, kHeight}}, undithered());
        const Picture picture = draw_over(renderer, scene, {colour.name(), depth.name(), 1e6});
        int largest = 0;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < 3 * kWidth / 8; ++x)
                largest = std::max(largest, difference(picture.at(x, y), sky.at(x, y)));
        }
        EXPECT_EQ(largest, 0) << name;
        // Rows from the top: tiny, huge, -5, -inf, inf, NaN, 1, 0 cd/m2; at distance 0 what is no light is
        // black.
        const int near_x = 7 * kWidth / 16;
        for (const int row : {2, 3, 5, 7}) {
            const Rgb dark = picture.at(near_x, row * kHeight / 8 + 4);
            EXPECT_EQ(dark.r + dark.g + dark.b, 0) << name << ' ' << row;
        }
        for (const int row : {1, 4}) {
            const Rgb bright = picture.at(near_x, row * kHeight / 8 + 4);
            EXPECT_EQ(bright.r + bright.g + bright.b, 765) << name << ' ' << row;
        }
    }
}

// A black ridge further and further away becomes the horizon.
TEST_F(Deferred, AFarRidgeTendsToTheHorizonSky) {
    Scene scene = make_scene(40.0, 185.0, -40.0, 0.0, 10.0);
    scene.air.visibility_m = 20e3;
    scene.sun.enabled = false;
    add_view(scene, symmetric_frustum(10.0, kWidth, kHeight), view_from_enu(100.0, 0.0, 0.0));
    gl::Texture colour{gl::TexelFormat::kRgba32F, kWidth, kHeight};
    gl::Texture depth{gl::TexelFormat::kR32F, kWidth, kHeight};
    colour.update(std::vector<float>(std::size_t{kWidth} * kHeight * 4, 0.0F));
    Renderer renderer({{"only", kWidth, kHeight}}, undithered());
    int last = 256;
    for (const double distance_m : {1e3, 5e3, 10e3, 20e3, 40e3, 80e3}) {
        std::vector<float> z(std::size_t{kWidth} * kHeight, 1.0F);
        std::fill_n(z.begin(), z.size() / 2 + 2 * kWidth, static_cast<float>(distance_m / kFar_m));
        depth.update(z);
        const Picture picture = draw_over(renderer, scene, {colour.name(), depth.name(), kFar_m});
        const int step =
            difference(picture.at(kWidth / 2, kHeight / 2 - 4), picture.at(kWidth / 2, kHeight / 2 + 1));
        std::printf("%5.0f km: %d codes from the sky above it\n", distance_m * 1e-3, step);
        EXPECT_LE(step, last);
        last = step;
    }
    EXPECT_LE(last, 2);
}

// A wall of one light across the view, among clouds of one height.
class AmongClouds : public Deferred {
  protected:
    static constexpr double kWall_cd_m2 = 900.0;

    Picture wall_at(Renderer& renderer, const Scene& scene, double distance_m) {
        const ChannelView& view = scene.views[0];
        gl::Texture colour{gl::TexelFormat::kRgba32F, kWidth, kHeight};
        gl::Texture depth{gl::TexelFormat::kR32F, kWidth, kHeight};
        colour.update(std::vector<float>(std::size_t{kWidth} * kHeight * 4, static_cast<float>(kWall_cd_m2)));
        std::vector<float> z;
        for (int y = kHeight - 1; y >= 0; --y) {
            for (int x = 0; x < kWidth; ++x) {
                const double along = -(view.view_from_enu * direction_at(view, x, y)).z;
                z.push_back(static_cast<float>(distance_m * along / kFar_m));
            }
        }
        depth.update(z);
        return draw_over(renderer, scene, {colour.name(), depth.name(), kFar_m});
    }
    /// Largest and mean distance from what the frame's own formulas say, display codes.
    static std::pair<double, double> off(const Renderer& renderer, const Scene& scene, const Picture& picture,
                                         double distance_m) {
        double largest = 0.0, sum = 0.0;
        int count = 0;
        for (int y = 0; y < kHeight; y += 10) {
            for (int x = 0; x < kWidth; x += 10) {
                const glm::dvec3 direction = direction_at(scene.views[0], x, y);
                const double codes =
                    off_by(picture.at(x, y),
                           renderer.reference_colour(direction, distance_m, glm::dvec3{kWall_cd_m2}));
                largest = std::max(largest, codes);
                sum += codes;
                ++count;
            }
        }
        return {largest, sum / count};
    }
};

TEST_F(AmongClouds, ThingsStandBeforeInsideAndBehindThem) {
    const FakeSheet sheet{
        .height_m = 2500.0, .wavelength_m = 0.0, .least_transmittance = 0.1, .most_transmittance = 0.1};
    Scene scene = make_scene(48.0, 185.0, -10.0, 40.0, 500.0);
    scene.sun.enabled = false;
    // Straight up: clouds are 2000 m away all over the picture, but for some per cent.
    add_view(scene, symmetric_frustum(8.0, kWidth, kHeight), view_from_enu(150.0, 85.0, 3.0));
    Quality quality;
    quality.cloud_map_size = 512;
    DisplaySettings display = undithered();
    display.fixed_adaptation_cd_m2 = 2000.0;
    Renderer without({{"only", kWidth, kHeight}}, display);
    Scene clouded = scene;
    add_layer(clouded, sheet);
    Renderer renderer({{"only", kWidth, kHeight}}, display, quality);
    renderer.draw_clouds(fake_clouds(sheet));
    double last = -1.0;
    for (const double distance_m : {300.0, 1500.0, 2005.0, 2600.0}) {
        const Picture clear = wall_at(without, scene, distance_m);
        const Picture picture = wall_at(renderer, clouded, distance_m);
        const auto [largest, mean] = off(renderer, clouded, picture, distance_m);
        const double changed =
            difference(clear.at(kWidth / 2, kHeight / 2), picture.at(kWidth / 2, kHeight / 2));
        std::printf(
            "wall at %5.0f m: %.0f codes from without clouds; from the formulas %.2f at most, %.2f in the "
            "mean\n",
            distance_m, changed, largest, mean);
        EXPECT_LE(largest, 1.6) << distance_m;
        // Air under clouds is less bright.
        EXPECT_LE(changed, distance_m < 1600.0 ? 3.0 : 255.0) << distance_m;
        EXPECT_GE(changed, last - 2.0) << "what is farther is hidden more";
        last = changed;
    }
    // The cloud's light and a tenth of the wall's.
    EXPECT_GT(last, 40.0);
}

TEST_F(Deferred, LandLiesInTheShadowsOfSingleClouds) {
    Scene scene = make_scene(48.0, 185.0, -40.0, 0.0, 600.0);
    scene.sun.enabled = false;
    add_view(scene, symmetric_frustum(25.0, kWidth, kHeight), view_from_enu(30.0, -12.0, 0.0));
    CloudLayer& layer = scene.weather.clouds[scene.weather.cloud_count++];
    layer.base_m = 1500.0;
    layer.coverage = 0.5;
    layer.seed = 4;
    const Ground ground = draw_ground(scene, 20e3);
    Renderer renderer({{"only", kWidth, kHeight}}, undithered());
    renderer.draw_clouds({std::make_unique<cloud::field::FieldMaker>(), nullptr});
    const Picture picture = draw_over(renderer, scene, ground.input());
    DeferredInput own = ground.input();
    own.shadows = false;
    const Picture even = draw_over(renderer, scene, own);
    double largest = 0.0;
    int darker = 0, brighter = 0;
    for (int y = 0; y < kHeight; y += 4) {
        for (int x = 0; x < kWidth; x += 4) {
            const Thing& thing = ground.at(x, y);
            if (!(thing.distance_m < 15e3)) continue;
            const glm::dvec3 direction = direction_at(scene.views[0], x, y);
            largest = std::max(
                largest, off_by(picture.at(x, y),
                                renderer.reference_colour(direction, thing.distance_m, thing.rgb_cd_m2)));
            const int step = picture.at(x, y).g - even.at(x, y).g;
            darker = std::max(darker, -step);
            brighter = std::max(brighter, step);
        }
    }
    std::printf("shadows %d codes darker, gaps %d brighter; from the formulas %.2f codes\n", darker, brighter,
                largest);
    EXPECT_GT(darker, 20);
    EXPECT_GT(brighter, 10);
    EXPECT_LE(largest, 2.0);
}

TEST_F(AmongClouds, InFogOfCloudsThingsFadeWithTheirDistance) {
    const FakeSheet fog{.light_cd_m2 = glm::vec3{4000.0F}, .fog_per_m = 0.01};
    Scene scene = make_scene(48.0, 185.0, -10.0, 40.0, 500.0);
    scene.sun.enabled = false;
    add_view(scene, symmetric_frustum(8.0, kWidth, kHeight), view_from_enu(150.0, 20.0, 3.0));
    add_layer(scene, fog);
    Renderer renderer({{"only", kWidth, kHeight}}, undithered());
    renderer.draw_clouds(fake_clouds(fog));
    for (const double distance_m : {20.0, 100.0, 250.0}) {
        const Picture picture = wall_at(renderer, scene, distance_m);
        const double passed = std::exp(-0.01 * distance_m);
        const glm::dvec3 exact = renderer.reference_colour(
            {0.0, 0.0, 1.0}, 0.0, glm::dvec3{passed * kWall_cd_m2 + (1.0 - passed) * 4000.0});
        const double codes = off_by(picture.at(kWidth / 2, kHeight / 2), exact);
        std::printf("%.0f m into it: %.1f codes from Koschmieder\n", distance_m, codes);
        EXPECT_LE(codes, 3.0) << distance_m;
    }
}

TEST_F(Deferred, ALightThatComesOrGoesMovesNoPictureBySteps) {
    SkyFrame frame({}, {});
    DeferredAir air;
    const glm::dvec3 direction = at(1.0, 200.0);
    for (const auto& [name, sun_deg, moon_deg, sun_step_deg, moon_step_deg] :
         {std::tuple{"the Moon comes", -25.0, -11.2, 0.0, 0.01},
          std::tuple{"the Sun goes", -21.6, 30.0, -0.01, 0.0}}) {
        double largest = 0.0;
        double most_lights = 0.0;
        double fewest_lights = 9.0;
        glm::dvec3 last{0.0};
        for (int i = 0; i < 100; ++i) {
            Scene scene =
                make_scene(sun_deg + sun_step_deg * i, 120.0, moon_deg + moon_step_deg * i, 250.0, 500.0);
            scene.time_s = i / 30.0;
            frame.prepare(scene, 8e-4);
            air.update(scene, frame.plan(), frame.tables(), frame.light());
            const glm::dvec3 shown =
                255.0 * shaders64::shown(air.under_air(glm::dvec3{1e-4}, direction, 30e3), frame.tone());
            const glm::dvec3 step = glm::abs(shown - last);
            if (i > 0) largest = std::max({largest, step.x, step.y, step.z});
            last = shown;
            most_lights = std::max(most_lights, static_cast<double>(air.source_count()));
            fewest_lights = std::min(fewest_lights, static_cast<double>(air.source_count()));
        }
        std::printf("%s: largest step %.3f codes\n", name, largest);
        EXPECT_LT(largest, 0.5) << name;
        EXPECT_GT(most_lights, fewest_lights) << name;
    }
}

}  // namespace
}  // namespace skyig::render
