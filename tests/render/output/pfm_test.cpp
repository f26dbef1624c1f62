// Floats on disk: what was written is read back; what cannot be written leaves a reason and no file.
#include "render/output/pfm.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace skyig::render::output {
namespace {

TEST(Pfm, KeepsEveryBitWithTheLowestRowFirst) {
    const std::string path = ::testing::TempDir() + "light.pfm";
    const std::vector<float> rgb{1.0F, -0.25F, 1e-30F, 2.0F, 3.0F, 1.6e9F,  // the upper row
                                 4.0F, 5.0F,   6.0F,   7.0F, 8.0F, 9.0F};
    std::string error;
    ASSERT_TRUE(write_pfm(path, 2, 2, rgb, error)) << error;
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

TEST(Pfm, WhatCannotBeWrittenIsToldByName) {
    const std::vector<float> rgb(12);
    std::string error;
    EXPECT_FALSE(write_pfm("no/such/folder/x.pfm", 2, 2, rgb, error));
    EXPECT_NE(error.find("no/such/folder/x.pfm: cannot be written: "), std::string::npos) << error;
    EXPECT_FALSE(write_pfm("x.pfm", 3, 2, rgb, error));
    EXPECT_NE(error.find("does not match its data"), std::string::npos) << error;
    EXPECT_FALSE(std::filesystem::exists("x.pfm"));
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    EXPECT_FALSE(write_pfm("/dev/full", 2, 2, rgb, error));
    EXPECT_NE(error.find("/dev/full: writing failed: "), std::string::npos) << error;
    EXPECT_TRUE(std::filesystem::exists("/dev/full"));
}

}  // namespace
}  // namespace skyig::render::output
