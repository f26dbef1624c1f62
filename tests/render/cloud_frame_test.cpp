// The cloud map without GL: its geometry, its schedule, its tone, and what the eye adapts to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/cloud/tile_tone.h"
#include "render/eye/exposure.h"
#include "render/eye/tone_curve.h"
#include "render/sky_frame.h"
#include "tests/render/fake_clouds.h"
#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using namespace tests;
using cloud::MapGeometry;

TEST(CloudMapGeometry, PlacesAndDirectionsAreInverseAndTheRimIsCommon) {
    double worst = 0.0, worst_float = 0.0;
    for (int i = 0; i < 4000; ++i) {
        const glm::dvec3 direction = at(std::fmod(i * 0.618034, 1.0) * 180.0 - 90.0, i * 7.1);
        const glm::dvec2 place = shaders64::cloud_map_place(direction);
        glm::dvec3 back = shaders64::cloud_map_direction(place);
        back.z = std::copysign(back.z, direction.z);
        worst = std::max(worst, glm::length(glm::normalize(back) - direction));
        const glm::vec2 single = shaders32::cloud_map_place(glm::vec3{direction});
        worst_float = std::max(worst_float, glm::length(glm::dvec2{single} - place));
    }
    std::printf("there and back %.1e rad; float against double %.1e of a square's half\n", worst,
                worst_float);
    EXPECT_LT(worst, 1e-14);
    EXPECT_LT(worst_float, 1e-6);
    const MapGeometry geometry(512);
    for (int i = 0; i < 512; ++i) {
        EXPECT_EQ(geometry.direction(i, 0, false),
                  geometry.direction(i, 0, true) * glm::vec3(1.0F, 1.0F, -1.0F));
        EXPECT_NEAR(geometry.direction(i, 0, false).z, 0.0F, 1e-7F);
    }
}

TEST(CloudMapGeometry, SizeGoesByTheFinestPixelAndWhatIsSeen) {
    std::vector<ChannelView> one{{symmetric_frustum(30.0, 1280, 1024), view_from_enu(0.0, 0.0, 0.0)}};
    EXPECT_EQ(cloud::map_size_for(9.0e-4, one), 1024);
    EXPECT_EQ(cloud::map_size_for(1.8e-3, one), 1024) << "640 pixels";
    EXPECT_EQ(cloud::map_size_for(3.6e-3, one), 512);
    EXPECT_EQ(cloud::map_size_for(4.0e-4, one), 2048);
    EXPECT_EQ(cloud::map_size_for(9.0e-4, std::vector<ChannelView>(3, one[0])), 1024);
    EXPECT_EQ(cloud::map_size_for(9.0e-4, std::vector<ChannelView>(8, one[0])), 512);
}

cloud::ToneLaw law_of(const shaders64::ToneParameters& tone) {
    const auto t = eye::single_precision(tone);
    return {t.log2_gain,       t.exponent, t.compression, t.burn,        t.photopic,
            t.inv_display_max, t.ambient,  t.shoulder,    t.encode_power};
}

TEST(CloudTone, IsTheFramesToneCurve) {
    DisplaySettings gamma;
    gamma.srgb = false;
    gamma.black_cd_m2 = 0.5;
    DisplaySettings reinhard;
    reinhard.tone = ToneOperator::kReinhard;
    for (const auto* kernel : {&cloud::portable::tone_kernel(), &cloud::tone_kernel()}) {
        double worst = 0.0;
        for (const DisplaySettings& display : {DisplaySettings{}, gamma, reinhard}) {
            for (const double adaptation : {1e-3, 0.3, 50.0, 4000.0, 3e4}) {
                const auto tone = eye::tone_parameters(display, adaptation);
                for (int i = 0; i < 40; ++i) {
                    float red[32], green[32], blue[32];
                    glm::dvec3 exact[32];
                    for (int k = 0; k < 32; ++k) {
                        const double luminance = adaptation * std::exp2((i * 32 + k) / 64.0 - 10.0);
                        const glm::dvec3 rgb{luminance * (1.0 + 0.4 * std::sin(k)), luminance,
                                             luminance * (1.0 - 1.1 * std::sin(0.7 * k))};
                        red[k] = static_cast<float>(rgb.x);
                        green[k] = static_cast<float>(rgb.y);
                        blue[k] = static_cast<float>(rgb.z);
                        exact[k] = shaders64::shown(rgb, tone);
                    }
                    kernel->show(law_of(tone), red, green, blue);
                    for (int k = 0; k < 32; ++k) {
                        const glm::dvec3 off = glm::abs(glm::dvec3{red[k], green[k], blue[k]} - exact[k]);
                        worst = std::max({worst, off.x, off.y, off.z});
                    }
                }
            }
        }
        std::printf("%s: %.4f codes\n", kernel->name, 255.0 * worst);
        EXPECT_LT(255.0 * worst, 0.02) << kernel->name;
    }
}

