// Which parts of a screen a blend changes.
#include "render/warp/blend.h"

#include <gtest/gtest.h>

namespace skyig::render::warp {
namespace {

TEST(Blend, TouchesOnlyTheSquaresThatItChanges) {
    Blend blend{100, 70, std::vector<float>(7000, 1.0F)};
    EXPECT_TRUE(changed_tiles(blend).indices.empty());
    blend.weight[static_cast<std::size_t>(69) * 100 + 99] = 0.5F;  // the upper right pixel
    const BlendTiles tiles = changed_tiles(blend);
    ASSERT_EQ(tiles.indices.size(), 6U);
    EXPECT_EQ(tiles.corners.front(), (glm::vec2{2.0F * 96.0F / 100.0F - 1.0F, 2.0F * 64.0F / 70.0F - 1.0F}));
    EXPECT_EQ(tiles.corners.back(), glm::vec2{1.0F});
    blend.lift = {0.01F};
    EXPECT_EQ(changed_tiles(blend).indices.size(), 6U * 4U * 3U);
}

}  // namespace
}  // namespace skyig::render::warp
