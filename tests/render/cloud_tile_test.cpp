// Tiles of the cloud map on their way to codes: which are made anew, what near clouds have before and in
// them, and what becomes of the map where its directions turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/cloud/tile_tone.h"
#include "render/eye/tone_curve.h"
#include "render/sky_frame.h"
#include "tests/render/fake_clouds.h"
#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kMapSize = 512;

Quality small_map() {
    Quality quality;
    quality.cloud_map_size = kMapSize;
    quality.cloud_tiles_a_frame = 12;
    return quality;
}

Scene noon_scene(double height_m) {
    Scene scene = make_scene(48.0, 185.0, -10.0, 40.0, height_m);
    add_view(scene, symmetric_frustum(30.0, 640, 512), view_from_enu(150.0, 25.0, 0.0));
    return scene;
}

// Snapshots of made-up texels round an eye that has moved, near clouds, a horizon, a fold.
struct MadeUpTile {
    std::vector<float> light = std::vector<float>(std::size_t{64} * 128 * 4);
    std::vector<float> reach_m = std::vector<float>(std::size_t{64} * 128);
    cloud::ToneTile tile{};

    explicit MadeUpTile(int column, bool near) {
        // Both squares alike, as they are on their rim.
        for (std::size_t i = 0; i < light.size(); ++i) {
            const std::size_t in_square = i % (light.size() / 2);
            const float opacity = 0.5F - 0.5F * std::sin(0.7F * static_cast<float>(in_square / 4));
            const float luminance = 4000.0F + 2500.0F * std::sin(1.3F * static_cast<float>(in_square));
            light[i] = i % 4 == 3 ? 1.0F - opacity : opacity * luminance;
        }
        for (std::size_t i = 0; i < reach_m.size(); ++i)
            reach_m[i] = 4000.0F * (1.0F - light[4 * i + 3]);
        tile.map_size = 64;
        tile.column = column;
        tile.row = 0;
        tile.fold = column == 0 ? cloud::Fold::kFalling : cloud::Fold::kRising;
        tile.horizon = true;
        tile.horizon_sine = 0.2F;
        tile.near = near;
        tile.part_count = 2;
        for (int i = 0; i < cloud::kNodeFloats; ++i) {
            const auto wave = [i](float of) { return 1.0F + 0.3F * std::sin(of * static_cast<float>(i)); };
            for (int c = 0; c < 3; ++c) {
                tile.smooth[cloud::kBehind + c][i] = 5000.0F * wave(0.2F);
                tile.smooth[cloud::kExtinction + c][i] = 1e-4F * wave(0.3F);
                tile.smooth[cloud::kConvergence + c][i] = 8000.0F * wave(0.4F);
                tile.smooth[cloud::kNearLight + c][i] = 700.0F * wave(0.5F);
                tile.ground[c][i] = 900.0F * wave(0.6F);
            }
            tile.near_passed[i] = 0.6F * wave(0.7F);
            for (cloud::TonePart& part : tile.parts)
                part.inverse_m[i] = 3e-4F * wave(0.8F);
        }
        for (int k = 0; k < 2; ++k) {
            cloud::TonePart& part = tile.parts[k];
            part = {light.data(), reach_m.data(), k == 0 ? 0.3F : 0.7F, {}, k == 1, {}};
            const float offsets_m[] = {200.0F, -90.0F, 30.0F};
            std::copy(std::begin(offsets_m), std::end(offsets_m), part.offset_m);
        }
    }
};

TEST(CloudTone, IsTheSameForEveryInstructionSet) {
    const auto tone = eye::single_precision(eye::tone_parameters({}, 3000.0));
    const cloud::ToneLaw law{tone.log2_gain, tone.exponent, tone.compression,
                             tone.burn,      tone.photopic, tone.inv_display_max,
                             tone.ambient,   tone.shoulder, tone.encode_power};
    const cloud::ToneKernel& plain = cloud::portable::tone_kernel();
    const cloud::ToneKernel& fast = cloud::tone_kernel();
    float worst = 0.0F, least = 1.0F, most = 0.0F;
    for (const int column : {0, 32}) {
        for (const bool near : {false, true}) {
            const MadeUpTile made(column, near);
            for (int y = 0; y < cloud::kToneRow; ++y) {
                float texels[2][4 * cloud::kToneRow];
                for (int k = 0; k < 2; ++k) {
                    cloud::ToneRow row{};
                    (k == 0 ? plain : fast).gather(made.tile, y, row);
                    (k == 0 ? plain : fast).tone(law, row, false, texels[k]);
                }
                for (int i = 0; i < 4 * cloud::kToneRow; ++i) {
                    worst = std::max(worst, std::abs(texels[0][i] - texels[1][i]));
                    least = std::min(least, texels[1][i]);
                    most = std::max(most, texels[1][i]);
                }
            }
        }
    }
    std::printf("%s from %s: %.1e codes, of %.2f to %.2f\n", fast.name, plain.name,
                255.0 * static_cast<double>(worst), static_cast<double>(least), static_cast<double>(most));
    EXPECT_GT(most - least, 0.5F);
    EXPECT_LT(255.0F * worst, 0.05F);
}

