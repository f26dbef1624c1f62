#include "config/nearest.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace skyig::config {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
    EXPECT_EQ(edit_distance("", ""), 0U);
    EXPECT_EQ(edit_distance("gamma", "gamma"), 0U);
    EXPECT_EQ(edit_distance("gama", "gamma"), 1U);
    EXPECT_EQ(edit_distance("gammma", "gamma"), 1U);
    EXPECT_EQ(edit_distance("gamna", "gamma"), 1U);
    EXPECT_EQ(edit_distance("gmama", "gamma"), 1U);
    EXPECT_EQ(edit_distance("Gamma", "gamma"), 0U);
    EXPECT_EQ(edit_distance("abc", ""), 3U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(Nearest, FindsMisspeltAndHalfWordsAndNothingFarAway) {
    constexpr std::array<std::string_view, 4> kKeys{"max_luminance_cd_m2", "gamma", "dither", "yaw_deg"};
    EXPECT_EQ(nearest("max_luminence_cd_m2", kKeys), "max_luminance_cd_m2");
    EXPECT_EQ(nearest("yaw", kKeys), "yaw_deg");
    EXPECT_EQ(nearest("max_luminance", kKeys), "max_luminance_cd_m2");
    EXPECT_EQ(nearest("dihter", kKeys), "dither");
    EXPECT_EQ(nearest("teapot", kKeys), "");
    EXPECT_EQ(nearest(std::string(5000, 'x'), kKeys), "");
}

}  // namespace
}  // namespace skyig::config
