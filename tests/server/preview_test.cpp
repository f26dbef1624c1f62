// Small pictures: made while asked for, the newest wins, the frame loop never waits.
#include "server/preview.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <string>
#include <thread>

namespace skyig::server {
namespace {

using std::chrono::milliseconds;

constexpr std::int64_t kMs_ns = 1'000'000;

/// Files that tell their first pixel, and a gate that they wait at.
struct Encoder {
    std::atomic<bool> open{true};
    std::atomic<int> begun{0};

    [[nodiscard]] Preview::Encode encode() {
        return [this](int width_px, int height_px, std::span<const std::byte> rgba, int, std::string& file) {
            ++begun;
            while (!open)
                std::this_thread::sleep_for(milliseconds(1));
            file = std::to_string(width_px) + "x" + std::to_string(height_px) + ":" +
                   std::to_string(std::to_integer<int>(rgba[0]));
            return true;
        };
    }
};

/// Fills a channel's picture with one value.
Preview::ReadBack filled(int value) {
    return [value](std::size_t, std::span<std::byte> rgba) {
        for (std::byte& byte : rgba)
            byte = static_cast<std::byte>(value);
    };
}

template <class Condition>
bool soon(const Condition& condition) {
    for (int tries = 0; tries < 2000; ++tries) {
        if (condition()) return true;
        std::this_thread::sleep_for(milliseconds(1));
    }
    return false;
}

TEST(Preview, MakesNothingUntilSomebodyAsksAndStopsWhenNobodyDoes) {
    Encoder encoder;
    Preview preview({{"a", 64, 48}, {"b", 64, 48}}, {}, encoder.encode());
    int read = 0;
    const Preview::ReadBack counts = [&read](std::size_t channel, std::span<std::byte>) {
        EXPECT_EQ(channel, 1U);
        ++read;
    };
    std::int64_t now_ns = 10'000 * kMs_ns;
    preview.offer(now_ns, counts);
    EXPECT_EQ(read, 0);
    EXPECT_EQ(preview.newest(1, now_ns).file, nullptr);
    preview.offer(now_ns, counts);
    EXPECT_EQ(read, 1);
    EXPECT_TRUE(soon([&] { return preview.newest(1, now_ns).number == 1; }));
    // Five a second, and no longer than they are asked for.
    for (int frame = 1; frame <= 180; ++frame)
        preview.offer(now_ns + frame * 1000 * kMs_ns / 60, counts);
    EXPECT_EQ(read, 1 + 10);
}

TEST(Preview, WidePicturesAreMadeSmallerByAWholeFactor) {
    Encoder encoder;
    Preview preview({{"a", 1280, 1024}}, {.width_px = 500}, encoder.encode());
    (void)preview.newest(0, 0);
    preview.offer(1, [](std::size_t, std::span<std::byte> rgba) {
        // The mean of the first 3 x 3 pixels, of which one is lit.
        rgba[0] = std::byte{90};
    });
    ASSERT_TRUE(soon([&] { return preview.newest(0, 1).number == 1; }));
    EXPECT_EQ(*preview.newest(0, 1).file, "426x341:10");
}

TEST(Preview, TheNewestFrameWinsAndTheFrameLoopNeverWaits) {
    Encoder encoder;
    Preview preview({{"a", 8, 8}}, {.rate_hz = 30.0}, encoder.encode());
    (void)preview.newest(0, 0);
    encoder.open = false;
    preview.offer(1, filled(1));
    ASSERT_TRUE(soon([&] { return encoder.begun == 1; }));
    // While the first is held up, these come and go without anyone waiting.
    for (int i = 2; i <= 9; ++i)
        preview.offer(i * 100 * kMs_ns, filled(i));
    encoder.open = true;
    ASSERT_TRUE(soon([&] { return preview.newest(0, 1).number == 2; }));
    EXPECT_EQ(*preview.newest(0, 1).file, "8x8:9");
    EXPECT_EQ(encoder.begun, 2);
}

TEST(Preview, NoFrameReadsBackAllOfARigAndNoChannelIsPassedOver) {
    Encoder encoder;
    Preview preview({{"a", 8, 8}, {"b", 8, 8}, {"c", 8, 8}}, {.rate_hz = 30.0}, encoder.encode());
    std::array<int, 3> reads{};
    for (int frame = 0; frame < 30; ++frame) {
        const std::int64_t now_ns = (1 + frame) * 100 * kMs_ns;
        for (std::size_t i = 0; i < reads.size(); ++i)
            (void)preview.newest(i, now_ns);
        int in_frame = 0;
        preview.offer(now_ns, [&](std::size_t channel, std::span<std::byte>) {
            ++reads[channel];
            ++in_frame;
        });
        EXPECT_EQ(in_frame, 1);
    }
    EXPECT_EQ(reads, (std::array<int, 3>{10, 10, 10}));
}

TEST(Preview, FindsChannelsByName) {
    Encoder encoder;
    const Preview preview({{"left", 8, 8}, {"right", 8, 8}}, {}, encoder.encode());
    EXPECT_EQ(preview.find("right"), 1U);
    EXPECT_FALSE(preview.find("middle"));
}

}  // namespace
}  // namespace skyig::server