Scene noon_scene(double height_m) {
    Scene scene = make_scene(48.0, 185.0, -10.0, 40.0, height_m);
    add_view(scene, symmetric_frustum(30.0, 640, 512), view_from_enu(150.0, 20.0, 0.0));
    return scene;
}

Quality coarse() {
    Quality quality;
    quality.cloud_map_size = 512;
    quality.cloud_tiles_a_frame = 6;
    return quality;
}

// Nothing but a wisp about one direction, no wider than a texel.
class Wisp final : public cloud::CloudSource {
  public:
    explicit Wisp(const glm::vec3& middle) : middle_(glm::normalize(middle)) {}

    void march(std::span<const cloud::CloudRay> rays, const cloud::CloudRange& /*range*/, float /*ray_rad*/,
               std::span<cloud::CloudSample> out) const noexcept override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const bool in = glm::length(glm::normalize(rays[i].direction_enu) - middle_) < 1e-3F;
            out[i] = in ? cloud::CloudSample{glm::vec3{100.0F}, 0.5F, 3000.0F} : cloud::CloudSample{};
        }
    }

  private:
    glm::vec3 middle_;
};

TEST(CloudMapSchedule, AWispOfOneTexelIsNotLeftOut) {
    const MapGeometry geometry(512);
    cloud::Snapshot snapshot;
    snapshot.resize(geometry, 0);
    snapshot.begin({});
    const int tile = 40;
    const MapGeometry::Texel corner = geometry.corner(tile);
    snapshot.march(Wisp(geometry.direction(corner.column + 6, corner.row + 9, corner.lower)), tile);
    EXPECT_EQ(snapshot.tile(tile), cloud::Snapshot::Tile::kCloud);
    snapshot.march(Wisp(geometry.direction(0, 0, !corner.lower)), tile);
    EXPECT_EQ(snapshot.tile(tile), cloud::Snapshot::Tile::kClear);
}

TEST(CloudMapSchedule, FollowsAFixedNumberOfRaysAFrameAndNoneWhereAllStandsStill) {
    const FakeSheet sheet{};
    Scene scene = noon_scene(500.0);
    add_layer(scene, sheet);
    SkyFrame frame({}, coarse());
    frame.draw_clouds(fake_clouds(sheet));
    frame.prepare(scene, 1.8e-3);
    EXPECT_GT(frame.clouds().map().rays_marched(), 30000) << "the first frame has all";
    int most = 0;
    long all = 0;
    for (int i = 0; i < 60; ++i) {
        scene.time_s += 1.0 / 30.0;
        scene.eye.latitude_deg += 7e-5;
        frame.prepare(scene, 1.8e-3);
        most = std::max(most, frame.clouds().map().rays_marched());
        all += frame.clouds().map().rays_marched();
    }
    std::printf("%d rays a frame at most, %.0f in the mean\n", most, static_cast<double>(all) / 60.0);
    EXPECT_LE(most, 6 * cloud::kTileTexels + 100);
    EXPECT_GT(all, 30 * 6 * cloud::kTileTexels / 2);
    for (int i = 0; i < 60; ++i)
        frame.prepare(scene, 1.8e-3);
    EXPECT_EQ(frame.clouds().map().rays_marched(), 0);
    EXPECT_TRUE(frame.clouds().toned().empty()) << "nothing has moved";
    EXPECT_TRUE(frame.plan().needs(Pass::kClouds));
    EXPECT_FALSE(frame.plan().needs(Pass::kNearClouds));
}

// All of what is seen follows, a third of it a frame.
TEST(CloudMapSchedule, ThinnedTonesFollowEveryThirdFrameAndAllInTurn) {
    const FakeSheet sheet{};
    Scene scene = noon_scene(500.0);
    add_layer(scene, sheet);
    SkyFrame whole({}, coarse()), thinned({}, coarse());
    render::Thinned tones;
    tones.set(static_cast<std::size_t>(Thin::kCloudTones));
    for (SkyFrame* frame : {&whole, &thinned})
        frame->draw_clouds(fake_clouds(sheet));
    thinned.thin(tones);
    std::vector<int> unseen_since;
    std::size_t of_whole = 0, of_thinned = 0, most = 0;
    for (int i = 0; i < 60; ++i) {
        scene.time_s += 1.0 / 30.0;
        scene.eye.latitude_deg += 7e-5;
        whole.prepare(scene, 1.8e-3);
        thinned.prepare(scene, 1.8e-3);
        if (i == 0) {
            EXPECT_EQ(thinned.clouds().toned().size(), whole.clouds().toned().size()) << "all at first";
            unseen_since.assign(static_cast<std::size_t>(whole.clouds().map().geometry().tile_count()), 0);
            continue;
        }
        for (const TonedTile& toned : whole.clouds().toned()) {
            int& waits = unseen_since[static_cast<std::size_t>(toned.tile)];
            waits = std::max(waits, 1);
        }
        for (const TonedTile& toned : thinned.clouds().toned())
            unseen_since[static_cast<std::size_t>(toned.tile)] = 0;
        for (int& waits : unseen_since) {
            EXPECT_LE(waits, 3);
            waits += waits > 0 ? 1 : 0;
        }
        of_whole += whole.clouds().toned().size();
        of_thinned += thinned.clouds().toned().size();
        most = std::max(most, thinned.clouds().toned().size());
    }
    std::printf("tiles toned in 59 frames: %zu, thinned %zu, %zu in one frame at most\n", of_whole,
                of_thinned, most);
    EXPECT_GT(of_thinned, 0U);
    EXPECT_LT(of_thinned, of_whole / 2);
    EXPECT_EQ(thinned.plan()[Pass::kClouds].reason, "followed more slowly: thinned out");
}

