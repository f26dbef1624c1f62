// One finished channel's light as a file: OpenEXR or PFM (portable float map), by the name's extension.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace skyig::render::output {

/// Whether the name ends in .exr or .pfm.
[[nodiscard]] bool names_light_file(std::string_view path) noexcept;

/// Writes linear RGB with the primaries of Rec.709 in 32-bit floats: what is given is what a reader gets, bit
/// by bit. An EXR says in its header that a value of 1 is 1 cd/m2 (whiteLuminance) and which primaries it has
/// (chromaticities); its scan lines are compressed by sixteens (ZIP). A PFM is not compressed, has scale 1,
/// least significant byte first, and can say neither. Floats and not halves: the Sun's disc is 1.6e9 cd/m2, a
/// half ends at 65504. A file that could not be finished is removed (devices and links are left alone).
/// Layout: "OpenEXR file layout" and "Technical introduction to OpenEXR" (openexr.com), single part, scan
/// lines. \param rgb  width * height * 3 floats, top row first (a PFM has the lowest first) \param error on
/// failure: one line that names the file and the reason \return true when the file is complete
[[nodiscard]] bool write_light(const std::string& path, int width_px, int height_px,
                               std::span<const float> rgb, std::string& error);

}  // namespace skyig::render::output
