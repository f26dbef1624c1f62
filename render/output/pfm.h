// One finished channel's light as a PFM file (portable float map).
#pragma once

#include <span>
#include <string>

namespace skyig::render::output {

/// Writes linear RGB in 32-bit floats, least significant byte first, scale 1: what is given is what a reader
/// gets. A file that could not be finished is removed (devices and links are left alone).
/// \param rgb  width * height * 3 floats, top row first (the file has the lowest first)
/// \param error on failure: one line that names the file and the reason
/// \return true when the file is complete
[[nodiscard]] bool write_pfm(const std::string& path, int width_px, int height_px, std::span<const float> rgb,
                             std::string& error);

}  // namespace skyig::render::output
