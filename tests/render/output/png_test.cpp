// Pictures on disk: what was written is read back with libpng; what cannot be written leaves a reason and no
// file.
#include "render/output/png.h"

#include <gtest/gtest.h>
#include <png.h>
#include <sys/resource.h>

#include <csetjmp>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace skyig::render::output {
namespace {

constexpr int kWidth = 37;
constexpr int kHeight = 23;

// Noise that no filter predicts: a file about as large as its pixels.
std::vector<std::byte> noise(int width_px, int height_px) {
    std::vector<std::byte> rgba(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 4);
    std::uint32_t state = 1;
    for (std::byte& value : rgba) {
        state = state * 1664525U + 1013904223U;
        value = static_cast<std::byte>(state >> 24U);
    }
    return rgba;
}

struct ReadBack {
    bool ok = false;
    png_uint_32 width_px = 0, height_px = 0;
    int bit_depth = 0, colour_type = 0;
    bool has_srgb = false, has_gamma = false, has_primaries = false;
    double file_gamma = 0.0;
    std::vector<png_byte> rgb;
};

ReadBack read_png(const std::string& path) {
    ReadBack result;
    std::FILE* file = std::fopen(path.c_str(), "rb");
    if (file == nullptr) return result;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    if (setjmp(png_jmpbuf(png)) == 0) {
        png_init_io(png, file);
        png_read_info(png, info);
        png_get_IHDR(png, info, &result.width_px, &result.height_px, &result.bit_depth, &result.colour_type,
                     nullptr, nullptr, nullptr);
        result.has_srgb = png_get_valid(png, info, PNG_INFO_sRGB) != 0;
        result.has_gamma = png_get_gAMA(png, info, &result.file_gamma) != 0;
        result.has_primaries = png_get_valid(png, info, PNG_INFO_cHRM) != 0;
        const std::size_t stride = png_get_rowbytes(png, info);
        result.rgb.resize(stride * result.height_px);
        for (png_uint_32 row = 0; row < result.height_px; ++row)
            png_read_row(png, &result.rgb[row * stride], nullptr);
        png_read_end(png, nullptr);
        result.ok = true;
    }
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(file);
    return result;
}

class Png : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "skyig_png_XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        directory_ = pattern;
    }
    void TearDown() override { std::filesystem::remove_all(directory_); }

    [[nodiscard]] std::string path(const char* name) const { return (directory_ / name).string(); }

    // Writes what must fail and checks that the caller alone hears of it, in one line that names the file.
    static std::string reason_of_failure(const std::string& path, int width_px, int height_px,
                                         std::span<const std::byte> rgba) {
        std::string error;
        ::testing::internal::CaptureStderr();
        const bool written = write_png(path, width_px, height_px, rgba, error);
        EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
        EXPECT_FALSE(written);
        EXPECT_EQ(error.rfind(path + ": ", 0), 0U) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
        EXPECT_EQ(error.find("Success"), std::string::npos) << error;
        std::printf("%s\n", error.c_str());
        return error;
    }

    std::filesystem::path directory_;
};

TEST_F(Png, PixelsComeBackWithoutTheirAlpha) {
    const auto rgba = noise(kWidth, kHeight);
    std::string error;
    ASSERT_TRUE(write_png(path("a.png"), kWidth, kHeight, rgba, error)) << error;
    EXPECT_EQ(error, "");
    const ReadBack picture = read_png(path("a.png"));
    ASSERT_TRUE(picture.ok);
    EXPECT_EQ(picture.width_px, static_cast<png_uint_32>(kWidth));
    EXPECT_EQ(picture.height_px, static_cast<png_uint_32>(kHeight));
    EXPECT_EQ(picture.bit_depth, 8);
    ASSERT_EQ(picture.colour_type, PNG_COLOR_TYPE_RGB);
    std::vector<png_byte> expected;
    for (std::size_t i = 0; i < rgba.size(); ++i)
        if (i % 4 != 3) expected.push_back(std::to_integer<png_byte>(rgba[i]));
    EXPECT_EQ(picture.rgb, expected);
}

