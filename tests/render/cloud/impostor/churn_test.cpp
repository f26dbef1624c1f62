// Ten minutes of flight through a field of clouds at 30 Hz, by every scheme of keeping their pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/cloud/impostor/impostor_field.h"
#include "tests/render/cloud/impostor/moments.h"

namespace skyig::render::cloud::impostor {
namespace {

constexpr int kFrames = 10 * 60 * 30;

struct Churn {
    double worst_pop = 0.0;
    long lit = 0;
    long drawn = 0;
    long packed = 0;
    std::size_t most_used = 0;
};

ImpostorSettings small(AtlasScheme scheme) {
    ImpostorSettings settings;
    settings.atlas.scheme = scheme;
    // Tight; tiles lose a quarter to their borders.
    settings.atlas.size = scheme == AtlasScheme::kTiles ? glm::ivec2{448, 288} : glm::ivec2{288, 176};
    settings.atlas.most_side = 96;
    settings.atlas.pictures = 160;
    settings.atlas.tile_side = 16;
    settings.cells = 8;
    settings.lights_per_update = 1;
    settings.pictures_per_update = 1;
    return settings;
}

/// A few coarse pictures of thin clouds, which is quick; the way winds and climbs through the layer and back.
Moment moment_of(int frame) {
    Moment moment = fair_weather(0.25);
    moment.texel_rad = 0.02F;
    moment.time_s = frame / 30.0;
    const double north_m = 100.0 * moment.time_s;
    moment.eye = moved_north(moment.eye, north_m);
    moment.eye.longitude_deg += 0.02 * std::sin(north_m / 9000.0);
    moment.eye.height_m = 1200.0 - 900.0 * std::cos(north_m / 15000.0);
    return moment;
}

/// Whether no two pictures share a texel; adds up what they take.
bool apart(const ImpostorClouds& clouds, glm::ivec2 size, std::size_t& used) {
    std::vector<std::uint8_t> taken(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    std::vector<glm::ivec4> places;
    for (const Cloud& cloud : clouds.clouds()) {
        for (const Picture& picture : cloud.pictures) {
            if (picture.id != Atlas::kNone) clouds.atlas().places(picture.id, places);
        }
    }
    used = 0;
    for (const glm::ivec4& place : places) {
        if (place.x < 0 || place.y < 0 || place.x + place.z > size.x || place.y + place.w > size.y)
            return false;
        for (int y = place.y; y < place.y + place.w; ++y) {
            for (int x = place.x; x < place.x + place.z; ++x) {
                std::uint8_t& texel = taken[static_cast<std::size_t>(y * size.x + x)];
                if (texel != 0) return false;
                texel = 1;
                ++used;
            }
        }
    }
    return true;
}

class ChurnTest : public testing::TestWithParam<AtlasScheme> {};

TEST_P(ChurnTest, TenMinutesWithoutOverlapLeakOrPop) {
    const ImpostorSettings settings = small(GetParam());
    ImpostorClouds clouds(settings);
    ImpostorField field;
    const CloudLight light = day_light();
    const ImpostorClouds* layer = &clouds;
    constexpr std::size_t kRays = 400;
    std::vector<CloudRay> rays;
    for (std::size_t i = 0; i < kRays; ++i) {
        const CloudRay ray = spread_ray(i, kRays, -0.6, 0.9);
        if (beside_sun(ray)) rays.push_back(ray);
    }
    std::vector<CloudSample> before(rays.size());
    std::vector<CloudSample> after(rays.size());
    const std::size_t whole = clouds.atlas().free_texels();
    Churn churn;
    for (int frame = 0; frame < kFrames; ++frame) {
        const Moment moment = moment_of(frame);
        const bool watched = frame > 0 && frame % 23 == 0;
        if (watched) {
            // From the new place, before and after pictures change: what is left is a pop.
            field.freeze({&layer, 1}, light, moment.eye);
            field.march(rays, {}, 0.02F, before);
        }
        clouds.update(moment);
        churn.lit += clouds.work().lit;
        churn.drawn += clouds.work().drawn;
        churn.packed += clouds.work().packed ? 1 : 0;
        if (watched) {
            field.freeze({&layer, 1}, light, moment.eye);
            field.march(rays, {}, 0.02F, after);
            for (std::size_t i = 0; i < rays.size(); ++i)
                churn.worst_pop = std::max(churn.worst_pop, std::abs(code(after[i]) - code(before[i])));
        }
        if (frame % 100 == 0) {
            std::size_t used = 0;
            ASSERT_TRUE(apart(clouds, settings.atlas.size, used)) << "frame " << frame;
            ASSERT_EQ(used + clouds.atlas().free_texels(), whole) << "frame " << frame;
            churn.most_used = std::max(churn.most_used, used);
        }
    }
    // The clouds go: all room returns.
    for (int frame = kFrames; frame < kFrames + 600; ++frame) {
        Moment moment = moment_of(frame);
        moment.layer.coverage = 0.0;
        clouds.update(moment);
    }
    EXPECT_EQ(clouds.atlas().free_texels(), whole);
    std::printf(
        "scheme %d: worst pop %.2f / 255; %ld clouds lit, %ld pictures, %zu of them smaller than wanted, %ld "
        "packings; up to %.0f %% of the atlas in use\n",
        static_cast<int>(GetParam()), churn.worst_pop, churn.lit, churn.drawn, clouds.atlas().shrunk(),
        churn.packed, 100.0 * static_cast<double>(churn.most_used) / static_cast<double>(whole));
    RecordProperty("worst_pop_codes", std::to_string(churn.worst_pop));
    EXPECT_GT(churn.drawn, 1000);
    EXPECT_LE(churn.worst_pop, 4.0);
}

INSTANTIATE_TEST_SUITE_P(Schemes, ChurnTest,
                         testing::Values(AtlasScheme::kBestFit, AtlasScheme::kDefragmented,
                                         AtlasScheme::kTiles));

}  // namespace
}  // namespace skyig::render::cloud::impostor
