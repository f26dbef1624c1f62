// What a captured packet holds, by link type.
#include "protocol/recording/link_layer.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/protocol/recording/capture_bytes.h"

namespace skyig::protocol::recording {
namespace {

Contents take(std::uint32_t link, const ByteVector& bytes, CapturedPacket& packet, bool whole = true) {
    return take_apart(link, bytes, whole, ByteOrder::kLittle, packet);
}

void expect_datagram(std::uint32_t link, const ByteVector& bytes, std::string_view payload) {
    CapturedPacket packet;
    ASSERT_EQ(take(link, bytes, packet), Contents::kUdp);
    EXPECT_EQ(packet.kind, CapturedPacket::Kind::kUdp);
    EXPECT_EQ(packet.from, (transport::Endpoint{0x0A000001, 1000}));
    EXPECT_EQ(packet.to, (transport::Endpoint{0x0A000002, 2000}));
    EXPECT_EQ(text_of(packet.payload), payload);
}

Contents contents_of(std::uint32_t link, const ByteVector& bytes, bool whole = true) {
    CapturedPacket packet;
    return take(link, bytes, packet, whole);
}

/// Addresses, then the tags and the protocol in `words`.
ByteVector ethernet(std::initializer_list<unsigned> words, const ByteVector& inside) {
    Builder frame = big_endian();
    frame.u32(1).u32(2).u32(3);
    for (const unsigned word : words)
        frame.u16(word);
    return frame.raw(inside).bytes;
}

ByteVector cooked(unsigned protocol, const ByteVector& inside) {
    return big_endian().u16(0).u16(1).u16(6).u64(0).u16(protocol).raw(inside).bytes;
}

ByteVector cooked2(unsigned protocol, const ByteVector& inside) {
    return big_endian().u16(protocol).u16(0).u32(3).u16(1).u8(0).u8(6).u64(0).raw(inside).bytes;
}

TEST(LinkLayer, DatagramsAreFoundBehindEveryHeader) {
    const ByteVector datagram = ipv4_udp("payload");
    expect_datagram(link_type::kRaw, datagram, "payload");
    expect_datagram(link_type::kIpv4, datagram, "payload");
    expect_datagram(link_type::kEthernet, ethernet({0x0800}, datagram), "payload");
    expect_datagram(link_type::kEthernet, ethernet({0x8100, 5, 0x0800}, datagram), "payload");
    expect_datagram(link_type::kEthernet, ethernet({0x88A8, 5, 0x8100, 6, 0x0800}, datagram), "payload");
    expect_datagram(link_type::kLinuxCooked, cooked(0x0800, datagram), "payload");
    expect_datagram(link_type::kLinuxCooked2, cooked2(0x0800, datagram), "payload");
    expect_datagram(link_type::kNull, big_endian().u32(2).raw(datagram).bytes, "payload");
    expect_datagram(link_type::kNull, Builder(ByteOrder::kLittle).u32(2).raw(datagram).bytes, "payload");
    expect_datagram(link_type::kLoop, big_endian().u32(2).raw(datagram).bytes, "payload");
}

TEST(LinkLayer, PaddingAndChecksumsBehindADatagramAreNotPayload) {
    ByteVector padded = ethernet({0x0800}, ipv4_udp("ab"));
    padded.resize(64);
    expect_datagram(link_type::kEthernet, padded, "ab");
    expect_datagram(link_type::kRaw, ipv4_udp(""), "");
}

TEST(LinkLayer, OptionsOfIpv4ArePassedOver) {
    ByteVector bytes = ipv4_udp("payload");
    bytes[0] = std::byte{0x46};
    store(bytes.data() + 2, ByteOrder::kBig, static_cast<std::uint16_t>(bytes.size() + 4));
    bytes.insert(bytes.begin() + 20, 4, std::byte{1});
    expect_datagram(link_type::kRaw, bytes, "payload");
}

TEST(LinkLayer, OtherTrafficIsTold) {
    EXPECT_EQ(contents_of(link_type::kRaw, ipv4_udp("x", 0x2000)), Contents::kFragment);
    EXPECT_EQ(contents_of(link_type::kRaw, ipv4_udp("x", 0x0001)), Contents::kFragment);
    EXPECT_EQ(contents_of(link_type::kRaw, ipv4_udp("x", 0x4000)), Contents::kUdp);
    EXPECT_EQ(contents_of(link_type::kRaw, ipv4_udp("x", 0, 6)), Contents::kOtherProtocol);
    EXPECT_EQ(contents_of(link_type::kRaw, ByteVector(40, std::byte{0x60})), Contents::kIpv6);
    EXPECT_EQ(contents_of(link_type::kEthernet, ethernet({0x86DD}, {})), Contents::kIpv6);
    EXPECT_EQ(contents_of(link_type::kEthernet, ethernet({0x0806}, {})), Contents::kOtherProtocol);
    EXPECT_EQ(contents_of(link_type::kNull, big_endian().u32(30).bytes), Contents::kIpv6);
    EXPECT_EQ(contents_of(link_type::kNull, big_endian().u32(7).bytes), Contents::kOtherProtocol);
    EXPECT_EQ(contents_of(147, ipv4_udp("x")), Contents::kUnknownLink);
}

TEST(LinkLayer, ACutPacketIsMalformedOnlyIfItWasWhole) {
    for (const auto& [link, bytes] :
         {std::pair{link_type::kRaw, ipv4_udp("payload")},
          std::pair{link_type::kEthernet, ethernet({0x8100, 5, 0x0800}, ipv4_udp("payload"))},
          std::pair{link_type::kLinuxCooked2, cooked2(0x0800, ipv4_udp("payload"))},
          std::pair{link_type::kSocketCan, can_bytes(0x123, "1234")}}) {
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            const ByteVector part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
            EXPECT_EQ(contents_of(link, part, false), Contents::kCutShort) << link << ", " << size;
            EXPECT_EQ(contents_of(link, part, true), Contents::kMalformed) << link << ", " << size;
        }
    }
}

TEST(LinkLayer, HeadersThatContradictThemselvesAreMalformed) {
    const auto with = [](std::size_t offset, unsigned value) {
        ByteVector bytes = ipv4_udp("payload");
        bytes[offset] = static_cast<std::byte>(value);
        return contents_of(link_type::kRaw, bytes, false);
    };
    EXPECT_EQ(with(0, 0x55), Contents::kMalformed);  // version 5
    EXPECT_EQ(with(0, 0x44), Contents::kMalformed);  // header of 16 bytes
    EXPECT_EQ(with(3, 19), Contents::kMalformed);    // total length below the header's
    EXPECT_EQ(with(3, 24), Contents::kMalformed);    // no room for the UDP header
    EXPECT_EQ(with(25, 7), Contents::kMalformed);    // UDP length below the header's
    EXPECT_EQ(with(25, 16), Contents::kMalformed);   // UDP longer than IP
}

TEST(LinkLayer, LengthsLeftToTheNetworkCardAreThoseOfTheCapture) {
    ByteVector bytes = ipv4_udp("payload");
    store(bytes.data() + 2, ByteOrder::kBig, std::uint16_t{0});
    store(bytes.data() + 24, ByteOrder::kBig, std::uint16_t{0});
    expect_datagram(link_type::kRaw, bytes, "payload");
}

CanFrame frame_of(const ByteVector& bytes, std::uint32_t link = link_type::kSocketCan) {
    CapturedPacket packet;
    EXPECT_EQ(take(link, bytes, packet), Contents::kCan);
    EXPECT_EQ(packet.kind, CapturedPacket::Kind::kCan);
    return packet.can;
}

CanFrame frame(std::uint32_t id, std::string_view data) {
    CanFrame made;
    made.id = id;
    made.length = static_cast<std::uint8_t>(data.size());
    std::copy(data.begin(), data.end(), made.data.begin());
    return made;
}

TEST(LinkLayer, CanFramesOfEveryKind) {
    EXPECT_EQ(frame_of(can_bytes(0x123, "1234")), frame(0x123, "1234"));
    EXPECT_EQ(frame_of(can_bytes(0x7FF, "")), frame(0x7FF, ""));
    CanFrame expected = frame(0x1ABCDEF0, "12345678");
    expected.extended = true;
    EXPECT_EQ(frame_of(can_bytes(0x9ABCDEF0, "12345678")), expected);
    expected = frame(0x123, "");
    expected.remote = true;
    expected.length = 5;
    EXPECT_EQ(frame_of(big_endian().u32(0x40000123).u8(5).u8(0).u16(0).bytes), expected);
    expected = frame(0x4, "12345678");
    expected.error = true;
    EXPECT_EQ(frame_of(can_bytes(0x20000004, "12345678")), expected);
    const std::string long_data(64, 'd');
    expected = frame(0x321, long_data);
    expected.fd = true;
    expected.fd_flags = 5;
    EXPECT_EQ(frame_of(can_bytes(0x321, long_data, 5)), expected);
}

TEST(LinkLayer, CanFdIsKnownWithoutItsFlag) {
    EXPECT_TRUE(frame_of(can_bytes(0x321, "123456789abc")).fd);  // longer than classic
    ByteVector whole = can_bytes(0x321, "12");                   // the size of CAN FD's structure
    whole.resize(72);
    EXPECT_TRUE(frame_of(whole).fd);
    EXPECT_EQ(frame_of(whole).length, 2);
    whole.resize(16);
    EXPECT_FALSE(frame_of(whole).fd);
}

TEST(LinkLayer, CookedCapturesHoldIdentifiersInTheOrderOfTheFile) {
    const ByteVector inside = can_bytes(0x123, "1234", 0, ByteOrder::kLittle);
    EXPECT_EQ(frame_of(cooked(0x000C, inside), link_type::kLinuxCooked), frame(0x123, "1234"));
    EXPECT_EQ(frame_of(cooked2(0x000D, inside), link_type::kLinuxCooked2).id, 0x123U);
}

TEST(LinkLayer, BadCanFramesAreMalformed) {
    EXPECT_EQ(contents_of(link_type::kSocketCan, can_bytes(0x800, "1")), Contents::kMalformed);
    EXPECT_EQ(contents_of(link_type::kSocketCan, can_bytes(0x40000123, "1", 4)), Contents::kMalformed);
    EXPECT_EQ(contents_of(link_type::kSocketCan, can_bytes(0x123, std::string(65, 'd'), 4)),
              Contents::kMalformed);
    EXPECT_EQ(contents_of(link_type::kSocketCan, can_bytes(0x123, std::string(130, 'd'))),
              Contents::kOtherProtocol);  // CAN XL's flag is in the length byte
}

}  // namespace
}  // namespace skyig::protocol::recording
