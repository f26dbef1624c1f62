// Encoded pictures, read back by the library's own decoder.
#include "render/output/jpeg.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

// After stdio, which it needs and does not include.
#include <jpeglib.h>

namespace skyig::render::output {
namespace {

struct Decoded {
    int width_px = 0;
    int height_px = 0;
    std::vector<unsigned char> rgb;
};

Decoded decode(const std::string& file) {
    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_decompress(&info);
    jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(file.data()), file.size());
    jpeg_read_header(&info, TRUE);
    jpeg_start_decompress(&info);
    Decoded out{static_cast<int>(info.output_width), static_cast<int>(info.output_height), {}};
    out.rgb.resize(std::size_t{info.output_width} * info.output_height * 3);
    while (info.output_scanline < info.output_height) {
        JSAMPLE* row = &out.rgb[std::size_t{info.output_scanline} * info.output_width * 3];
        jpeg_read_scanlines(&info, &row, 1);
    }
    jpeg_finish_decompress(&info);
    jpeg_destroy_decompress(&info);
    return out;
}

TEST(Jpeg, ShowsThePictureTheRightWayUpInItsColours) {
    constexpr int kWidth_px = 96, kHeight_px = 70;
    std::vector<std::byte> rgba;
    for (int y = 0; y < kHeight_px; ++y)
        for (int x = 0; x < kWidth_px; ++x)
            for (const int value : {40 + 2 * x, 220 - 2 * y, 90, 0})
                rgba.push_back(static_cast<std::byte>(value));
    std::string file;
    ASSERT_TRUE(encode_jpeg(kWidth_px, kHeight_px, rgba, 95, file));
    const Decoded decoded = decode(file);
    ASSERT_EQ(decoded.width_px, kWidth_px);
    ASSERT_EQ(decoded.height_px, kHeight_px);
    double square = 0.0;
    for (std::size_t i = 0; i < decoded.rgb.size(); ++i) {
        const double error = decoded.rgb[i] - std::to_integer<int>(rgba[i / 3 * 4 + i % 3]);
        square += error * error;
    }
    const double rms = std::sqrt(square / static_cast<double>(decoded.rgb.size()));
    std::printf("  %zu bytes, rms %.2f codes\n", file.size(), rms);
    EXPECT_LT(rms, 2.0);
}

TEST(Jpeg, RefusesWhatIsNoPicture) {
    std::string file = "old";
    EXPECT_FALSE(encode_jpeg(0, 10, {}, 80, file));
    EXPECT_EQ(file, "");
    EXPECT_FALSE(encode_jpeg(10, 10, std::vector<std::byte>(399), 80, file));
    // Beyond what the format can say.
    EXPECT_FALSE(encode_jpeg(70'000, 1, std::vector<std::byte>(280'000), 80, file));
}

}  // namespace
}  // namespace skyig::render::output
