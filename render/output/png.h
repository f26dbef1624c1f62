// One finished channel as a PNG file.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace skyig::render::output {

/// Writes 8-bit RGB and, as chunks, the encoding of its values; alpha is dropped. Safe to call from several
/// threads at once. A file that could not be finished is removed (devices and links are left alone).
/// \param rgba  width * height * 4 bytes, top row first
/// \param error on failure: one line that names the file and the reason
/// \param gamma display value = linear light ^ (1 / gamma), > 0; empty: the sRGB curve. Primaries are those
/// of sRGB either way.
/// \return true when the file is complete
[[nodiscard]] bool write_png(const std::string& path, int width_px, int height_px,
                             std::span<const std::byte> rgba, std::string& error,
                             std::optional<double> gamma = std::nullopt);

}  // namespace skyig::render::output