TEST(CloudMapSchedule, ThinnedShadowsLeaveTheGroundInEvenLight) {
    FakeSheet sheet{};
    sheet.casts_shadow = true;
    Scene scene = noon_scene(500.0);
    add_layer(scene, sheet);
    SkyFrame frame({}, coarse());
    frame.draw_clouds(fake_clouds(sheet));
    frame.prepare(scene, 1.8e-3);
    EXPECT_TRUE(frame.ground_shadow().shown());
    const auto bit = static_cast<std::size_t>(Thin::kCloudShadows);
    EXPECT_TRUE(thinnable(frame.plan())[bit]);
    render::Thinned shadows;
    shadows.set(bit);
    frame.thin(shadows);
    frame.prepare(scene, 1.8e-3);
    EXPECT_FALSE(frame.ground_shadow().shown());
    EXPECT_EQ(frame.plan()[Pass::kCloudShadows].reason, "thinned out for the frame rate");
    EXPECT_FALSE(thinnable(frame.plan())[bit]);
    frame.thin({});
    scene.eye.latitude_deg += 1e-3;
    for (int i = 0; i < 200; ++i)
        frame.prepare(scene, 1.8e-3);
    EXPECT_TRUE(frame.ground_shadow().shown()) << "they come back";
}

TEST(CloudMapSchedule, CloudsThatGoLeaveNoGapFromOneFrameToTheNext) {
    const FakeSheet sheet{.least_transmittance = 0.2, .most_transmittance = 0.2};
    Scene scene = noon_scene(500.0);
    add_layer(scene, sheet);
    SkyFrame frame({}, coarse());
    frame.draw_clouds(fake_clouds(sheet));
    frame.prepare(scene, 1.8e-3);
    const glm::dvec3 ahead = at(20.0, 150.0);
    double last = frame.clouds().transmittance(ahead), largest = 0.0;
    EXPECT_NEAR(last, 0.2, 0.01);
    scene.weather.cloud_count = 0;
    int frames = 0;
    for (; frames < 400 && frame.clouds().shown(); ++frames) {
        frame.prepare(scene, 1.8e-3);
        EXPECT_FALSE(frame.plan().needs(Pass::kClouds));
        const double now = frame.clouds().shown() ? frame.clouds().transmittance(ahead) : 1.0;
        largest = std::max(largest, std::abs(now - last));
        last = now;
    }
    std::printf("gone after %d frames, largest step of what passes %.3f\n", frames, largest);
    EXPECT_LT(frames, 400);
    EXPECT_EQ(last, 1.0);
    EXPECT_LT(largest, 0.8 * 1.6 / cloud::CloudMap::kBlendFrames);
}

TEST(CloudMapSchedule, TheOrderOfLayersMovesNothingAndALeapOfTheEyeBeginsAnew) {
    const FakeSheet sheet{};
    Scene scene = noon_scene(500.0);
    for (const std::uint32_t seed : {1U, 2U}) {
        add_layer(scene, sheet);
        CloudLayer& layer = scene.weather.clouds[scene.weather.cloud_count - 1];
        layer.seed = seed;
        layer.drift_m = seed == 1U ? glm::dvec2{36e3, 0.0} : glm::dvec2{0.0, 54e3};
    }
    SkyFrame frame({}, coarse());
    frame.draw_clouds(fake_clouds(sheet));
    for (int i = 0; i < 3; ++i)
        frame.prepare(scene, 1.8e-3);
    const auto offset_m = [&] { return glm::length(frame.clouds().map().parts().front().offset_m); };
    EXPECT_LT(offset_m(), 0.01F);
    std::swap(scene.weather.clouds[0], scene.weather.clouds[1]);
    frame.prepare(scene, 1.8e-3);
    EXPECT_LT(offset_m(), 0.01F);
    // The measured one is switched off.
    scene.weather.clouds[0] = scene.weather.clouds[1];
    scene.weather.clouds[0].seed = 7;
    scene.weather.cloud_count = 1;
    frame.prepare(scene, 1.8e-3);
    EXPECT_LT(offset_m(), 0.01F);
    scene.eye.latitude_deg += 0.1;
    frame.prepare(scene, 1.8e-3);
    EXPECT_LT(offset_m(), 0.01F);
    EXPECT_GT(frame.clouds().map().rays_marched(), 30000);
}

