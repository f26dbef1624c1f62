// What is left of a file whose writing failed.
#pragma once

#include <string>

namespace skyig::render::output {

/// Removes a regular file; devices and links are left alone: as root, a device given as a path would be
/// removed like any file.
void remove_partial(const std::string& path);

}  // namespace skyig::render::output
