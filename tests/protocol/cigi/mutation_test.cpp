// Damaged datagrams: cut at every byte, and a million random changes. What comes through must still keep its
// promises; the sanitizer build of this test watches the reads.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <random>

#include "protocol/cigi/layout_host.h"
#include "protocol/cigi/layout_ig.h"
#include "protocol/cigi/layout_sight.h"
#include "protocol/cigi/message.h"
#include "tests/protocol/cigi/golden.h"

namespace skyig::protocol::cigi {
namespace {

bool inside(const Range& range, double value) {
    switch (range.kind) {
        case Range::Kind::kAny:
            return true;
        case Range::Kind::kClosed:
            return value >= range.low && value <= range.high;
        case Range::Kind::kHalfOpen:
            return value >= range.low && value < range.high;
        case Range::Kind::kPositive:
            return value > 0.0;
        case Range::Kind::kPercent:
            return value >= 0.0 && value <= 100.0;
        case Range::Kind::kHalfTurn:
            return std::abs(value) <= 180.0;
        case Range::Kind::kFullTurn:
            return value >= 0.0 && value <= 360.0;
        case Range::Kind::kTwoTurns:
            break;
    }
    return std::abs(value) <= 360.0;
}

/// Checks all that validation promises of every packet.
struct Promises {
    template <class P>
    void operator()(const P& packet, const PacketInfo& info) {
        ++delivered;
        in_order = in_order && info.offset + info.bytes.size() > end;
        end = info.offset + info.bytes.size();
        for_each_field<P>([&](const auto& field) {
            using Value = typename std::decay_t<decltype(field)>::Value;
            const Value& value = packet.*(field.member);
            if constexpr (std::is_floating_point_v<Value>) {
                finite = finite && std::isfinite(value);
                const bool counts = field.counts == nullptr || field.counts(packet);
                in_range = in_range && (!counts || inside(field.range, static_cast<double>(value)));
            } else if constexpr (std::is_same_v<Value, std::string_view>) {
                for (const char c : value)
                    touched = touched + static_cast<unsigned char>(c);
            }
        });
    }
    void skipped(const PacketInfo& /*info*/) { ++passed_over; }

    std::uint64_t delivered = 0;
    std::uint64_t passed_over = 0;
    std::size_t end = 0;
    unsigned touched = 0;
    bool finite = true;
    bool in_range = true;
    bool in_order = true;
};

/// Decodes as host and as IG message and checks what came out.
MessageSummary decode_both(std::span<const std::byte> bytes, Counters& counters) {
    Promises host;
    Promises ig;
    const MessageSummary summary = decode_host_message(bytes, host, counters);
    const MessageSummary other = decode_ig_message(bytes, ig, counters);
    EXPECT_FALSE(summary.accepted && other.accepted);
    for (const Promises& promises : {host, ig}) {
        EXPECT_TRUE(promises.finite && promises.in_range && promises.in_order);
        EXPECT_LE(promises.end, bytes.size());
    }
    return summary.accepted ? summary : other;
}

/// Storage whose last byte is the datagram's last byte, so that a read beyond it is seen by the sanitizer.
class TightBuffer {
  public:
    static constexpr std::size_t kSize = 1024;
    std::span<std::byte> last(std::size_t size) { return std::span(storage_.get(), kSize).last(size); }

