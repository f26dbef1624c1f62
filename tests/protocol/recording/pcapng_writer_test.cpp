// What the recorder writes reads back, and whatever cuts it off leaves whole blocks.
#include "protocol/recording/pcapng_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "protocol/recording/capture_reader.h"
#include "tests/protocol/recording/capture_bytes.h"

namespace skyig::protocol::recording {
namespace {

using testing::HasSubstr;
constexpr transport::Endpoint kHost{0xC0A80102, 8005};
constexpr transport::Endpoint kUs{0x7F000001, 8004};

/// Keeps what is written, and where each call ended.
struct Kept {
    [[nodiscard]] BlockSink sink() {
        return [this](std::span<const std::byte> blocks) {
            bytes.insert(bytes.end(), blocks.begin(), blocks.end());
            ends.push_back(bytes.size());
            return true;
        };
    }
    ByteVector bytes;
    std::vector<std::size_t> ends;
};

PcapngWriter begin(Kept& kept, const RecordingHead& head) {
    auto writer = PcapngWriter::begin(kept.sink(), head);
    EXPECT_TRUE(writer.has_value());
    return std::move(*writer);
}

CaptureReader reader_of(const ByteVector& bytes) {
    auto reader = CaptureReader::over(bytes, "FILE");
    EXPECT_TRUE(reader.has_value());
    return std::move(*reader);
}

/// One of each kind, on two buses.
std::vector<CanFrame> frames() {
    std::vector<CanFrame> all(6);
    all[0] = {.received_ns = kTime_ns, .id = 0x7FF, .length = 8};
    all[1] = {.received_ns = kTime_ns + 1, .id = 0x1ABCDEF0, .length = 0, .bus = 1, .extended = true};
    all[2] = {.received_ns = kTime_ns + 2, .id = 0x123, .length = 5, .remote = true};
    all[3] = {.received_ns = kTime_ns + 3, .id = 0x4, .length = 8, .error = true};
    all[4] = {.received_ns = kTime_ns + 4, .id = 0x321, .length = 64, .bus = 1, .fd = true, .fd_flags = 5};
    all[5] = {.received_ns = kTime_ns + 5, .id = 0x321, .length = 3, .fd = true, .fd_flags = 4};
    for (CanFrame& frame : all)
        if (!frame.remote) std::iota(frame.data.begin(), frame.data.begin() + frame.length, std::uint8_t{1});
    return all;
}

TEST(PcapngWriter, DatagramsReadBack) {
    Kept kept;
    PcapngWriter writer = begin(kept, {.comment = "two\nlines of Größe"});
    const std::vector<std::string> payloads{"", "a", "ab", "abc", "abcd", std::string(65'507, 'm')};
    std::int64_t time_ns = kTime_ns;
    for (const std::string& payload : payloads) {
        EXPECT_TRUE(writer.write_udp(time_ns++, kHost, kUs, std::as_bytes(std::span(payload)),
                                     payload.size() == 3 ? "größer" : ""));
    }
    EXPECT_EQ(writer.written(), payloads.size());
    EXPECT_EQ(writer.written_bytes(), kept.bytes.size());
    CaptureReader reader = reader_of(kept.bytes);
    EXPECT_EQ(reader.section_comment(), "two\nlines of Größe");
    ASSERT_EQ(reader.interfaces().size(), 0U);  // they come with the blocks behind the section's
    time_ns = kTime_ns;
    for (const std::string& payload : payloads) {
        const CapturedPacket* packet = reader.next();
        ASSERT_NE(packet, nullptr) << reader.trouble();
        EXPECT_EQ(packet->kind, CapturedPacket::Kind::kUdp);
        EXPECT_EQ(packet->time_ns, time_ns++);
        EXPECT_EQ(packet->from, kHost);
        EXPECT_EQ(packet->to, kUs);
        EXPECT_EQ(text_of(packet->payload), payload);
        EXPECT_EQ(packet->comment, payload.size() == 3 ? "größer" : "");
    }
    EXPECT_EQ(reader.next(), nullptr);
    EXPECT_EQ(reader.end(), CaptureReader::End::kComplete) << reader.trouble();
}

TEST(PcapngWriter, CanFramesReadBackOnTheirBuses) {
    Kept kept;
    PcapngWriter writer = begin(kept, {.can_names = {"can0", "vcan1"}});
    for (const CanFrame& frame : frames())
        EXPECT_TRUE(writer.write_can(frame));
    CaptureReader reader = reader_of(kept.bytes);
    for (const CanFrame& frame : frames()) {
        const CapturedPacket* packet = reader.next();
        ASSERT_NE(packet, nullptr) << reader.trouble();
        EXPECT_EQ(packet->can, frame) << std::hex << frame.id;
        EXPECT_EQ(reader.interface_of_last().name, frame.bus == 0 ? "can0" : "vcan1");
    }
    EXPECT_EQ(reader.next(), nullptr);
    EXPECT_EQ(reader.end(), CaptureReader::End::kComplete);
}

TEST(PcapngWriter, EveryCallToTheSinkIsWholeBlocks) {
    Kept kept;
    PcapngWriter writer = begin(kept, {.comment = "head", .can_names = {"can0"}});
    EXPECT_TRUE(writer.write_udp(kTime_ns, kHost, kUs, std::as_bytes(std::span("payload", 7)), "comment"));
    EXPECT_TRUE(writer.write_can({.received_ns = kTime_ns, .id = 1, .length = 1}));
    ASSERT_EQ(kept.ends.size(), 3U);
    for (std::size_t calls = 0; calls < kept.ends.size(); ++calls) {
        auto reader = CaptureReader::over(std::span(kept.bytes).first(kept.ends[calls]), "FILE");
        ASSERT_TRUE(reader.has_value());
        std::size_t packets = 0;
        while (reader->next() != nullptr)
            ++packets;
        EXPECT_EQ(packets, calls);
        EXPECT_EQ(reader->end(), CaptureReader::End::kComplete) << reader->trouble();
    }
}

TEST(PcapngWriter, LongTextsAreDividedBetweenLinesAndJoinedAgain) {
    std::string text;
    while (text.size() < 300'000)
        text += "line " + std::to_string(text.size()) + " with some text\n";
    Kept kept;
    static_cast<void>(begin(kept, {.comment = text}));
    EXPECT_EQ(reader_of(kept.bytes).section_comment(), text);

    std::string one_line;  // without any place to divide it: characters stay whole all the same
    while (one_line.size() < 70'000)
        one_line += "ö";
    one_line.insert(0, 1, 'x');
    Kept other;
    static_cast<void>(begin(other, {.comment = one_line}));
    std::string joined(reader_of(other.bytes).section_comment());
    const std::size_t division = joined.find('\n');
    ASSERT_NE(division, std::string::npos);
    EXPECT_EQ(division % 2, 1U);
    joined.erase(division, 1);
    EXPECT_EQ(joined, one_line);
}

TEST(PcapngWriter, APacketsCommentIsCutBetweenCharacters) {
    std::string comment = "x";
    while (comment.size() < 2 * PcapngWriter::kMaxPacketCommentBytes)
        comment += "ö";
    Kept kept;
    PcapngWriter writer = begin(kept, {});
    EXPECT_TRUE(writer.write_udp(kTime_ns, kHost, kUs, ByteVector(65'507), comment));
    CaptureReader reader = reader_of(kept.bytes);
    const CapturedPacket* packet = reader.next();
    ASSERT_NE(packet, nullptr);
    EXPECT_EQ(packet->comment, comment.substr(0, PcapngWriter::kMaxPacketCommentBytes - 1));
}

TEST(PcapngWriter, RefusesWhatCannotBeWritten) {
    Kept kept;
    PcapngWriter writer = begin(kept, {.can_names = {"can0"}});
    const std::size_t before = kept.bytes.size();
    EXPECT_FALSE(writer.write_udp(kTime_ns, kHost, kUs, ByteVector(65'508)));
    EXPECT_FALSE(writer.write_can({.bus = 1}));
    EXPECT_EQ(writer.refused(), 2U);
    EXPECT_EQ(kept.bytes.size(), before);

    bool takes = true;
    auto full = PcapngWriter::begin([&takes](std::span<const std::byte> /*blocks*/) { return takes; }, {});
    ASSERT_TRUE(full.has_value());
    takes = false;
    EXPECT_FALSE(full->write_udp(kTime_ns, kHost, kUs, {}));
    EXPECT_EQ(full->written(), 0U);
    EXPECT_EQ(full->refused(), 1U);
    const auto none = PcapngWriter::begin([](std::span<const std::byte> /*blocks*/) { return false; }, {});
    ASSERT_FALSE(none.has_value());
    EXPECT_EQ(none.error(), "the recording's header could not be written");
}

TEST(PcapngWriter, RefusesHeadsThatAreTooLong) {
    const auto error_of = [](const RecordingHead& head) {
        Kept kept;
        const auto writer = PcapngWriter::begin(kept.sink(), head);
        EXPECT_FALSE(writer.has_value());
        EXPECT_TRUE(kept.bytes.empty());
        return writer ? "" : writer.error();
    };
    EXPECT_EQ(error_of({.comment = std::string(600'000, 'x')}),
              "the recording's comment has 600000 bytes; 524288 at most");
    EXPECT_THAT(error_of({.can_names = {std::string(65, 'c')}}), HasSubstr("has 65 bytes; 64 at most"));
    EXPECT_EQ(error_of({.can_names = std::vector<std::string>(257, "can")}), "257 CAN buses; 256 at most");
}

TEST(PcapngWriter, TimesBefore1970AreWrittenAs1970) {
    Kept kept;
    PcapngWriter writer = begin(kept, {});
    EXPECT_TRUE(writer.write_udp(-1, kHost, kUs, {}));
    CaptureReader reader = reader_of(kept.bytes);
    const CapturedPacket* packet = reader.next();
    ASSERT_NE(packet, nullptr);
    EXPECT_EQ(packet->time_ns, 0);
}

}  // namespace
}  // namespace skyig::protocol::recording
