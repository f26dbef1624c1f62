// Times of a daemon's frames under loads that come from one processor, so that quiet and load can be
// compared.
#pragma once

#include <sched.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace skyig::tests {

/// Of the environment; nothing where it is not set.
[[nodiscard]] std::optional<int> number_from(const char* name);

/// Keeps this thread, and the programs and threads that it starts, on one processor as long as it lives.
class Pinned {
  public:
    explicit Pinned(int cpu);
    ~Pinned();
    Pinned(const Pinned&) = delete;
    Pinned& operator=(const Pinned&) = delete;

  private:
    cpu_set_t before_{};
};

/// Of those that this thread may run on.
[[nodiscard]] int last_cpu();

struct FrameTime {
    std::int64_t utc_ns = 0;
    double input_us = 0.0;
    double frame_us = 0.0;
};

/// What `skyigd --times` wrote of the channels left, centre and right.
[[nodiscard]] std::vector<FrameTime> read_frame_times(const std::string& path);

/// \param q  0..1; 0 of nothing is 0
[[nodiscard]] double quantile(std::vector<double> values, double q);

}  // namespace skyig::tests
