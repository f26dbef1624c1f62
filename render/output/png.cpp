#include "render/output/png.h"

#include <png.h>

#include <array>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>

#include "render/output/partial_file.h"

namespace skyig::render::output {

namespace {

// What libpng is given back in its callbacks. No destructors: libpng leaves by longjmp.
struct Sink {
    std::FILE* file = nullptr;
    std::array<char, 256> reason{};
};

void keep(Sink& sink, const char* text) {
    std::snprintf(sink.reason.data(), sink.reason.size(), "%s", text);
}

[[noreturn]] void on_error(png_structp png, png_const_charp text) {
    auto& sink = *static_cast<Sink*>(png_get_error_ptr(png));
    // The warning before an error says more: "width exceeds limit", then "invalid header".
    if (sink.reason[0] == '\0') keep(sink, text);
    png_longjmp(png, 1);
}

void on_warning(png_structp png, png_const_charp text) {
    keep(*static_cast<Sink*>(png_get_error_ptr(png)), text);
}

void write_bytes(png_structp png, png_bytep data, std::size_t size) {
    auto& sink = *static_cast<Sink*>(png_get_io_ptr(png));
    if (std::fwrite(data, 1, size, sink.file) == size) return;
    keep(sink, std::strerror(errno));
    png_error(png, sink.reason.data());
}

void set_encoding(png_structp png, png_infop info, const double* gamma) {
    if (gamma == nullptr) {
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
        return;
    }
    png_set_gAMA(png, info, 1.0 / *gamma);
    // White D65, then red, green and blue of Rec. 709 as x, y.
    png_set_cHRM(png, info, 0.3127, 0.3290, 0.64, 0.33, 0.30, 0.60, 0.15, 0.06);
}

// Everything with a destructor lives in the caller.
bool write_rows(Sink& sink, png_structp png, png_infop info, int width_px, int height_px,
                std::span<const std::byte> rgba, const double* gamma) {
    if (setjmp(png_jmpbuf(png))) return false;
    // Buffered by the stream: nothing to flush on libpng's word.
    png_set_write_fn(png, &sink, write_bytes, [](png_structp) {});
    png_set_IHDR(png, info, static_cast<png_uint_32>(width_px), static_cast<png_uint_32>(height_px), 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    set_encoding(png, info, gamma);
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

bool write_picture(Sink& sink, int width_px, int height_px, std::span<const std::byte> rgba,
                   const double* gamma) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, on_error, on_warning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const bool written = info != nullptr && write_rows(sink, png, info, width_px, height_px, rgba, gamma);
    png_destroy_write_struct(&png, &info);
    if (!written && sink.reason[0] == '\0') keep(sink, "libpng has no memory");
    return written;
}

}  // namespace

bool write_png(const std::string& path, int width_px, int height_px, std::span<const std::byte> rgba,
               std::string& error, std::optional<double> gamma) {
    if (width_px < 1 || height_px < 1 ||
        rgba.size() < static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 4) {
        error = path + ": picture of " + std::to_string(width_px) + "x" + std::to_string(height_px) +
                " pixels does not match its data";
        return false;
    }
    if (gamma && !(*gamma > 0.0)) {
        error = path + ": gamma " + std::to_string(*gamma) + " is not above 0";
        return false;
    }
    Sink sink;
    sink.file = std::fopen(path.c_str(), "wb");
    if (sink.file == nullptr) {
        error = path + ": cannot be written: " + std::strerror(errno);
        return false;
    }
    bool complete = write_picture(sink, width_px, height_px, rgba, gamma ? &*gamma : nullptr);
    if (std::fclose(sink.file) != 0 && complete) {
        keep(sink, std::strerror(errno));
        complete = false;
    }
    if (complete) return true;
    error = path + ": writing failed: " + sink.reason.data();
    remove_partial(path);
    return false;
}

}  // namespace skyig::render::output
