// Drops on a windscreen as they are drawn: where they stand, and that they turn over what is behind them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "render/precipitation/windscreen.h"
#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;
using precipitation::Windscreen;

constexpr int kWidth = 640;
constexpr int kHeight = 512;

class WindscreenPicture : public GlTest {
  protected:
    // Bright sky over dark ground.
    static Scene rainy() {
        Scene scene = make_scene(40.0, 180.0, -30.0, 0.0, 300.0);
        scene.weather.precipitations[0] = {Precipitation::Kind::kRain, 30.0, 3000.0};
        scene.weather.precipitation_count = 1;
        add_view(scene, symmetric_frustum(20.0, kWidth, kHeight), view_from_enu(0.0, 0.0, 0.0));
        return scene;
    }
    static std::size_t place(int x, int y) {
        return static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
    }
    static int brightness(const Rgb& rgb) { return rgb.r + rgb.g + rgb.b; }
};

TEST_F(WindscreenPicture, DropsTurnOverWhatIsBehindThemAndLeaveTheRestAlone) {
    Renderer with({{"only", kWidth, kHeight}}, without_glare());
    Renderer without({{"only", kWidth, kHeight}}, without_glare());
    Scene bare = rainy();
    Scene scene = bare;
    scene.views[0].windscreen_m = 0.8F;
    Windscreen drops;
    with.prepare(scene);
    drops.advance(scene, scene.views[0]);
    EXPECT_EQ(draw(with, scene)[0].rgba, draw(without, bare)[0].rgba) << "dry at first";
    for (int i = 0; i < 200; ++i) {
        bare.time_s = scene.time_s += 1.0 / 30.0;
        with.prepare(scene);
        without.prepare(bare);
        drops.advance(scene, scene.views[0]);
    }
    const Picture wet = draw(with, scene)[0];
    const Picture clear = draw(without, bare)[0];
    EXPECT_EQ(draw(with, scene)[0].rgba, wet.rgba) << "time stands";
    const double focal_px = kHeight / 2.0 / std::tan(scene.views[0].frustum.top_rad);
    std::vector<bool> in_drop(std::size_t{kWidth} * kHeight);
    int large = 0, turned = 0;
    for (const Windscreen::Drop& drop : drops.drops()) {
        if (!(drop.there > 0.0)) continue;
        const double x = kWidth / 2.0 + drop.at_m.x / 0.8 * focal_px;
        const double y = kHeight / 2.0 - drop.at_m.y / 0.8 * focal_px;
        const double radius_px = drop.radius_m / 0.8 * focal_px;
        const int reach = static_cast<int>(radius_px + 2.0);
        for (int dy = -reach; dy <= reach; ++dy) {
            for (int dx = -reach; dx <= reach; ++dx) {
                const int px = static_cast<int>(x) + dx, py = static_cast<int>(y) + dy;
                if (px < 0 || py < 0 || px >= kWidth || py >= kHeight) continue;
                if (std::hypot(px + 0.5 - x, py + 0.5 - y) < radius_px + 1.0) in_drop[place(px, py)] = true;
            }
        }
        const bool near_horizon = std::abs(y - kHeight / 2.0) < 0.06 * focal_px;
        const bool inside = x > 20 && x < kWidth - 20;
        if (!near_horizon || !inside || drop.there < 1.0 || radius_px < 3.5) continue;
        const int above = static_cast<int>(y - 0.7 * radius_px);
        const int below = static_cast<int>(y + 0.7 * radius_px);
        ++large;
        turned +=
            brightness(wet.at(static_cast<int>(x), below)) > brightness(wet.at(static_cast<int>(x), above));
    }
    int strayed = 0, changed = 0, most = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const int off = difference(wet.at(x, y), clear.at(x, y));
            most = std::max(most, off);
            changed += off > 1;
            strayed += off > 1 && !in_drop[place(x, y)];
        }
    }
    std::printf(
        "%d pixels changed, by %d codes at most, %d of them in no drop; %d of %d drops on the horizon show "
        "the sky below the ground\n",
        changed, most, strayed, turned, large);
    EXPECT_GT(changed, 500);
    EXPECT_EQ(strayed, 0);
    EXPECT_GE(large, 4);
    EXPECT_EQ(turned, large);
}

}  // namespace
}  // namespace skyig::render