  private:
    std::unique_ptr<std::byte[]> storage_{new std::byte[kSize]};
};

TEST(Damage, ADatagramCutAnywhereKeepsItsWholePackets) {
    TightBuffer buffer;
    std::uint64_t cuts = 0;
    for (const GoldenDatagram& golden : golden_datagrams()) {
        for (std::size_t size = 0; size <= golden.bytes.size(); ++size) {
            const auto bytes = buffer.last(size);
            std::copy_n(golden.bytes.begin(), size, bytes.begin());
            Counters counters;
            const MessageSummary summary = decode_both(bytes, counters);
            ++cuts;
            std::size_t whole = 0;
            bool at_boundary = false;
            for (const auto& packet : golden.packets) {
                const std::size_t end =
                    packet.at("offset").get<std::size_t>() + packet.at("size").get<std::size_t>();
                if (end <= size && !packet.at("packet").is_null()) ++whole;
                at_boundary = at_boundary || end == size;
            }
            std::uint64_t delivered = 0;
            for (const std::uint64_t count : counters.packets)
                delivered += count;
            EXPECT_EQ(summary.accepted, size >= 24) << golden.name << " cut to " << size;
            EXPECT_EQ(delivered, whole) << golden.name << " cut to " << size;
            EXPECT_EQ(counters[Count::kTruncated], size >= 24 && !at_boundary ? 1U : 0U);
        }
    }
    std::printf("%llu cuts\n", static_cast<unsigned long long>(cuts));
    EXPECT_GT(cuts, 2000U);
}

class Mutator {
  public:
    explicit Mutator(std::uint64_t seed) : random_(seed) {}

    /// A golden datagram with one to six changes, in `buffer`.
    std::span<const std::byte> next(TightBuffer& buffer) {
        const auto& all = golden_datagrams();
        const std::vector<std::byte>& source = all[below(all.size())].bytes;
        std::size_t size = source.size();
        if (below(4) == 0) size = below(source.size() + 1);
        if (below(8) == 0) size = std::min(TightBuffer::kSize, source.size() + below(64));
        const auto bytes = buffer.last(size);
        std::fill(bytes.begin(), bytes.end(), static_cast<std::byte>(below(256)));
        std::copy_n(source.begin(), std::min(size, source.size()), bytes.begin());
        for (std::size_t changes = 1 + below(6); changes > 0 && size > 0; --changes)
            change(bytes);
        return bytes;
    }

  private:
    std::size_t below(std::size_t limit) { return static_cast<std::size_t>(random_() % limit); }

    void change(std::span<std::byte> bytes) {
        // Most changes spare the first packet: without it nothing else is read.
        const std::size_t first = bytes.size() > 24 && below(8) != 0 ? 24 : 0;
        std::byte& target = bytes[first + below(bytes.size() - first)];
        switch (below(4)) {
            case 0:
                target ^= static_cast<std::byte>(1U << below(8));
                break;
            case 1:
                target = static_cast<std::byte>(below(256));
                break;
            case 2:
                target =
                    below(2) == 0 ? std::byte{0xFF} : std::byte{0x7F};  // makes NaNs and infinities likely
                break;
            default: {
                const std::size_t length = 1 + below(std::min<std::size_t>(8, bytes.size()));
                const std::size_t from = below(bytes.size() - length + 1);
                const std::size_t to = below(bytes.size() - length + 1);
                std::memmove(bytes.data() + to, bytes.data() + from, length);
            }
        }
    }

    std::mt19937_64 random_;
};

TEST(Damage, AMillionRandomChangesBreakNoPromise) {
    constexpr int kRounds = 1'000'000;
    const std::uint64_t seed = std::random_device{}();
    std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
    RecordProperty("seed", std::to_string(seed));
    Mutator mutator(seed);
    TightBuffer buffer;
    Counters counters;
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kRounds && !HasFailure(); ++i)
        static_cast<void>(decode_both(mutator.next(buffer), counters));
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    std::printf("%d datagrams in %.2f s, %llu accepted\n", kRounds, seconds.count(),
                static_cast<unsigned long long>(counters.messages));
    // Each kind of damage must have been met, or the test shows nothing.
    for (std::size_t i = 0; i < kCounts; ++i) {
        const auto count = static_cast<Count>(i);
        std::printf("  %-26s %llu\n", std::string(count_name(count)).c_str(),
                    static_cast<unsigned long long>(counters[count]));
        EXPECT_GT(counters[count], 0U) << count_name(count);
    }
}

}  // namespace
}  // namespace skyig::protocol::cigi
