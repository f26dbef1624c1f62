// What a piece of work takes: wall time, and processor time of all threads, which other work on the machine
// touches less; and "a write", the measure of all costs.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

#include "render/gl/draw.h"
#include "render/gl/framebuffer.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"

namespace skyig::render::bench {

struct Spent {
    double wall_ms = 0.0;
    double processor_ms = 0.0;
};

inline double processor_ms() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

template <class Work>
Spent spent(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    const double processor_start_ms = processor_ms();
    work();
    return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(),
            processor_ms() - processor_start_ms};
}

inline double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

/// A full-screen triangle with a literal colour into RGBA8.
class Write {
  public:
    Write(int width_px, int height_px) : target_(width_px, height_px) {}

    void operator()() {
        target_.bind();
        gl::set_blend(gl::Blend::kReplace);
        program_.use();
        triangle_.draw_strip(3);
        gl::finish();
    }

  private:
    gl::Framebuffer target_;
    gl::Program program_{"common/write.vert", "common/write.frag"};
    gl::Mesh triangle_{{}, 3};
};

}  // namespace skyig::render::bench
