#include "render/output/pfm.h"

#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <string>

#include "render/output/partial_file.h"

namespace skyig::render::output {

namespace {

static_assert(std::endian::native == std::endian::little, "floats are written as they lie in memory");

bool write_rows(std::FILE* file, int width_px, int height_px, std::span<const float> rgb) {
    if (std::fprintf(file, "PF\n%d %d\n-1.0\n", width_px, height_px) < 0) return false;
    const auto stride = static_cast<std::size_t>(width_px) * 3;
    for (auto row = static_cast<std::size_t>(height_px); row-- > 0;) {
        if (std::fwrite(&rgb[row * stride], sizeof(float), stride, file) != stride) return false;
    }
    return true;
}

}  // namespace

bool write_pfm(const std::string& path, int width_px, int height_px, std::span<const float> rgb,
               std::string& error) {
    if (width_px < 1 || height_px < 1 ||
        rgb.size() < static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 3) {
        error = path + ": picture of " + std::to_string(width_px) + "x" + std::to_string(height_px) +
                " pixels does not match its data";
        return false;
    }
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) {
        error = path + ": cannot be written: " + std::strerror(errno);
        return false;
    }
    bool complete = write_rows(file, width_px, height_px, rgb);
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