TEST_F(Png, SrgbIsSaidByItsOwnChunk) {
    std::string error;
    ASSERT_TRUE(write_png(path("a.png"), kWidth, kHeight, noise(kWidth, kHeight), error)) << error;
    const ReadBack picture = read_png(path("a.png"));
    ASSERT_TRUE(picture.ok);
    EXPECT_TRUE(picture.has_srgb);
    EXPECT_TRUE(picture.has_primaries);
}

TEST_F(Png, GammaIsSaidInsteadOfSrgb) {
    for (const double gamma : {1.0, 1.8, 2.2, 2.6}) {
        std::string error;
        ASSERT_TRUE(write_png(path("a.png"), kWidth, kHeight, noise(kWidth, kHeight), error, gamma)) << error;
        const ReadBack picture = read_png(path("a.png"));
        ASSERT_TRUE(picture.ok) << gamma;
        EXPECT_FALSE(picture.has_srgb) << gamma;
        EXPECT_TRUE(picture.has_primaries) << gamma;
        ASSERT_TRUE(picture.has_gamma) << gamma;
        EXPECT_NEAR(picture.file_gamma * gamma, 1.0, 5e-5) << gamma;
    }
}

TEST_F(Png, ImpossibleGammaAndTooLittleDataAreRefused) {
    std::string error;
    EXPECT_FALSE(write_png(path("a.png"), kWidth, kHeight, noise(kWidth, kHeight), error, 0.0));
    EXPECT_NE(error.find("gamma"), std::string::npos) << error;
    reason_of_failure(path("a.png"), kWidth, kHeight + 1, noise(kWidth, kHeight));
    reason_of_failure(path("a.png"), 0, kHeight, noise(kWidth, kHeight));
    EXPECT_FALSE(std::filesystem::exists(path("a.png")));
}

TEST_F(Png, PathThatCannotBeOpenedIsNamedWithItsReason) {
    const std::string missing = path("nowhere/a.png");
    EXPECT_NE(
        reason_of_failure(missing, kWidth, kHeight, noise(kWidth, kHeight)).find("No such file or directory"),
        std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(missing));
    EXPECT_NE(reason_of_failure(directory_.string(), kWidth, kHeight, noise(kWidth, kHeight))
                  .find("Is a directory"),
              std::string::npos);
    EXPECT_TRUE(std::filesystem::is_directory(directory_));
}

TEST_F(Png, FullDiskIsNamedWhetherItShowsWhileWritingOrWhileClosing) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    // The small picture waits in the stream's buffer until it is closed. The device is reached by a link, so
    // that a clean-up which follows links or removes them shows.
    const std::string link = path("full.png");
    std::filesystem::create_symlink("/dev/full", link);
    for (const int size : {8, 500}) {
        EXPECT_NE(reason_of_failure(link, size, size, noise(size, size)).find("No space left on device"),
                  std::string::npos);
        EXPECT_TRUE(std::filesystem::is_symlink(link));
        EXPECT_TRUE(std::filesystem::exists("/dev/full"));
    }
}

TEST_F(Png, FileThatBreaksOffIsRemoved) {
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit small = before;
    small.rlim_cur = 20000;
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    std::string error;
    const auto rgba = noise(500, 500);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const bool written = write_png(path("a.png"), 500, 500, rgba, error);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_FALSE(written);
    EXPECT_EQ(error, path("a.png") + ": writing failed: File too large");
    EXPECT_FALSE(std::filesystem::exists(path("a.png")));
}

TEST_F(Png, RefusalOfTheLibraryIsKeptAndNothingIsPrinted) {
    // More columns than libpng allows unless told otherwise.
    constexpr int kTooWide = 1'000'001;
    EXPECT_NE(reason_of_failure(path("a.png"), kTooWide, 1, noise(kTooWide, 1)).find("width"),
              std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(path("a.png")));
}

}  // namespace
}  // namespace skyig::render::output
