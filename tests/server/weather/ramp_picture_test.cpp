// Weather that a host changes over a minute, as it is drawn: no frame may differ from the one before by more
// than two codes.
#include <array>
#include <cstdio>

#include "tests/render/gl_fixture.h"
#include "tests/server/weather/weather_bench.h"

namespace skyig::server::weather {
namespace {

using cigi::CloudType;
using cigi::WeatherControl;

constexpr int kWidth = 320, kHeight = 256;
constexpr double kFrame_s = 1.0 / 60.0;

class RampPicture : public render::tests::GlTest {
  protected:
    static config::Config looking(double pitch_deg) {
        config::Config config = config::default_config();
        config.start.utc = config::UtcDateTime{2026, 6, 21, 11, 0, 0.0};
        config.start.height_m = 100.0;
        config.start.yaw_deg = 150.0;
        config.start.pitch_deg = pitch_deg;
        config.channels[0].width_px = kWidth;
        config.channels[0].height_px = kHeight;
        config.weather.transition_s = 60.0;
        config.air.visibility_m = 50e3;
        return config;
    }

    /// The largest step of any pixel over a second from `from_s` of the way on.
    int largest_step(WeatherBench& bench, double& now_s, double from_s) {
        while (now_s < from_s) {
            bench.frame(kFrame_s);
            now_s += kFrame_s;
        }
        render::Renderer renderer({{"only", kWidth, kHeight}}, undithered());
        renderer.draw_clouds(render::scene_clouds());
        std::vector<std::byte> last, picture(std::size_t{kWidth} * kHeight * 4);
        int largest = 0;
        // The first snapshots of the map are made meanwhile.
        constexpr int kWarm = 125, kFrames = 45;
        for (int frame = 0; frame < kWarm + kFrames; ++frame, now_s += kFrame_s) {
            render::Scene scene = bench.frame(kFrame_s);
            // Clouds change by themselves too.
            for (std::size_t i = 0; i < scene.weather.cloud_count; ++i)
                scene.weather.clouds[i].age_s = 0.0;
            renderer.prepare(scene);
            renderer.draw(0);
            renderer.read_back(0, picture);
            for (std::size_t i = 0; frame >= kWarm && i < picture.size(); ++i)
                largest = std::max(
                    largest, std::abs(std::to_integer<int>(picture[i]) - std::to_integer<int>(last[i])));
            last = picture;
        }
        return largest;
    }
};

TEST_F(RampPicture, CloudsCloseOverAMinuteWithoutPops) {
    for (const CloudType type : {CloudType::kCumulus, CloudType::kStratocumulus}) {
        WeatherBench bench(looking(25.0));
        bench.frame(kFrame_s);
        WeatherControl layer = cloud(1, type, 1200.0F, 100.0F);
        layer.thickness = 900.0F;
        bench.send(layer);
        double now_s = 0.0;
        for (const double from_s : {2.0, 28.0, 53.0}) {
            const int step = largest_step(bench, now_s, from_s);
            std::printf("type %d, from %.0f s: coverage %.3f, steps of %d codes\n", static_cast<int>(type),
                        from_s, bench.weather().clouds[0].coverage, step);
            EXPECT_LE(step, 2);
        }
    }
}

TEST_F(RampPicture, FogComesOverAMinuteWithoutPops) {
    WeatherBench bench(looking(0.0));
    bench.frame(kFrame_s);
    WeatherControl fog = cloud(0, CloudType::kNone, -1000.0F, 100.0F);
    fog.thickness = 1200.0F;
    fog.visibility = 300.0F;
    bench.send(fog);
    double now_s = 0.0;
    for (const double from_s : {0.0, 4.0}) {
        const int step = largest_step(bench, now_s, from_s);
        std::printf("fog, from %.0f s: steps of %d codes\n", from_s, step);
        EXPECT_LE(step, 2);
    }
}

}  // namespace
}  // namespace skyig::server::weather
