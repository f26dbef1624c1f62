// A recording run again: the same arrivals of the same sources in the same frames.
#include "server/replay.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/recording/pcapng_writer.h"
#include "server/inbox.h"
#include "server/log.h"
#include "server/world/world.h"
#include "tests/server/loop/recording_fixture.h"

namespace skyig::server {
namespace {

using namespace tests;
using protocol::recording::PcapngWriter;
using protocol::recording::RecordingHead;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr const char* kFlightGear = SKYIG_TEST_DATA "/flights/fg_native_fdm_2s.pcap";

protocol::CanFrame can_frame(std::uint32_t id, std::int64_t time_ns, std::uint8_t bus = 0) {
    protocol::CanFrame frame;
    frame.received_ns = time_ns;
    frame.id = id;
    frame.length = 1;
    frame.bus = bus;
    return frame;
}

/// Six frames, the fourth two slots late: host each frame, instructor each second, a bus each third.
std::string record(const Scratch& scratch, const config::Config& config) {
    Recorder recorder(scratch.file("rig.pcapng"), config, facts(config));
    std::int64_t now_ns = kStartNs;
    for (std::uint64_t i = 1; i <= 6; ++i) {
        const std::uint64_t slots = i == 1 ? 0 : i == 4 ? 2 : 1;
        now_ns += static_cast<std::int64_t>(slots) * 20 * kMs;
        recorder.mark({i, slots, 0, now_ns}, bytes_of("answer"));
        recorder.datagram(0, {kHost, now_ns - 3 * kMs, bytes_of(fmt::format("h{}", i))});
        if (i % 2 == 0) recorder.datagram(1, {kInstructor, now_ns - kMs, bytes_of(fmt::format("i{}", i))});
        if (i % 3 == 0) recorder.can_frame(3, can_frame(static_cast<std::uint32_t>(i), now_ns - 2 * kMs));
    }
    return recorder.path();
}

/// The line that a replay cannot be made for.
std::string refusal(const std::string& path, const config::Config& config = rig()) {
    try {
        const Replay replay(path, config);
    } catch (const std::runtime_error& error) {
        std::printf("  %s\n", error.what());
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "no error";
}

/// A capture as another program writes it.
class Foreign {
  public:
    Foreign(std::string path, std::vector<std::string> can_names) : path_(std::move(path)) {
        RecordingHead head;
        head.can_names = std::move(can_names);
        writer_.emplace(PcapngWriter::begin(
                            [this](std::span<const std::byte> blocks) {
                                bytes_.append(reinterpret_cast<const char*>(blocks.data()), blocks.size());
                                return true;
                            },
                            head)
                            .value());
    }
    void udp(std::int64_t at_ms, std::uint16_t to_port, std::string_view text,
             const protocol::transport::Endpoint& from = kHost) {
        EXPECT_TRUE(writer_->write_udp(kStartNs + at_ms * kMs, from, {0x7F000001, to_port}, bytes_of(text)));
    }
    void can(std::int64_t at_ms, std::uint8_t bus, std::uint32_t id) {
        EXPECT_TRUE(writer_->write_can(can_frame(id, kStartNs + at_ms * kMs, bus)));
    }
    const std::string& write() {
        std::ofstream(path_, std::ios::binary) << bytes_;
        return path_;
    }

  private:
    std::string path_;
    std::string bytes_;
    std::optional<PcapngWriter> writer_;
};

TEST(Replay, GivesEveryFrameWhatItHad) {
    const Scratch scratch;
    const config::Config config = rig();
    Replay replay(record(scratch, config), config);
    EXPECT_TRUE(replay.has_marks());
    EXPECT_EQ(replay.start_utc(), "2026-06-21T12:00:00.000000000Z");
    EXPECT_EQ(replay.renderer(), "llvmpipe test");
    const auto frames = frames_of(replay);
    ASSERT_EQ(frames.size(), 6U);
    EXPECT_THAT(frames[0].second, ElementsAre("0 127.0.0.1:8005 h1"));
    EXPECT_THAT(frames[1].second, ElementsAre("0 127.0.0.1:8005 h2", "1 127.0.0.1:9001 i2"));
    EXPECT_THAT(frames[2].second, ElementsAre("0 127.0.0.1:8005 h3", "3 can 3:1"));
    EXPECT_THAT(frames[5].second, ElementsAre("0 127.0.0.1:8005 h6", "1 127.0.0.1:9001 i6", "3 can 6:1"));
    std::vector<std::uint64_t> slots;
    for (const auto& [mark, heard] : frames)
        slots.push_back(mark.slots);
    EXPECT_THAT(slots, ElementsAre(0, 1, 1, 2, 1, 1));
    EXPECT_EQ(frames[3].first.utc_ns, kStartNs + 80 * kMs);
    EXPECT_EQ(frames[3].first.number, 4U);
    EXPECT_EQ(replay.strangers(), 0U);
    EXPECT_THAT(replay.trouble(), IsEmpty());
}

TEST(Replay, FrameThatDrainsNothingLosesItsArrivalsOnly) {
    const Scratch scratch;
    const config::Config config = rig();
    Replay replay(record(scratch, config), config);
    ASSERT_TRUE(replay.begin_frame());
    ASSERT_TRUE(replay.begin_frame());
    Words words;
    replay.drain(words);
    EXPECT_THAT(words.heard, ElementsAre("0 127.0.0.1:8005 h2", "1 127.0.0.1:9001 i2"));
}

TEST(Replay, RecordingCutAnywhereGivesAllThatIsWhole) {
    const Scratch scratch;
    const config::Config config = rig();
    const std::string whole = Scratch::read(record(scratch, config));
    Replay all(scratch.file("rig.pcapng"), config);
    const auto frames = frames_of(all);
    int lengths = 0;
    int refused = 0;
    std::size_t most = 0;
    for (std::size_t size = 0; size < whole.size(); size += size + 100 < whole.size() ? 7 : 1) {
        ++lengths;
        const std::string path = scratch.write("cut.pcapng", std::string_view(whole).substr(0, size));
        try {
            Replay cut(path, config);
            const auto kept = frames_of(cut);
            ASSERT_LE(kept.size(), frames.size());
            for (std::size_t i = 0; i < kept.size(); ++i) {
                ASSERT_EQ(kept[i].first.number, frames[i].first.number);
                ASSERT_LE(kept[i].second.size(), frames[i].second.size());
                ASSERT_TRUE(
                    std::equal(kept[i].second.begin(), kept[i].second.end(), frames[i].second.begin()));
            }
            ASSERT_GE(kept.size(), most) << "a longer file holds less";
            most = kept.size();
        } catch (const std::runtime_error& error) {
            ++refused;
            ASSERT_THAT(error.what(), HasSubstr("cut.pcapng"));
        }
    }
    std::printf("of %d lengths %d hold no frame, the longest holds %zu of %zu frames\n", lengths, refused,
                most, frames.size());
    EXPECT_EQ(most, frames.size());
    EXPECT_LT(refused, lengths / 2);
}

TEST(Replay, ForeignCaptureIsPutOnTheGridOfFrames) {
    const Scratch scratch;
    const config::Config config = rig();
    Foreign capture(scratch.file("foreign.pcapng"), {"can0"});
    capture.udp(0, 8004, "a");
    capture.udp(19, 8004, "b");
    capture.can(20, 0, 5);
    capture.udp(21, 8010, "c");
    capture.udp(90, 8004, "d");
    Replay replay(capture.write(), config);
    EXPECT_FALSE(replay.has_marks());
    EXPECT_EQ(replay.start_utc(), "");
    const auto frames = frames_of(replay);
    ASSERT_EQ(frames.size(), 6U);
    EXPECT_THAT(frames[0].second, ElementsAre("0 127.0.0.1:8005 a"));
    EXPECT_THAT(frames[1].second, ElementsAre("0 127.0.0.1:8005 b", "2 can 5:1"));
    EXPECT_THAT(frames[2].second, ElementsAre("1 127.0.0.1:8005 c"));
    EXPECT_THAT(frames[3].second, IsEmpty());
    EXPECT_THAT(frames[5].second, ElementsAre("0 127.0.0.1:8005 d"));
    EXPECT_EQ(frames[0].first.slots, 0U);
    EXPECT_EQ(frames[5].first.slots, 1U);
    EXPECT_EQ(frames[5].first.utc_ns, kStartNs + 100 * kMs);
}

TEST(Replay, CandumpLogIsPutOnTheGridByItsStamps) {
    const Scratch scratch;
    const config::Config config = rig();
    const std::string path = scratch.write("bus.log",
                                           "# two buses\n"
                                           "(1782000000.000000) can1 005#00\n"
                                           "(1782000000.019999) can0 006#00\n"
                                           "(1782000000.020001) can1 007#00\n"
                                           "(1782000000.060000) can0 008#00\n");
    Replay replay(path, config);
    EXPECT_FALSE(replay.has_marks());
    const auto frames = frames_of(replay);
    ASSERT_EQ(frames.size(), 4U);
    EXPECT_THAT(frames[0].second, ElementsAre("3 can 5:1"));
    EXPECT_THAT(frames[1].second, ElementsAre("2 can 6:1"));
    EXPECT_THAT(frames[2].second, ElementsAre("3 can 7:1"));
    EXPECT_THAT(frames[3].second, ElementsAre("2 can 8:1"));
    EXPECT_EQ(frames[3].first.utc_ns, kStartNs + 60 * kMs);
    EXPECT_THAT(refusal(scratch.write("empty.log", "# nothing\n")),
                HasSubstr("holds no UDP datagram and no CAN frame"));
    EXPECT_THAT(refusal(scratch.write("bad.log", "(12) can0 1\n")), HasSubstr("line 1, column 4"));
}

TEST(Replay, BusIsFoundByItsNameBeforeItsPlace) {
    const Scratch scratch;
    const config::Config config = rig();
    Foreign named(scratch.file("named.pcapng"), {"can1"});
    named.can(0, 0, 1);
    Replay by_name(named.write(), config);
    EXPECT_THAT(frames_of(by_name)[0].second, ElementsAre("3 can 1:1"));

    Foreign foreign(scratch.file("other.pcapng"), {"vcan7", "vcan8", "vcan9"});
    foreign.can(0, 0, 1);
    foreign.can(0, 1, 2);
    foreign.can(0, 2, 3);
    Replay by_place(foreign.write(), config);
    EXPECT_THAT(frames_of(by_place)[0].second, ElementsAre("2 can 1:1", "3 can 2:1"));
    EXPECT_EQ(by_place.strangers(), 1U);

    config::Config one_bus = config;
    one_bus.sources.pop_back();
    Replay only(foreign.write(), one_bus);
    EXPECT_THAT(frames_of(only)[0].second, ElementsAre("2 can 1:1", "2 can 2:1", "2 can 3:1"));
}

TEST(Replay, SendersAreToldApartAsTheSettingsSay) {
    const Scratch scratch;
    config::Config config = rig();
    // Both on one port.
    config.sources[0].listen.port = 8004;
    config.host.allow = {{"127.0.0.1", 8005}};
    config.sources[0].allow = {{"127.0.0.1", 9001}};
    Foreign capture(scratch.file("shared.pcapng"), {});
    capture.udp(0, 8004, "host");
    capture.udp(0, 8004, "instructor", kInstructor);
    capture.udp(0, 8004, "nobody", {0x7F000001, 9999});
    capture.udp(0, 8004, "elsewhere", {0x0A000001, 8005});
    capture.udp(0, 53, "name");
    Replay replay(capture.write(), config);
    EXPECT_THAT(frames_of(replay)[0].second,
                ElementsAre("0 127.0.0.1:8005 host", "1 127.0.0.1:9001 instructor"));
    EXPECT_EQ(replay.strangers(), 3U);
}

TEST(Replay, FlightGearsCaptureMovesTheOwnship) {
    config::Config config = config::default_config();
    config.host.enabled = false;
    config.sources.push_back(source("flight", config::SourceKind::kFgNetFdm));
    // Not the port of the capture: a lone source is meant in any case.
    config.sources[0].listen.port = 7777;
    ManualClock clock;
    Log log(clock, [](Severity, std::string_view) {});
    world::World world(config, *ephemeris::parse_utc("2026-06-21T12:00:00Z"), log);
    Inbox inbox(config, world, log);
    Replay replay(kFlightGear, config);
    int frames = 0;
    double longest_step_deg = 0.0;
    double latitude_deg = 0.0;
    while (const auto mark = replay.begin_frame()) {
        replay.drain(inbox);
        world.advance(static_cast<double>(mark->slots) / config.daemon.rate_hz);
        const double now_deg = world.ownship().position.latitude_deg;
        if (frames++ > 0) longest_step_deg = std::max(longest_step_deg, std::abs(now_deg - latitude_deg));
        latitude_deg = now_deg;
    }
    EXPECT_EQ(inbox.datagrams(), 60U);
    EXPECT_TRUE(world.ownship().placed_by_host);
    // Keflavik; 2 s of climb.
    EXPECT_NEAR(latitude_deg, 63.98, 0.05);
    EXPECT_NEAR(world.ownship().position.longitude_deg, -22.6, 0.1);
    std::printf("60 packets in %d frames, the largest step is %.1f m\n", frames, longest_step_deg * 111e3);
    EXPECT_NEAR(frames, 120, 12);
    // 0.7 m a frame, and once 2.7 m between two packets of which the first came late.
    EXPECT_LT(longest_step_deg * 111e3, 2.7);
    EXPECT_GT(longest_step_deg, 0.0);
}

TEST(Replay, WhatCannotBeReplayedIsOneLine) {
    const Scratch scratch;
    EXPECT_THAT(refusal("no/such/file.pcapng"), HasSubstr("no/such/file.pcapng: "));
    EXPECT_THAT(refusal(scratch.write("empty.pcapng", "")), HasSubstr("empty.pcapng"));
    EXPECT_THAT(refusal(scratch.write("text.pcapng", "t_s,lat_deg\n0,1\n2,3\n4,5\n6,7\n")),
                HasSubstr("text.pcapng: byte 0: "));
    Foreign nothing(scratch.file("nothing.pcapng"), {"can0"});
    EXPECT_THAT(refusal(nothing.write()), HasSubstr("holds no UDP datagram and no CAN frame to replay"));
    config::Config other = rig();
    other.daemon.rate_hz = 60.0;
    EXPECT_THAT(refusal(record(scratch, rig()), other),
                HasSubstr("rig.pcapng: made at 50 Hz; the settings say daemon.rate_hz = 60"));
}

TEST(Replay, RecordingOfAnotherVersionIsRefusedByName) {
    const Scratch scratch;
    for (const char* version : {"skyig recording 2", "skyig recording 9"}) {
        std::string bytes = Scratch::read(record(scratch, rig()));
        const std::size_t at = bytes.find(kRecordingTitle);
        ASSERT_NE(at, std::string::npos);
        bytes.replace(at, std::string_view(version).size(), version);
        EXPECT_THAT(refusal(scratch.write("other.pcapng", bytes)),
                    HasSubstr(std::string("other.pcapng: is a \"") + version +
                              "\"; this program replays \"skyig recording 1\""));
    }
}

TEST(ReplayPace, GoesByTheRecordingAndSleepsOnTheWall) {
    const Scratch scratch;
    const config::Config config = rig();
    const std::string path = record(scratch, config);
    for (const double speed : {0.0, 1.0, 4.0}) {
        Replay replay(path, config);
        ManualClock now;
        ManualClock wall(77 * kMs);
        ReplayPace pace(replay, now, wall, config.daemon.rate_hz, speed);
        std::vector<std::uint64_t> slots;
        while (const auto slot = pace.next()) {
            slots.push_back(slot->slots);
            EXPECT_FALSE(slot->late);
        }
        EXPECT_THAT(slots, ElementsAre(0, 1, 1, 2, 1, 1));
        EXPECT_EQ(now.monotonic_ns(), 120 * kMs);
        const double expected_ms = speed == 0.0 ? 0.0 : 120.0 / speed;
        EXPECT_NEAR(static_cast<double>(wall.monotonic_ns()) * 1e-6 - 77.0, expected_ms, 1e-6) << speed;
    }
}

}  // namespace
}  // namespace skyig::server
