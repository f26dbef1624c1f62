// The bytes of an OpenEXR file. \see light_file.h, which is what to call
#pragma once

#include <cstdio>
#include <span>

namespace skyig::render::output {

/// \param file  empty, can be sought in
/// \param rgb   width * height * 3 floats, top row first; both sizes at least 1
/// \return false with errno when it could not go on
[[nodiscard]] bool write_exr(std::FILE* file, int width_px, int height_px, std::span<const float> rgb);

}  // namespace skyig::render::output
