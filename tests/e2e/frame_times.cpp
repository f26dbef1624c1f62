#include "tests/e2e/frame_times.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <sstream>

#include "tests/e2e/process.h"

namespace skyig::tests {

std::optional<int> number_from(const char* name) {
    const char* text = std::getenv(name);
    if (text == nullptr) return std::nullopt;
    return std::atoi(text);
}

Pinned::Pinned(int cpu) {
    pthread_getaffinity_np(pthread_self(), sizeof(before_), &before_);
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(static_cast<std::size_t>(cpu), &set);
    pthread_setaffinity_np(pthread_self(), sizeof(set), &set);
}

Pinned::~Pinned() {
    pthread_setaffinity_np(pthread_self(), sizeof(before_), &before_);
}

int last_cpu() {
    cpu_set_t set;
    pthread_getaffinity_np(pthread_self(), sizeof(set), &set);
    int last = 0;
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
        if (CPU_ISSET(static_cast<std::size_t>(cpu), &set)) last = cpu;
    return last;
}

std::vector<FrameTime> read_frame_times(const std::string& path) {
    std::istringstream in(read_text(path));
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(
        line,
        "frame,utc_ns,slots,late,arrivals,input_us,shared_us,left_us,centre_us,right_us,frame_us,shown_ns");
    std::vector<FrameTime> frames;
    while (std::getline(in, line)) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');)
            cells.push_back(cell);
        if (cells.size() == 12)
            frames.push_back({std::stoll(cells[1]), std::stod(cells[5]), std::stod(cells[10])});
        EXPECT_EQ(cells.size(), 12U) << line;
    }
    return frames;
}

double quantile(std::vector<double> values, double q) {
    if (values.empty()) return 0.0;
    const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

}  // namespace skyig::tests
