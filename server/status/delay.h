// How long something took, over all times that it did.
#pragma once

#include <cstdint>

namespace skyig::server::status {

struct Delay {
    std::uint64_t count = 0;
    double median_ms = 0.0;
    double p99_ms = 0.0;
    double largest_ms = 0.0;
};

}  // namespace skyig::server::status
