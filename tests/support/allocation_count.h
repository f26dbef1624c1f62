// Linked into a test program, counts every operator new of it.
#pragma once

#include <cstdint>

namespace skyig::tests {

/// How often memory was asked for since the program began, by all threads.
[[nodiscard]] std::uint64_t allocation_count() noexcept;
/// The same by the calling thread alone.
[[nodiscard]] std::uint64_t allocation_count_of_this_thread() noexcept;

}  // namespace skyig::tests
