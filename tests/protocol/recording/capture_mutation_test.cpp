// Damaged captures: random changes of sound ones. What is read must keep its promises; the sanitizer build of
// this test watches the reads.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "protocol/recording/capture_reader.h"
#include "tests/protocol/recording/capture_bytes.h"

namespace skyig::protocol::recording {
namespace {

/// One of everything: sections in both orders, all packet blocks, all link types.
ByteVector sound_pcapng(ByteOrder order) {
    Builder capture(order);
    const ByteVector datagram = ipv4_udp("payload");
    const auto size = static_cast<std::uint32_t>(datagram.size());
    capture.section("comment").interface(link_type::kRaw, 9).interface(link_type::kSocketCan, 0x8A, 7);
    capture.interface(link_type::kEthernet).interface(link_type::kLinuxCooked2, 6, 0, 96);
    capture.packet(0, 1'718'978'566'123'456'789, datagram, "first")
        .packet(1, 5, can_bytes(0x123, "12345678"));
    capture.packet(1, 6, can_bytes(0x321, std::string(64, 'd'), 5));
    capture.packet(2, 7,
                   big_endian().u32(1).u32(2).u32(3).u16(0x8100).u16(1).u16(0x0800).raw(datagram).bytes);
    capture.packet(3, 8,
                   big_endian().u16(0x0800).u16(0).u32(3).u16(1).u8(0).u8(6).u64(0).raw(datagram).bytes);
    capture.block(2, capture.body().u16(0).u16(0).u32(0).u32(9).u32(size).u32(size).raw(datagram));
    capture.block(3, capture.body().u32(size).raw(datagram)).block(5, capture.body().u32(0));
    return capture.packet(0, 10, ipv4_udp("part", 0x2000)).bytes;
}

std::vector<ByteVector> sound_captures() {
    std::vector<ByteVector> all;
    for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
        all.push_back(sound_pcapng(order));
        for (const std::uint32_t magic : {0xA1B2C3D4U, 0xA1B23C4DU}) {
            Builder old(order);
            old.pcap_header(magic, link_type::kRaw).pcap_record(1, 2, ipv4_udp("one"));
            all.push_back(old.pcap_record(3, 4, ipv4_udp("two"), 80).bytes);
        }
    }
    const ByteVector second = sound_pcapng(ByteOrder::kBig);
    all.push_back(sound_pcapng(ByteOrder::kLittle));
    all.back().insert(all.back().end(), second.begin(), second.end());
    return all;
}

struct Tally {
    std::uint64_t refused = 0;
    std::array<std::uint64_t, 4> ends{};
    CaptureCounters counters;
};

bool inside(std::span<const std::byte> part, std::span<const std::byte> whole) {
    return part.empty() || (std::less_equal<>()(whole.data(), part.data()) &&
                            std::less_equal<>()(part.data() + part.size(), whole.data() + whole.size()));
}

void add(CaptureCounters& sum, const CaptureCounters& counters) {
    sum.packets += counters.packets;
    sum.udp += counters.udp;
    sum.can += counters.can;
    sum.fragments += counters.fragments;
    sum.ipv6 += counters.ipv6;
    sum.other_protocols += counters.other_protocols;
    sum.unknown_link += counters.unknown_link;
    sum.cut_short += counters.cut_short;
    sum.malformed += counters.malformed;
}

std::uint64_t parts(const CaptureCounters& counters) {
    return counters.udp + counters.can + counters.fragments + counters.ipv6 + counters.other_protocols +
           counters.unknown_link + counters.cut_short + counters.malformed + counters.oversized;
}

void read_and_check(std::span<const std::byte> bytes, Tally& tally) {
    auto reader = CaptureReader::over(bytes, "FILE");
    if (!reader) {
        EXPECT_TRUE(reader.error().starts_with("FILE: byte "));
        ++tally.refused;
        return;
    }
    std::uint64_t given = 0;
    std::uint64_t last_offset = 0;
    while (const CapturedPacket* packet = reader->next()) {
        ++given;
        EXPECT_TRUE(inside(packet->payload, bytes));
        EXPECT_TRUE(inside(std::as_bytes(std::span(packet->comment)), bytes));
        EXPECT_GT(packet->offset_bytes, last_offset);
        last_offset = packet->offset_bytes;
        if (packet->kind == CapturedPacket::Kind::kCan) {
            const CanFrame& frame = packet->can;
            EXPECT_LE(frame.length, frame.fd ? kFdBytes : kClassicBytes);
            EXPECT_LE(frame.id, frame.extended || frame.error ? kMaxExtendedId : kMaxStandardId);
            EXPECT_LE(int{frame.error} + int{frame.remote} + int{frame.fd}, 1);
            EXPECT_EQ(frame.bus, reader->interface_of_last().bus);
        }
    }
    const CaptureCounters& counters = reader->counters();
    EXPECT_EQ(given, counters.udp + counters.can);
    EXPECT_EQ(counters.packets, parts(counters));
    EXPECT_NE(reader->end(), CaptureReader::End::kNotYet);
    EXPECT_EQ(reader->trouble().empty(), reader->end() == CaptureReader::End::kComplete);
    ++tally.ends[static_cast<std::size_t>(reader->end())];
    add(tally.counters, counters);
}

class Mutator {
  public:
    explicit Mutator(std::uint64_t seed) : random_(seed) {}

