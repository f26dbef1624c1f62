// Recordings of the real daemon run again by the real daemon: the same pictures, the same log.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "protocol/cigi/message.h"
#include "protocol/recording/capture_reader.h"
#include "tests/e2e/process.h"
#include "tests/e2e/rig.h"
#include "tests/e2e/site.h"

namespace skyig::tests {
namespace {

namespace cigi = protocol::cigi;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

constexpr const char* kFlight = SKYIG_TEST_DATA "/flights/fg_c172p_takeoff_bikf.csv";
constexpr const char* kFlightGear = SKYIG_TEST_DATA "/flights/fg_native_fdm_2s.pcap";

std::vector<std::string> host_command(const Rig& rig, const std::string& version, const std::string& order,
                                      const std::string& duration_s) {
    const std::string local = "127.0.0.1:";
    return {SKYIG_PROGRAM, "host",
            "--flight",    kFlight,
            "--utc",       "2024-06-21T21:30:15Z",
            "--cigi",      version,
            "--order",     order,
            "--to",        local + std::to_string(rig.host_port),
            "--listen",    local + std::to_string(rig.reply_port),
            "--duration",  duration_s,
            "--start-s",   "40",
            "--wait",      "15",
            "--json"};
}

/// Sends the weather from a port of its own.
class Instructor {
  public:
    void say(const Rig& rig, float visibility_m) {
        cigi::MessageWriter writer(buffer_, cigi::Version::k33, cigi::ByteOrder::kBig);
        cigi::IgControl control;
        control.ig_mode = cigi::IgMode::kOperate;
        control.host_frame_number = ++frame_;
        ASSERT_TRUE(writer.add(control));
        cigi::AtmosphereControl air;
        air.model_enable = true;
        air.humidity = 50;
        air.air_temperature = 10.0F;
        air.visibility = visibility_m;
        air.pressure = 1000.0F;
        ASSERT_TRUE(writer.add(air));
        socket_.send(rig.instructor_port, writer.bytes());
    }
    void send(std::uint16_t port, std::span<const std::byte> bytes) const { socket_.send(port, bytes); }

  private:
    TestSocket socket_;
    std::array<std::byte, 256> buffer_{};
    std::uint32_t frame_ = 0;
};

Json report_of(const std::string& text) {
    return text.empty() ? Json::object() : Json::parse(text);
}

long different_hashes(const std::string& hashes) {
    std::set<std::string> seen;
    std::istringstream in(hashes);
    for (std::string line; std::getline(in, line);)
        seen.insert(line.substr(line.rfind(' ')));
    return static_cast<long>(seen.size());
}

/// A run with all that a log may tell of: two sources, garbage, silence, a host of another version.
class LiveRun {
  public:
    LiveRun() {
        Process daemon({SKYIGD_PROGRAM, "--config", config, "--record", recording, "--hashes",
                        rig.scratch.file("hashes"), "--report", rig.scratch.file("report")});
        EXPECT_TRUE(daemon.wait_for_err("records into")) << daemon.err_so_far();
        {
            Process host(host_command(rig, "3.3", "big", "1.5"));
            EXPECT_TRUE(daemon.wait_for_err("set mode operate")) << daemon.err_so_far();
            Instructor instructor;
            for (int i = 0; i < 20; ++i) {
                instructor.say(rig, i % 2 == 0 ? 2000.0F : 60'000.0F);
                if (i == 10) instructor.send(rig.host_port, std::vector<std::byte>(48, std::byte{0x5A}));
                std::this_thread::sleep_for(std::chrono::milliseconds(50));
            }
            const Finished flown = host.wait();
            EXPECT_EQ(flown.status, 0) << flown.err;
        }
        EXPECT_TRUE(daemon.wait_for_err(" lost: ")) << daemon.err_so_far();
        const Finished again = run(host_command(rig, "4.0", "little", "0.3"));
        EXPECT_EQ(again.status, 0) << again.err;
        daemon.signal(SIGTERM);
        const Finished finished = daemon.wait();
        EXPECT_EQ(finished.status, 0) << finished.err;
        hashes = read_text(rig.scratch.file("hashes"));
        report = report_of(read_text(rig.scratch.file("report")));
    }

    Rig rig;
    std::string recording = rig.scratch.file("run.pcapng");
    std::string config = rig.scratch.write("site.toml", rig.settings());
    std::string hashes;
    Json report;
};

/// One run for all of its tests.
class RecordedRun : public ::testing::Test {
  protected:
    static void SetUpTestSuite() { live_ = std::make_unique<LiveRun>(); }
    static void TearDownTestSuite() { live_.reset(); }

