// Frames written as light: what each pixel sends before eye and display.
#pragma once

#include "config/config.h"
#include "server/image_writer.h"

namespace skyig::server {

/// Draws the scenes that it is handed once more, in an OpenGL context of its own without windows, and writes
/// each channel's light as the file's extension says (exr, pfm): linear Rec.709 in cd/m2, top row first,
/// every star and the discs, unclipped; neither glare, which is in the eye, nor test patterns and texts,
/// which are codes, nor a blend. It is never thinned. The first file waits for the tables, about a second.
/// Clouds and eyes have a past: they are those of a renderer that has seen what it was handed.
[[nodiscard]] ImageWriter::Files light_files(const config::Config& config);

}  // namespace skyig::server
