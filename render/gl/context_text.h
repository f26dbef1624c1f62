// What draws, for people.
#pragma once

#include <string>

namespace skyig::render::gl {

/// Of the current context: "4.5 (Core Profile) Mesa 22.3.6, llvmpipe (LLVM 15, 256 bits)".
[[nodiscard]] std::string context_text();

}  // namespace skyig::render::gl