    [[nodiscard]] static Replayed again(const std::string& config) {
        Replayed replayed = replay(SKYIGD_PROGRAM, config, live_->recording);
        EXPECT_EQ(replayed.finished.status, 0) << replayed.finished.err;
        return replayed;
    }

    static std::unique_ptr<LiveRun> live_;
};

std::unique_ptr<LiveRun> RecordedRun::live_;

TEST_F(RecordedRun, ReplaysToTheSamePicturesAndTheSameLog) {
    const Replayed first = again(live_->config);
    const Replayed second = again(live_->config);
    std::printf("%ld frames drawn, %ld different; a recording of %ju bytes, %ld lines of log\n",
                line_count(live_->hashes), different_hashes(live_->hashes),
                static_cast<std::uintmax_t>(std::filesystem::file_size(live_->recording)),
                line_count(first.events));
    EXPECT_GT(line_count(live_->hashes), 120);
    EXPECT_GT(different_hashes(live_->hashes), 60);
    // Not EXPECT_EQ: thousands of lines would be told.
    EXPECT_TRUE(first.hashes == live_->hashes) << "drawn otherwise than live";
    EXPECT_TRUE(second.hashes == first.hashes) << "drawn otherwise from one replay to the next";
    EXPECT_EQ(first.events, second.events);
    for (const char* part :
         {"speaks CIGI 3.3", "clock set to 2024-06-21", " dropped: ", " lost: ", " is back after "})
        EXPECT_THAT(first.events, HasSubstr(part));
    const Json told = report_of(first.report);
    EXPECT_EQ(told.at("frames"), live_->report.at("frames"));
    EXPECT_EQ(told.at("datagrams"), live_->report.at("datagrams"));
    EXPECT_EQ(told.at("packets"), live_->report.at("packets"));
    EXPECT_EQ(told.at("rejects"), live_->report.at("rejects"));
    EXPECT_EQ(told.at("packets").at("atmosphere_control"), 20);
    if (std::getenv("SKYIG_REBUILD_REPLAYS") != nullptr) {
        const std::string to = SKYIG_SOURCE_DIR "/tests/replay/host_and_instructor";
        std::filesystem::copy_file(live_->recording, to + ".pcapng",
                                   std::filesystem::copy_options::overwrite_existing);
        std::filesystem::copy_file(live_->config, to + ".toml",
                                   std::filesystem::copy_options::overwrite_existing);
    }
}

TEST_F(RecordedRun, PositionIsTheHostsAndWeatherTheInstructors) {
    const auto with = [](const char* host_owns, const char* instructor_owns) {
        return again(live_->rig.scratch.write("other.toml",
                                              live_->rig.settings({}, host_owns, instructor_owns)))
            .hashes;
    };
    const std::string host = R"(["control", "ownship", "time", "views"])";
    EXPECT_TRUE(with(host.c_str(), R"(["weather"])") == live_->hashes);
    EXPECT_FALSE(with(host.c_str(), R"(["views"])") == live_->hashes) << "the weather changed no picture";
    EXPECT_FALSE(with(R"(["control", "time", "views"])", R"(["weather"])") == live_->hashes)
        << "the position changed no picture";
}

TEST(Replay, RecordingOfAKilledDaemonReplays) {
    const Rig rig;
    const std::string recording = rig.scratch.file("killed.pcapng");
    const std::string config = rig.scratch.write("site.toml", rig.settings("2026-06-21T12:00:00Z"));
    {
        Process daemon({SKYIGD_PROGRAM, "--config", config, "--record", recording});
        Process host(host_command(rig, "3.3", "little", "30"));
        ASSERT_TRUE(daemon.wait_for_err("clock set to")) << daemon.err_so_far();
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        daemon.signal(SIGKILL);
        EXPECT_EQ(daemon.wait().status, 128 + SIGKILL);
    }
    const Replayed first = replay(SKYIGD_PROGRAM, config, recording);
    const Replayed second = replay(SKYIGD_PROGRAM, config, recording);
    EXPECT_EQ(first.finished.status, 0) << first.finished.err;
    EXPECT_GE(line_count(first.hashes), 10);
    EXPECT_TRUE(first.hashes == second.hashes);
    EXPECT_THAT(first.events, HasSubstr("clock set to 2024-06-21"));
    std::printf("%ld frames of a daemon killed half a second after its clock was set\n",
                line_count(first.hashes));
}

TEST(Replay, FlightGearsCaptureMovesThePicture) {
    const ScratchDirectory scratch;
    const std::string config = scratch.write(
        "fg.toml",
        "version = 1\n[host]\nenabled = false\n[start]\nutc = \"2026-06-21T20:00:00Z\"\n[[source]]\nname = "
        "\"flight\"\nkind = \"fgnetfdm\"\nlisten = \"127.0.0.1:5500\"\n" +
            channel_toml("only", 64, 48, 0));
    const Replayed first = replay(SKYIGD_PROGRAM, config, kFlightGear);
    const Replayed second = replay(SKYIGD_PROGRAM, config, kFlightGear);
    ASSERT_EQ(first.finished.status, 0) << first.finished.err;
    EXPECT_TRUE(first.hashes == second.hashes);
    EXPECT_EQ(first.events, second.events);
    const long frames = line_count(first.hashes);
    const long different = different_hashes(first.hashes);
    std::printf("FlightGear: %ld frames, %ld different\n", frames, different);
    EXPECT_GE(frames, 110);
    // A climb in a turn: hardly a frame looks like another.
    EXPECT_GT(different, frames / 2);
    EXPECT_EQ(report_of(first.report).at("datagrams"), 60);
}

TEST(Replay, IsRecordedOnRequestAndIntoAnotherFileOnly) {
    const Rig rig;
    const std::string records = rig.scratch.file("records");
    std::filesystem::create_directory(records);
    const std::string config = rig.scratch.write(
        "site.toml", rig.settings("2026-06-21T12:00:00Z") + "[record]\nfile = \"records/{time}.pcapng\"\n");
    const auto files = [&records] {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(records))
            names.push_back(entry.path().string());
        return names;
    };
    const Finished live = run({SKYIGD_PROGRAM, "--config", config, "--frames", "5"});
    ASSERT_EQ(live.status, 0) << live.err;
    ASSERT_EQ(files().size(), 1U);
    const std::string recording = files().front();
    EXPECT_THAT(std::filesystem::path(recording).filename().string(),
                ::testing::MatchesRegex("[0-9]{8}T[0-9]{6}Z\\.pcapng"));

