// What keeping the tables fresh costs in flight, and what more channels cost, as multiples of "a write" of
// one 1280x1024 channel in the same run. Processor time of all threads: the builder of new air counts.
//   upkeep_bench [SECONDS]     of flight at 30 frames a second, default 30
//   upkeep_bench steadiness [SECONDS]     largest step from frame to frame in a replay, default 150 s a
//   flight
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "render/gl/headless_context.h"
#include "render/renderer.h"
#include "tests/bench/spent.h"
#include "tests/render/flights.h"
#include "tests/render/scenes.h"
#include "tests/render/steadiness.h"

namespace {

using namespace skyig::render;
using namespace skyig::render::bench;

constexpr int kWidth = 1280;
constexpr int kHeight = 1024;

void add_writes(std::vector<double>& times) {
    constexpr int kRounds = 20;
    Write write(kWidth, kHeight);
    for (int i = -5; i < kRounds; ++i) {
        const double ms = spent(write).processor_ms;
        if (i >= 0) times.push_back(ms);  // shaders are compiled late
    }
}

void measure_upkeep(const tests::Flight& flight, int frames) {
    std::vector<double> writes;
    add_writes(writes);
    double upkeep_ms = 0.0;
    double largest_ms = 0.0;
    {
        Renderer renderer({{"only", kWidth, kHeight}}, {});
        renderer.prepare(flight.scene(0));
        upkeep_ms = spent([&] {
                        for (int i = 1; i <= frames; ++i) {
                            const double wall_ms = spent([&] { renderer.prepare(flight.scene(i)); }).wall_ms;
                            largest_ms = std::max(largest_ms, wall_ms);
                        }
                    }).processor_ms /
                    frames;
    }
    add_writes(writes);
    const double write = median(writes);
    std::printf("%-28s %9.2f %11.3f %9.3f %12.1f\n", flight.name.c_str(), write, upkeep_ms, upkeep_ms / write,
                largest_ms);
}

// A rig of channels that look to where they are told, and what its frames take.
class Rig {
  public:
    explicit Rig(const std::vector<double>& yaws_deg)
        : renderer_(std::vector<Channel>(yaws_deg.size(), {"channel", kWidth, kHeight}), {}) {
        for (const double yaw_deg : yaws_deg)
            tests::add_view(scene_, tests::symmetric_frustum(30.0, kWidth, kHeight),
                            tests::view_from_enu(yaw_deg, 8.0, 0.0));
    }

    double frame_ms() {
        scene_.time_s += 1.0 / 30.0;
        return spent([&] {
                   renderer_.prepare(scene_);
                   for (std::size_t c = 0; c < renderer_.channels().size(); ++c)
                       renderer_.draw(c);
               })
            .processor_ms;
    }

  private:
    Scene scene_ = tests::four_times()[1].scene;
    Renderer renderer_;
};

// Each alone in turn with all three: views differ in what they cost.
void measure_channels() {
    constexpr int kRounds = 60;
    Rig left({115.0}), ahead({175.0}), right({235.0}), all({115.0, 175.0, 235.0});
    std::vector<double> ratios;
    for (int i = -5; i < kRounds; ++i) {
        const double one_ms = (left.frame_ms() + ahead.frame_ms() + right.frame_ms()) / 3.0;
        const double three_ms = all.frame_ms();
        if (i >= 0) ratios.push_back(three_ms / one_ms);
    }
    std::printf("three channels cost %.2f times one, median of %d rounds\n", median(ratios), kRounds);
}

void replay_for_steps(int seconds) {
    for (const tests::Flight& flight : tests::steadiness_flights()) {
        const tests::Steps steps = tests::largest_step(flight, 0, 30 * seconds);
        std::printf("%-30s %d frames, largest step %d codes, at frame %d\n", flight.name.c_str(),
                    30 * seconds, steps.largest, steps.at_frame);
    }
}

}  // namespace

int main(int argc, char** argv) {
    const gl::HeadlessContext context = gl::HeadlessContext::create(false);
    if (argc > 1 && std::string_view(argv[1]) == "steadiness") {
        replay_for_steps(argc > 2 ? std::max(2, std::atoi(argv[2])) : 150);
        return 0;
    }
    const int seconds = argc > 1 ? std::max(2, std::atoi(argv[1])) : 30;
    std::printf("%s, %dx%d, %d s of flight\n", context.description().c_str(), kWidth, kHeight, seconds);
    std::printf("%-28s %9s %11s %9s %12s\n", "flight", "write ms", "upkeep ms", "writes", "slowest ms");
    for (const tests::Flight& flight : tests::upkeep_flights())
        measure_upkeep(flight, 30 * seconds);
    measure_channels();
    return 0;
}
