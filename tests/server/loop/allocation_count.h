// Counts what this test program allocates, thread by thread.
#pragma once

#include <cstdint>

namespace skyig::server {

/// Calls of operator new by the calling thread since it began.
[[nodiscard]] std::uint64_t allocations_of_this_thread() noexcept;

}  // namespace skyig::server
