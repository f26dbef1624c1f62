// The first bytes decide: version, byte order, or why the datagram is dropped.
#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "protocol/cigi/message.h"

namespace skyig::protocol::cigi {
namespace {

using Bytes24 = std::array<std::byte, 24>;

Bytes24 start_with(std::initializer_list<int> first) {
    Bytes24 bytes{};
    std::size_t i = 0;
    for (const int octet : first)
        bytes[i++] = static_cast<std::byte>(octet);
    return bytes;
}

struct Row {
    const char* what;
    std::initializer_list<int> first;
    std::optional<Count> fault;
    Version version = Version::k33;
    ByteOrder order = ByteOrder::kLittle;
};

void expect_row(const Row& row, const MessageSummary& found) {
    SCOPED_TRACE(row.what);
    EXPECT_EQ(found.fault, row.fault);
    EXPECT_EQ(found.accepted, !row.fault.has_value());
    if (!row.fault) {
        EXPECT_EQ(found.version, row.version);
        EXPECT_EQ(found.order, row.order);
    }
}

TEST(Detect, HostMessageByItsFirstPacket) {
    const Row rows[] = {
        {"3.3 little", {1, 24, 3, 0, 0x30, 0, 0x00, 0x80}, {}, Version::k33, ByteOrder::kLittle},
        {"3.3 big", {1, 24, 3, 0, 0x30, 0, 0x80, 0x00}, {}, Version::k33, ByteOrder::kBig},
        {"3.2 little", {1, 24, 3, 0, 0x20, 0, 0x00, 0x80}, {}, Version::k33, ByteOrder::kLittle},
        {"3.3 without magic", {1, 24, 3, 0, 0x30, 0, 0, 0}, Count::kBadMagic},
        {"3.3 with both magic bytes", {1, 24, 3, 0, 0x30, 0, 0x80, 0x80}, Count::kBadMagic},
        {"3.0", {1, 16, 3, 0, 0, 0, 0x00, 0x80}, Count::kBadVersion},
        {"CIGI 1", {1, 20, 1}, Count::kBadVersion},
        {"CIGI 2", {1, 24, 2}, Count::kBadVersion},
        {"CIGI 5 in the old form", {1, 24, 5}, Count::kBadVersion},
        {"4.0 little", {0x18, 0, 0, 0, 4}, {}, Version::k40, ByteOrder::kLittle},
        {"4.0 big", {0, 0x18, 0, 0, 4}, {}, Version::k40, ByteOrder::kBig},
        {"5 little", {0x18, 0, 0, 0, 5}, Count::kBadVersion},
        {"5 big", {0, 0x18, 0, 0, 5}, Count::kBadVersion},
        {"Start of Frame 3.3", {101, 24, 3, 0, 0, 0, 0x00, 0x80}, Count::kFirstPacket},
        {"Start of Frame 4.0", {0x18, 0, 0xFF, 0xFF, 4}, Count::kFirstPacket},
        {"Entity Control first", {2, 48, 0, 0}, Count::kFirstPacket},
        {"IG Control of a strange size", {1, 32, 3}, Count::kFirstPacket},
        {"4.0 IG Control of a strange size", {0x20, 0, 0, 0, 4}, Count::kFirstPacket},
        {"zeros", {0}, Count::kFirstPacket},
        {"text", {'G', 'E', 'T', ' '}, Count::kFirstPacket},
    };
    for (const Row& row : rows)
        expect_row(row, detect_host_message(start_with(row.first)));
}

TEST(Detect, IgMessageByItsFirstPacket) {
    const Row rows[] = {
        {"3.3 little", {101, 24, 3, 0, 0, 0, 0x00, 0x80}, {}, Version::k33, ByteOrder::kLittle},
        {"3.3 big", {101, 24, 3, 0, 0, 0, 0x80, 0x00}, {}, Version::k33, ByteOrder::kBig},
        {"3.3 without magic", {101, 24, 3}, Count::kBadMagic},
        {"3.0", {101, 16, 3}, Count::kBadVersion},
        {"4.0 little", {0x18, 0, 0xFF, 0xFF, 4}, {}, Version::k40, ByteOrder::kLittle},
        {"4.0 big", {0, 0x18, 0xFF, 0xFF, 4}, {}, Version::k40, ByteOrder::kBig},
        {"5", {0x18, 0, 0xFF, 0xFF, 5}, Count::kBadVersion},
        {"IG Control 3.3", {1, 24, 3, 0, 0x30, 0, 0x00, 0x80}, Count::kFirstPacket},
        {"IG Control 4.0", {0x18, 0, 0, 0, 4}, Count::kFirstPacket},
    };
    for (const Row& row : rows)
        expect_row(row, detect_ig_message(start_with(row.first)));
}

TEST(Detect, AnythingShorterThanTheFirstPacketIsShort) {
    const Bytes24 bytes = start_with({1, 24, 3, 0, 0x30, 0, 0x00, 0x80});
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const MessageSummary found = detect_host_message(std::span(bytes).first(size));
        EXPECT_EQ(found.fault, Count::kShort);
        EXPECT_EQ(found.offset, size);
    }
}

TEST(Detect, EveryCountHasANameAndASentence) {
    for (std::size_t i = 0; i < kCounts; ++i) {
        EXPECT_FALSE(count_name(static_cast<Count>(i)).empty());
        EXPECT_GT(count_text(static_cast<Count>(i)).size(), count_name(static_cast<Count>(i)).size());
    }
    EXPECT_EQ(count_name(Count::kShort), "short");
    EXPECT_EQ(count_name(Count::kDuplicateStartOfFrame), "duplicate_start_of_frame");
}

}  // namespace
}  // namespace skyig::protocol::cigi
