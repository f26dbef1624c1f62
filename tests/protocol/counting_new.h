// Linked into a test, counts every operator new of the program.
#pragma once

#include <cstdint>

namespace skyig::protocol {

/// How often memory was asked for since the program began, by all threads.
[[nodiscard]] std::uint64_t allocation_count() noexcept;

}  // namespace skyig::protocol
