// Files of warps and blends, made by the tests.
#pragma once

#include <gtest/gtest.h>
#include <png.h>
#include <zip.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace skyig::config::tests {

/// As std::string: bytes that are easy to put together and to spoil.
inline std::string pfm(int width, int height, const std::function<std::array<float, 2>(double, double)>& at) {
    std::string bytes = "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const auto [right, up] = at((column + 0.5) / width, (row + 0.5) / height);
            const std::array<float, 3> values{right, up, 0.0F};
            std::array<char, sizeof values> raw{};
            std::memcpy(raw.data(), values.data(), sizeof values);
            bytes.append(raw.data(), raw.size());
        }
    }
    return bytes;
}

inline std::array<float, 2> same(double right, double up) {
    return {static_cast<float>(right), static_cast<float>(up)};
}

/// Grey of 8 bits, or grey under alpha; the top row first. \param components  1 or 2
inline std::string png(int width, int height, int components,
                       const std::function<std::uint8_t(int x, int y, int component)>& at) {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int k = 0; k < components; ++k)
                pixels.push_back(at(x, y, k));
        }
    }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = components == 1 ? PNG_FORMAT_GRAY : PNG_FORMAT_GA;
    png_alloc_size_t size = 0;
    EXPECT_NE(png_image_write_get_memory_size(image, size, 0, pixels.data(), 0, nullptr), 0);
    std::string bytes(size, '\0');
    EXPECT_NE(png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr), 0);
    return bytes;
}

/// A folder of the test's own, gone with it.
class Folder {
  public:
    Folder() {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        path_ = std::filesystem::path(::testing::TempDir()) /
                (std::string("skyig-") + test->test_suite_name() + "-" + test->name());
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    void write(const std::string& name, std::string_view bytes) const {
        std::ofstream(path_ / name, std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    /// An archive of (name, bytes).
    void write_zip(const std::string& name,
                   const std::vector<std::pair<std::string, std::string>>& entries) const {
        zip_t* zip = zip_open((path_ / name).c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
        ASSERT_NE(zip, nullptr);
        for (const auto& [entry, bytes] : entries)
            ASSERT_GE(zip_file_add(zip, entry.c_str(), zip_source_buffer(zip, bytes.data(), bytes.size(), 0),
                                   ZIP_FL_ENC_GUESS),
                      0);
        ASSERT_EQ(zip_close(zip), 0);
    }
    [[nodiscard]] std::string path(const std::string& name) const { return (path_ / name).string(); }

  private:
    std::filesystem::path path_;
};

/// mpcdi.xml of one region "left" of 64x48 pixels, its frustum as given, with a warp and both masks.
inline std::string mpcdi_xml(std::string_view profile, std::string_view region_inside, int width_px = 64,
                             int height_px = 48) {
    const std::string size =
        "xResolution=\"" + std::to_string(width_px) + "\" yResolution=\"" + std::to_string(height_px) + "\"";
    return "<?xml version=\"1.0\"?>\n<MPCDI profile=\"" + std::string(profile) +
           "\" geometry=\"1\" version=\"1.0\"><display><buffer id=\"b\" " + size +
           "><region id=\"left\" x=\"0.25\" y=\"0\" xsize=\"0.5\" ysize=\"1\" " + size + ">" +
           std::string(region_inside) +
           "</region></buffer></display><files><fileset "
           "region=\"left\"><geometryWarpFile><path>left.pfm</path>"
           "<interpolation>linear</interpolation></geometryWarpFile>"
           "<alphaMap><path>alpha.png</path><gammaEmbedded>2.0</gammaEmbedded></alphaMap>"
           "<betaMap><path>beta.png</path></betaMap></fileset></files></MPCDI>\n";
}

inline constexpr std::string_view kMpcdiFrustum =
    "<frustum><yaw>-30</yaw><pitch>5</pitch><roll>1</roll><rightAngle>30</rightAngle>"
    "<leftAngle>-31</leftAngle><upAngle>25</upAngle><downAngle>-24</downAngle></frustum>";

}  // namespace skyig::config::tests
