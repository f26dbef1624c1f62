// pcapng and pcap files of every shape, whole, cut off and damaged.
#include "protocol/recording/capture_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "tests/protocol/recording/capture_bytes.h"

namespace skyig::protocol::recording {
namespace {

using testing::HasSubstr;

struct Seen {
    std::int64_t time_ns;
    std::string payload;  // of UDP; of CAN its data
    std::string comment;
    std::uint32_t interface;
    std::uint64_t number;
};

struct Reading {
    std::vector<Seen> packets;
    CaptureReader::End end = CaptureReader::End::kNotYet;
    std::string trouble;
    CaptureCounters counters;
};

Reading drain(CaptureReader& reader) {
    Reading all;
    while (const CapturedPacket* packet = reader.next()) {
        const bool udp = packet->kind == CapturedPacket::Kind::kUdp;
        all.packets.push_back({packet->time_ns,
                               udp ? text_of(packet->payload) : text_of(std::as_bytes(packet->can.bytes())),
                               std::string(packet->comment), packet->interface, packet->number});
    }
    EXPECT_EQ(reader.next(), nullptr);
    all.end = reader.end();
    all.trouble = reader.trouble();
    all.counters = reader.counters();
    return all;
}

Reading read(std::span<const std::byte> bytes) {
    auto reader = CaptureReader::over(bytes, "FILE");
    if (!reader) return {{}, CaptureReader::End::kDamaged, reader.error(), {}};
    return drain(*reader);
}

class Orders : public testing::TestWithParam<ByteOrder> {
  protected:
    [[nodiscard]] Builder file() const { return Builder(GetParam()); }
};

TEST_P(Orders, PcapngGivesPacketsStampsAndComments) {
    const Builder capture = file()
                                .section("made by hand")
                                .interface(link_type::kRaw, 9)
                                .interface(link_type::kSocketCan, 9)
                                .packet(0, kTime_ns, ipv4_udp("first"), "a comment")
                                .packet(1, kTime_ns + 1, can_bytes(0x123, "data"))
                                .packet(0, kTime_ns + 2, ipv4_udp("third!"));
    auto reader = CaptureReader::over(capture.bytes, "FILE");
    ASSERT_TRUE(reader.has_value()) << reader.error();
    EXPECT_EQ(reader->section_comment(), "made by hand");
    const Reading all = drain(*reader);
    EXPECT_EQ(all.end, CaptureReader::End::kComplete);
    EXPECT_EQ(all.trouble, "");
    ASSERT_EQ(all.packets.size(), 3U);
    EXPECT_EQ(all.packets[0].payload, "first");
    EXPECT_EQ(all.packets[0].comment, "a comment");
    EXPECT_EQ(all.packets[0].time_ns, kTime_ns);
    EXPECT_EQ(all.packets[1].payload, "data");
    EXPECT_EQ(all.packets[1].interface, 1U);
    EXPECT_EQ(all.packets[1].time_ns, kTime_ns + 1);
    EXPECT_EQ(all.packets[1].comment, "");
    EXPECT_EQ(all.packets[2].payload, "third!");
    EXPECT_EQ(all.packets[2].number, 3U);
    EXPECT_EQ(all.counters, (CaptureCounters{.packets = 3, .udp = 2, .can = 1}));
}

TEST_P(Orders, PcapInMicrosecondsAndNanoseconds) {
    for (const auto& [magic, fraction_ns] :
         {std::pair{0xA1B2C3D4U, std::int64_t{1000}}, std::pair{0xA1B23C4DU, std::int64_t{1}}}) {
        // The upper bits of the link type tell of checksums.
        const Builder capture = file()
                                    .pcap_header(magic, link_type::kRaw | 0x50000000U)
                                    .pcap_record(1'718'978'566, 123'456, ipv4_udp("one"))
                                    .pcap_record(4'000'000'000U, 999'999, ipv4_udp("two"));
        const Reading all = read(capture.bytes);
        EXPECT_EQ(all.end, CaptureReader::End::kComplete) << all.trouble;
        ASSERT_EQ(all.packets.size(), 2U);
        EXPECT_EQ(all.packets[0].time_ns, 1'718'978'566'000'000'000 + 123'456 * fraction_ns);
        EXPECT_EQ(all.packets[1].time_ns, 4'000'000'000'000'000'000 + 999'999 * fraction_ns);
        EXPECT_EQ(all.packets[1].payload, "two");
    }
}

TEST_P(Orders, ObsoleteAndSimplePacketsAreRead) {
    const ByteVector datagram = ipv4_udp("payload");
    const auto size = static_cast<std::uint32_t>(datagram.size());
    Builder capture = file().section().interface(link_type::kRaw, 9, 0, size);
    Builder obsolete = capture.body();
    obsolete.u16(0).u16(99).u32(1).u32(2).u32(size).u32(size).raw(datagram).pad().option(1, "old").u32(0);
    Builder simple = capture.body();
    simple.u32(size).raw(datagram);
    Builder cut = capture.body();
    cut.u32(size + 100).raw(datagram);  // captured up to the interface's limit
    capture.block(2, obsolete).block(3, simple).block(3, cut);
    auto reader = CaptureReader::over(capture.bytes, "FILE");
    ASSERT_TRUE(reader.has_value());
    const CapturedPacket* packet = reader->next();
    ASSERT_NE(packet, nullptr);
    EXPECT_TRUE(packet->stamped);
    EXPECT_EQ(packet->time_ns, (std::int64_t{1} << 32) + 2);
    EXPECT_EQ(packet->comment, "old");
    packet = reader->next();
    ASSERT_NE(packet, nullptr);
    EXPECT_FALSE(packet->stamped);
    EXPECT_EQ(packet->time_ns, (std::int64_t{1} << 32) + 2);  // of the packet before it
    EXPECT_EQ(text_of(packet->payload), "payload");
    packet = reader->next();  // the datagram is whole all the same
    ASSERT_NE(packet, nullptr);
    EXPECT_EQ(text_of(packet->payload), "payload");
    EXPECT_EQ(reader->next(), nullptr);
    EXPECT_EQ(reader->end(), CaptureReader::End::kComplete) << reader->trouble();
}

TEST_P(Orders, UnknownBlocksAndOptionsArePassedOver) {
    Builder capture = file().section();
    const Builder small = capture.body();
    Builder huge = capture.body();
    huge.bytes.resize(3 * ByteWindow::kBytes);
    capture.block(4, small).interface(link_type::kRaw, 9).block(0x0BAD, huge).block(5, small);
    Builder with_options = capture.body();
    const ByteVector datagram = ipv4_udp("payload");
    const auto size = static_cast<std::uint32_t>(datagram.size());
    with_options.u32(0).u32(0).u32(7).u32(size).u32(size).raw(datagram).pad();
    with_options.option(2, "flag").option(2988, "custom").option(1, "one").option(1, "two");
    capture.block(6, with_options);  // no end-of-options mark
    const Reading all = read(capture.bytes);
    EXPECT_EQ(all.end, CaptureReader::End::kComplete) << all.trouble;
    ASSERT_EQ(all.packets.size(), 1U);
    EXPECT_EQ(all.packets[0].comment, "one");
}

TEST_P(Orders, CutAnywhereAllWholePacketsAreReadAndItIsSaid) {
    Builder capture = file().section("comment").interface(link_type::kRaw, 9);
    std::vector<std::size_t> ends{capture.bytes.size()};
    for (int i = 0; i < 5; ++i) {
        capture.packet(0, 1, ipv4_udp(std::string(static_cast<std::size_t>(i) * 3, 'p')), "comment");
        ends.push_back(capture.bytes.size());
    }
    const std::size_t header = file().section("comment").bytes.size();
    for (std::size_t size = header; size <= capture.bytes.size(); ++size) {
        const Reading all = read(std::span(capture.bytes).first(size));
        std::size_t whole = 0;
        while (whole < 5 && ends[whole + 1] <= size)
            ++whole;
        EXPECT_EQ(all.packets.size(), whole) << size;
        const bool at_boundary = size == header || std::ranges::find(ends, size) != ends.end();
        EXPECT_EQ(all.end, at_boundary ? CaptureReader::End::kComplete : CaptureReader::End::kTruncated);
        EXPECT_THAT(all.trouble, HasSubstr(at_boundary ? "" : "the file ends inside a block"));
    }
    const Reading all = read(std::span(capture.bytes).first(ends[2] + 7));
    EXPECT_EQ(all.trouble, "FILE: byte " + std::to_string(ends[2]) +
                               ": the file ends inside a block; all blocks before it were read");
}

INSTANTIATE_TEST_SUITE_P(Both, Orders, testing::Values(ByteOrder::kLittle, ByteOrder::kBig));

TEST(CaptureReader, APcapCutAnywhereGivesItsWholeRecords) {
    Builder capture(ByteOrder::kLittle);
    capture.pcap_header(0xA1B2C3D4, link_type::kRaw);
    const std::size_t header = capture.bytes.size();
    capture.pcap_record(1, 2, ipv4_udp("one"));
    const std::size_t one = capture.bytes.size();
    capture.pcap_record(3, 4, ipv4_udp("two"));
    for (std::size_t size = header; size <= capture.bytes.size(); ++size) {
        const Reading all = read(std::span(capture.bytes).first(size));
        EXPECT_EQ(all.packets.size(), size == capture.bytes.size() ? 2U : size >= one ? 1U : 0U);
        const bool at_boundary = size == header || size == one || size == capture.bytes.size();
        EXPECT_EQ(all.end, at_boundary ? CaptureReader::End::kComplete : CaptureReader::End::kTruncated);
    }
}

TEST(CaptureReader, CommentsAloneMakeNoBusLog) {
    const auto opens = [](std::string_view text) {
        return CaptureReader::over(std::as_bytes(std::span(text)), "FILE").has_value();
    };
    EXPECT_TRUE(opens("# a bus\n\n(1.000000) can0 12C#00\n"));
    EXPECT_TRUE(opens("\n(1.000000) can0 12C#00\n"));
    EXPECT_TRUE(opens("# nothing was heard\n"));
    EXPECT_FALSE(opens("# a flight\ntime,latitude\n0,47\n"));
    EXPECT_FALSE(opens("[daemon]\nrate_hz = 60\n"));
}

TEST(CaptureReader, SectionsMayDifferInOrderInterfacesAndComment) {
    const Builder first = Builder(ByteOrder::kLittle)
                              .section("one")
                              .interface(link_type::kSocketCan, 9)
                              .interface(link_type::kSocketCan, 9)
                              .packet(1, 10, can_bytes(1, "a"));
    const Builder second = Builder(ByteOrder::kBig)
                               .section("two")
                               .interface(link_type::kRaw, 6)
                               .interface(link_type::kSocketCan, 6)
                               .packet(1, 20, can_bytes(2, "b"))
                               .packet(0, 30, ipv4_udp("c"));
    Builder capture = first;
    capture.raw(second.bytes);
    auto reader = CaptureReader::over(capture.bytes, "FILE");
    ASSERT_TRUE(reader.has_value());
    const CapturedPacket* packet = reader->next();
    ASSERT_NE(packet, nullptr);
    EXPECT_EQ(reader->section_comment(), "one");
    EXPECT_EQ(packet->can.bus, 1);
    EXPECT_EQ(packet->interface, 1U);
    packet = reader->next();
    ASSERT_NE(packet, nullptr);
    EXPECT_EQ(reader->section_comment(), "two");
    EXPECT_EQ(packet->can.bus, 0);
    EXPECT_EQ(packet->interface, 3U);
    EXPECT_EQ(packet->can.received_ns, 20'000);
    EXPECT_EQ(reader->interface_of_last().link_type, link_type::kSocketCan);
    packet = reader->next();
    ASSERT_NE(packet, nullptr);
    EXPECT_EQ(packet->interface, 2U);
    EXPECT_EQ(reader->interface_of_last().link_type, link_type::kRaw);
    EXPECT_EQ(reader->next(), nullptr);
    EXPECT_EQ(reader->end(), CaptureReader::End::kComplete);
}

TEST(CaptureReader, StampsOfEveryResolution) {
    struct Case {
        unsigned resolution;  // as in the file
        std::int64_t offset_s;
        std::uint64_t ticks;
        std::int64_t ns;
    };
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    const std::array cases{
        Case{0xFF, 0, 1'500'000, 1'500'000'000},  // microseconds where nothing is said
        Case{0, 0, 2, 2'000'000'000},
        Case{3, -1, 1500, 500'000'000},
        Case{6, 1'700'000'000, 5, 1'700'000'000'000'005'000},
        Case{9, 0, 1'718'978'566'123'456'789, 1'718'978'566'123'456'789},
        Case{12, 0, 1'999, 1},
        Case{19, 0, 19'999'999'999ULL, 1},
        Case{0x80, 0, 3, 3'000'000'000},
        Case{0x80 | 10, 0, 1536, 1'500'000'000},
        Case{0x80 | 32, 1, std::uint64_t{1} << 31U, 1'500'000'000},
        Case{0x80 | 63, 0, std::uint64_t{1} << 62U, 500'000'000},
        Case{0, 0, std::numeric_limits<std::uint64_t>::max(), kMost},
        Case{9, -10'000'000'000, 0, std::numeric_limits<std::int64_t>::min()},
    };
    for (const Case& each : cases) {
        const Builder capture = Builder(ByteOrder::kLittle)
                                    .section()
                                    .interface(link_type::kRaw, each.resolution, each.offset_s)
                                    .packet(0, each.ticks, ipv4_udp("x"));
        const Reading all = read(capture.bytes);
        ASSERT_EQ(all.packets.size(), 1U) << all.trouble;
        EXPECT_EQ(all.packets[0].time_ns, each.ns) << each.resolution << " " << each.ticks;
    }
}

TEST(CaptureReader, WhatIsNoCaptureIsRefusedByItsFirstBytes) {
    const auto refusal = [](std::string_view text) {
        const auto reader = CaptureReader::over(std::as_bytes(std::span(text)), "FILE");
        EXPECT_FALSE(reader.has_value());
        return reader ? "" : reader.error();
    };
    EXPECT_EQ(refusal(""), "FILE: byte 0: empty; a pcapng or pcap capture or a candump log is read");
    EXPECT_EQ(
        refusal("t17"),
        "FILE: byte 0: 74 31 37 is the head of no capture; pcapng begins with 0A 0D 0D 0A, pcap with "
        "A1 B2 C3 D4 or A1 B2 3C 4D or their reverse, a candump log with a time stamp in round brackets");
    EXPECT_EQ(refusal("\x1F\x8B\x08z"), "FILE: byte 0: compressed with gzip; unpack it first (gunzip)");
    EXPECT_THAT(refusal("\x0A\x0D\x0D\x0A"), HasSubstr("ends inside a block"));
    EXPECT_THAT(refusal("\x0A\x0D\x0D\x0A____ABCD"), HasSubstr("byte 8: byte-order mark 41424344; 1A2B3C4D"));
}

Reading read_text(std::string_view text) {
    return read(std::as_bytes(std::span(text)));
}

TEST(CaptureReader, CandumpLogEndsWhereALineIsNoFrame) {
    const std::string good = "(1.000001) can0 123#00\n";
    const Reading torn = read_text(good + "(1.000002) can0 12");
    EXPECT_EQ(torn.end, CaptureReader::End::kTruncated);
    EXPECT_EQ(torn.packets.size(), 1U);
    EXPECT_THAT(torn.trouble, HasSubstr("FILE: byte 23: line 2, column 17: write the identifier"));
    const Reading damaged = read_text(good + "(1.000002) can0 123#0\n" + good);
    EXPECT_EQ(damaged.end, CaptureReader::End::kDamaged);
    EXPECT_EQ(damaged.packets.size(), 1U);
    EXPECT_THAT(damaged.trouble, HasSubstr("line 2, column 22: write each data byte as two hex digits"));
    const Reading endless = read_text(good + "#" + std::string(5000, 'x') + '\n' + good);
    EXPECT_EQ(endless.end, CaptureReader::End::kDamaged);
    EXPECT_THAT(endless.trouble, HasSubstr("longer than 4096"));
    EXPECT_EQ(read_text("# empty\n").end, CaptureReader::End::kComplete);
}

/// A section, an interface and a packet, each at a known place, one word of it changed.
Reading read_changed(std::size_t offset, std::uint32_t word) {
    Builder capture = Builder(ByteOrder::kLittle)
                          .section()                        // 0..28
                          .interface(link_type::kRaw, 9)    // 28..60
                          .packet(0, 1, ipv4_udp("abcd"));  // 60..124
    store(capture.bytes.data() + offset, ByteOrder::kLittle, word);
    return read(capture.bytes);
}

TEST(CaptureReader, DamageIsLocatedAndSaysWhatWouldBeRight) {
    EXPECT_EQ(read_changed(12, 2).trouble, "FILE: byte 12: pcapng version 2; 1 is read");
    EXPECT_EQ(read_changed(4, 24).trouble,
              "FILE: byte 20: a block repeats its length at its end: 24 is right here");
    EXPECT_EQ(read_changed(64, 63).trouble, "FILE: byte 64: block length 63; a multiple of 4 from 12 on");
    EXPECT_EQ(read_changed(64, 8).trouble, "FILE: byte 64: block length 8; a multiple of 4 from 12 on");
    EXPECT_EQ(read_changed(120, 60).trouble,
              "FILE: byte 120: a block repeats its length at its end: 64 is right here");
    EXPECT_EQ(read_changed(68, 1).trouble,
              "FILE: byte 68: packet of interface 1; its section has described 1 so far");
    EXPECT_EQ(read_changed(80, 33).trouble, "FILE: byte 80: 33 captured bytes in a block with room for 32");
    EXPECT_EQ(read_changed(48, 20).trouble,
              "FILE: byte 48: time resolution 10^-20; 10^0 to 10^-19, or 2^0 to 2^-63");
    EXPECT_EQ(read_changed(44, 0x00630009).trouble,
              "FILE: byte 44: the option at byte 16 of its block is longer than the block");
    EXPECT_EQ(read_changed(64, 0x7FFFFFFC).end, CaptureReader::End::kTruncated);
    EXPECT_EQ(read_changed(60, 0x0BAD).end, CaptureReader::End::kComplete);
}

TEST(CaptureReader, PacketBlocksTooSmallForTheirFieldsAreDamage) {
    for (const std::uint32_t type : {1U, 2U, 3U, 6U, 0x0A0D0D0AU}) {
        Builder capture = Builder(ByteOrder::kLittle).section().interface(link_type::kRaw);
        Builder small = capture.body();
        if (type == 0x0A0D0D0AU) small.u32(0x1A2B3C4D);
        capture.block(type, small);
        const Reading all = read(capture.bytes);
        EXPECT_EQ(all.end, CaptureReader::End::kDamaged) << type;
        EXPECT_THAT(all.trouble, HasSubstr("at least")) << type;
    }
}

TEST(CaptureReader, PcapDamageIsLocated) {
    Builder capture(ByteOrder::kBig);
    capture.pcap_header(0xA1B2C3D4, link_type::kRaw).pcap_record(1, 2, ipv4_udp("abcd"));
    store(capture.bytes.data() + 32, ByteOrder::kBig, std::uint32_t{300'000});
    EXPECT_EQ(read(capture.bytes).trouble, "FILE: byte 32: 300000 captured bytes; 262144 at most");
    store(capture.bytes.data() + 4, ByteOrder::kBig, std::uint16_t{3});
    EXPECT_EQ(read(capture.bytes).trouble, "FILE: byte 4: pcap version 3; 2 is read");
}

TEST(CaptureReader, ZerosAtTheEndAreAFileThatWasNotWrittenOut) {
    Builder capture =
        Builder(ByteOrder::kLittle).section().interface(link_type::kRaw).packet(0, 1, ipv4_udp("x"));
    capture.bytes.resize(capture.bytes.size() + 500);
    const Reading all = read(capture.bytes);
    EXPECT_EQ(all.packets.size(), 1U);
    EXPECT_EQ(all.end, CaptureReader::End::kTruncated);
    EXPECT_THAT(all.trouble, HasSubstr("not written out"));
    Builder old = Builder(ByteOrder::kLittle).pcap_header(0xA1B2C3D4, link_type::kRaw);
    old.pcap_record(1, 2, ipv4_udp("x")).bytes.resize(old.bytes.size() + 500);
    EXPECT_EQ(read(old.bytes).end, CaptureReader::End::kTruncated);
}

TEST(CaptureReader, EveryPacketIsCountedOnce) {
    const ByteVector cut = ipv4_udp("captured in part");
    Builder capture = Builder(ByteOrder::kLittle)
                          .section()
                          .interface(link_type::kRaw, 9)
                          .interface(147, 9)
                          .packet(0, 1, ipv4_udp("datagram"))
                          .packet(0, 1, ipv4_udp("part", 0x2000))
                          .packet(0, 1, ipv4_udp("tcp", 0, 6))
                          .packet(0, 1, ByteVector(40, std::byte{0x60}))
                          .packet(0, 1, std::span(cut).first(40), "", 60)
                          .packet(0, 1, ByteVector(3, std::byte{0x45}))
                          .packet(1, 1, ipv4_udp("who knows"));
    const ByteVector large(2 * ByteWindow::kBytes);
    capture.packet(0, 1, large).packet(0, 1, ipv4_udp("the last"));
    const Reading all = read(capture.bytes);
    EXPECT_EQ(all.end, CaptureReader::End::kComplete) << all.trouble;
    EXPECT_EQ(all.counters, (CaptureCounters{.packets = 9,
                                             .udp = 2,
                                             .fragments = 1,
                                             .ipv6 = 1,
                                             .other_protocols = 1,
                                             .unknown_link = 1,
                                             .cut_short = 1,
                                             .malformed = 1,
                                             .oversized = 1}));
    ASSERT_EQ(all.packets.size(), 2U);
    EXPECT_EQ(all.packets[1].number, 9U);
}

TEST(CaptureReader, InterfacesOfASectionAreLimited) {
    Builder capture = Builder(ByteOrder::kLittle).section();
    for (std::size_t i = 0; i <= PcapngReader::kMaxInterfaces; ++i)
        capture.interface(link_type::kSocketCan);
    auto reader = CaptureReader::over(capture.bytes, "FILE");
    ASSERT_TRUE(reader.has_value());
    EXPECT_EQ(drain(*reader).end, CaptureReader::End::kDamaged);
    EXPECT_EQ(reader->interfaces().back().bus, 255);
}

TEST(CaptureReader, FilesLongerThanTheWindowAreReadThroughIt) {
    const auto path =
        std::filesystem::temp_directory_path() / ("skyig_capture_" + std::to_string(::getpid()) + ".pcapng");
    Builder capture = Builder(ByteOrder::kLittle).section().interface(link_type::kRaw, 9);
    std::vector<std::string> payloads;
    for (std::size_t i = 0; i < 4000; ++i) {
        payloads.push_back(std::string(i * 7919 % 1600, static_cast<char>('a' + i % 26)));
        capture.packet(0, i, ipv4_udp(payloads.back()));
    }
    ASSERT_GT(capture.bytes.size(), 3 * ByteWindow::kBytes);
    std::ofstream(path, std::ios::binary) << text_of(capture.bytes);
    auto reader = CaptureReader::open(path.string());
    ASSERT_TRUE(reader.has_value()) << reader.error();
    const Reading all = drain(*reader);
    std::filesystem::remove(path);
    EXPECT_EQ(all.end, CaptureReader::End::kComplete) << all.trouble;
    ASSERT_EQ(all.packets.size(), payloads.size());
    for (std::size_t i = 0; i < payloads.size(); ++i)
        ASSERT_EQ(all.packets[i].payload, payloads[i]);
}

TEST(CaptureReader, APipeIsReadAsItFills) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    const transport::FileDescriptor out(ends[0]);
    const auto send = [&ends](const ByteVector& bytes) {
        EXPECT_EQ(::write(ends[1], bytes.data(), bytes.size()), static_cast<::ssize_t>(bytes.size()));
    };
    send(Builder(ByteOrder::kLittle).section().interface(link_type::kRaw).bytes);
    auto reader = CaptureReader::open("/proc/self/fd/" + std::to_string(ends[0]));
    ASSERT_TRUE(reader.has_value()) << reader.error();
    for (const std::string_view payload : {"first", "second"}) {
        send(Builder(ByteOrder::kLittle).packet(0, 1, ipv4_udp(payload)).bytes);
        const CapturedPacket* packet = reader->next();  // does not wait for more than this packet
        ASSERT_NE(packet, nullptr);
        EXPECT_EQ(text_of(packet->payload), payload);
    }
    ::close(ends[1]);
    EXPECT_EQ(reader->next(), nullptr);
    EXPECT_EQ(reader->end(), CaptureReader::End::kComplete) << reader->trouble();
}

TEST(CaptureReader, WhatCannotBeOpenedIsNamed) {
    EXPECT_EQ(CaptureReader::open("no/such/file.pcapng").error(),
              "no/such/file.pcapng: No such file or directory");
    EXPECT_EQ(CaptureReader::open("/").error(), "/: Is a directory");
}

}  // namespace
}  // namespace skyig::protocol::recording
