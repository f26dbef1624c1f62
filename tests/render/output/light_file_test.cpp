// Light on disk: what was written is read back; what cannot be written leaves a reason and no file.
#include "render/output/light_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/exr_reader.h"

namespace skyig::render::output {
namespace {

TEST(LightFile, PfmKeepsEveryBitWithTheLowestRowFirst) {
    const std::string path = ::testing::TempDir() + "light.pfm";
    const std::vector<float> rgb{1.0F, -0.25F, 1e-30F, 2.0F, 3.0F, 1.6e9F,  // the upper row
                                 4.0F, 5.0F,   6.0F,   7.0F, 8.0F, 9.0F};
    std::string error;
    ASSERT_TRUE(write_light(path, 2, 2, rgb, error)) << error;
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const std::string heading = "PF\n2 2\n-1.0\n";
    ASSERT_EQ(bytes.size(), heading.size() + rgb.size() * sizeof(float));
    EXPECT_EQ(bytes.substr(0, heading.size()), heading);
    std::vector<float> read(rgb.size());
    std::memcpy(read.data(), &bytes[heading.size()], rgb.size() * sizeof(float));
    EXPECT_EQ((std::vector<float>{read.begin(), read.begin() + 6}),
              (std::vector<float>{rgb.begin() + 6, rgb.end()}));
    EXPECT_EQ((std::vector<float>{read.begin() + 6, read.end()}),
              (std::vector<float>{rgb.begin(), rgb.begin() + 6}));
    std::filesystem::remove(path);
}

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// A sky of smooth rows, whose bits a ZIP packs, or noise that it cannot.
std::vector<float> picture(int width_px, int height_px, bool noise) {
    std::vector<float> rgb(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 3);
    std::uint32_t state = 1;
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        state = state * 1664525U + 1013904223U;
        rgb[i] = noise ? std::ldexp(static_cast<float>(state >> 8U), static_cast<int>(state % 60U) - 40)
                       : static_cast<float>(100 * (i % 3) + i / 3 / static_cast<std::size_t>(width_px));
    }
    return rgb;
}

TEST(LightFile, ExrKeepsEveryBitOfWidthsAndHeightsThatFillNoBlock) {
    const std::string path = ::testing::TempDir() + "light.exr";
    for (const auto& [width_px, height_px, noise] :
         {std::tuple{1, 1, false}, {7, 33, false}, {64, 16, false}, {5, 17, true}}) {
        std::vector<float> rgb = picture(width_px, height_px, noise);
        rgb.back() = 1.6e9F;  // the Sun's disc
        rgb.front() = -0.25F;
        std::string error;
        ASSERT_TRUE(write_light(path, width_px, height_px, rgb, error)) << error;
        const std::string bytes = bytes_of(path);
        skyig::tests::ExrReader reader(bytes);
        const skyig::tests::Exr exr = reader.read();
        ASSERT_EQ(exr.width_px, width_px);
        ASSERT_EQ(exr.height_px, height_px);
        ASSERT_EQ(exr.channels.size(), 3U);
        for (std::size_t i = 0; i < rgb.size(); ++i) {
            const std::string name(1, "RGB"[i % 3]);
            ASSERT_EQ(exr.channels.at(name)[i / 3], rgb[i]) << name << " of pixel " << i / 3;
        }
        EXPECT_EQ(reader.numbers<float>("whiteLuminance"), std::vector{1.0F});
        EXPECT_EQ(reader.numbers<float>("chromaticities"),
                  (std::vector{0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F}));
        const bool packs = !noise && height_px > 16;
        EXPECT_TRUE(!packs || bytes.size() < rgb.size() * sizeof(float)) << bytes.size();
    }
    std::filesystem::remove(path);
}

TEST(LightFile, WhatCannotBeWrittenIsToldByName) {
    const std::vector<float> rgb(12);
    std::string error;
    EXPECT_FALSE(write_light("no/such/folder/x.pfm", 2, 2, rgb, error));
    EXPECT_NE(error.find("no/such/folder/x.pfm: cannot be written: "), std::string::npos) << error;
    EXPECT_FALSE(write_light("x.pfm", 3, 2, rgb, error));
    EXPECT_NE(error.find("does not match its data"), std::string::npos) << error;
    EXPECT_FALSE(std::filesystem::exists("x.pfm"));
    EXPECT_FALSE(write_light("x.hdr", 2, 2, rgb, error));
    EXPECT_EQ(error, "x.hdr: light is written as .exr or .pfm");
    // A link is left alone, what it leads to has no room.
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    for (const char* name : {"full.pfm", "full.exr"}) {
        const std::string link = ::testing::TempDir() + name;
        std::filesystem::remove(link);
        std::filesystem::create_symlink("/dev/full", link);
        EXPECT_FALSE(write_light(link, 2, 2, rgb, error));
        EXPECT_NE(error.find(link + ": writing failed: "), std::string::npos) << error;
        EXPECT_TRUE(std::filesystem::is_symlink(link));
        std::filesystem::remove(link);
    }
}

}  // namespace
}  // namespace skyig::render::output
