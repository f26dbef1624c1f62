#include "server/image_writer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace skyig::server {
namespace {

std::vector<render::Channel> two_channels() {
    return {{"left", 4, 3}, {"right", 2, 2}};
}

TEST(ImageWriter, WritesEveryChannelUnderItsNameAndFrameNumber) {
    std::map<std::string, std::vector<std::byte>> files;
    ImageWriter writer(
        {"out", two_channels(), 2},
        [&](const std::string& path, const ImageWriter::Frame& frame, std::size_t channel, std::string&) {
            files[path] = frame.channels[channel];
            return true;
        });
    ImageWriter::Frame* frame = writer.try_acquire();
    ASSERT_NE(frame, nullptr);
    frame->number = 42;
    ASSERT_EQ(frame->channels.size(), 2U);
    EXPECT_EQ(frame->channels[0].size(), 4U * 3 * 4);
    frame->channels[1].assign(frame->channels[1].size(), std::byte{7});
    writer.submit(frame);
    writer.finish();
    ASSERT_EQ(files.size(), 2U);
    EXPECT_EQ(files.at("out/left_000042.png").size(), 48U);
    EXPECT_EQ(files.at("out/right_000042.png"), std::vector<std::byte>(16, std::byte{7}));
    EXPECT_EQ(writer.counts().written, 2U);
    EXPECT_EQ(writer.counts().skipped, 0U);
}

TEST(ImageWriter, SkipsAndCountsWhenAllBuffersAreUnderWay) {
    std::promise<void> disk_ready;
    const std::shared_future<void> ready = disk_ready.get_future().share();
    ImageWriter writer({"out", {{"only", 1, 1}}, 2},
                       [ready](const std::string&, const ImageWriter::Frame&, std::size_t, std::string&) {
                           ready.wait();
                           return true;
                       });
    for (int i = 0; i < 2; ++i) {
        ImageWriter::Frame* frame = writer.try_acquire();
        ASSERT_NE(frame, nullptr);
        writer.submit(frame);
    }
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(writer.try_acquire(), nullptr);
    disk_ready.set_value();
    writer.finish();
    EXPECT_EQ(writer.counts().skipped, 5U);
    EXPECT_EQ(writer.counts().written, 2U);
}

TEST(ImageWriter, WaitsForABufferWhereThatIsWanted) {
    ImageWriter writer({"out", {{"only", 1, 1}}, 1},
                       [](const std::string&, const ImageWriter::Frame&, std::size_t, std::string&) {
                           std::this_thread::sleep_for(std::chrono::milliseconds(5));
                           return true;
                       });
    for (int i = 0; i < 5; ++i)
        writer.submit(writer.acquire());
    writer.finish();
    EXPECT_EQ(writer.counts().skipped, 0U);
    EXPECT_EQ(writer.counts().written, 5U);
}

TEST(ImageWriter, ShowsFramesThatAreNotWrittenToWhoDrawsThem) {
    std::vector<std::string> events;
    ImageWriter::Files files{
        [&](const std::string& path, const ImageWriter::Frame&, std::size_t, std::string&) {
            events.push_back(path);
            return true;
        },
        [&](const ImageWriter::Frame& frame) { events.push_back("seen " + std::to_string(frame.number)); }};
    ImageWriter writer({"d", {{"c", 1, 1}}, 3, ImageWriter::Takes::kScene, "exr"}, std::move(files));
    for (std::uint64_t i = 1; i <= 3; ++i) {
        ImageWriter::Frame* frame = writer.acquire();
        frame->number = i;
        frame->written = i == 3;
        writer.submit(frame);
    }
    writer.finish();
    EXPECT_EQ(events, (std::vector<std::string>{"seen 1", "seen 2", "d/c_000003.exr"}));
    EXPECT_EQ(writer.counts().written, 1U);
}

TEST(ImageWriter, FlushesAllPendingInOrder) {
    std::vector<std::string> paths;
    {
        ImageWriter writer({"d", {{"c", 1, 1}}, 3}, [&](const std::string& path, const ImageWriter::Frame&,
                                                        std::size_t, std::string&) {
            paths.push_back(path);
            return true;
        });
        for (std::uint64_t i = 1; i <= 3; ++i) {
            ImageWriter::Frame* frame = writer.try_acquire();
            ASSERT_NE(frame, nullptr);
            frame->number = i;
            writer.submit(frame);
        }
    }
    EXPECT_EQ(paths, (std::vector<std::string>{"d/c_000001.png", "d/c_000002.png", "d/c_000003.png"}));
}

TEST(ImageWriter, CountsFailuresAndKeepsTheFirstReason) {
    int calls = 0;
    ImageWriter writer({"d", two_channels(), 1}, [&](const std::string& path, const ImageWriter::Frame&,
                                                     std::size_t, std::string& error) {
        error = path + ": disk full " + std::to_string(++calls);
        return false;
    });
    ImageWriter::Frame* frame = writer.try_acquire();
    ASSERT_NE(frame, nullptr);
    writer.submit(frame);
    writer.finish();
    EXPECT_EQ(writer.counts().failed, 2U);
    EXPECT_EQ(writer.counts().written, 0U);
    EXPECT_EQ(writer.first_error(), "d/left_000000.png: disk full 1");
}

}  // namespace
}  // namespace skyig::server