// What a rig shows of a cloud frame: the texture, kept by tiles.
class Shown {
  public:
    explicit Shown(const FakeSheet& sheet) : maker_(sheet), frame_(1) {}

    void prepare(const Scene& scene, SkyFrame& sky, std::uint64_t revision,
                 const GroundShadow* shadow = nullptr) {
        frame_.follow(maker_, scene, {}, sky.light(), false, kMapSize, 2);
        frame_.shade_ground(shadow);
        const auto tones = std::array{sky.tone()};
        frame_.tone(sky.light(), sky.air_between(scene), tones, 1, revision, {});
        texels_.resize(static_cast<std::size_t>(frame_.map().geometry().tile_count()));
        for (const TonedTile& toned : frame_.toned()) {
            auto& texels = texels_[static_cast<std::size_t>(toned.tile)];
            texels.assign(CloudFrame::kTileFloats, 0.0F);
            if (toned.first == TonedTile::kClear) continue;
            const auto from = frame_.texels(0).subspan(toned.first, CloudFrame::kTileFloats);
            std::copy(from.begin(), from.end(), texels.begin());
        }
    }

    [[nodiscard]] const CloudFrame& frame() const { return frame_; }

    // The largest change of a code, for whatever stands behind.
    [[nodiscard]] double codes_from(const Shown& other) const {
        float worst = 0.0F;
        for (const int tile : frame_.map().seen_tiles()) {
            const auto& a = texels_[static_cast<std::size_t>(tile)];
            const auto& b = other.texels_[static_cast<std::size_t>(tile)];
            for (std::size_t i = 0; i < a.size(); i += 4) {
                for (std::size_t c = 0; c < 3; ++c) {
                    const float colour = a[i + c] - b[i + c];
                    const float lit = colour + a[i + 3] - b[i + 3];
                    worst = std::max({worst, std::abs(colour), std::abs(lit)});
                }
            }
        }
        return 255.0 * static_cast<double>(worst);
    }

  private:
    FakeMaker maker_;
    CloudFrame frame_;
    std::vector<std::vector<float>> texels_;
};

TEST(CloudTiles, ThoseThatAreKeptShowWhatTheyWouldMadeAnew) {
    const FakeSheet far{.wavelength_m = 6000.0};
    const FakeSheet near{.height_m = 900.0, .wavelength_m = 900.0};
    struct Case {
        const char* name;
        FakeSheet sheet;
        double speed_m_s;
    };
    const Scene clear = noon_scene(600.0);
    SkyFrame sky({}, small_map());
    sky.prepare(clear, 1.8e-3);
    for (const Case& c : {Case{"2.5 km below", far, 3.0}, Case{"300 m below", near, 0.2}}) {
        Scene scene = clear;
        add_layer(scene, c.sheet);
        Shown kept(c.sheet), anew(c.sheet);
        std::size_t kept_tiles = 0, all_tiles = 0;
        double worst = 0.0;
        for (int i = 0; i < 50; ++i) {
            scene.eye.latitude_deg += glm::degrees(c.speed_m_s / 30.0 / kEarthRadius_m);
            kept.prepare(scene, sky, 1);
            anew.prepare(scene, sky, static_cast<std::uint64_t>(i) + 1);
            if (i == 0) continue;
            kept_tiles += kept.frame().toned().size();
            all_tiles += anew.frame().toned().size();
            worst = std::max(worst, kept.codes_from(anew));
        }
        std::printf("%s: %.2f codes, %.0f of %.0f tiles a frame\n", c.name, worst,
                    static_cast<double>(kept_tiles) / 49.0, static_cast<double>(all_tiles) / 49.0);
        EXPECT_EQ(kept.frame().map().near_map() != nullptr, c.speed_m_s < 1.0);
        EXPECT_GT(worst, 0.0);
        EXPECT_LT(worst, 1.0) << c.name;
        EXPECT_LT(kept_tiles, all_tiles * 3 / 4) << c.name;
    }
}

