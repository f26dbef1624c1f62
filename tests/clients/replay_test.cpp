// skyig replay at a socket of this process, in time that passes by hand.
#include "clients/skyig/replay.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/transport/udp.h"
#include "server/clock.h"
#include "tests/server/loop/recording_fixture.h"

namespace skyig::clients {
namespace {

namespace transport = protocol::transport;
using server::tests::bytes_of;
using server::tests::kHost;
using server::tests::kInstructor;
using server::tests::kMs;
using server::tests::kStartNs;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kFlightGear = SKYIG_TEST_DATA "/flights/fg_native_fdm_2s.pcap";

struct Played {
    int status = -1;
    nlohmann::json told;
    std::string err;
};

class ReplayVerb : public ::testing::Test {
  protected:
    ReplayVerb()
        : receiver_(transport::UdpReceiver::open({.listen = transport::parse_endpoint("127.0.0.1:0").value()})
                        .value()) {
        options_.to = transport::to_string(receiver_.local());
        options_.json = true;
    }

    /// Three frames of a daemon: two of the host and the instructor each, a frame of a bus.
    std::string recording() {
        const config::Config config = server::tests::rig();
        server::Recorder recorder(scratch_.file("rig.pcapng"), config, server::tests::facts(config));
        for (std::uint64_t i = 1; i <= 3; ++i) {
            const std::int64_t now_ns = kStartNs + static_cast<std::int64_t>(i) * 1000 * kMs;
            recorder.mark({i, 1, 0, now_ns}, bytes_of("answer"));
            if (i == 3) continue;
            recorder.datagram(0, {kHost, now_ns, bytes_of(fmt::format("h{}", i))});
            recorder.datagram(1, {kInstructor, now_ns, bytes_of(fmt::format("i{}", i))});
            recorder.can_frame(2, {});
        }
        return recorder.path();
    }

    Played play(const std::string& path, const std::string& lines = {}) {
        options_.path = path;
        std::istringstream steps(lines);
        ::testing::internal::CaptureStdout();
        ::testing::internal::CaptureStderr();
        Played played;
        played.status = run_replay(options_, clock_, steps);
        const std::string out = ::testing::internal::GetCapturedStdout();
        played.err = ::testing::internal::GetCapturedStderr();
        if (options_.json && !out.empty()) played.told = nlohmann::json::parse(out);
        return played;
    }

    /// Texts of what has come, once there are so many of them.
    std::vector<std::string> heard(std::size_t count) {
        std::vector<std::string> texts;
        while (texts.size() < count && receiver_.wait(std::chrono::seconds(5))) {
            receiver_.drain([&](const transport::Datagram& datagram) {
                texts.emplace_back(reinterpret_cast<const char*>(datagram.bytes.data()),
                                   datagram.bytes.size());
                senders_.insert(datagram.from.port);
            });
        }
        return texts;
    }
    bool silent() { return !receiver_.wait(std::chrono::milliseconds(50)); }

    server::tests::Scratch scratch_;
    transport::UdpReceiver receiver_;
    ReplayOptions options_;
    server::ManualClock clock_;
    std::set<std::uint16_t> senders_;
};

TEST_F(ReplayVerb, SendsWhatWasHeardAndNoMarks) {
    const Played played = play(recording());
    EXPECT_EQ(played.status, 0) << played.err;
    EXPECT_THAT(heard(4), ElementsAre("h1", "i1", "h2", "i2"));
    EXPECT_TRUE(silent());
    EXPECT_EQ(senders_.size(), 2U);
    EXPECT_EQ(played.told.at("left_out").at("frame_marks"), 3);
    EXPECT_EQ(played.told.at("left_out").at("can_frames"), 2);
    EXPECT_EQ(played.told.at("complete"), true);
    // The bus's frames are stamped 1970: they make no pace.
    EXPECT_NEAR(static_cast<double>(clock_.monotonic_ns()) * 1e-9, 1.0, 1e-6);
}

TEST_F(ReplayVerb, PaceIsScaled) {
    for (const double speed : {1.0, 10.0, 0.0}) {
        options_.speed = speed;
        const std::int64_t before_ns = clock_.monotonic_ns();
        EXPECT_EQ(play(kFlightGear).status, 0);
        const double took_s = static_cast<double>(clock_.monotonic_ns() - before_ns) * 1e-9;
        EXPECT_NEAR(took_s, speed == 0.0 ? 0.0 : 2.0 / speed, 0.02) << speed;
        EXPECT_EQ(heard(60).size(), 60U);
    }
}

TEST_F(ReplayVerb, PortsAreChosen) {
    options_.ports = {8010};
    const Played played = play(recording());
    EXPECT_EQ(played.status, 0) << played.err;
    EXPECT_THAT(heard(2), ElementsAre("i1", "i2"));
    EXPECT_EQ(played.told.at("left_out").at("other_ports"), 2);
    options_.ports = {99};
    const Played nothing = play(recording());
    EXPECT_EQ(nothing.status, 1);
    EXPECT_THAT(nothing.err, HasSubstr("holds no UDP datagram that was to be sent"));
}

TEST_F(ReplayVerb, ALineIsAFrameOfARecordingOrADatagramOfACapture) {
    options_.step = true;
    EXPECT_EQ(play(recording(), "\n").status, 0);
    EXPECT_THAT(heard(2), ElementsAre("h1", "i1"));
    EXPECT_TRUE(silent());
    EXPECT_EQ(play(recording(), "\n\n\n").status, 0);
    EXPECT_EQ(heard(4).size(), 4U);
    EXPECT_EQ(play(kFlightGear, "\n\n\n").told.at("datagrams"), 3);
    EXPECT_EQ(heard(3).size(), 3U);
    EXPECT_EQ(clock_.monotonic_ns(), 0);
}

TEST_F(ReplayVerb, CutCaptureIsSentUpToItsCutDamagedOneIsAFailure) {
    const std::string whole = server::tests::Scratch::read(kFlightGear);
    const Played cut =
        play(scratch_.write("cut.pcap", std::string_view(whole).substr(0, whole.size() - 100)));
    EXPECT_EQ(cut.status, 0);
    EXPECT_EQ(cut.told.at("datagrams"), 59);
    EXPECT_THAT(cut.err, HasSubstr("cut.pcap: byte "));
    EXPECT_EQ(heard(59).size(), 59U);

    std::string damaged = server::tests::Scratch::read(recording());
    // A packet block that says that it is 13 bytes long.
    damaged += std::string("\6\0\0\0\15\0\0\0", 8) + std::string(64, '\0');
    const Played broken = play(scratch_.write("damaged.pcapng", damaged));
    EXPECT_EQ(broken.status, 1);
    EXPECT_THAT(broken.err, HasSubstr("damaged.pcapng: byte "));
    EXPECT_EQ(std::count(broken.err.begin(), broken.err.end(), '\n'), 1) << broken.err;
    EXPECT_EQ(heard(4).size(), 4U);
}

TEST_F(ReplayVerb, WhatIsNoCaptureIsOneLine) {
    for (const std::string& path : {std::string("no/such.pcapng"), scratch_.write("empty", ""),
                                    scratch_.write("text", "t_s,lat\n0,1\n")}) {
        const Played played = play(path);
        EXPECT_EQ(played.status, 1);
        EXPECT_THAT(played.err, HasSubstr("skyig replay: " + path));
        EXPECT_EQ(std::count(played.err.begin(), played.err.end(), '\n'), 1) << played.err;
    }
}

}  // namespace
}  // namespace skyig::clients
