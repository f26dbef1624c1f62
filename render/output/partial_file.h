// A file that is there whole or not at all.
#pragma once

#include <cstdio>
#include <functional>
#include <string>

namespace skyig::render::output {

/// Removes what is left of a regular file whose writing failed; devices and links are left alone: as root, a
/// device given as a path would be removed like any file.
void remove_partial(const std::string& path);

/// Makes a file of what `write` puts into it; one that could not be finished is removed.
/// \param write false with errno when it could not go on
/// \param error on failure: one line that names the file and the reason
/// \return true when the file is complete
[[nodiscard]] bool write_file(const std::string& path, const std::function<bool(std::FILE*)>& write,
                              std::string& error);

}  // namespace skyig::render::output