// A sheet above the eye, whose shadows lie below.
struct Shady {
    FakeSheet sheet{.wavelength_m = 6000.0, .casts_shadow = true};
    Scene scene;
    SkyFrame sky;

    Shady(double latitude_deg, double height_m, double pitch_deg)
        : scene(make_scene(48.0, 185.0, -10.0, 40.0, height_m)), sky(display(), small_map()) {
        scene.eye.latitude_deg = latitude_deg;
        add_view(scene, symmetric_frustum(30.0, 640, 512), view_from_enu(150.0, pitch_deg, 0.0));
        add_layer(scene, sheet);
        CloudLayer& layer = scene.weather.clouds[0];
        layer.coverage = 0.5;
        layer.base_m = sheet.height_m - 200.0;
        layer.thickness_m = 400.0;
        sky.draw_clouds(fake_clouds(sheet));
        sky.prepare(scene, 1.8e-3);
    }
    static DisplaySettings display() {
        DisplaySettings fixed;
        fixed.fixed_adaptation_cd_m2 = 1500.0;
        return fixed;
    }
    // Toned in this frame; null: it is not.
    [[nodiscard]] const float* texels(int tile) const {
        for (const TonedTile& toned : sky.clouds().toned()) {
            if (toned.tile == tile && toned.first != TonedTile::kClear)
                return &sky.clouds().texels(0)[toned.first];
        }
        return nullptr;
    }
    [[nodiscard]] bool is_lower(int tile) const { return sky.clouds().map().geometry().corner(tile).lower; }
};

// Shadows of a row of texels in lanes, against GroundShadow for one direction.
TEST(CloudTone, ShadesTheGroundAsGroundShadowTells) {
    const Shady shady(0.0, 2000.0, -35.0);
    const GroundShadow& shadow = shady.sky.ground_shadow();
    ASSERT_TRUE(shadow.shown());
    const cloud::CloudMap& map = shady.sky.clouds().map();
    const auto texel_rad = static_cast<float>(map.geometry().worst_texel_rad());
    const cloud::ShadowCells cells = shadow.cells(texel_rad);
    for (const auto* kernel : {&cloud::portable::tone_kernel(), &cloud::tone_kernel()}) {
        double worst = 0.0, least = 1.0, most = -1.0;
        for (const int index : map.seen_tiles()) {
            const auto corner = map.geometry().corner(index);
            if (!corner.lower) continue;
            cloud::ToneTile tile{};
            tile.map_size = map.geometry().size();
            tile.column = corner.column;
            tile.row = corner.row;
            tile.lower = true;
            tile.clear = true;
            tile.shadow = &cells;
            for (auto& sunlit : tile.sunlit)
                std::fill(std::begin(sunlit), std::end(sunlit), 1.0F);
            for (int y = 0; y < cloud::kToneRow; y += 7) {
                cloud::ToneRow row{};
                kernel->gather(tile, y, row);
                for (int i = 0; i < cloud::kToneRow; ++i) {
                    const glm::vec3 direction =
                        map.geometry().direction(corner.column + i, corner.row + y, true);
                    GroundShadow::Place place;
                    const float told =
                        shadow.meets(direction, texel_rad, place) ? shadow.over_mean(place) : 0.0F;
                    worst = std::max(worst, static_cast<double>(std::abs(row.shade[1][i] - told)));
                    least = std::min(least, static_cast<double>(told));
                    most = std::max(most, static_cast<double>(told));
                }
            }
        }
        std::printf("%s: shade within %.1e, of %.2f to %.2f\n", kernel->name, worst, least, most);
        EXPECT_LT(least, -0.1) << kernel->name;
        EXPECT_GT(most, 0.1) << kernel->name;
        EXPECT_LT(worst, 1e-3) << kernel->name;
    }
}

