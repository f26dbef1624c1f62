#include "render/output/partial_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace skyig::render::output {

void remove_partial(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::symlink_status(path, ignored).type() == std::filesystem::file_type::regular)
        std::filesystem::remove(path, ignored);
}

bool write_file(const std::string& path, const std::function<bool(std::FILE*)>& write, std::string& error) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) {
        error = path + ": cannot be written: " + std::strerror(errno);
        return false;
    }
    bool complete = write(file);
    int reason = errno;
    if (std::fclose(file) != 0 && complete) {
        reason = errno;
        complete = false;
    }
    if (complete) return true;
    error = path + ": writing failed: " + std::strerror(reason);
    remove_partial(path);
    return false;
}

}  // namespace skyig::render::output