    const Replayed plain = replay(SKYIGD_PROGRAM, config, recording);
    EXPECT_EQ(plain.finished.status, 0) << plain.finished.err;
    EXPECT_EQ(line_count(plain.hashes), 5);
    EXPECT_EQ(files().size(), 1U);

    const Replayed onto_itself = replay(SKYIGD_PROGRAM, config, recording, {"--record", recording});
    EXPECT_EQ(onto_itself.finished.status, 1);
    EXPECT_THAT(onto_itself.finished.err, HasSubstr("is the recording that is replayed"));

    // A replay that is recorded replays the same.
    const std::string copy = rig.scratch.file("copy.pcapng");
    EXPECT_TRUE(replay(SKYIGD_PROGRAM, config, recording, {"--record", copy}).hashes == plain.hashes);
    EXPECT_TRUE(replay(SKYIGD_PROGRAM, config, copy).hashes == plain.hashes);
}

TEST(Replay, WhatCannotBeReplayedOrRecordedIsOneLine) {
    const Rig rig;
    const std::string config = rig.scratch.write("site.toml", rig.settings("2026-06-21T12:00:00Z"));
    const auto fails = [&](const std::vector<std::string>& more, const std::string& part) {
        std::vector<std::string> command{SKYIGD_PROGRAM, "--config", config};
        command.insert(command.end(), more.begin(), more.end());
        const Finished finished = run(command);
        EXPECT_EQ(finished.status, 1);
        EXPECT_THAT(finished.err, HasSubstr("skyigd: "));
        EXPECT_THAT(finished.err, HasSubstr(part));
    };
    fails({"--replay", "no/such.pcapng"}, "no/such.pcapng");
    fails({"--replay", kFlight}, "fg_c172p_takeoff_bikf.csv: byte 0: 23 20 46 6C is the head of no capture");
    fails({"--record", "no/such/dir/a.pcapng"}, "cannot be made for a recording");
    fails({"--hashes", "no/such/dir/hashes"}, "cannot be made for hashes");
    EXPECT_EQ(run({SKYIGD_PROGRAM, "--config", config, "--speed", "2"}).status, 2);
}

TEST(SkyigReplay, PlaysIntoADaemonAndIntoARecorder) {
    const ScratchDirectory scratch;
    const std::string at = "127.0.0.1:" + std::to_string(free_port());
    const std::string config =
        scratch.write("fg.toml",
                      "version = 1\n[host]\nenabled = false\n[[source]]\nname = \"flight\"\nkind = "
                      "\"fgnetfdm\"\nlisten = \"" +
                          at + "\"\n" + channel_toml("only", 64, 48, 0));
    const std::string report = scratch.file("report");
    Process daemon({SKYIGD_PROGRAM, "--config", config, "--report", report});
    ASSERT_TRUE(daemon.wait_for_err("ephemeris")) << daemon.err_so_far();
    const Finished played = run({SKYIG_PROGRAM, "replay", kFlightGear, "--to", at, "--speed", "4", "--json"});
    ASSERT_EQ(played.status, 0) << played.err;
    const Json told = Json::parse(played.out);
    EXPECT_EQ(told.at("datagrams"), 60);
    EXPECT_EQ(told.at("bytes"), 60 * 408);
    EXPECT_NEAR(told.at("recorded_s").get<double>(), 1.97, 0.05);
    EXPECT_GE(told.at("elapsed_s").get<double>(), 0.4);
    std::printf("%.2f s at four times the pace took %.2f s\n", told.at("recorded_s").get<double>(),
                told.at("elapsed_s").get<double>());
    ASSERT_TRUE(daemon.wait_for_err("lost")) << daemon.err_so_far();
    daemon.signal(SIGTERM);
    EXPECT_EQ(daemon.wait().status, 0);
    EXPECT_EQ(report_of(read_text(report)).at("datagrams"), 60);

    const std::string kept = scratch.file("kept.pcapng");
    Process recorder({SKYIG_PROGRAM, "record", "--listen", at, "--out", kept, "--json"});
    ASSERT_TRUE(recorder.wait_for_err(" into ")) << recorder.err_so_far();
    ASSERT_EQ(run({SKYIG_PROGRAM, "replay", kFlightGear, "--to", at, "--speed", "20"}).status, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    recorder.signal(SIGINT);
    const Finished recorded = recorder.wait();
    ASSERT_EQ(recorded.status, 0) << recorded.err;
    EXPECT_EQ(Json::parse(recorded.out).at("datagrams"), 60);
    auto original = protocol::recording::CaptureReader::open(kFlightGear).value();
    auto copy = protocol::recording::CaptureReader::open(kept).value();
    for (int i = 0; i < 60; ++i) {
        const auto* const sent = original.next();
        const auto* const came = copy.next();
        ASSERT_NE(sent, nullptr);
        ASSERT_NE(came, nullptr);
        EXPECT_TRUE(std::equal(sent->payload.begin(), sent->payload.end(), came->payload.begin(),
                               came->payload.end()));
    }
    EXPECT_EQ(copy.next(), nullptr);
}

TEST(SkyigReplay, WrongUsageIsStatusTwoAndOneLine) {
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"replay"},
             {"replay", "a.pcapng", "--to", "somewhere"},
             {"replay", "a.pcapng", "--speed", "-1"},
             {"replay", "a.pcapng", "--speed", "nan"},
             {"replay", "a.pcapng", "--step", "--speed", "2"},
             {"replay", "a.pcapng", "--port", "0"},
             {"record", "--out", "a.pcapng"},
             {"record", "--listen", "8004"},
             {"record", "--listen", "70000", "--out", "a.pcapng"},
             {"record", "--listen", "8004", "--from", "me", "--out", "a.pcapng"}}) {
        std::vector<std::string> command{SKYIG_PROGRAM};
        command.insert(command.end(), words.begin(), words.end());
        const Finished finished = run(command);
        EXPECT_EQ(finished.status, 2) << finished.err;
        EXPECT_EQ(line_count(finished.err), 1) << finished.err;
    }
    for (const char* verb : {"replay", "record"})
        EXPECT_THAT(run({SKYIG_PROGRAM, verb, "--help"}).out, HasSubstr("--json"));
}

TEST(Replay, LightInFilesDoesNotDependOnHowManyAreWanted) {
    const Rig rig;
    const std::string config = rig.scratch.write(
        "clouds.toml", rig.settings("2026-06-21T12:00:00Z") + "[weather]\npreset = \"broken\"\n");
    const std::string recording = rig.scratch.file("clouds.pcapng");
    const Finished live =
        run({SKYIGD_PROGRAM, "--config", config, "--headless", "--record", recording, "--frames", "15"});
    ASSERT_EQ(live.status, 0) << live.err;
    const auto light_of_last = [&](const std::string& every) {
        const std::string out = rig.scratch.file("every" + every);
        const Replayed again =
            replay(SKYIGD_PROGRAM, config, recording,
                   {"--headless", "--speed", "0", "--out", out, "--out-format", "pfm", "--out-every", every});
        EXPECT_EQ(again.finished.status, 0) << again.finished.err;
        return read_text(out + "/only_000015.pfm");
    };
    const std::string of_all = light_of_last("1");
    EXPECT_GT(of_all.size(), 64U * 48U * 12U);
    EXPECT_TRUE(of_all == light_of_last("15"));
}

}  // namespace
}  // namespace skyig::tests
