// What a channel costs, as a multiple of "a write": a full-screen triangle with a literal colour into RGBA8
// of the same size, drawn in turn with it in the same run. Medians of wall time.
//   frame_bench [ROUNDS]     default 60
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "render/gl/draw.h"
#include "render/gl/framebuffer.h"
#include "render/gl/headless_context.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/renderer.h"
#include "tests/render/scenes.h"

namespace {

using namespace skyig::render;

constexpr int kWidth = 1280;
constexpr int kHeight = 1024;

template <class Work>
double milliseconds(Work work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

struct Costs {
    std::vector<double> write, draw, ratio, prepare, read_back;
};

Costs measure(Renderer& renderer, Scene scene, int rounds) {
    gl::Framebuffer target(kWidth, kHeight);
    const gl::Program program("common/write.vert", "common/write.frag");
    const gl::Mesh triangle({}, 3);
    std::vector<std::byte> pixels(static_cast<std::size_t>(kWidth) * kHeight * 4);
    Costs costs;
    for (int i = -5; i < rounds; ++i) {
        scene.time_s += 1.0 / 30.0;
        const double write = milliseconds([&] {
            target.bind();
            gl::set_blend(gl::Blend::kReplace);
            program.use();
            triangle.draw_strip(3);
            gl::finish();
        });
        const double prepare = milliseconds([&] { renderer.prepare(scene); });
        const double draw = milliseconds([&] { renderer.draw(0); });
        const double read_back = milliseconds([&] { renderer.read_back(0, pixels); });
        if (i < 0) continue;  // shaders are compiled late
        costs.write.push_back(write);
        costs.draw.push_back(draw);
        costs.ratio.push_back(draw / write);
        costs.prepare.push_back(prepare);
        costs.read_back.push_back(read_back);
    }
    return costs;
}

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 60;
    const gl::HeadlessContext context = gl::HeadlessContext::create(false);
    std::printf("%s, %dx%d, medians of %d rounds\n", context.description().c_str(), kWidth, kHeight, rounds);
    std::printf("%-6s %9s %9s %9s %11s %9s %6s\n", "scene", "write ms", "draw ms", "writes", "shared ms",
                "read ms", "stars");
    for (auto& [name, scene] : tests::four_times()) {
        const double yaw = name == "dawn" ? 120.0 : name == "dusk" ? 235.0 : 175.0;
        tests::add_view(scene, tests::symmetric_frustum(30.0, kWidth, kHeight),
                        tests::view_from_enu(yaw, 8.0, 0.0));
        Renderer renderer({{"only", kWidth, kHeight}}, {});
        const Costs costs = measure(renderer, scene, rounds);
        std::printf("%-6s %9.2f %9.2f %9.2f %11.3f %9.2f %6zu\n", name.c_str(), median(costs.write),
                    median(costs.draw), median(costs.ratio), median(costs.prepare), median(costs.read_back),
                    renderer.prepare(scene).stars_drawn);
    }
    return 0;
}
