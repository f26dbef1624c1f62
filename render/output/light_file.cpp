#include "render/output/light_file.h"

#include <bit>
#include <cstddef>

#include "render/output/exr.h"
#include "render/output/partial_file.h"

namespace skyig::render::output {

namespace {

static_assert(std::endian::native == std::endian::little, "floats are written as they lie in memory");

bool write_pfm(std::FILE* file, int width_px, int height_px, std::span<const float> rgb) {
    if (std::fprintf(file, "PF\n%d %d\n-1.0\n", width_px, height_px) < 0) return false;
    const auto stride = static_cast<std::size_t>(width_px) * 3;
    for (auto row = static_cast<std::size_t>(height_px); row-- > 0;) {
        if (std::fwrite(&rgb[row * stride], sizeof(float), stride, file) != stride) return false;
    }
    return true;
}

bool is_exr(std::string_view path) noexcept {
    return path.ends_with(".exr");
}

}  // namespace

bool names_light_file(std::string_view path) noexcept {
    return is_exr(path) || path.ends_with(".pfm");
}

bool write_light(const std::string& path, int width_px, int height_px, std::span<const float> rgb,
                 std::string& error) {
    if (!names_light_file(path)) {
        error = path + ": light is written as .exr or .pfm";
        return false;
    }
    if (width_px < 1 || height_px < 1 ||
        rgb.size() < static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 3) {
        error = path + ": picture of " + std::to_string(width_px) + "x" + std::to_string(height_px) +
                " pixels does not match its data";
        return false;
    }
    return write_file(
        path,
        [&](std::FILE* file) {
            return is_exr(path) ? write_exr(file, width_px, height_px, rgb)
                                : write_pfm(file, width_px, height_px, rgb);
        },
        error);
}

}  // namespace skyig::render::output
