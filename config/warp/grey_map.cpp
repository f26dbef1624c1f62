#include "config/warp/grey_map.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstring>

namespace skyig::config::warp {
namespace {

constexpr png_uint_32 kMostSide = 16384;

// What libpng is given back in its callbacks. No destructors: libpng leaves by longjmp.
struct Source {
    const std::byte* next = nullptr;
    std::size_t left = 0;
    std::array<char, 200> reason{};
};

[[noreturn]] void on_error(png_structp png, png_const_charp text) {
    auto& source = *static_cast<Source*>(png_get_error_ptr(png));
    std::snprintf(source.reason.data(), source.reason.size(), "%s", text);
    png_longjmp(png, 1);
}

void on_warning(png_structp /*png*/, png_const_charp /*text*/) {}

void take_bytes(png_structp png, png_bytep out, std::size_t size) {
    auto& source = *static_cast<Source*>(png_get_io_ptr(png));
    if (size > source.left) png_error(png, "the file ends too early");
    std::memcpy(out, source.next, size);
    source.next += size;
    source.left -= size;
}

/// Of what unpacks from a small file to gigabytes; four times what the largest projectors have.
constexpr std::size_t kMostPixels = 8192U * 8192U;

struct Raw {
    png_uint_32 width = 0;
    png_uint_32 height = 0;
    bool has_alpha = false;
    std::vector<png_uint_16> rgba;
};

// Everything with a destructor lives in the caller.
bool read_head(Source& source, png_structp png, png_infop info, Raw& raw) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_user_limits(png, kMostSide, kMostSide);
    png_set_read_fn(png, &source, take_bytes);
    png_read_info(png, info);
    raw.width = png_get_image_width(png, info);
    raw.height = png_get_image_height(png, info);
    if (std::size_t{raw.width} * raw.height > kMostPixels) png_error(png, "it has more than 67108864 pixels");
    raw.has_alpha = (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) != 0 ||
                    png_get_valid(png, info, PNG_INFO_tRNS) != 0;
    png_set_expand_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xFFFF, PNG_FILLER_AFTER);
    png_set_swap(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    return true;
}

bool read_rows(png_structp png, std::vector<png_bytep>& rows) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_read_image(png, rows.data());
    png_read_end(png, nullptr);
    return true;
}

bool read_raw(Source& source, Raw& raw) {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    bool whole = info != nullptr && read_head(source, png, info, raw);
    if (whole) {
        raw.rgba.resize(std::size_t{raw.width} * raw.height * 4);
        std::vector<png_bytep> rows;
        for (std::size_t row = 0; row < raw.height; ++row)
            rows.push_back(reinterpret_cast<png_bytep>(&raw.rgba[row * raw.width * 4]));
        whole = read_rows(png, rows);
    }
    png_destroy_read_struct(&png, &info, nullptr);
    return whole;
}

}  // namespace

FileRead<GreyMap> read_grey_map(std::span<const std::byte> bytes, MaskPart part) {
    Source source{bytes.data(), bytes.size()};
    Raw raw;
    if (!read_raw(source, raw)) {
        const char* reason = source.reason[0] == '\0' ? "libpng has no memory" : source.reason.data();
        return {std::nullopt, fmt::format("cannot be read as PNG: {}", reason)};
    }
    if (part == MaskPart::kAlpha && !raw.has_alpha) return {std::nullopt, "has no alpha channel"};
    const bool alpha = part == MaskPart::kAlpha || (part == MaskPart::kEither && raw.has_alpha);
    GreyMap map{static_cast<int>(raw.width), static_cast<int>(raw.height), {}};
    map.values.reserve(std::size_t{raw.width} * raw.height);
    for (std::size_t row = raw.height; row-- > 0;) {
        for (std::size_t column = 0; column < raw.width; ++column) {
            const png_uint_16* pixel = &raw.rgba[(row * raw.width + column) * 4];
            const int sum = pixel[0] + pixel[1] + pixel[2];
            map.values.push_back(static_cast<float>(alpha ? pixel[3] / 65535.0 : sum / (3.0 * 65535.0)));
        }
    }
    return {std::move(map), {}};
}

GreyMap stretched(const GreyMap& map, int width_px, int height_px) {
    if (map.width_px == width_px && map.height_px == height_px) return map;
    GreyMap out{width_px, height_px, {}};
    out.values.reserve(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
    const auto at = [&](int column, int row) {
        return map.values[static_cast<std::size_t>(std::min(row, map.height_px - 1)) *
                              static_cast<std::size_t>(map.width_px) +
                          static_cast<std::size_t>(std::min(column, map.width_px - 1))];
    };
    for (int row = 0; row < height_px; ++row) {
        const double y = std::clamp((row + 0.5) * map.height_px / height_px - 0.5, 0.0, map.height_px - 1.0);
        const auto up = static_cast<float>(y - std::floor(y));
        for (int column = 0; column < width_px; ++column) {
            const double x =
                std::clamp((column + 0.5) * map.width_px / width_px - 0.5, 0.0, map.width_px - 1.0);
            const auto across = static_cast<float>(x - std::floor(x));
            const int c = static_cast<int>(x);
            const int r = static_cast<int>(y);
            const float below = std::lerp(at(c, r), at(c + 1, r), across);
            out.values.push_back(std::lerp(below, std::lerp(at(c, r + 1), at(c + 1, r + 1), across), up));
        }
    }
    return out;
}

}  // namespace skyig::config::warp
