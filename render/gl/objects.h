// How many GL objects there are: what must not grow.
#pragma once

#include <cstddef>

namespace skyig::render::gl {

/// Textures, buffers, vertex arrays, framebuffers and programs of the current context with names up to 1024
/// each, which drivers give out from the lowest free one. Some 5,000 questions to the driver: for counting
/// once in a while.
[[nodiscard]] std::size_t count_objects();

}  // namespace skyig::render::gl
