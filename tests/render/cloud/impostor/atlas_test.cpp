#include "render/cloud/impostor/atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace skyig::render::cloud::impostor {
namespace {

constexpr std::array<AtlasScheme, 3> kSchemes{AtlasScheme::kBestFit, AtlasScheme::kDefragmented,
                                              AtlasScheme::kTiles};

AtlasSettings small(AtlasScheme scheme, int tile_side = 32) {
    AtlasSettings settings;
    settings.scheme = scheme;
    settings.size = {512, 256};
    settings.most_side = 128;
    settings.pictures = 256;
    settings.tile_side = tile_side;
    return settings;
}

/// Every texel tells where it is and whose.
std::vector<Texel> marked(glm::ivec2 size, float whose) {
    std::vector<Texel> picture(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    for (std::size_t i = 0; i < picture.size(); ++i)
        picture[i] = {{static_cast<float>(i), whose}};
    return picture;
}

void expect_marked(const Atlas& atlas, Atlas::Id id, float whose) {
    const glm::ivec2 size = atlas.size(id);
    for (int y = 0; y + 1 < size.y; ++y) {
        for (int x = 0; x + 1 < size.x; ++x) {
            int stride = 0;
            const Texel* corner = atlas.corner(id, {x, y}, stride);
            const auto at = static_cast<float>(y * size.x + x);
            const std::array<float, 4> seen{corner[0].v[0], corner[1].v[0], corner[stride].v[0],
                                            corner[stride + 1].v[0]};
            const auto row = static_cast<float>(size.x);
            ASSERT_EQ(seen, (std::array<float, 4>{at, at + 1.0F, at + row, at + row + 1.0F}))
                << "at " << x << ", " << y;
            ASSERT_EQ(corner[0].v[1], whose);
        }
    }
}

TEST(Atlas, GivesBackWhatWasWrittenWhateverTheScheme) {
    for (const AtlasScheme scheme : kSchemes) {
        for (const int tile_side : {16, 32}) {
            const auto atlas = Atlas::make(small(scheme, tile_side));
            std::vector<Atlas::Id> ids;
            for (const glm::ivec2 size : {glm::ivec2{16, 16}, {112, 48}, {32, 96}, {128, 64}, {16, 128}}) {
                const Atlas::Id id = atlas->allocate(size);
                ASSERT_NE(id, Atlas::kNone);
                ASSERT_EQ(atlas->size(id), size);
                atlas->write(id, marked(size, static_cast<float>(id)).data());
                ids.push_back(id);
            }
            for (const Atlas::Id id : ids)
                expect_marked(*atlas, id, static_cast<float>(id));
        }
    }
}

TEST(Atlas, TakesTheLargestOfTheSameShapeWhenNothingFits) {
    for (const AtlasScheme scheme : kSchemes) {
        const auto atlas = Atlas::make(small(scheme));
        const std::size_t all = atlas->free_texels();
        std::vector<Atlas::Id> ids;
        while (atlas->shrunk() == 0) {
            ids.push_back(atlas->allocate({112, 80}));
            ASSERT_NE(ids.back(), Atlas::kNone);
        }
        const glm::ivec2 size = atlas->size(ids.back());
        EXPECT_LT(size.x, 112);
        EXPECT_EQ(size.x % 16 + size.y % 16, 0);
        EXPECT_NEAR(static_cast<double>(size.x) / size.y, 1.4, 0.45);
        // Until not even the smallest fits; and then everything returns.
        for (Atlas::Id id = atlas->allocate({112, 80}); id != Atlas::kNone; id = atlas->allocate({112, 80}))
            ids.push_back(id);
        EXPECT_LT(atlas->free_texels(), all / 8);
        for (const Atlas::Id id : ids)
            atlas->release(id);
        EXPECT_EQ(atlas->free_texels(), all);
        const Atlas::Id again = atlas->allocate({112, 80});
        EXPECT_EQ(atlas->size(again), (glm::ivec2{112, 80}));
    }
}

TEST(Atlas, PacksAnewSoThatWhatIsFreeCanBeUsedAndNotMoreOftenThanTold) {
    AtlasSettings settings = small(AtlasScheme::kDefragmented);
    settings.defragmentations_per_s = 2.0;
    const auto atlas = Atlas::make(settings);
    std::vector<Atlas::Id> ids;
    for (int i = 0; i < 32; ++i) {
        ids.push_back(atlas->allocate({64, 64}));
        atlas->write(ids.back(), marked({64, 64}, static_cast<float>(i)).data());
    }
    EXPECT_EQ(atlas->free_texels(), 0U);
    EXPECT_FALSE(atlas->tidy(0.0)) << "nothing was refused yet";
    for (std::size_t i = 0; i < ids.size(); i += 2)
        atlas->release(ids[i]);
    const Atlas::Id cramped = atlas->allocate({128, 128});
    EXPECT_LT(atlas->size(cramped).x, 128) << "half of the room is free, in pieces";
    atlas->release(cramped);
    EXPECT_TRUE(atlas->tidy(10.0));
    for (std::size_t i = 1; i < ids.size(); i += 2)
        expect_marked(*atlas, ids[i], static_cast<float>(i));
    const Atlas::Id whole = atlas->allocate({128, 128});
    EXPECT_EQ(atlas->size(whole), (glm::ivec2{128, 128}));
    while (atlas->allocate({128, 128}) != Atlas::kNone) {
    }
    EXPECT_FALSE(atlas->tidy(10.4));
    EXPECT_TRUE(atlas->tidy(10.5));
}

}  // namespace
}  // namespace skyig::render::cloud::impostor