TEST(CloudTiles, AnEyeThatIsCarriedElsewhereSeesTheShadowsThatLieThere) {
    Shady carried(0.0, 2000.0, -35.0);
    ASSERT_TRUE(carried.sky.ground_shadow().shown());
    carried.scene.eye.latitude_deg = 0.9;
    carried.sky.prepare(carried.scene, 1.8e-3);
    const Shady anew(0.9, 2000.0, -35.0);
    double worst = 0.0, least = 1.0, most = 0.0;
    int tiles = 0;
    for (const int tile : anew.sky.clouds().map().seen_tiles()) {
        const float* wanted = anew.texels(tile);
        if (wanted == nullptr || !anew.is_lower(tile)) continue;
        const float* is = carried.texels(tile);
        ASSERT_NE(is, nullptr) << tile;
        ++tiles;
        for (std::size_t i = 0; i < CloudFrame::kTileFloats; ++i) {
            worst = std::max(worst, static_cast<double>(std::abs(is[i] - wanted[i])));
            if (i % 4 != 1) continue;
            least = std::min(least, static_cast<double>(wanted[i]));
            most = std::max(most, static_cast<double>(wanted[i]));
        }
    }
    std::printf("shadows after a leap: off by %.2f codes of %.0f to %.0f, in %d tiles\n", 255.0 * worst,
                255.0 * least, 255.0 * most, tiles);
    EXPECT_GT(tiles, 10);
    EXPECT_GT(255.0 * (most - least), 20.0);
    EXPECT_LT(255.0 * worst, 1.0);
}

TEST(CloudTiles, ThoseThatAreKeptShowTheShadowsThatAMovingEyeSees) {
    Shady shady(0.0, 2000.0, -35.0);
    ASSERT_TRUE(shady.sky.ground_shadow().shown());
    Shown kept(shady.sheet), anew(shady.sheet);
    std::size_t kept_tiles = 0, all_tiles = 0;
    double worst = 0.0;
    for (int i = 0; i < 60; ++i) {
        shady.scene.eye.latitude_deg += glm::degrees(20.0 / 30.0 / kEarthRadius_m);
        shady.sky.prepare(shady.scene, 1.8e-3);
        kept.prepare(shady.scene, shady.sky, 1, &shady.sky.ground_shadow());
        anew.prepare(shady.scene, shady.sky, static_cast<std::uint64_t>(i) + 1, &shady.sky.ground_shadow());
        if (i == 0) continue;
        kept_tiles += kept.frame().toned().size();
        all_tiles += anew.frame().toned().size();
        worst = std::max(worst, kept.codes_from(anew));
    }
    std::printf("over shadows at 20 m/s: %.2f codes, %.0f of %.0f tiles a frame\n", worst,
                static_cast<double>(kept_tiles) / 59.0, static_cast<double>(all_tiles) / 59.0);
    EXPECT_GT(worst, 0.0);
    EXPECT_LT(worst, 1.0);
    EXPECT_LT(kept_tiles, all_tiles * 3 / 4);
}

// Low over the ground a tile above the level holds a little of what lies below it in its cone.
TEST(CloudTiles, ShadowsThatMoveChangeNoneAboveTheLevel) {
    Shady shady(0.0, 30.0, 0.0);
    ASSERT_TRUE(shady.sky.ground_shadow().shown());
    const std::uint64_t before = shady.sky.ground_shadow().map().revision();
    std::size_t lower = 0, upper = 0;
    for (int frame = 0; frame < 80; ++frame) {
        shady.scene.sun.direction_enu = at(48.02, 185.0);
        shady.sky.prepare(shady.scene, 1.8e-3);
        for (const TonedTile& toned : shady.sky.clouds().toned())
            ++(shady.is_lower(toned.tile) ? lower : upper);
    }
    EXPECT_GT(shady.sky.ground_shadow().map().revision(), before);
    std::printf("the Sun moves by a fiftieth of a degree: %zu tiles below the level, %zu above\n", lower,
                upper);
    EXPECT_GT(lower, 0u);
    EXPECT_EQ(upper, 0u);
}

