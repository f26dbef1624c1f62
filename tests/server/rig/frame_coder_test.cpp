// What travels of a frame comes out as it went in, to the last bit.
#include "server/rig/frame_coder.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <vector>

#include "render/cloud/field/texture.h"
#include "server/rig/messages.h"

namespace skyig::server::rig {
namespace {

using render::cloud::field::Texture;

/// A scene with something of everything.
FrameState busy_state(std::size_t clouds, std::size_t channels) {
    FrameState state;
    render::Scene& scene = state.scene;
    scene.frame_number = 123456;
    scene.time_s = 1234.0 / 3.0;
    scene.eye = {47.1 / 3.0, -8.7 / 3.0, 1234.5};
    scene.sun.direction_enu = {0.1, 0.2, std::sqrt(1.0 - 0.05)};
    scene.moon.enabled = false;
    scene.stars.years_since_j2000 = 24.0 + 1.0 / 7.0;
    scene.ground.albedo = 0.3;
    scene.sky.preetham.turbidity = 3.0;
    scene.overlay.lines[1].say("FREEZE 12:00:00");
    scene.weather.cloud_count = clouds;
    for (std::size_t i = 0; i < clouds; ++i) {
        render::CloudLayer& layer = scene.weather.clouds[i];
        layer.base_m = 1000.0 / 7.0 * static_cast<double>(i + 1);
        layer.coverage = 1.0 / static_cast<double>(i + 3);
        layer.drift_m = {1e5 / 3.0, -1e4 / 7.0};
        layer.age_s = 77.0 / 3.0;
        layer.seed = static_cast<std::uint32_t>(1234567 * (i + 1));
        if (i % 2 == 1) layer.area = render::WeatherArea{.centre_m = {1.0 / 3.0, 2.0}, .axis_rad = 0.3};
    }
    scene.view_count = channels;
    for (std::size_t i = 0; i < channels; ++i) {
        render::ChannelView& view = scene.views[i];
        view.frustum = {-0.5, 0.5, -0.4, 0.4};
        const double turn = 0.3 * static_cast<double>(i) + 0.01;
        view.view_from_enu =
            glm::dmat3{std::cos(turn),      0.1, std::sin(turn), 0.2, std::cos(0.4), 0.3, 0.5, 0.7 / 3.0,
                       std::sin(0.3 + turn)};
    }
    state.eyes.update(123.0, 1.0, false, {});
    state.thinned.set(3);
    state.world_utc_ns = 1'700'000'000'123'456'789;
    state.slots = 2;
    return state;
}

std::vector<std::byte> told(const FrameCoder& coder, const FrameState& state) {
    std::vector<std::byte> bytes(kMostStateBytes);
    bytes.resize(coder.encode(state, bytes));
    return bytes;
}

TEST(FrameCoder, TakesWhatItToldToTheLastBit) {
    const FrameCoder coder;
    const FrameState state = busy_state(6, 3);
    const std::vector<std::byte> bytes = told(coder, state);
    ASSERT_FALSE(bytes.empty());
    auto taken = std::make_unique<FrameState>(busy_state(16, 16));
    ASSERT_TRUE(coder.decode(bytes, *taken));
    // All that the list of fields visits comes out alike: it is told again.
    EXPECT_EQ(told(coder, *taken), bytes);
    EXPECT_EQ(taken->scene.weather.clouds, state.scene.weather.clouds);
    EXPECT_EQ(taken->scene.ground, state.scene.ground);
    EXPECT_EQ(taken->scene.sky, state.scene.sky);
    EXPECT_EQ(taken->scene.night, state.scene.night);
    EXPECT_EQ(taken->scene.air, state.scene.air);
    EXPECT_EQ(taken->scene.overlay.lines[1].text(), "FREEZE 12:00:00");
    EXPECT_EQ(std::memcmp(&taken->scene.views[2].view_from_enu, &state.scene.views[2].view_from_enu,
                          sizeof(glm::dmat3)),
              0);
    EXPECT_EQ(taken->eyes.luminance_cd_m2(), state.eyes.luminance_cd_m2());
    EXPECT_EQ(taken->thinned, state.thinned);
    EXPECT_EQ(taken->world_utc_ns, state.world_utc_ns);
    EXPECT_EQ(taken->slots, 2U);
}

TEST(FrameCoder, UsualFramesAreSmallAndTheLargestThatFitIsTold) {
    const FrameCoder coder;
    const std::size_t usual = told(coder, busy_state(3, 3)).size();
    const std::size_t large = told(coder, busy_state(16, 8)).size();
    std::printf("3 layers, 3 channels: %zu bytes; 16 layers, 8 channels: %zu bytes; 16 and 16: %zu\n", usual,
                large, told(coder, busy_state(16, 16)).size());
    EXPECT_LT(usual, 1200U);
    EXPECT_GT(large, 0U);
    std::array<std::byte, 100> little{};
    EXPECT_EQ(coder.encode(busy_state(3, 3), little), 0U);
}

TEST(FrameCoder, PicturesTravelAsTheirPlaceInTheSettings) {
    const std::vector<float> grey(16 * 16, 0.25F);
    const std::vector<float> dark(16 * 16, 0.125F);
    const std::array<FrameCoder::Picture, 2> here{std::make_shared<Texture>(16, grey),
                                                  std::make_shared<Texture>(16, dark)};
    const std::array<FrameCoder::Picture, 2> there{std::make_shared<Texture>(16, grey),
                                                   std::make_shared<Texture>(16, dark)};
    const FrameCoder leader(here);
    const FrameCoder node(there);
    FrameState state = busy_state(2, 1);
    state.scene.weather.clouds[1].look.emplace();
    // The scene's own copy of the second.
    state.scene.weather.clouds[1].look->tiles[0].picture = std::make_shared<Texture>(16, dark);
    FrameState taken;
    ASSERT_TRUE(node.decode(told(leader, state), taken));
    EXPECT_EQ(taken.scene.weather.clouds[1].look->tiles[0].picture, there[1]);
    state.scene.weather.clouds[1].look->tiles[0].picture =
        std::make_shared<Texture>(16, std::vector<float>(16 * 16, 0.5F));
    EXPECT_TRUE(told(leader, state).empty());
}

TEST(FrameCoder, RefusesWhatIsNoState) {
    const FrameCoder coder;
    const std::vector<std::byte> bytes = told(coder, busy_state(6, 3));
    FrameState taken;
    EXPECT_FALSE(coder.decode({}, taken));
    std::vector<std::byte> other_layout = bytes;
    other_layout[0] = std::byte{FrameCoder::kLayout + 1};
    EXPECT_FALSE(coder.decode(other_layout, taken));
    FrameState not_a_number = busy_state(6, 3);
    not_a_number.scene.eye.height_m = NAN;
    EXPECT_FALSE(coder.decode(told(coder, not_a_number), taken));
    FrameState too_many = busy_state(6, 3);
    too_many.scene.weather.cloud_count = 17;
    EXPECT_FALSE(coder.decode(told(coder, too_many), taken));
}

TEST(FrameCoder, AnyBytesAreTakenOrRefusedWithoutHarm) {
    const FrameCoder coder;
    const std::vector<std::byte> good = told(coder, busy_state(6, 3));
    std::mt19937 random(1);
    FrameState taken;
    int refused = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::vector<std::byte> bytes = good;
        for (int j = 0; j < 3; ++j)
            bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        bytes.resize(random() % 4 == 0 ? random() % bytes.size() : bytes.size());
        if (coder.decode(bytes, taken))
            EXPECT_LE(taken.scene.weather.cloud_count, render::Weather::kMaxClouds);
        else
            ++refused;
    }
    EXPECT_GT(refused, 1000);
}

TEST(FrameCoder, CostsFarLessThanAFrame) {
    const FrameCoder coder;
    const FrameState state = busy_state(6, 3);
    auto taken = std::make_unique<FrameState>();
    std::array<std::byte, kMostStateBytes> bytes{};
    constexpr int kTimes = 500;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kTimes; ++i)
        ASSERT_TRUE(coder.decode(std::span(bytes).first(coder.encode(state, bytes)), *taken));
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    std::printf("a frame is told and taken in %.1f us\n", took.count() / kTimes);
    EXPECT_LT(took.count() / kTimes, 1000.0);
}

}  // namespace
}  // namespace skyig::server::rig
