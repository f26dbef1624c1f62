// Every way in which a message can be wrong, by the name it is counted under, and the line that the log gets.
#include "server/inbox.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <vector>

#include "tests/server/world/host_bench.h"

namespace skyig::server {
namespace {

namespace cigi = protocol::cigi;
using world::HostBench;
using world::kHostA;

class InboxTest : public ::testing::TestWithParam<cigi::Version> {
  protected:
    InboxTest() { bench_.version = GetParam(); }

    template <class... Packets>
    std::vector<std::byte> message(const Packets&... packets) {
        std::array<std::byte, 512> buffer{};
        cigi::MessageWriter writer(buffer, GetParam(), cigi::ByteOrder::kBig);
        cigi::IgControl control;
        control.ig_mode = bench_.mode;
        control.host_frame_number = ++bench_.frame;
        EXPECT_TRUE(writer.add(control) && (writer.add(packets) && ...));
        return {writer.bytes().begin(), writer.bytes().end()};
    }
    void take(const std::vector<std::byte>& bytes, std::size_t source = 0) {
        inbox_.take(source, protocol::transport::Datagram{kHostA, 0, bytes});
    }
    /// What the names counted, of decoder and world together.
    [[nodiscard]] std::uint64_t counted(std::string_view name) const {
        for (std::size_t i = 0; i < cigi::kCounts; ++i)
            if (cigi::count_name(static_cast<cigi::Count>(i)) == name) return inbox_.counters().counts[i];
        const auto found =
            std::find_if(world::kCounterNames.begin(), world::kCounterNames.end(),
                         [name](const world::NamedCounter& counter) { return counter.name == name; });
        if (found != world::kCounterNames.end()) return bench_.world.counters().*found->value;
        ADD_FAILURE() << "no counter is called " << name;
        return 0;
    }
    void set(std::vector<std::byte>& bytes, std::size_t at, unsigned value) {
        bytes[at] = static_cast<std::byte>(value);
    }
    /// Size of the packet at `at`, below 256.
    void resize(std::vector<std::byte>& bytes, std::size_t at, unsigned size) {
        const bool is_33 = GetParam() == cigi::Version::k33;
        set(bytes, at + 1, size);
        if (!is_33) set(bytes, at, 0);
    }
    void rename(std::vector<std::byte>& bytes, std::size_t at, unsigned id) {
        if (GetParam() == cigi::Version::k33) {
            set(bytes, at, id);
        } else {
            set(bytes, at + 2, id >> 8U);
            set(bytes, at + 3, id & 0xFFU);
        }
    }

    HostBench bench_;
    Inbox inbox_{bench_.config, bench_.world, bench_.log};
};

TEST_P(InboxTest, EveryFaultIsCountedByItsName) {
    cigi::PositionRequest place;
    std::vector<std::byte> bytes = message(place);
    take({bytes.begin(), bytes.begin() + 23});
    EXPECT_EQ(counted("short"), 1U);
    std::vector<std::byte> bad = bytes;
    rename(bad, 0, 0xEE);
    take(bad);
    EXPECT_EQ(counted("first_packet"), 1U);
    bad = bytes;
    set(bad, GetParam() == cigi::Version::k33 ? 2 : 4, 7);
    take(bad);
    EXPECT_EQ(counted("bad_version"), 1U);
    if (GetParam() == cigi::Version::k33) {
        bad = bytes;
        set(bad, 6, 0x81);
        take(bad);
        EXPECT_EQ(counted("bad_magic"), 1U);
    }
    bad = bytes;
    resize(bad, 24, 1);
    take(bad);
    EXPECT_EQ(counted("bad_size"), 1U);
    resize(bad, 24, 16);
    take(bad);
    EXPECT_EQ(counted("truncated"), 1U);
    bad = bytes;
    bad.resize(bad.size() + 8);
    resize(bad, 24, 16);
    take(bad);
    EXPECT_EQ(counted("wrong_size"), 1U);
    bad = bytes;
    rename(bad, 24, 250);
    take(bad);
    EXPECT_EQ(counted("skipped"), 1U);
    cigi::AtmosphereControl air;
    air.visibility = std::numeric_limits<float>::quiet_NaN();
    take(message(air));
    EXPECT_EQ(counted("nonfinite"), 1U);
    air.visibility = -1.0F;
    take(message(air));
    EXPECT_EQ(counted("out_of_range"), 1U);
    air.visibility = 1.0F;
    air.humidity = 120;
    take(message(air));
    EXPECT_EQ(counted("clamped"), 1U);
    take(message(cigi::IgControl{}));
    EXPECT_EQ(counted("duplicate_ig_control"), 1U);
    bench_.mode = cigi::IgMode::kStandby;
    take(message(place, place));
    EXPECT_EQ(counted("standby_ignored"), 2U);
}

TEST_P(InboxTest, WhatIsPassedOverIsLoggedNowAndThen) {
    std::vector<std::byte> wrong = message(cigi::PositionRequest{});
    wrong.resize(wrong.size() + 8);
    resize(wrong, 24, 16);
    for (int i = 0; i < 50; ++i) {
        take(wrong);
        take(message(cigi::IgControl{}));
    }
    EXPECT_EQ(bench_.lines_with("position_request of 16 bytes at byte 24 ignored: a packet's size"), 1U);
    EXPECT_EQ(bench_.lines_with("ig_control of 24 bytes at byte 24 ignored: more than one IG Control"), 1U);
    EXPECT_EQ(counted("wrong_size"), 50U);
    EXPECT_EQ(counted("duplicate_ig_control"), 50U);
    bench_.clock.advance_s(11.0);
    take(wrong);
    EXPECT_EQ(bench_.lines_with("position_request of 16 bytes"), 2U);
}

TEST(Inbox, FaultsOfOneSourceDoNotHideThoseOfAnother) {
    config::Config config = world::three_channels();
    config.sources.emplace_back();
    config.sources.back().kind = config::SourceKind::kCigi;
    HostBench bench(config);
    Inbox inbox(bench.config, bench.world, bench.log);
    const std::vector<std::byte> noise(40);
    for (int i = 0; i < 5; ++i) {
        inbox.take(0, protocol::transport::Datagram{kHostA, 0, noise});
        inbox.take(1, protocol::transport::Datagram{world::kHostB, 0, noise});
    }
    EXPECT_EQ(bench.lines_with("datagram of 40 bytes"), 2U);
}

INSTANTIATE_TEST_SUITE_P(Versions, InboxTest, ::testing::Values(cigi::Version::k33, cigi::Version::k40),
                         [](const auto& version) {
                             return version.param == cigi::Version::k33 ? "Cigi33" : "Cigi40";
                         });

}  // namespace
}  // namespace skyig::server
