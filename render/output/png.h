// One finished channel as a PNG file.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace skyig::render::output {

/// Writes 8-bit RGB with an sRGB chunk; alpha is dropped. Safe to call from several threads at once.
/// \param rgba  width * height * 4 bytes, top row first
/// \param error on failure: one line that names the file and the reason
/// \return true when the file is complete
[[nodiscard]] bool write_png(const std::string& path, int width_px, int height_px,
                             std::span<const std::byte> rgba, std::string& error);

}  // namespace skyig::render::output
