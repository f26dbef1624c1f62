// What a warp and a blend add to a channel, in writes (see spent.h): flat, drawn directly through a curved
// screen's warp, resampled, and with a mask over a fifth of the screen, in turn in each round.
//   warp_bench [ROUNDS]     default 60
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "render/gl/headless_context.h"
#include "render/renderer.h"
#include "render/warp/blend.h"
#include "tests/bench/spent.h"
#include "tests/render/warps.h"

namespace {

using namespace skyig::render;
using namespace skyig::render::bench;

constexpr int kWidth = 1280;
constexpr int kHeight = 1024;

// Ramps of a tenth of the width on both sides.
std::shared_ptr<const warp::Blend> side_ramps() {
    auto blend = std::make_shared<warp::Blend>(warp::Blend{kWidth, kHeight, {}});
    for (int i = 0; i < kWidth * kHeight; ++i) {
        const int from_side = std::min(i % kWidth, kWidth - 1 - i % kWidth);
        blend->weight.push_back(std::min(1.0F, (static_cast<float>(from_side) + 0.5F) / (0.1F * kWidth)));
    }
    return blend;
}

struct Way {
    const char* name;
    Channel channel;
    std::unique_ptr<Renderer> renderer = {};
    std::vector<double> draws = {}, extra_wall = {}, extra_cpu = {};
};

std::vector<Way> all_ways() {
    const tests::CurvedScreen curved;
    const auto warp = curved.warp(kWidth, kHeight);
    const Channel flat{.name = "flat", .width_px = kWidth, .height_px = kHeight};
    Channel direct = flat;
    direct.warp = warp;
    Channel resampled = direct;
    resampled.drawing = WarpDrawing::kResampled;
    Channel sharp = resampled;
    sharp.render_scale = 1.5;
    Channel blended = flat;
    blended.blend = side_ramps();
    std::vector<Way> ways;
    ways.push_back({"flat", flat});
    ways.push_back({"direct", direct});
    ways.push_back({"resampled", resampled});
    ways.push_back({"at 1.5", sharp});
    ways.push_back({"blended", blended});
    for (Way& way : ways)
        way.renderer = std::make_unique<Renderer>(std::vector{way.channel}, DisplaySettings{});
    return ways;
}

void print_costs(const tests::NamedScene& view, int rounds) {
    Scene scene = view.scene;
    tests::add_view(scene, tests::CurvedScreen{}.frustum(), tests::view_from_enu(175.0, 8.0, 0.0));
    std::vector<Way> ways = all_ways();
    Write write_once(kWidth, kHeight);
    for (int i = -5; i < rounds; ++i) {
        scene.time_s += 1.0 / 30.0;
        const Spent write = spent(write_once);
        Spent flat;
        for (Way& way : ways) {
            way.renderer->prepare(scene);
            const Spent draw = spent([&] { way.renderer->draw(0); });
            if (&way == &ways.front()) flat = draw;
            if (i < 0) continue;
            way.draws.push_back(draw.processor_ms / write.processor_ms);
            way.extra_wall.push_back((draw.wall_ms - flat.wall_ms) / write.wall_ms);
            way.extra_cpu.push_back((draw.processor_ms - flat.processor_ms) / write.processor_ms);
        }
    }
    for (const Way& way : ways)
        std::printf("%-6s %-10s %6.2f writes of cpu, extra %6.2f, of cpu %6.2f\n", view.name.c_str(),
                    way.name, median(way.draws), median(way.extra_wall), median(way.extra_cpu));
}

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 60;
    const gl::HeadlessContext context = gl::HeadlessContext::create(false);
    std::printf("%s, %dx%d, medians of %d rounds\n", context.description().c_str(), kWidth, kHeight, rounds);
    for (const tests::NamedScene& view : tests::four_times())
        print_costs(view, rounds);
    return 0;
}