    /// A sound capture with one to four changes, at the end of `storage`.
    std::span<const std::byte> next(std::span<std::byte> storage) {
        const ByteVector& source = sound_[below(sound_.size())];
        const std::size_t size = below(8) == 0 ? below(source.size() + 1) : source.size();
        const auto bytes = storage.last(size);
        std::copy_n(source.begin(), size, bytes.begin());
        for (std::size_t changes = 1 + below(4); changes > 0 && size >= 8; --changes)
            change(bytes);
        return bytes;
    }

  private:
    std::size_t below(std::size_t limit) { return static_cast<std::size_t>(random_() % limit); }

    void change(std::span<std::byte> bytes) {
        const std::size_t at = below(bytes.size());
        constexpr std::array kEdges{0x00U, 0x01U, 0x7FU, 0x80U, 0xFFU, 0x45U, 0x60U, 0x06U};
        switch (below(4)) {
            case 0:
                bytes[at] ^= static_cast<std::byte>(1U << below(8));
                break;
            case 1:
                bytes[at] = static_cast<std::byte>(kEdges[below(kEdges.size())]);
                break;
            case 2: {  // a small number where a length may be
                const std::size_t word = at / 4 * 4;
                if (word + 4 <= bytes.size())
                    store(bytes.data() + word, kNativeOrder, static_cast<std::uint32_t>(below(200)));
                break;
            }
            default: {
                const std::size_t length = 1 + below(8);
                if (length > bytes.size()) break;
                std::memmove(bytes.data() + below(bytes.size() - length + 1),
                             bytes.data() + below(bytes.size() - length + 1), length);
            }
        }
    }

    std::mt19937_64 random_;
    std::vector<ByteVector> sound_ = sound_captures();
};

TEST(CaptureDamage, SoundCapturesAreReadToTheirEnd) {
    for (const ByteVector& capture : sound_captures()) {
        Tally tally;
        read_and_check(capture, tally);
        EXPECT_EQ(tally.ends[static_cast<std::size_t>(CaptureReader::End::kComplete)], 1U);
        EXPECT_GE(tally.counters.udp, 1U);
    }
}

TEST(CaptureDamage, RandomChangesBreakNoPromise) {
    constexpr int kRounds = 100'000;
    const std::uint64_t seed = std::random_device{}();
    std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
    RecordProperty("seed", std::to_string(seed));
    Mutator mutator(seed);
    // Captures end where the storage ends, so that the sanitizer sees a read beyond.
    constexpr std::size_t kStorage = 4096;
    const std::unique_ptr<std::byte[]> storage(new std::byte[kStorage]);
    Tally tally;
    for (int round = 0; round < kRounds && !HasFailure(); ++round)
        read_and_check(mutator.next({storage.get(), kStorage}), tally);
    const CaptureCounters& sum = tally.counters;
    const std::array counts{
        std::pair{"refused", tally.refused},
        std::pair{"complete", tally.ends[1]},
        std::pair{"truncated", tally.ends[2]},
        std::pair{"damaged", tally.ends[3]},
        std::pair{"udp", sum.udp},
        std::pair{"can", sum.can},
        std::pair{"fragments", sum.fragments},
        std::pair{"ipv6", sum.ipv6},
        std::pair{"other", sum.other_protocols},
        std::pair{"unknown link", sum.unknown_link},
        std::pair{"cut short", sum.cut_short},
        std::pair{"malformed", sum.malformed},
    };
    for (const auto& [name, count] : counts) {
        std::printf("  %-14s %llu\n", name, static_cast<unsigned long long>(count));
        EXPECT_GT(count, 0U) << name;  // each must have been met, or the test shows nothing
    }
}

}  // namespace
}  // namespace skyig::protocol::recording
