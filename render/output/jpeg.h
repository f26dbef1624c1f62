// JPEG files in memory (libjpeg-turbo): small pictures for people who watch from afar.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace skyig::render::output {

/// \param rgba  top row first, width * height * 4 bytes; alpha is left out \param quality  1..100
/// \param file  becomes the file's bytes, in the memory that it has where that is enough
/// \return false if the library refuses the size (1..65500 each way) or memory is short; `file` is then empty
[[nodiscard]] bool encode_jpeg(int width_px, int height_px, std::span<const std::byte> rgba, int quality,
                               std::string& file);

}  // namespace skyig::render::output
