// What the walk over a message does with bad sizes, strange ids and doubled first packets.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "protocol/cigi/message.h"

namespace skyig::protocol::cigi {
namespace {

/// Which packets came through, in order.
struct Kinds {
    template <class P>
    void operator()(const P& /*packet*/, const PacketInfo& info) {
        kinds.push_back(kPacketKind<P>);
        offsets.push_back(info.offset);
    }
    void skipped(const PacketInfo& info) { skipped_ids.push_back(info.id); }

    std::vector<std::size_t> kinds;
    std::vector<std::uint32_t> offsets;
    std::vector<std::uint16_t> skipped_ids;
};

class Framing : public testing::TestWithParam<std::tuple<Version, ByteOrder>> {
  protected:
    Framing() : writer(buffer, std::get<0>(GetParam()), std::get<1>(GetParam())) {
        EXPECT_TRUE(writer.add(IgControl{}));
    }

    /// A header of any id and size, with `total` bytes in all.
    void add_raw(std::uint16_t id, std::uint16_t size, std::size_t total) {
        std::vector<std::byte> bytes(total);
        if (writer.version() == Version::k33) {
            if (total > 0) bytes[0] = static_cast<std::byte>(id);
            if (total > 1) bytes[1] = static_cast<std::byte>(size);
        } else if (total >= 4) {
            store(bytes.data(), writer.order(), size);
            store(bytes.data() + 2, writer.order(), id);
        }
        ASSERT_TRUE(writer.add_raw(bytes));
    }
    [[nodiscard]] std::uint16_t id_of_celestial() const { return writer.version() == Version::k33 ? 9 : 8; }
    [[nodiscard]] std::uint16_t user_id() const { return writer.version() == Version::k33 ? 201 : 0x1234; }

    MessageSummary decode() { return decode_host_message(writer.bytes(), kinds, counters); }

