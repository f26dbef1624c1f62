// What a channel costs, as a multiple of "a write": a full-screen triangle with a literal colour into RGBA8
// of the same size, drawn in turn with it in the same run. Medians of wall time, and of the processor time of
// all threads, which other work on the machine touches less.
//   frame_bench [ROUNDS [clouds | ground | patterns]]     default 60; with a word: those alone
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "render/cloud/field/field_maker.h"
#include "render/geometry.h"
#include "render/gl/headless_context.h"
#include "render/gl/texture.h"
#include "render/night/starlight.h"
#include "render/renderer.h"
#include "tests/bench/spent.h"
#include "tests/render/scenes.h"

namespace {

using namespace skyig::render;
using namespace skyig::render::bench;

constexpr int kWidth = 1280;
constexpr int kHeight = 1024;

struct Costs {
    std::vector<double> write, draw, ratio, processor_ratio, prepare, read_back;
};

Costs measure(Renderer& renderer, Scene scene, int rounds) {
    Write write_once(kWidth, kHeight);
    std::vector<std::byte> pixels(static_cast<std::size_t>(kWidth) * kHeight * 4);
    Costs costs;
    for (int i = -5; i < rounds; ++i) {
        scene.time_s += 1.0 / 30.0;
        const Spent write = spent(write_once);
        const Spent prepare = spent([&] { renderer.prepare(scene); });
        const Spent draw = spent([&] { renderer.draw(0); });
        const Spent read_back = spent([&] { renderer.read_back(0, pixels); });
        if (i < 0) continue;  // shaders are compiled late
        costs.write.push_back(write.wall_ms);
        costs.draw.push_back(draw.wall_ms);
        costs.ratio.push_back(draw.wall_ms / write.wall_ms);
        costs.processor_ratio.push_back(draw.processor_ms / write.processor_ms);
        costs.prepare.push_back(prepare.wall_ms);
        costs.read_back.push_back(read_back.wall_ms);
    }
    return costs;
}

using NamedView = tests::NamedScene;  // with its one view

void look_at(Scene& scene, double azimuth_deg, double elevation_deg, double width_deg) {
    tests::add_view(scene, tests::symmetric_frustum(0.5 * width_deg, kWidth, kHeight),
                    tests::view_from_enu(azimuth_deg, elevation_deg, 0.0));
}

// Midnight of a June night at 40 deg south: the Milky Way's centre stands near the zenith.
Scene june_night(double moon_elevation_deg) {
    Scene scene = tests::make_scene(-60.0, 180.0, moon_elevation_deg, 0.0, 600.0);
    scene.stars.enu_from_gcrs = enu_from_equatorial(-40.0 * tests::kDegree, 270.0 * tests::kDegree);
    return scene;
}

void add_nights(std::vector<NamedView>& views) {
    const Scene moonless = june_night(-40.0);
    const glm::dmat3 enu_from_galactic =
        moonless.stars.enu_from_gcrs * glm::transpose(night::galactic_from_gcrs());
    const Horizontal centre = horizontal_of(enu_from_galactic * glm::dvec3{1.0, 0.0, 0.0});
    views.push_back({"milky way", moonless});
    look_at(views.back().scene, centre.azimuth_rad / tests::kDegree, centre.elevation_rad / tests::kDegree,
            60.0);
    const Horizontal pole = horizontal_of(enu_from_galactic * glm::dvec3{0.0, 0.0, 1.0});
    views.push_back({"moonless away", moonless});
    look_at(views.back().scene, pole.azimuth_rad / tests::kDegree, 15.0, 60.0);
    views.push_back({"dusk -6", tests::make_scene(-6.0, 235.0, -40.0, 100.0, 300.0)});
    look_at(views.back().scene, 235.0, 8.0, 60.0);
    views.push_back({"full moon 10", june_night(60.0)});
    look_at(views.back().scene, 0.0, 60.0, 10.0);
}

std::vector<NamedView> all_views() {
    auto views = tests::four_times();
    views.push_back({"sea", tests::make_scene(48.0, 185.0, -10.0, 40.0, 30.0)});
    views[4].scene.ground.kind = Ground::Kind::kSea;
    views.push_back({"waves", views[4].scene});
    tests::add_waves(views[5].scene);
    for (auto& [name, scene] : views) {
        const double yaw_deg = name == "dawn" ? 120.0 : name == "dusk" ? 235.0 : 175.0;
        const double pitch_deg = scene.ground.kind == Ground::Kind::kSea ? -20.0 : 8.0;  // nine tenths sea
        look_at(scene, yaw_deg, pitch_deg, 60.0);
    }
    add_nights(views);
    return views;
}

// Another renderer's picture over the whole channel, all of it at 20 km.
void print_deferred(Scene scene, int rounds) {
    constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;
    const gl::Texture colour(gl::TexelFormat::kRgba32F, kWidth, kHeight);
    const gl::Texture depth(gl::TexelFormat::kR32F, kWidth, kHeight);
    colour.update(std::vector<float>(kPixels * 4, 2000.0F));
    depth.update(std::vector<float>(kPixels, 0.2F));
    look_at(scene, 175.0, 8.0, 60.0);
    Renderer renderer({{"only", kWidth, kHeight}}, {});
    Write write_once(kWidth, kHeight);
    std::vector<double> writes, draws, shared;
    for (int i = -5; i < rounds; ++i) {
        scene.time_s += 1.0 / 30.0;
        const Spent write = spent(write_once);
        shared.push_back(spent([&] { renderer.prepare(scene); }).wall_ms);
        const Spent sky = spent([&] { renderer.draw(0); });
        const Spent both = spent([&] { renderer.draw_scene(0, {colour.name(), depth.name(), 100e3}); });
        if (i < 0) continue;
        writes.push_back((both.wall_ms - sky.wall_ms) / write.wall_ms);
        draws.push_back((both.processor_ms - sky.processor_ms) / write.processor_ms);
    }
    std::printf("deferred picture over every pixel: %.2f writes, of cpu %.2f; shared %.3f ms\n",
                median(writes), median(draws), median(shared));
}

// What all stars of a moonless night cost: channels drawn with and without them in turn.
void print_stars(double width_deg, int rounds) {
    Scene scene = tests::make_scene(-40.0, 0.0, -40.0, 90.0, 600.0);
    scene.sky.star_scintillation = true;
    look_at(scene, 175.0, 40.0, width_deg);
    Scene starless = scene;
    starless.stars.enabled = false;
    Renderer renderer({{"only", kWidth, kHeight}}, {});
    Write write_once(kWidth, kHeight);
    std::vector<double> walls, processors, shared;
    std::size_t stars = 0;
    for (int i = -5; i < rounds; ++i) {
        starless.time_s = scene.time_s += 1.0 / 30.0;
        const Spent write = spent(write_once);
        const double without_ms = spent([&] { renderer.prepare(starless); }).wall_ms;
        const Spent sky = spent([&] { renderer.draw(0); });
        const double with_ms = spent([&] { stars = renderer.prepare(scene).stars_drawn; }).wall_ms;
        const Spent both = spent([&] { renderer.draw(0); });
        if (i < 0) continue;
        walls.push_back((both.wall_ms - sky.wall_ms) / write.wall_ms);
        processors.push_back((both.processor_ms - sky.processor_ms) / write.processor_ms);
        shared.push_back(with_ms - without_ms);
    }
    // A sky that has turned by more than its stars may lag.
    const glm::dmat3 turn =
        tests::view_from_enu(0.01, 0.0, 0.0) * glm::transpose(tests::view_from_enu(0.0, 0.0, 0.0));
    std::vector<double> anew;
    for (int i = 0; i < rounds; ++i) {
        scene.stars.enu_from_gcrs = turn * scene.stars.enu_from_gcrs;
        anew.push_back(spent([&] { renderer.prepare(scene); }).processor_ms);
    }
    std::printf(
        "%zu stars of a moonless night at %.0f deg: %.2f writes, of cpu %.2f; shared %.3f ms, %.3f ms of cpu "
        "when worked out anew\n",
        stars, width_deg, median(walls), median(processors), median(shared), median(anew));
}

// Sunlight of a clear noon on clouds of every height.
void noon_light(const Scene& scene, const Plan& /*plan*/, const LightTables& /*tables*/,
                const SkyLight& /*sky*/, cloud::CloudLight& light) {
    light.beams[cloud::CloudLight::kSun] = {true, glm::vec3{scene.sun.direction_enu}};
    light.beam_lx[cloud::CloudLight::kSun].fill(glm::vec3{1.1e5F});
    light.above_cd_m2.fill(glm::vec3{3000.0F, 3600.0F, 5000.0F});
    light.below_cd_m2.fill(glm::vec3{4500.0F});
}

Scene clouded(double eye_m, CloudGenus genus, CloudModel model, double coverage) {
    Scene scene = tests::make_scene(48.0, 185.0, -10.0, 40.0, eye_m);
    CloudLayer& layer = scene.weather.clouds[scene.weather.cloud_count++];
    layer.genus = genus;
    layer.model = model;
    layer.base_m = 1500.0;
    layer.thickness_m = genus == CloudGenus::kCumulus ? 1200.0 : 500.0;
    layer.coverage = coverage;
    return scene;
}

// What the channels of a rig cost in clouds. Drawing is timed with an eye that stands still, for which
// nothing is kept up; upkeep is all else that one at 200 m/s costs on all threads, beyond a clear sky.
void print_clouds(const std::string& name, Scene scene, double pitch_deg, std::size_t channels, int rounds) {
    std::vector<Channel> list;
    for (std::size_t i = 0; i < channels; ++i) {
        list.push_back({"channel", kWidth, kHeight});
        look_at(scene, 175.0 + 60.0 * (static_cast<double>(i) - 0.5 * static_cast<double>(channels - 1)),
                pitch_deg, 60.0);
    }
    Scene clear = scene;
    clear.weather.cloud_count = 0;
    Scene still_scene = scene;
    Renderer moving(list, {}), still(list, {}), without(list, {});
    const auto draw_all = [&](Renderer& renderer) {
        for (std::size_t c = 0; c < channels; ++c)
            renderer.draw(c);
    };
    for (Renderer* renderer : {&moving, &still})
        renderer->draw_clouds({std::make_unique<cloud::field::FieldMaker>(), noon_light});
    Write write_once(kWidth, kHeight);
    std::vector<double> draws, draws_of_cpu, clear_draws, upkeep, rays, tiles;
    for (int i = -50; i < rounds; ++i) {
        clear.time_s = still_scene.time_s = scene.time_s += 1.0 / 30.0;
        scene.eye.latitude_deg += 6e-5;
        clear.eye = scene.eye;
        const Spent write = spent(write_once);
        const Spent plain = spent([&] { without.prepare(clear); });
        const Spent plain_draw = spent([&] { draw_all(without); });
        still.prepare(still_scene);
        const Spent draw = spent([&] { draw_all(still); });
        const FrameReport* report = nullptr;
        const Spent all = spent([&] {
            report = &moving.prepare(scene);
            draw_all(moving);
        });
        if (i < 0) continue;
        draws.push_back(draw.wall_ms / write.wall_ms);
        draws_of_cpu.push_back(draw.processor_ms / write.processor_ms);
        clear_draws.push_back(plain_draw.processor_ms / write.processor_ms);
        upkeep.push_back((all.processor_ms - draw.processor_ms - plain.processor_ms) / write.processor_ms);
        rays.push_back(report->cloud_rays);
        tiles.push_back(static_cast<double>(report->cloud_tiles));
    }
    std::printf(
        "%-15s %zu ch: draw %.2f writes, of cpu %.2f (clear sky %.2f); upkeep of cpu %.2f: %.0f rays, %.0f "
        "tiles toned\n",
        name.c_str(), channels, median(draws), median(draws_of_cpu), median(clear_draws), median(upkeep),
        median(rays), median(tiles));
}

void print_all_clouds(int rounds) {
    const Scene overcast = clouded(500.0, CloudGenus::kStratus, CloudModel::kLayer, 1.0);
    const Scene broken = clouded(500.0, CloudGenus::kCumulus, CloudModel::kVolume, 0.5);
    const Scene above = clouded(4000.0, CloudGenus::kCumulus, CloudModel::kVolume, 0.4);
    const Scene inside = clouded(1700.0, CloudGenus::kStratus, CloudModel::kVolume, 1.0);
    Scene patches = clouded(3.0, CloudGenus::kFogPatches, CloudModel::kAuto, 0.5);
    CloudLayer& fog = patches.weather.clouds[0];
    fog.base_m = 0.0;
    fog.thickness_m = 40.0;
    fog.top_band_m = 10.0;
    fog.extinction_per_m = 0.028;
    Scene over_patches = patches;
    over_patches.eye.height_m = 300.0;
    for (const std::size_t channels : {std::size_t{1}, std::size_t{3}}) {
        print_clouds("overcast layer", overcast, 20.0, channels, rounds);
        print_clouds("broken volume", broken, 20.0, channels, rounds);
        print_clouds("in cloud", inside, 5.0, channels, rounds);
        print_clouds("broken, above", above, -20.0, channels, rounds);
        print_clouds("broken, below", broken, -10.0, channels, rounds);
        print_clouds("fog patches", patches, 0.0, channels, rounds);
        print_clouds("over patches", over_patches, -8.0, channels, rounds);
    }
}

// What falls: channels drawn with and without it in turn.
void print_falling(const char* name, const Precipitation& falling, double speed_m_s, double azimuth_deg,
                   int rounds) {
    Scene scene = tests::make_scene(30.0, 120.0, -30.0, 200.0, 300.0);
    look_at(scene, azimuth_deg, 3.0, 60.0);
    scene.air.visibility_m = 6000.0;
    scene.weather.wind_m_s = {2.0, 1.0, 0.0};
    scene.weather.eye_velocity_m_s = {0.0, speed_m_s, 0.0};
    Scene dry = scene;
    scene.weather.precipitations[0] = falling;
    scene.weather.precipitation_count = 1;
    Renderer renderer({{"only", kWidth, kHeight}}, {});
    Write write_once(kWidth, kHeight);
    std::vector<double> walls, processors, shared;
    for (int i = -5; i < rounds; ++i) {
        dry.time_s = scene.time_s += 1.0 / 30.0;
        const Spent write = spent(write_once);
        const double without_ms = spent([&] { renderer.prepare(dry); }).wall_ms;
        const Spent sky = spent([&] { renderer.draw(0); });
        const double with_ms = spent([&] { renderer.prepare(scene); }).wall_ms;
        const Spent both = spent([&] { renderer.draw(0); });
        if (i < 0) continue;
        walls.push_back((both.wall_ms - sky.wall_ms) / write.wall_ms);
        processors.push_back((both.processor_ms - sky.processor_ms) / write.processor_ms);
        shared.push_back(with_ms - without_ms);
    }
    std::printf("%-10s at %3.0f m/s, looking %2.0f deg off: %.2f writes, of cpu %.2f; shared %.3f ms\n", name,
                speed_m_s, azimuth_deg, median(walls), median(processors), median(shared));
}

void print_all_that_falls(int rounds) {
    const Precipitation rain{Precipitation::Kind::kRain, 10.0, 1500.0};
    const Precipitation snow{Precipitation::Kind::kSnow, 2.0, 1500.0};
    for (const double speed_m_s : {0.0, 70.0, 130.0}) {
        print_falling("rain", rain, speed_m_s, 0.0, rounds);
        print_falling("rain", rain, speed_m_s, 90.0, rounds);
    }
    for (const double speed_m_s : {0.0, 70.0})
        print_falling("snow", snow, speed_m_s, 90.0, rounds);
}

// Test patterns in place of a clear day's sky; and what texts, a mirror and pixels that repeat add to it.
void print_over_pictures(int rounds) {
    Scene plain = tests::make_scene(30.0, 120.0, -30.0, 200.0, 300.0);
    look_at(plain, 175.0, 8.0, 60.0);
    std::vector<NamedView> cases;
    for (std::size_t i = 0; i < kPatternCount; ++i) {
        cases.push_back({std::string(kPatternNames[i]), plain});
        cases.back().scene.views[0].pattern = static_cast<Pattern>(i);
    }
    cases.push_back({"texts", plain});
    for (OverlayLine& line : cases.back().scene.overlay.lines)
        line.say("operate 2026-06-21 12:00:00Z, 60.0 Hz");
    cases.back().scene.overlay.warning.say("HOST LOST");
    cases.back().scene.views[0].overlay = kShowsWarning | 0b111;
    cases.push_back({"mirrored", plain});
    cases.back().scene.views[0].showing = {.mirrored_across = true};
    cases.push_back({"repeated 2x2", plain});
    cases.back().scene.views[0].showing = {.repeat_across = 2, .repeat_upright = 2};
    Renderer renderer({{"only", kWidth, kHeight}}, {});
    for (const NamedView& each : cases) {
        const Costs costs = measure(renderer, each.scene, rounds);
        std::printf("%-14s %.2f writes, of cpu %.2f\n", each.name.c_str(), median(costs.ratio),
                    median(costs.processor_ratio));
    }
}

// Median of what `what` costs in writes over what `base` does, drawn in turn.
template <class What, class Base>
double writes_over(const What& what, const Base& base, int rounds) {
    Write write_once(kWidth, kHeight);
    std::vector<double> writes;
    for (int i = -5; i < rounds; ++i) {
        const Spent write = spent(write_once);
        const Spent less = spent(base);
        const Spent more = spent(what);
        if (i >= 0) writes.push_back((more.wall_ms - less.wall_ms) / write.wall_ms);
    }
    return median(writes);
}

// Another renderer's level floor 12 m below the eye, over two thirds of the picture: what water and snow add.
void print_covered_floor(int rounds) {
    constexpr double kFar_m = 1000.0;
    Scene dry = tests::make_scene(48.0, 185.0, -10.0, 40.0, 12.0);
    look_at(dry, 175.0, -10.0, 60.0);
    std::vector<float> depths;
    for (int row = 0; row < kHeight; ++row) {
        const glm::dvec3 view =
            view_direction({"only", kWidth, kHeight}, dry.views[0].frustum, 0.5 * kWidth, row + 0.5);
        const double down = -(glm::transpose(dry.views[0].view_from_enu) * view).z;
        const double along_m = down > 0.012 ? 12.0 / down * -view.z : kFar_m;
        depths.insert(depths.end(), kWidth, static_cast<float>(along_m / kFar_m));
    }
    const gl::Texture colour(gl::TexelFormat::kRgba32F, kWidth, kHeight);
    const gl::Texture depth(gl::TexelFormat::kR32F, kWidth, kHeight);
    constexpr int kMap_px = precipitation::ExposureView::kSize_px;
    const gl::Texture map(gl::TexelFormat::kR32F, kMap_px, kMap_px);
    colour.update(std::vector<float>(std::size_t{kWidth} * kHeight * 4, 2000.0F));
    depth.update(depths);
    map.update(std::vector<float>(std::size_t{kMap_px} * kMap_px, 1.0F));
    const auto draws = [&](Renderer& renderer, unsigned exposure) {
        return [&renderer, &colour, &depth, exposure] {
            renderer.draw_scene(0, {colour.name(), depth.name(), kFar_m, true, exposure});
        };
    };
    Renderer plain({{"only", kWidth, kHeight}}, {});
    plain.prepare(dry);
    for (const bool white : {false, true}) {
        Scene scene = dry;
        (white ? scene.ground.snow : scene.ground.wet) = 1.0;
        Renderer renderer({{"only", kWidth, kHeight}}, {});
        renderer.prepare(scene);
        std::printf("floor under %s: %+.2f writes, with a map from above %+.2f\n", white ? "snow" : "water",
                    writes_over(draws(renderer, 0), draws(plain, 0), rounds),
                    writes_over(draws(renderer, map.name()), draws(plain, 0), rounds));
    }
}

void print_windscreen(int rounds) {
    for (const double speed_m_s : {0.0, 70.0}) {
        Scene bare = tests::make_scene(30.0, 120.0, -30.0, 200.0, 300.0);
        look_at(bare, 175.0, 8.0, 60.0);
        bare.weather.precipitations[0] = {Precipitation::Kind::kRain, 20.0, 1500.0};
        bare.weather.precipitation_count = 1;
        bare.weather.eye_velocity_m_s = {0.0, -speed_m_s, 0.0};
        Scene scene = bare;
        scene.views[0].windscreen_m = 0.8F;
        Renderer plain({{"only", kWidth, kHeight}}, {});
        Renderer with({{"only", kWidth, kHeight}}, {});
        plain.prepare(bare);
        std::vector<double> shared;
        for (int i = 0; i < 900; ++i) {
            scene.time_s += 1.0 / 30.0;
            shared.push_back(spent([&] { with.prepare(scene); }).processor_ms);
        }
        std::printf("windscreen in 20 mm/h at %.0f m/s: %+.2f writes; frames prepare in %.3f ms of cpu\n",
                    speed_m_s, writes_over([&] { with.draw(0); }, [&] { plain.draw(0); }, rounds),
                    median(shared));
    }
}

void print_ground(int rounds) {
    print_covered_floor(rounds);
    print_windscreen(rounds);
}

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 60;
    const gl::HeadlessContext context = gl::HeadlessContext::create(false);
    std::printf("%s, %dx%d, medians of %d rounds\n", context.description().c_str(), kWidth, kHeight, rounds);
    if (argc > 2) {
        if (std::string(argv[2]) == "patterns")
            print_over_pictures(rounds);
        else if (std::string(argv[2]) == "ground")
            print_ground(rounds);
        else
            print_all_clouds(rounds);
        return 0;
    }
    std::printf("%-14s %9s %9s %9s %9s %11s %9s %6s\n", "scene", "write ms", "draw ms", "writes", "of cpu",
                "shared ms", "read ms", "stars");
    for (const NamedView& view : all_views()) {
        Renderer renderer({{"only", kWidth, kHeight}}, {});
        const Costs costs = measure(renderer, view.scene, rounds);
        std::printf("%-14s %9.2f %9.2f %9.2f %9.2f %11.3f %9.2f %6zu\n", view.name.c_str(),
                    median(costs.write), median(costs.draw), median(costs.ratio),
                    median(costs.processor_ratio), median(costs.prepare), median(costs.read_back),
                    renderer.prepare(view.scene).stars_drawn);
    }
    for (const double width_deg : {60.0, 120.0})
        print_stars(width_deg, rounds);
    print_deferred(tests::four_times()[1].scene, rounds);
    print_all_clouds(rounds);
    print_all_that_falls(rounds);
    print_over_pictures(rounds);
    print_ground(rounds);
    return 0;
}
