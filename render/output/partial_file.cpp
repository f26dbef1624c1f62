#include "render/output/partial_file.h"

#include <filesystem>
#include <system_error>

namespace skyig::render::output {

void remove_partial(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::symlink_status(path, ignored).type() == std::filesystem::file_type::regular)
        std::filesystem::remove(path, ignored);
}

}  // namespace skyig::render::output
