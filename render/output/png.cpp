#include "render/output/png.h"

#include <png.h>

#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

namespace skyig::render::output {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

// Everything with a destructor lives in the caller: libpng leaves this function by longjmp.
bool write_rows(std::FILE* file, png_structp png, png_infop info, int width_px, int height_px,
                std::span<const std::byte> rgba) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_init_io(png, file);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width_px), static_cast<png_uint_32>(height_px), 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    // Dithered skies compress badly at any level: a fast one loses little and keeps the writer ahead of the
    // frames.
    png_set_compression_level(png, 1);
    png_set_filter(png, 0, PNG_FILTER_SUB);
    png_write_info(png, info);
    png_set_filler(png, 0, PNG_FILLER_AFTER);
    const auto stride = static_cast<std::size_t>(width_px) * 4;
    for (int row = 0; row < height_px; ++row) {
        png_write_row(png, reinterpret_cast<png_const_bytep>(&rgba[static_cast<std::size_t>(row) * stride]));
    }
    png_write_end(png, info);
    return true;
}

}  // namespace

bool write_png(const std::string& path, int width_px, int height_px, std::span<const std::byte> rgba,
               std::string& error) {
    if (width_px < 1 || height_px < 1 ||
        rgba.size() < static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 4) {
        error = path + ": picture of " + std::to_string(width_px) + "x" + std::to_string(height_px) +
                " pixels does not match its data";
        return false;
    }
    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "wb"));
    if (!file) {
        error = path + ": cannot be written: " + std::strerror(errno);
        return false;
    }
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const bool written = info != nullptr && write_rows(file.get(), png, info, width_px, height_px, rgba);
    png_destroy_write_struct(&png, &info);
    if (!written || std::fflush(file.get()) != 0) {
        error = path + ": writing failed: " + std::strerror(errno);
        return false;
    }
    return true;
}

}  // namespace skyig::render::output
