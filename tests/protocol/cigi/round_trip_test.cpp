// What is written reads back, in every packet, version and byte order; and the layouts say what the interface
// tables say.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <random>
#include <vector>

#include "protocol/cigi/catalogue.h"
#include "protocol/cigi/message.h"
#include "tests/protocol/cigi/random_packet.h"

namespace skyig::protocol::cigi {
namespace {

constexpr Version kVersions[] = {Version::k33, Version::k40};
constexpr ByteOrder kOrders[] = {ByteOrder::kLittle, ByteOrder::kBig};

/// One packet there and back; returns how many of its fields are equal, and fails on any that is not.
template <class P>
std::size_t round_trip(RandomPackets& random, Version version, ByteOrder order) {
    std::string text;
    const P written = random.next<P>(version, text);
    std::array<std::byte, 256> bytes{};
    bytes.fill(std::byte{0xA5});  // reserved bytes must be written, not left
    write_packet(written, version, order, bytes.data());
    P read{};
    const std::size_t size = packet_bytes(written, version);
    EXPECT_TRUE(read_packet(std::span(bytes).first(size), version, order, read)) << Layout<P>::kName;
    std::size_t equal = 0;
    for_each_field<P>([&](const auto& field) {
        if (!field.place(version).present) return;
        EXPECT_TRUE(read.*(field.member) == written.*(field.member)) << Layout<P>::kName << "." << field.name;
        ++equal;
    });
    return equal;
}

TEST(RoundTrip, EveryFieldOfEveryPacketComesBack) {
    constexpr int kRounds = 200;
    const std::uint64_t seed = std::random_device{}();
    RecordProperty("seed", std::to_string(seed));
    RandomPackets random(seed);
    std::size_t compared = 0;
    for (const Version version : kVersions) {
        for (const ByteOrder order : kOrders) {
            for_each_packet([&]<class P>() {
                if (shape_of<P>(version).size == 0) return;
                for (int round = 0; round < kRounds; ++round)
                    compared += round_trip<P>(random, version, order);
            });
        }
    }
    std::printf("%zu fields compared, seed %llu\n", compared, static_cast<unsigned long long>(seed));
    EXPECT_GT(compared, 200'000U);
}

TEST(RoundTrip, EveryBitOfAPacketBelongsToOneFieldOrIsReserved) {
    for (const Version version : kVersions) {
        for_each_packet([&]<class P>() {
            const std::size_t size = shape_of<P>(version).size;
            if (size == 0 || has_text<P>()) return;
            std::vector<std::byte> ones(size, std::byte{0xFF});
            P packet{};
            ASSERT_TRUE(read_packet<P>(ones, version, ByteOrder::kLittle, packet));
            if constexpr (requires { packet.major_version; }) return;  // the writer says the version itself
            std::vector<std::byte> again(size);
            write_packet(packet, version, ByteOrder::kLittle, again.data());
            std::size_t bits = 0;
            for_each_field<P>([&](const auto& field) {
                using Value = typename std::decay_t<decltype(field)>::Value;
                const Place place = field.place(version);
                if (place.present) bits += place.bits > 0 ? place.bits : 8 * sizeof(Value);
            });
            std::size_t set = 0;
            for (std::size_t i = header_bytes(version); i < size; ++i)
                set += static_cast<std::size_t>(std::popcount(std::to_integer<unsigned>(again[i])));
            EXPECT_EQ(set, bits) << Layout<P>::kName;
        });
    }
}

TEST(Catalogue, HoldsEveryPacketThatIsReadWithItsIdAndSize) {
    for (const Version version : kVersions) {
        for_each_packet([&]<class P>() {
            const Shape shape = shape_of<P>(version);
            if (shape.size == 0) return;
            EXPECT_EQ(listed_packet_name(version, shape.id), Layout<P>::kName);
            for (const ListedPacket& listed : listed_packets()) {
                if (listed.name != Layout<P>::kName) continue;
                EXPECT_EQ(listed.shape(version).size, shape.size) << listed.name;
                EXPECT_EQ(listed.shape(version).varies, has_text<P>()) << listed.name;
                EXPECT_EQ(listed.sender == Sender::kHost, kPacketKind<P> < kHostPacketKinds) << listed.name;
            }
        });
    }
}

TEST(Catalogue, NamesWhatIsNotRead) {
    EXPECT_EQ(listed_packet_name(Version::k33, 6), "articulated_part_control");
    EXPECT_EQ(listed_packet_name(Version::k40, 0x0021), "symbol_control");
    EXPECT_EQ(listed_packet_name(Version::k40, 0x0FF4), "collision_segment_notification");
    EXPECT_EQ(listed_packet_name(Version::k33, 200), "unassigned");
    EXPECT_EQ(listed_packet_name(Version::k33, 201), "user_defined");
    EXPECT_EQ(listed_packet_name(Version::k40, 0x0FEF), "unassigned");
    EXPECT_EQ(listed_packet_name(Version::k40, 0x1000), "user_defined");
    EXPECT_EQ(listed_packet_name(Version::k40, 0xFFFF), "start_of_frame");
}

}  // namespace
}  // namespace skyig::protocol::cigi
