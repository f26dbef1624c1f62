// A host at 60 Hz and a bus with 1000 frames a second, recorded and replayed twice bit by bit.
//   SKYIG_DATA_SECONDS=N    so much of them (script/replay-check: ten minutes); seven seconds without it
//   SKYIG_RECORD_SECONDS=N  at their own pace for so long with and without a recording, three times each:
//   what
//                           recording takes of a processor (script/record-check)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/recording/pcapng_writer.h"
#include "tests/e2e/rig.h"
#include "tests/support/cockpit_traffic.h"

namespace skyig::tests {
namespace {

namespace recording = protocol::recording;
namespace transport = protocol::transport;
using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr std::uint16_t kHostPort = 8004;
constexpr transport::Endpoint kHost{0x7F000001, 8005};
constexpr std::int64_t kStartUtc_ns = 1'782'043'140'000'000'000;  // 2026-06-21T11:59:00Z

long seconds_from(const char* name, long otherwise) {
    const char* text = std::getenv(name);
    return text == nullptr ? otherwise : std::atol(text);
}

/// Place and time are the bus's; while it is silent, the host's.
std::string settings(bool with_bus) {
    std::string text =
        "version = 1\n[daemon]\nrate_hz = 60\n[host]\nlisten = \"127.0.0.1:8004\"\npriority = 40\n"
        "[start]\nutc = \"2026-06-21T12:00:00Z\"\n" +
        channel_toml("only", 160, 128, 0);
    if (with_bus)
        text +=
            "[[source]]\nname = \"cockpit\"\nkind = \"canaerospace\"\ninterface = \"can0\"\n"
            "owns = [\"ownship\", \"time\"]\npriority = 60\n";
    return text;
}

struct Sent {
    std::uint64_t messages = 0;
    std::uint64_t frames = 0;
};

/// A capture as tcpdump would make it.
Sent write_capture(const std::string& path, long seconds) {
    std::ofstream file(path, std::ios::binary);
    recording::RecordingHead head;
    head.can_names = {"can0"};
    auto writer = recording::PcapngWriter::begin(
        [&file](std::span<const std::byte> blocks) {
            file.write(reinterpret_cast<const char*>(blocks.data()),
                       static_cast<std::streamsize>(blocks.size()));
            return file.good();
        },
        head);
    Sent sent;
    if (!writer) return sent;
    CockpitTraffic traffic(kStartUtc_ns);
    const std::int64_t end_ns = kStartUtc_ns + seconds * 1'000'000'000;
    for (const CockpitTraffic::Arrival* arrival = &traffic.next(); arrival->utc_ns < end_ns;
         arrival = &traffic.next()) {
        const bool written =
            arrival->is_can
                ? writer->write_can(arrival->frame)
                : writer->write_udp(arrival->utc_ns, kHost, {kHost.address, kHostPort}, arrival->message);
        EXPECT_TRUE(written);
        ++(arrival->is_can ? sent.frames : sent.messages);
    }
    return sent;
}

std::size_t different_hashes(const std::string& hashes) {
    std::set<std::string> seen;
    std::istringstream in(hashes);
    for (std::string line; std::getline(in, line);)
        seen.insert(line.substr(line.rfind(' ')));
    return seen.size();
}

TEST(BusAndHost, ARecordingReplaysTwiceBitByBit) {
    const long seconds = seconds_from("SKYIG_DATA_SECONDS", 7);
    const std::chrono::seconds limit(60 + 3 * seconds);
    const ScratchDirectory scratch;
    const std::string capture = scratch.file("capture.pcapng");
    const std::string recorded = scratch.file("recording.pcapng");
    const std::string config = scratch.write("site.toml", settings(true));
    const auto begin = std::chrono::steady_clock::now();
    const Sent sent = write_capture(capture, seconds);
    const Replayed drawn = replay(SKYIGD_PROGRAM, config, capture, {"--record", recorded}, limit);
    const Replayed first = replay(SKYIGD_PROGRAM, config, recorded, {}, limit);
    const Replayed second = replay(SKYIGD_PROGRAM, config, recorded, {}, limit);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    for (const Replayed* one : {&drawn, &first, &second})
        ASSERT_EQ(one->finished.status, 0) << one->finished.err;

    const std::size_t different = different_hashes(first.hashes);
    std::printf(
        "%ld s of data: %ju messages, %ju CAN frames, a recording of %ju bytes; %ld frames, %zu "
        "different, %ld lines of log; three runs in %.1f s\n",
        seconds, std::uintmax_t{sent.messages}, std::uintmax_t{sent.frames},
        std::uintmax_t{std::filesystem::file_size(recorded)}, line_count(first.hashes), different,
        line_count(first.events), took.count());
    EXPECT_TRUE(first.hashes == drawn.hashes) << "drawn otherwise than while recording";
    EXPECT_TRUE(second.hashes == first.hashes) << "drawn otherwise from one replay to the next";
    EXPECT_TRUE(second.events == first.events) << "told otherwise from one replay to the next";
    EXPECT_EQ(events_of_frames(first.events), events_of_frames(drawn.events));
    EXPECT_NEAR(static_cast<double>(line_count(first.hashes)), static_cast<double>(60 * seconds), 2.0);
    EXPECT_GT(different, static_cast<std::size_t>(30 * seconds));
    const Json told = Json::parse(first.report);
    EXPECT_EQ(told.at("datagrams"), sent.messages);
    EXPECT_EQ(told.at("packets").at("ig_control"), sent.messages);
    EXPECT_THAT(first.events, HasSubstr("cockpit lost: "));

    // The bus is seen in the picture.
    const std::string alone = scratch.write("alone.toml", settings(false));
    const Replayed without = replay(SKYIGD_PROGRAM, alone, recorded, {"--frames", "120"}, limit);
    EXPECT_FALSE(first.hashes.starts_with(without.hashes));
}

/// Processor time a second of one run at the recorded pace.
double cpu_of_replay(const std::string& config, const std::string& capture,
                     const std::vector<std::string>& more) {
    const ScratchDirectory scratch;
    std::vector<std::string> command{
        SKYIGD_PROGRAM,        "--config", config, "--replay", capture, "--speed", "1", "--report",
        scratch.file("report")};
    command.insert(command.end(), more.begin(), more.end());
    const Finished finished = Process(command).wait(std::chrono::hours(1));
    EXPECT_EQ(finished.status, 0) << finished.err;
    const Json report = Json::parse(read_text(scratch.file("report")));
    return report.at("cpu_s").get<double>() / report.at("elapsed_s").get<double>();
}

TEST(BusAndHost, RecordingTakesLessThanTwoPercentOfAProcessor) {
    const long seconds = seconds_from("SKYIG_RECORD_SECONDS", 0);
    if (seconds == 0) GTEST_SKIP() << "takes minutes: script/record-check runs it";
    constexpr int kRounds = 3;
    const ScratchDirectory scratch;
    const std::string capture = scratch.file("capture.pcapng");
    const std::string config = scratch.write("site.toml", settings(true));
    write_capture(capture, seconds);
    // Other work on the machine only adds: the least of each is the truest.
    double plain = std::numeric_limits<double>::max();
    double recorded = plain;
    for (int round = 0; round < kRounds; ++round) {
        plain = std::min(plain, cpu_of_replay(config, capture, {}));
        recorded =
            std::min(recorded, cpu_of_replay(config, capture, {"--record", scratch.file("copy.pcapng")}));
    }
    std::printf(
        "%ld s at their own pace, the least of %d: %.2f %% of a processor, %.2f %% with a recording\n",
        seconds, kRounds, 100.0 * plain, 100.0 * recorded);
    EXPECT_LT(recorded - plain, 0.02);
}

}  // namespace
}  // namespace skyig::tests