    std::array<std::byte, 1024> buffer{};
    MessageWriter writer;
    Kinds kinds;
    Counters counters;
};

TEST_P(Framing, SizeBelowTheHeaderStopsTheWalkAndKeepsWhatCameBefore) {
    const auto header = static_cast<std::uint16_t>(header_bytes(writer.version()));
    for (std::uint16_t size = 0; size < header; ++size) {
        writer.clear();
        kinds = {};
        counters = {};
        ASSERT_TRUE(writer.add(IgControl{}));
        ASSERT_TRUE(writer.add(AtmosphereControl{}));
        const auto before = static_cast<std::uint32_t>(writer.bytes().size());
        add_raw(id_of_celestial(), size, 16);
        ASSERT_TRUE(writer.add(ViewControl{}));
        const MessageSummary summary = decode();
        EXPECT_TRUE(summary.accepted);
        EXPECT_EQ(summary.fault, Count::kBadSize);
        EXPECT_EQ(summary.offset, before);
        EXPECT_EQ(kinds.kinds, (std::vector{kPacketKind<IgControl>, kPacketKind<AtmosphereControl>}));
        EXPECT_EQ(counters[Count::kBadSize], 1U);
    }
}

TEST_P(Framing, SizeBeyondTheDatagramIsTruncated) {
    ASSERT_TRUE(writer.add(AtmosphereControl{}));
    add_raw(id_of_celestial(), 24, 16);
    const MessageSummary summary = decode();
    EXPECT_EQ(summary.fault, Count::kTruncated);
    EXPECT_EQ(kinds.kinds.size(), 2U);
    EXPECT_EQ(counters[Count::kTruncated], 1U);
}

TEST_P(Framing, LessThanAHeaderLeftIsTruncated) {
    for (std::size_t left = 1; left < header_bytes(writer.version()); ++left) {
        writer.clear();
        ASSERT_TRUE(writer.add(IgControl{}));
        add_raw(1, 1, left);
        EXPECT_EQ(decode().fault, Count::kTruncated);
    }
    EXPECT_EQ(counters[Count::kTruncated], header_bytes(writer.version()) - 1);
}

TEST_P(Framing, KnownIdOfAnotherSizeIsPassedOver) {
    add_raw(id_of_celestial(), 32, 32);
    ASSERT_TRUE(writer.add(AtmosphereControl{}));
    const MessageSummary summary = decode();
    EXPECT_FALSE(summary.fault);
    EXPECT_EQ(counters[Count::kWrongSize], 1U);
    EXPECT_EQ(kinds.kinds, (std::vector{kPacketKind<IgControl>, kPacketKind<AtmosphereControl>}));
}

TEST_P(Framing, APacketThatIsPassedOverIsNamedWithItsReason) {
    struct Watch {
        void passed_over(const RefusedPacket& packet, const PacketInfo& info) {
            seen.emplace_back(packet.kind, packet.reason, info.offset);
        }
        std::vector<std::tuple<std::size_t, Count, std::uint32_t>> seen;
    };
    add_raw(id_of_celestial(), 32, 32);
    ASSERT_TRUE(writer.add(IgControl{}));
    Watch watch;
    static_cast<void>(decode_host_message(writer.bytes(), watch, counters));
    ASSERT_EQ(watch.seen.size(), 2U);
    EXPECT_EQ(watch.seen[0], std::tuple(kPacketKind<CelestialSphereControl>, Count::kWrongSize, 24U));
    EXPECT_EQ(watch.seen[1], std::tuple(kPacketKind<IgControl>, Count::kDuplicateIgControl, 56U));
}

TEST_P(Framing, ATextMayBeUnpaddedAndUnendedButNotLongerThanItsPacketMayBe) {
    struct Texts {
        void operator()(const IgMessage& message) { texts.emplace_back(message.text); }
        std::vector<std::string> texts;
    };
    const auto header = header_bytes(writer.version());
    const std::size_t offset = writer.version() == Version::k33 ? 4 : 8;
    const std::uint16_t id = writer.version() == Version::k33 ? 117 : 0x0FF0;
    writer.clear();
    ASSERT_TRUE(writer.add(StartOfFrame{}));
    add_raw(id, static_cast<std::uint16_t>(offset), offset);  // no text at all
    const std::size_t at = writer.bytes().size();
    add_raw(id, static_cast<std::uint16_t>(offset + 3), offset + 3);
    std::fill_n(buffer.begin() + static_cast<std::ptrdiff_t>(at + offset), 3, std::byte{'a'});
    add_raw(id, 112, 112);
    add_raw(id, static_cast<std::uint16_t>(header), header);
    Texts texts;
    EXPECT_FALSE(decode_ig_message(writer.bytes(), texts, counters).fault);
    const bool old = writer.version() == Version::k33;
    EXPECT_EQ(texts.texts,
              old ? (std::vector<std::string>{"", "aaa"}) : (std::vector<std::string>{"", "aaa", ""}));
    EXPECT_EQ(counters[Count::kWrongSize], old ? 2U : 1U);
}

TEST_P(Framing, UnknownIdsAreSkippedByTheirSize) {
    add_raw(user_id(), 40, 40);
    add_raw(writer.version() == Version::k33 ? 101 : 0x0FFF, 24,
            24);  // an IG's packet means nothing to an IG
    ASSERT_TRUE(writer.add(AtmosphereControl{}));
    EXPECT_FALSE(decode().fault);
    EXPECT_EQ(counters[Count::kSkipped], 2U);
    EXPECT_EQ(kinds.skipped_ids.at(0), user_id());
    EXPECT_EQ(kinds.offsets.back(), 24U + 40U + 24U);
}

TEST_P(Framing, ASecondIgControlIsIgnored) {
    ASSERT_TRUE(writer.add(AtmosphereControl{}));
    ASSERT_TRUE(writer.add(IgControl{}));
    ASSERT_TRUE(writer.add(IgControl{}));
    EXPECT_FALSE(decode().fault);
    EXPECT_EQ(counters[Count::kDuplicateIgControl], 2U);
    EXPECT_EQ(kinds.kinds, (std::vector{kPacketKind<IgControl>, kPacketKind<AtmosphereControl>}));
}

TEST_P(Framing, ASecondStartOfFrameIsIgnored) {
    writer.clear();
    ASSERT_TRUE(writer.add(StartOfFrame{}));
    ASSERT_TRUE(writer.add(StartOfFrame{}));
    const MessageSummary summary = decode_ig_message(writer.bytes(), kinds, counters);
    EXPECT_TRUE(summary.accepted);
    EXPECT_EQ(counters[Count::kDuplicateStartOfFrame], 1U);
    EXPECT_EQ(kinds.kinds.size(), 1U);
}

TEST_P(Framing, ARefusedIgControlDoesNotVoidTheRest) {
    writer.clear();
    ASSERT_TRUE(writer.add(IgControl{.ig_mode = IgMode::kOfflineMaintenance}));
    ASSERT_TRUE(writer.add(AtmosphereControl{}));
    EXPECT_TRUE(decode().accepted);
    EXPECT_EQ(counters[Count::kOutOfRange], 1U);
    EXPECT_EQ(kinds.kinds, (std::vector{kPacketKind<AtmosphereControl>}));
}

TEST_P(Framing, TheLargestDatagramOfTheSmallestPacketsIsWalkedToItsEnd) {
    std::vector<std::byte> large(kMaxMessageBytes);
    MessageWriter big(large, writer.version(), writer.order());
    ASSERT_TRUE(big.add(IgControl{}));
    std::uint64_t added = 0;
    while (big.add(PositionRequest{}))
        ++added;
    EXPECT_FALSE(decode_host_message(big.bytes(), kinds, counters).fault);
    EXPECT_EQ(counters.packets_of<PositionRequest>(), added);
    EXPECT_EQ(added, (kMaxMessageBytes - 24) / 8);
}

TEST_P(Framing, AWriterWithoutRoomWritesNothing) {
    std::array<std::byte, 48> small{};
    MessageWriter tight(small, writer.version(), writer.order());
    EXPECT_TRUE(tight.add(IgControl{}));
    EXPECT_FALSE(tight.add(AtmosphereControl{}));
    EXPECT_EQ(tight.bytes().size(), 24U);
    EXPECT_EQ(std::to_integer<int>(small[24]), 0);
    EXPECT_TRUE(tight.add(PositionRequest{}));
    EXPECT_FALSE(tight.add_raw(std::array<std::byte, 24>{}));
}

TEST_P(Framing, AHandlerWithoutAnOverloadStillCountsThePacket) {
    ASSERT_TRUE(writer.add(AtmosphereControl{.humidity = 7}));
    int humidity = 0;
    const auto only_air = [&humidity](const AtmosphereControl& air) { humidity = air.humidity; };
    static_cast<void>(decode_host_message(writer.bytes(), only_air, counters));
    EXPECT_EQ(humidity, 7);
    EXPECT_EQ(counters.packets_of<IgControl>(), 1U);
    EXPECT_EQ(counters.messages, 1U);
}

TEST_P(Framing, TheWriterStampsItsOwnVersionUnlessTheStructHasIt) {
    const bool is33 = writer.version() == Version::k33;
    std::vector<int> seen;
    const auto note = [&seen](const IgControl& control) {
        seen = {control.major_version, control.minor_version, control.byte_swap};
    };
    static_cast<void>(decode_host_message(writer.bytes(), note, counters));
    EXPECT_EQ(seen, is33 ? (std::vector{3, 3, 0x8000}) : (std::vector{4, 0, 0x8000}));

    writer.clear();
    const auto own_major = static_cast<std::uint8_t>(is33 ? 3 : 4);
    ASSERT_TRUE(writer.add(IgControl{.major_version = own_major, .minor_version = 2}));
    static_cast<void>(decode_host_message(writer.bytes(), note, counters));
    EXPECT_EQ(seen[1], 2);
}

INSTANTIATE_TEST_SUITE_P(Both, Framing,
                         testing::Combine(testing::Values(Version::k33, Version::k40),
                                          testing::Values(ByteOrder::kLittle, ByteOrder::kBig)));

TEST(Writer, APacketThatTheVersionLacksIsNotWritten) {
    std::array<std::byte, 128> buffer{};
    MessageWriter old(buffer, Version::k33, ByteOrder::kLittle);
    EXPECT_FALSE(old.add(EntityPosition{}));
    EXPECT_TRUE(old.bytes().empty());
}

std::string message_text(const MessageWriter& writer) {
    std::string text;
    Counters counters;
    static_cast<void>(decode_ig_message(
        writer.bytes(), [&text](const IgMessage& message) { text = message.text; }, counters));
    return text;
}

TEST(Writer, MessageTextIsCutPaddedAndReadBack) {
    for (const Version version : {Version::k33, Version::k40}) {
        for (const std::size_t length : {0U, 1U, 3U, 4U, 99U, 100U, 300U}) {
            std::array<std::byte, 512> buffer{};
            MessageWriter writer(buffer, version, ByteOrder::kBig);
            ASSERT_TRUE(writer.add(StartOfFrame{}));
            const std::string text(length, 'x');
            ASSERT_TRUE(writer.add(IgMessage{.message_id = 1, .text = text}));
            EXPECT_EQ(writer.bytes().size() % 8, 0U);
            EXPECT_EQ(message_text(writer), text.substr(0, version == Version::k33 ? 99 : length));
            if (version == Version::k33) {
                EXPECT_LE(writer.bytes().size(), 24U + 104U);
            }
        }
    }
}

TEST(Writer, MessageTextWithoutNulIsAccepted) {
    std::array<std::byte, 64> buffer{};
    MessageWriter writer(buffer, Version::k33, ByteOrder::kLittle);
    ASSERT_TRUE(writer.add(StartOfFrame{}));
    const std::array<std::byte, 7> bare{std::byte{117}, std::byte{7},   std::byte{1},  std::byte{0},
                                        std::byte{'a'}, std::byte{'b'}, std::byte{'c'}};
    ASSERT_TRUE(writer.add_raw(bare));
    EXPECT_EQ(message_text(writer), "abc");
}

}  // namespace
}  // namespace skyig::protocol::cigi
