// What a channel costs, as a multiple of "a write": a full-screen triangle with a literal colour into RGBA8
// of the same size, drawn in turn with it in the same run. Medians of wall time, and of the processor time of
// all threads, which other work on the machine touches less.
//   frame_bench [ROUNDS]     default 60
#include <cstdio>
#include <cstdlib>

#include "render/gl/headless_context.h"
#include "render/gl/texture.h"
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

// Another renderer's picture over the whole channel, all of it at 20 km.
void print_deferred(Scene scene, int rounds) {
    constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;
    const gl::Texture colour(gl::TexelFormat::kRgba32F, kWidth, kHeight);
    const gl::Texture depth(gl::TexelFormat::kR32F, kWidth, kHeight);
    colour.update(std::vector<float>(kPixels * 4, 2000.0F));
    depth.update(std::vector<float>(kPixels, 0.2F));
    tests::add_view(scene, tests::symmetric_frustum(30.0, kWidth, kHeight),
                    tests::view_from_enu(175.0, 8.0, 0.0));
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
    tests::add_view(scene, tests::symmetric_frustum(0.5 * width_deg, kWidth, kHeight),
                    tests::view_from_enu(175.0, 40.0, 0.0));
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
    std::printf("%zu stars of a moonless night at %.0f deg: %.2f writes, of cpu %.2f; shared %.3f ms\n",
                stars, width_deg, median(walls), median(processors), median(shared));
}

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 60;
    const gl::HeadlessContext context = gl::HeadlessContext::create(false);
    std::printf("%s, %dx%d, medians of %d rounds\n", context.description().c_str(), kWidth, kHeight, rounds);
    std::printf("%-6s %9s %9s %9s %9s %11s %9s %6s\n", "scene", "write ms", "draw ms", "writes", "of cpu",
                "shared ms", "read ms", "stars");
    auto scenes = tests::four_times();
    scenes.push_back({"sea", tests::make_scene(48.0, 185.0, -10.0, 40.0, 30.0)});
    scenes.push_back({"waves", scenes.back().scene});
    scenes[4].scene.ground.kind = Ground::Kind::kSea;
    tests::add_waves(scenes[5].scene);
    for (auto& [name, scene] : scenes) {
        const double yaw = name == "dawn" ? 120.0 : name == "dusk" ? 235.0 : 175.0;
        const double pitch = scene.ground.kind == Ground::Kind::kSea ? -20.0 : 8.0;  // nine tenths of it sea
        tests::add_view(scene, tests::symmetric_frustum(30.0, kWidth, kHeight),
                        tests::view_from_enu(yaw, pitch, 0.0));
        Renderer renderer({{"only", kWidth, kHeight}}, {});
        const Costs costs = measure(renderer, scene, rounds);
        std::printf("%-6s %9.2f %9.2f %9.2f %9.2f %11.3f %9.2f %6zu\n", name.c_str(), median(costs.write),
                    median(costs.draw), median(costs.ratio), median(costs.processor_ratio),
                    median(costs.prepare), median(costs.read_back), renderer.prepare(scene).stars_drawn);
    }
    for (const double width_deg : {60.0, 120.0})
        print_stars(width_deg, rounds);
    print_deferred(tests::four_times()[1].scene, rounds);
    return 0;
}
