// Waves that pixels resolve: drawn against the same shading in double, and against the sea without them.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/sky/sea_waves.h"
#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kWidth = 320;
constexpr int kHeight = 256;

class Waves : public GlTest {
  protected:
    static Scene looking_down(Scene scene, double yaw_deg, double pitch_deg) {
        scene.stars.enabled = scene.sun.enabled = scene.moon.enabled = false;
        add_view(scene, symmetric_frustum(25.0, kWidth, kHeight), view_from_enu(yaw_deg, pitch_deg, 5.0));
        return scene;
    }
    const std::vector<Channel> channels_{{"only", kWidth, kHeight}};
};

struct NamedView {
    const char* name;
    Scene scene;
};

TEST_F(Waves, DrawnPixelsAreTheShadingOfTheirDirectionInDouble) {
    std::vector<NamedView> views{
        {"noon", looking_down(make_scene(50.0, 185.0, -30.0, 40.0, 30.0), 175.0, -15.0)},
        {"low sun", looking_down(make_scene(6.0, 180.0, -30.0, 40.0, 100.0), 178.0, -12.0)},
        {"moon", looking_down(make_scene(-40.0, 10.0, 25.0, 180.0, 30.0), 178.0, -12.0)},
        {"1 km", looking_down(make_scene(35.0, 180.0, -30.0, 40.0, 1e3), 175.0, -25.0)}};
    for (auto& [name, scene] : views) {
        add_waves(scene);
        scene.time_s = 7.7;
        Renderer renderer(channels_, undithered());
        const auto pictures = draw(renderer, scene);
        const ChannelView& view = scene.views[0];
        const double horizon = refraction_of(scene).horizon_elevation_rad();
        std::vector<double> errors;
        for (int y = 0; y < kHeight; y += 3) {
            for (int x = y % 2; x < kWidth; x += 2) {
                const glm::dvec3 direction =
                    glm::transpose(view.view_from_enu) *
                    view_direction(channels_[0], view.frustum, x + 0.5, kHeight - y - 0.5);
                if (std::asin(direction.z) > horizon - 0.01) continue;
                const Rgb drawn = pictures[0].at(x, y);
                const glm::dvec3 off = glm::abs(glm::dvec3{drawn.r, drawn.g, drawn.b} -
                                                renderer.reference_colour(direction) * 255.0);
                errors.push_back(std::max({off.x, off.y, off.z}));
            }
        }
        ASSERT_GT(errors.size(), 1000U) << name;
        std::sort(errors.begin(), errors.end());
        const double p99 = errors[errors.size() * 99 / 100];
        std::printf("waves, %-8s codes: median %.2f, p99 %.2f, largest %.2f\n", name,
                    errors[errors.size() / 2], p99, errors.back());
        EXPECT_LE(p99, 1.5) << name;
        EXPECT_LE(errors.back(), 2.5) << name;
    }
}

TEST_F(Waves, RunWithTheSceneTimeAndStandWithIt) {
    Scene scene = looking_down(make_scene(50.0, 185.0, -30.0, 40.0, 30.0), 175.0, -15.0);
    add_waves(scene);
    Renderer renderer(channels_, undithered());
    draw(renderer, scene);
    const Picture first = draw(renderer, scene)[0];
    EXPECT_EQ(first.rgba, draw(renderer, scene)[0].rgba);
    scene.time_s += 0.5;
    const Picture later = draw(renderer, scene)[0];
    int moved = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x)
            moved += difference(first.at(x, y), later.at(x, y)) > 4 ? 1 : 0;
    }
    std::printf("half a second: %.0f %% of the pixels have changed\n", 100.0 * moved / (kWidth * kHeight));
    EXPECT_GT(moved, kWidth * kHeight / 5);
}

TEST_F(Waves, FadeIntoTheDomeWithoutAnEdge) {
    // From high up the rows that end the pass stand far from the horizon.
    Scene scene = looking_down(make_scene(35.0, 180.0, -30.0, 40.0, 2e3), 0.0, -14.0);
    add_waves(scene);
    Renderer renderer(channels_, undithered());
    const Picture picture = draw(renderer, scene)[0];
    ASSERT_TRUE(renderer.prepare(scene).plan.needs(Pass::kWaves));
    const Renderer& told = renderer;
    const ChannelView& view = scene.views[0];
    double worst = 0.0;
    int compared = 0;
    for (int y = 0; y < kHeight; y += 2) {
        for (int x = 0; x < kWidth; x += 2) {
            const glm::dvec3 direction =
                glm::transpose(view.view_from_enu) *
                view_direction(channels_[0], view.frustum, x + 0.5, kHeight - y - 0.5);
            const double sine = -direction.z;
            const double ends = sky::least_depression_sine(
                2e3, 2.0 * std::numbers::pi / 110.0, finest_pixel_rad(channels_, scene.channel_views()));
            if (sine < 0.85 * ends || sine > 1.1 * ends) continue;
            const Rgb drawn = picture.at(x, y);
            const glm::dvec3 off =
                glm::abs(glm::dvec3{drawn.r, drawn.g, drawn.b} - told.reference_colour(direction) * 255.0);
            worst = std::max({worst, off.x, off.y, off.z});
            ++compared;
        }
    }
    std::printf("where waves end: %.2f codes at most over %d pixels\n", worst, compared);
    EXPECT_GT(compared, 500);
    EXPECT_LE(worst, 1.0);
}

TEST_F(Waves, SteepOnesInACalmAreNoHolesInTheSea) {
    Scene scene = looking_down(make_scene(40.0, 90.0, -30.0, 40.0, 20.0), 90.0, -15.0);
    scene.eye.latitude_deg = 60.0;
    scene.eye.longitude_deg = 2.4;
    scene.ground.kind = Ground::Kind::kSea;
    scene.sea.wave_count = 1;
    scene.sea.waves[0] = {
        .height_m = 2.8, .length_m = 20.0, .period_s = 3.6, .direction_rad = 90.0 * kDegree};
    const Picture picture = draw(channels_, scene, undithered())[0];
    int black = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x)
            black += difference(picture.at(x, y), {}) == 0 ? 1 : 0;
    }
    std::printf("%d black pixels\n", black);
    EXPECT_EQ(black, 0);
}

}  // namespace
}  // namespace skyig::render