void flash_lights(const FakeSheet& sheet) {
    Scene scene = make_scene(-40.0, 0.0, -40.0, 90.0, 500.0);
    add_view(scene, symmetric_frustum(60.0, 640, 512), view_from_enu(0.0, 60.0, 0.0));
    add_layer(scene, sheet);
    scene.weather.lightnings[scene.weather.lightning_count++] = {0, 400.0, 7};
    // The first flash over the eye.
    const auto overhead = [](const cloud::Flashes& flashes) {
        return std::any_of(flashes.all().begin(), flashes.all().end(), [](const cloud::Flash& flash) {
            return flash.intensity_cd > 1e6 && glm::length(glm::dvec2{flash.place_m}) < 2000.0 &&
                   flash.place_m.z > 100.0;
        });
    };
    for (int i = 0; i < 20000 && !overhead(cloud::flashes_at(scene)); ++i)
        scene.time_s = i / 30.0;
    ASSERT_TRUE(overhead(cloud::flashes_at(scene)));
    Scene calm = scene;
    calm.weather.lightning_count = 0;
    SkyFrame frame({}, coarse());
    frame.draw_clouds(fake_clouds(sheet));
    const auto shown = [&](const Scene& now) {
        frame.prepare(now, 1.8e-3);
        return frame.through_clouds(glm::dvec3{0.0}, at(85.0, 0.0)).y;
    };
    const auto brightest = [&] {
        float most = 0.0F;
        const auto texels = frame.clouds().texels(0);
        for (const TonedTile& toned : frame.clouds().toned()) {
            for (std::size_t i = 0; toned.first != TonedTile::kClear && i < CloudFrame::kTileFloats; i += 4)
                most = std::max(most, texels[toned.first + i + 1]);
        }
        return most;
    };
    const double dark = shown(calm);
    const float dark_code = brightest();
    const double lit = shown(scene);
    const float lit_code = brightest();
    EXPECT_NEAR(shown(calm), dark, 0.01 * dark + 1e-9);
    EXPECT_FALSE(frame.clouds().toned().empty()) << "what was lit is toned once more";
    std::printf("clouds of %.3g cd/m2 by a flash, %.2g without; codes %.3f and %.3f\n", lit, dark,
                static_cast<double>(lit_code), static_cast<double>(dark_code));
    EXPECT_GT(lit, 10.0 * dark);
    EXPECT_GT(lit_code, dark_code + 0.2F);
}

TEST(CloudLightning, LightsTheCloudsNearTheFlashWhileItLasts) {
    flash_lights({.height_m = 3000.0,
                  .wavelength_m = 0.0,
                  .least_transmittance = 0.0,
                  .most_transmittance = 0.0,
                  .light_cd_m2 = glm::vec3{0.0F}});
}

TEST(CloudLightning, LightsTheCloudsRoundTheEye) {
    flash_lights({.light_cd_m2 = glm::vec3{0.0F}, .fog_per_m = 0.05});
}

TEST(CloudAdaptation, IsToWhatIsSeenOfCloudsToo) {
    for (const AdaptationSource source : {AdaptationSource::kSky, AdaptationSource::kViewMean}) {
        DisplaySettings display;
        display.adapt_to = source;
        const FakeSheet fog{.light_cd_m2 = glm::vec3{700.0F}, .fog_per_m = 0.05};
        Scene scene = noon_scene(500.0);
        SkyFrame clear(display, coarse());
        clear.prepare(scene, 1.8e-3);
        add_layer(scene, fog);
        SkyFrame frame(display, coarse());
        frame.draw_clouds(fake_clouds(fog));
        frame.prepare(scene, 1.8e-3);
        std::printf("clear %.0f cd/m2, in fog of 700: %.1f\n", clear.adaptation_cd_m2(),
                    frame.adaptation_cd_m2());
        EXPECT_GT(clear.adaptation_cd_m2(), 1500.0);
        // The sunlit air of the nearest metres is before it.
        EXPECT_NEAR(frame.adaptation_cd_m2(), 700.0, 14.0);
    }
}

}  // namespace
}  // namespace skyig::render