// Black fog round the eye: what is seen of it is what the air before it adds.
TEST(CloudTiles, NearCloudsHaveTheAirBeforeThem) {
    const FakeSheet fog{.light_cd_m2 = glm::vec3{0.0F}, .fog_per_m = 0.01};
    Scene scene = noon_scene(500.0);
    add_layer(scene, fog);
    DisplaySettings display;
    display.fixed_adaptation_cd_m2 = 150.0;
    SkyFrame frame(display, small_map());
    frame.draw_clouds(fake_clouds(fog));
    frame.prepare(scene, 1.8e-3);
    ASSERT_NE(frame.clouds().map().near_map(), nullptr);
    const cloud::MapGeometry& geometry = frame.clouds().map().geometry();
    double worst = 0.0, brightest = 0.0;
    int compared = 0;
    for (const TonedTile& toned : frame.clouds().toned()) {
        const auto corner = geometry.corner(toned.tile);
        const glm::dvec3 direction =
            glm::normalize(glm::dvec3{geometry.direction(corner.column + 20, corner.row + 12, corner.lower)});
        const Horizontal to = horizontal_of(direction);
        if (to.elevation_rad < 0.05 || !cloud::sees(scene.channel_views()[0], {direction, 1.0, 0.0}, 0.0))
            continue;
        // All of it within the near map's range, at 100 m, and the rest beyond: at 500 m.
        const double passed = std::exp(-4.0);
        const auto near = frame.air_between()->between(direction, 100.0);
        const auto far = frame.air_between()->between(direction, 500.0);
        const glm::dvec3 light = (1.0 - passed) * near.added_rgb + passed * far.added_rgb;
        EXPECT_NEAR(frame.through_clouds(glm::dvec3{0.0}, direction).y, light.y, 0.02 * light.y);
        const glm::dvec3 code = shaders64::shown(light, frame.tone());
        const float* texel =
            &frame.clouds().texels(0)[toned.first + (std::size_t{12} * cloud::kTile + 20) * 4];
        for (int c = 0; c < 3; ++c) {
            worst = std::max(worst, 255.0 * std::abs(static_cast<double>(texel[c]) - code[c]));
            brightest = std::max(brightest, 255.0 * code[c]);
        }
        ++compared;
    }
    std::printf("air before near clouds: %.2f codes of %.0f, in %d directions\n", worst, brightest, compared);
    EXPECT_GT(compared, 20);
    EXPECT_GT(brightest, 20.0);
    // The air is taken to be as it is at 200 m.
    EXPECT_LT(worst, 3.0);
}

TEST(CloudMapSchedule, EyesGoOverAPoleAsAnywhere) {
    // Ten metres beside the pole, on the meridians 20 and 200.
    const auto beside = [](double way_m) {
        const double latitude_deg = 90.0 - glm::degrees(std::hypot(way_m, 10.0) / kEarthRadius_m);
        return Eye{latitude_deg, 110.0 - glm::degrees(std::atan2(way_m, 10.0)), 0.0};
    };
    double worst_m = 0.0;
    for (double way_m = -400.0; way_m < 400.0; way_m += 6.7) {
        const Eye from = beside(way_m), to = beside(way_m + 6.7);
        worst_m = std::max(worst_m, std::abs(glm::length(cloud::eye_offset_m(from, to)) - 6.7));
    }
    std::printf("steps of 6.7 m over the pole are told within %.1e m\n", worst_m);
    EXPECT_LT(worst_m, 1e-5);
    const glm::dvec3 across_m = cloud::eye_offset_m({89.99, 30.0, 0.0}, {89.99, -150.0, 0.0});
    EXPECT_NEAR(across_m.x, 0.0, 1e-6);
    EXPECT_NEAR(across_m.y, glm::radians(0.02) * kEarthRadius_m, 1e-3);

    const FakeSheet sheet{.height_m = 3000.0, .wavelength_m = 0.0};
    Scene scene = noon_scene(500.0);
    add_layer(scene, sheet);
    SkyFrame frame({}, small_map());
    frame.draw_clouds(fake_clouds(sheet));
    int at_once = 0;
    for (int i = -12; i < 12; ++i) {
        scene.eye = beside(6.7 * i - 2.0);
        scene.eye.height_m = 500.0;
        scene.time_s += 1.0 / 30.0;
        frame.prepare(scene, 1.8e-3);
        const bool all = frame.clouds().map().rays_marched() > 30000;
        if (i > -12) at_once += all ? 1 : 0;
        for (const auto& part : frame.clouds().map().parts())
            EXPECT_LT(glm::length(part.offset_m), 700.0F) << i;
        // Another place's clouds are not shown with these directions.
        EXPECT_TRUE(all || std::abs(i) > 1) << i;
    }
    std::printf("begun anew in %d of 24 frames\n", at_once);
    EXPECT_LT(at_once, 10);
}

}  // namespace
}  // namespace skyig::render
