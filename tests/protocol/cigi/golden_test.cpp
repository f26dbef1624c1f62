// Every golden datagram decodes to its fields, by name and without one more or less, and encodes to its bytes
// again.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>

#include "protocol/cigi/layout_host.h"
#include "protocol/cigi/layout_ig.h"
#include "protocol/cigi/layout_sight.h"
#include "protocol/cigi/message.h"
#include "tests/protocol/cigi/golden.h"

namespace skyig::protocol::cigi {
namespace {

struct SeenPacket {
    std::string name;  // empty: skipped
    std::uint16_t id = 0;
    std::size_t size = 0;
    std::size_t offset = 0;
    std::map<std::string, nlohmann::json> fields;
};

/// Collects all that is decoded, and writes it again.
struct Collector {
    template <class P>
    void operator()(const P& packet, const PacketInfo& info) {
        SeenPacket& seen = add(info);
        seen.name = Layout<P>::kName;
        visit_fields(packet, info.version, [&seen](std::string_view name, const auto& value) {
            seen.fields.emplace(std::string(name), nlohmann::json(value));
        });
        EXPECT_TRUE(writer.add(packet));
    }
    void skipped(const PacketInfo& info) {
        add(info);
        EXPECT_TRUE(writer.add_raw(info.bytes));
    }
    void refused(const RefusedPacket& refusal, const PacketInfo& info) {
        ADD_FAILURE() << packet_name(refusal.kind) << " at byte " << info.offset << ": " << refusal.field
                      << " " << count_name(refusal.reason);
    }
    SeenPacket& add(const PacketInfo& info) {
        packets.push_back({"", info.id, info.bytes.size(), info.offset, {}});
        return packets.back();
    }

    MessageWriter writer;
    std::vector<SeenPacket> packets;
};

MessageSummary decode(const GoldenDatagram& golden, Collector& collector, Counters& counters,
                      Validation validation) {
    return golden.from_host ? decode_host_message(golden.bytes, collector, counters, validation)
                            : decode_ig_message(golden.bytes, collector, counters, validation);
}

void compare_packet(const SeenPacket& seen, const nlohmann::json& wanted, std::size_t& compared) {
    EXPECT_EQ(seen.id, wanted.at("id").get<std::size_t>());
    EXPECT_EQ(seen.size, wanted.at("size").get<std::size_t>());
    EXPECT_EQ(seen.offset, wanted.at("offset").get<std::size_t>());
    if (wanted.at("packet").is_null()) {
        EXPECT_EQ(seen.name, "");
        return;
    }
    EXPECT_EQ(seen.name, wanted.at("packet").get<std::string>());
    const nlohmann::json& fields = wanted.at("fields");
    EXPECT_EQ(seen.fields.size(), fields.size()) << seen.name;
    for (const auto& [name, value] : fields.items()) {
        const auto found = seen.fields.find(name);
        ASSERT_NE(found, seen.fields.end()) << seen.name << " lacks " << name;
        EXPECT_EQ(found->second, value) << seen.name << "." << name;
        ++compared;
    }
}

TEST(Golden, EveryDatagramDecodesToItsFields) {
    ASSERT_EQ(golden_datagrams().size(), 24U);
    std::size_t compared = 0;
    for (const GoldenDatagram& golden : golden_datagrams()) {
        SCOPED_TRACE(golden.name);
        std::array<std::byte, 1024> buffer{};
        Collector collector{MessageWriter(buffer, golden.version, golden.order), {}};
        Counters counters;
        const MessageSummary summary = decode(golden, collector, counters, Validation::kOff);
        EXPECT_TRUE(summary.accepted);
        EXPECT_FALSE(summary.fault);
        EXPECT_EQ(summary.version, golden.version);
        EXPECT_EQ(summary.order, golden.order);
        EXPECT_EQ(summary.offset, golden.bytes.size());
        ASSERT_EQ(collector.packets.size(), golden.packets.size());
        for (std::size_t i = 0; i < golden.packets.size(); ++i) {
            compare_packet(collector.packets[i], golden.packets[i], compared);
        }
    }
    std::printf("%zu fields compared\n", compared);
    EXPECT_GT(compared, 800U);
}

TEST(Golden, EveryDatagramEncodesToItsBytesAgain) {
    for (const GoldenDatagram& golden : golden_datagrams()) {
        SCOPED_TRACE(golden.name);
        std::array<std::byte, 1024> buffer{};
        buffer.fill(std::byte{0xA5});  // reserved bytes must be written, not left
        Collector collector{MessageWriter(buffer, golden.version, golden.order), {}};
        Counters counters;
        static_cast<void>(decode(golden, collector, counters, Validation::kOff));
        const std::vector<std::byte> written(collector.writer.bytes().begin(),
                                             collector.writer.bytes().end());
        EXPECT_EQ(written, golden.bytes);
    }
}

TEST(Golden, NoPacketIsRefusedOrClamped) {
    for (const GoldenDatagram& golden : golden_datagrams()) {
        SCOPED_TRACE(golden.name);
        std::array<std::byte, 1024> buffer{};
        Collector collector{MessageWriter(buffer, golden.version, golden.order), {}};
        Counters counters;
        EXPECT_TRUE(decode(golden, collector, counters, Validation::kOn).accepted);
        EXPECT_EQ(collector.packets.size(), golden.packets.size());
        EXPECT_EQ(counters[Count::kClamped], 0U);
    }
}

TEST(Golden, EveryPacketKindOfTheLibraryOccursOrIsOfSurfaceMotionOrSight) {
    Counters counters;
    for (const GoldenDatagram& golden : golden_datagrams()) {
        std::array<std::byte, 1024> buffer{};
        Collector collector{MessageWriter(buffer, golden.version, golden.order), {}};
        static_cast<void>(decode(golden, collector, counters, Validation::kOff));
    }
    const std::set<std::size_t> not_in_file{
        kPacketKind<ConformalClamped>,          kPacketKind<RateControl>,
        kPacketKind<MaritimeSurfaceControl>,    kPacketKind<WaveControl>,
        kPacketKind<TerrestrialSurfaceControl>, kPacketKind<EarthModelDefinition>,
        kPacketKind<MaritimeSurfaceResponse>,   kPacketKind<TerrestrialSurfaceResponse>,
        kPacketKind<AccelerationControl>,       kPacketKind<LosSegmentRequest>,
        kPacketKind<LosVectorRequest>,          kPacketKind<LosResponse>,
        kPacketKind<LosExtendedResponse>};
    for (std::size_t kind = 0; kind < kPacketKinds; ++kind)
        EXPECT_EQ(counters.packets[kind] == 0, not_in_file.contains(kind)) << packet_name(kind);
}

}  // namespace
}  // namespace skyig::protocol::cigi
