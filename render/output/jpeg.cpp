#include "render/output/jpeg.h"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>

// After stdio, which it needs and does not include.
#include <jpeglib.h>

namespace skyig::render::output {
namespace {

struct Failure {
    jpeg_error_mgr manager;
    std::jmp_buf way_out;
};

// The library's own would end the program.
[[noreturn]] void leave(j_common_ptr info) {
    std::longjmp(reinterpret_cast<Failure*>(info->err)->way_out, 1);
}

void say_nothing(j_common_ptr) {}

/// What the encoder works with: nothing here has a destructor, since longjmp passes none.
struct Encoder {
    jpeg_compress_struct info;
    Failure failure;
    unsigned char* bytes;
    unsigned long size;
};

bool encode(Encoder& encoder, int width_px, int height_px, const std::byte* rgba, int quality) {
    encoder.info.err = jpeg_std_error(&encoder.failure.manager);
    encoder.failure.manager.error_exit = &leave;
    encoder.failure.manager.output_message = &say_nothing;
    if (setjmp(encoder.failure.way_out) != 0) return false;
    jpeg_create_compress(&encoder.info);
    jpeg_mem_dest(&encoder.info, &encoder.bytes, &encoder.size);
    encoder.info.image_width = static_cast<JDIMENSION>(width_px);
    encoder.info.image_height = static_cast<JDIMENSION>(height_px);
    encoder.info.input_components = 4;
    encoder.info.in_color_space = JCS_EXT_RGBX;
    jpeg_set_defaults(&encoder.info);
    jpeg_set_quality(&encoder.info, quality, TRUE);
    jpeg_start_compress(&encoder.info, TRUE);
    const std::size_t stride = static_cast<std::size_t>(width_px) * 4;
    while (encoder.info.next_scanline < encoder.info.image_height) {
        // The library does not write into what it reads; its type is older than const.
        auto* row =
            reinterpret_cast<JSAMPLE*>(const_cast<std::byte*>(rgba) + encoder.info.next_scanline * stride);
        jpeg_write_scanlines(&encoder.info, &row, 1);
    }
    jpeg_finish_compress(&encoder.info);
    return true;
}

}  // namespace

bool encode_jpeg(int width_px, int height_px, std::span<const std::byte> rgba, int quality,
                 std::string& file) {
    file.clear();
    if (width_px < 1 || height_px < 1 ||
        rgba.size() < static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 4)
        return false;
    Encoder encoder{};
    const bool done = encode(encoder, width_px, height_px, rgba.data(), quality);
    jpeg_destroy_compress(&encoder.info);
    if (done) file.assign(reinterpret_cast<const char*>(encoder.bytes), encoder.size);
    std::free(encoder.bytes);  // jpeg_mem_dest's, which asks malloc for it
    return done;
}

}  // namespace skyig::render::output
