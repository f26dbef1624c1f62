#include "server/frame_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "protocol/cigi/message.h"
#include "server/status/account.h"
#include "tests/server/loop/loop_fixture.h"
#include "tests/support/allocation_count.h"

namespace skyig::server {
namespace {

using namespace tests;
using ::testing::HasSubstr;

TEST_F(FrameLoopTest, RunsTheFramesAskedForWithoutAnyHost) {
    loop(30).run([] { return false; });
    const RunReport report = loop_->report();
    EXPECT_EQ(report.frames, 30U);
    EXPECT_EQ(report.late_frames, 0U);
    EXPECT_NEAR(report.elapsed_s, 0.293, 1e-9);
    EXPECT_EQ(report.start_of_frame_sent, 30U);
    EXPECT_EQ(link_.last_to, (transport::Endpoint{0x7F000001, 8005}));
    EXPECT_TRUE(report.host.empty());
    const cigi::StartOfFrame answer = last_answer(cigi::Version::k33);
    EXPECT_EQ(answer.ig_frame_number, 30U);
    EXPECT_EQ(answer.ig_mode, cigi::IgMode::kStandby);
    EXPECT_EQ(painter_.last_scene.frame_number, 30U);
    EXPECT_NEAR(painter_.last_scene.time_s, 0.29, 1e-9);
}

TEST_F(FrameLoopTest, WarmsUpUncountedAndUnheard) {
    loop(3).warm_up();
    EXPECT_EQ(link_.sends, 0);
    EXPECT_EQ(painter_.last_scene.view_count, 1U);
    loop_->run([] { return false; });
    EXPECT_EQ(loop_->report().frames, 3U);
    EXPECT_NEAR(loop_->report().times[1].median_ms, 1.0, 0.01);
    EXPECT_EQ(last_answer(cigi::Version::k33).ig_frame_number, 3U);
}

TEST_F(FrameLoopTest, TellsOnceThatLeapSecondsAreAssumed) {
    config_.start.utc = config::UtcDateTime{2090, 6, 21, 12, 0, 0.0};
    loop(3000).warm_up();
    loop_->run([] { return false; });
    ASSERT_EQ(lines_.size(), 1U) << ::testing::PrintToString(lines_);
    EXPECT_THAT(lines_[0], HasSubstr("beyond the announced leap seconds"));
    const RunReport report = loop_->report();
    EXPECT_TRUE(report.leap_seconds_assumed);
    EXPECT_FALSE(report.date_clamped);
}

TEST_F(FrameLoopTest, TellsOnceThatTheDateIsClamped) {
    config_.start.utc = config::UtcDateTime{2100, 12, 31, 23, 59, 45.0};
    loop(6000).warm_up();
    loop_->run([] { return false; });
    EXPECT_EQ(std::count_if(lines_.begin(), lines_.end(),
                            [](const std::string& line) {
                                return line.find("outside 1900..2100") != std::string::npos;
                            }),
              1)
        << ::testing::PrintToString(lines_);
    EXPECT_TRUE(loop_->report().date_clamped);
}

TEST_F(FrameLoopTest, DrawsAndReportsTheConfiguredEphemeris) {
    loop(1).run([] { return false; });
    const glm::dvec3 moon = painter_.last_scene.moon.direction_enu;
    EXPECT_EQ(loop_->report().ephemeris_text(), "series, Earth orientation by the built-in tables");
    config_.ephemeris.model = config::EphemerisModel::kAlmanac;
    loop(1).run([] { return false; });
    EXPECT_EQ(loop_->report().ephemeris, "almanac");
    const double apart_deg = glm::degrees(glm::length(painter_.last_scene.moon.direction_enu - moon));
    std::printf("the almanac's Moon is %.4f deg from that of the series\n", apart_deg);
    EXPECT_GT(apart_deg, 1e-4);
    EXPECT_LT(apart_deg, 0.5);
}

TEST_F(FrameLoopTest, TurnsTheSkyByTheMeasuredEarth) {
    loop(1).run([] { return false; });
    const glm::dmat3 by_tables = painter_.last_scene.stars.enu_from_gcrs;
    // UT1 half a second off: 7.5 arcsec about the pole.
    std::vector<ephemeris::EarthOrientationRow> rows;
    for (const double mjd : {61210.0, 61220.0})
        rows.push_back({mjd, 0.5, 0.0, 0.0});
    world_ = std::make_unique<world::World>(config_, start_time(config_.start, clock_), log_);
    FrameLoop measured(config_, FrameLoopParts{clock_, log_, pace_, link_, *world_, painter_, nullptr}, 1, 1,
                       ephemeris::EarthOrientation(rows));
    measured.run([] { return false; });
    EXPECT_EQ(measured.report().earth_orientation, "2026-06-19..2026-06-29");
    const glm::dmat3 turned = painter_.last_scene.stars.enu_from_gcrs * glm::transpose(by_tables);
    const double trace = turned[0][0] + turned[1][1] + turned[2][2];
    const double turned_arcsec = glm::degrees(std::sqrt(std::max(0.0, 3.0 - trace))) * 3600.0;
    std::printf("half a second of UT1 turns the sky by %.2f arcsec\n", turned_arcsec);
    EXPECT_NEAR(turned_arcsec, 0.5 * 15.04, 1.6);
    EXPECT_GT(turned_arcsec, 4.0);
}

TEST_F(FrameLoopTest, TellsEachResetOfTheDeviceOnce) {
    loop();
    for (int i = 0; i < 3; ++i)
        loop_->run_frame();
    EXPECT_TRUE(lines_.empty()) << ::testing::PrintToString(lines_);
    painter_.device_resets = 1;
    for (int i = 0; i < 3; ++i)
        loop_->run_frame();
    ASSERT_EQ(lines_.size(), 1U) << ::testing::PrintToString(lines_);
    EXPECT_THAT(lines_[0], HasSubstr("the graphics device was reset"));
    EXPECT_EQ(loop_->report().gl_resets, 1U);
}

TEST_F(FrameLoopTest, NamesAChannelThatCannotBeDrawn) {
    loop();
    loop_->run_frame();
    EXPECT_TRUE(lines_.empty()) << ::testing::PrintToString(lines_);
    painter_.channel_health.failed = painter_.channel_health.crossed_out = true;
    painter_.channel_health.failures = 1;
    painter_.channel_health.set_reason("out of wonders");
    for (int i = 0; i < 20; ++i)
        loop_->run_frame();
    ASSERT_EQ(lines_.size(), 1U) << ::testing::PrintToString(lines_);
    EXPECT_THAT(lines_[0],
                HasSubstr("channel centre cannot be drawn: out of wonders; it is crossed out in red"));
    EXPECT_TRUE(status_->newest().health[0].failed);
    EXPECT_EQ(status_->newest().health[0].reason(), "out of wonders");
    painter_.channel_health.failed = false;
    loop_->run_frame();
    ASSERT_EQ(lines_.size(), 2U) << ::testing::PrintToString(lines_);
    EXPECT_THAT(lines_[1], HasSubstr("channel centre is drawn again, after 1 failures"));
}

TEST_F(FrameLoopTest, OfALostDevicesChannelsItSaysThatNothingIsShown) {
    loop();
    painter_.channel_health.failed = true;
    painter_.channel_health.set_reason("no device");
    loop_->run_frame();
    ASSERT_EQ(lines_.size(), 1U) << ::testing::PrintToString(lines_);
    EXPECT_THAT(lines_[0], HasSubstr("cannot be drawn: no device; nothing is shown of it until then"));
}

TEST_F(FrameLoopTest, TellsOfAMonitorThatIsGoneAndGoesOn) {
    loop();
    loop_->run_frame();
    painter_.hidden = true;
    for (int i = 0; i < 50; ++i)
        EXPECT_TRUE(loop_->run_frame());
    ASSERT_EQ(lines_.size(), 1U) << ::testing::PrintToString(lines_);
    EXPECT_THAT(lines_[0], HasSubstr("channel centre is not shown: its monitor is gone"));
    EXPECT_TRUE(status_->newest().hidden[0]);
    const status::Facts facts = loop_->facts();
    const status::Health health = status::health_of(facts, status_->newest(), clock_.monotonic_ns());
    EXPECT_FALSE(health.good);
    EXPECT_EQ(health.text, "channel centre is not shown: its monitor is gone");
    painter_.hidden = false;
    for (int i = 0; i < 20; ++i)
        loop_->run_frame();
    ASSERT_EQ(lines_.size(), 2U) << ::testing::PrintToString(lines_);
    EXPECT_THAT(lines_[1], HasSubstr("channel centre is shown again"));
    EXPECT_FALSE(status_->newest().hidden[0]);
}

TEST_F(FrameLoopTest, OverlayTellsModeRateAndTheHostThatIsLost) {
    config_.overlay = {.mode = true, .rate = true, .host = true, .host_lost = true};
    config_.host.rights.lost_after_s = 0.5;
    loop();
    const render::Scene& scene = painter_.last_scene;
    loop_->run_frame();
    EXPECT_EQ(scene.views[0].overlay, 0b1111);
    EXPECT_THAT(std::string(scene.overlay.lines[0].text()), HasSubstr("standby 2026-06-21 12:00:00Z"));
    EXPECT_EQ(scene.overlay.lines[1].text(), "100.0 Hz of 100, 0 left out");
    EXPECT_EQ(scene.overlay.lines[2].text(), "host waiting");
    EXPECT_TRUE(scene.overlay.warning.text().empty());
    link_.put(kHost, Message(cigi::Version::k33, cigi::IgMode::kOperate, 1).bytes());
    loop_->run_frame();
    EXPECT_EQ(scene.overlay.lines[2].text(), "host 127.0.0.1:8005 live");
    for (int i = 0; i < 100; ++i)
        loop_->run_frame();
    EXPECT_THAT(std::string(scene.overlay.lines[2].text()), HasSubstr("host 127.0.0.1:8005 lost"));
    EXPECT_EQ(scene.overlay.warning.text(), "HOST LOST");
    // Every frame takes two periods and a half: each third place of the grid is left out at least.
    painter_.draw_ns = 24 * kMs;
    for (int i = 0; i < 100; ++i)
        loop_->run_frame();
    std::printf("%s\n", std::string(scene.overlay.lines[1].text()).c_str());
    EXPECT_THAT(std::string(scene.overlay.lines[1].text()), HasSubstr("40.0 Hz of 100"));
}

TEST_F(FrameLoopTest, StopsWhenAsked) {
    int asked = 0;
    loop().run([&asked] { return ++asked > 5; });
    EXPECT_EQ(loop_->report().frames, 5U);
}

TEST_F(FrameLoopTest, TimesSharedWorkChannelsAndFrame) {
    loop(20).run([] { return false; });
    const RunReport report = loop_->report();
    ASSERT_EQ(report.times.size(), 4U);
    EXPECT_EQ(report.times[0].name, "input");
    EXPECT_EQ(report.times[0].median_ms, 0.0);
    EXPECT_EQ(report.times[1].name, "shared");
    EXPECT_NEAR(report.times[1].median_ms, 1.0, 0.01);
    EXPECT_EQ(report.times[2].name, "centre");
    EXPECT_NEAR(report.times[2].p95_ms, 2.0, 0.02);
    EXPECT_EQ(report.times[3].name, "frame");
    EXPECT_NEAR(report.times[3].largest_ms, 3.0, 0.03);
}

TEST_F(FrameLoopTest, CountsLateFramesAndSaysSoOnceAWhile) {
    painter_.draw_ns = 14 * kMs;
    loop(4000).run([] { return false; });
    const RunReport report = loop_->report();
    EXPECT_EQ(report.late_frames, 3999U);
    // 15 ms of work on a 10 ms grid: every second slot passes by.
    EXPECT_NEAR(static_cast<double>(report.slots_left_out), 2000.0, 2.0);
    EXPECT_NEAR(painter_.last_scene.time_s, 60.0, 0.1);
    ASSERT_EQ(lines_.size(), 1U);
    EXPECT_THAT(lines_[0], HasSubstr("frames were late: 100 Hz leaves 10.0 ms, a frame has taken 15."));
}

TEST_F(FrameLoopTest, AnswersInTheHostsVersionAndMovesTheOwnship) {
    config_.host.cigi = {4, 0};
    loop();
    loop_->run_frame();
    last_answer(cigi::Version::k40);
    link_.put(kHost, Message(cigi::Version::k33, cigi::IgMode::kOperate, 7).at(45.0).bytes());
    loop_->run_frame();
    loop_->run_frame();
    const cigi::StartOfFrame answer = last_answer(cigi::Version::k33);
    EXPECT_EQ(answer.last_host_frame_number, 7U);
    EXPECT_EQ(answer.ig_mode, cigi::IgMode::kOperate);
    EXPECT_NEAR(painter_.last_scene.eye.latitude_deg, 45.0, 1e-9);
    const RunReport report = loop_->report();
    EXPECT_EQ(report.host, "127.0.0.1:8005");
    EXPECT_EQ(report.host_protocol, "3.3 big-endian");
    EXPECT_EQ(count(report.packets, "ig_control"), 1U);
    EXPECT_EQ(count(report.packets, "entity_control"), 1U);
}

TEST_F(FrameLoopTest, AnswersTheSenderWhereTheSettingsSaySo) {
    config_.host.reply_to.reset();
    loop().run_frame();
    EXPECT_EQ(link_.sends, 0);
    link_.put(kOther, Message(cigi::Version::k33, cigi::IgMode::kOperate, 1).bytes());
    loop_->run_frame();
    loop_->run_frame();
    EXPECT_EQ(link_.last_to, kOther);
    EXPECT_EQ(loop_->report().start_of_frame_sent, 1U);
}

TEST_F(FrameLoopTest, TellsHowManyFramesTheHostIsBehind) {
    loop();
    for (std::uint32_t i = 1; i <= 20; ++i) {
        // The host answers the frame before the last: two frames behind what is sent when it is read.
        link_.put(kHost, Message(cigi::Version::k33, cigi::IgMode::kOperate, i, i > 2 ? i - 2 : 0).bytes());
        loop_->run_frame();
    }
    EXPECT_EQ(loop_->report().host_frames_behind_median, 2U);
    EXPECT_EQ(loop_->report().host_frames_behind_largest, 2U);
}

TEST_F(FrameLoopTest, GoesOnThroughGarbageWithOneLine) {
    loop();
    const std::vector<std::byte> garbage(40, std::byte{0xA5});
    const std::vector<std::byte> crumb(3, std::byte{1});
    for (int i = 0; i < 50; ++i) {
        link_.put(kOther, garbage);
        link_.put(kOther, crumb);
        loop_->run_frame();
    }
    const RunReport report = loop_->report();
    EXPECT_EQ(report.frames, 50U);
    EXPECT_EQ(count(report.rejects, "first_packet"), 50U);
    EXPECT_EQ(count(report.rejects, "short"), 50U);
    EXPECT_EQ(report.datagrams, 100U);
    ASSERT_EQ(lines_.size(), 1U) << ::testing::PrintToString(lines_);
    EXPECT_THAT(lines_[0], HasSubstr("datagram of 40 bytes from 127.0.0.1:9999 dropped: "));
}

TEST_F(FrameLoopTest, SaysWhichPacketWasRefusedAndKeepsTheOthers) {
    loop();
    link_.put(kHost, Message(cigi::Version::k33, cigi::IgMode::kOperate, 1).at(91.0).at(30.0).bytes());
    loop_->run_frame();
    EXPECT_EQ(count(loop_->report().rejects, "out_of_range"), 1U);
    EXPECT_NEAR(painter_.last_scene.eye.latitude_deg, 30.0, 1e-9);
    EXPECT_THAT(lines_, ::testing::Contains(HasSubstr(
                            "entity_control at byte 24 of a message ignored: lat_x is out of range")));
}

TEST_F(FrameLoopTest, SecondHostAndSilenceAreToldOnceAndThePictureGoesOn) {
    loop();
    link_.put(kHost, Message(cigi::Version::k33, cigi::IgMode::kOperate, 1).at(45.0).bytes());
    loop_->run_frame();
    for (std::uint32_t i = 1; i <= 20; ++i) {
        link_.put(kOther, Message(cigi::Version::k40, cigi::IgMode::kStandby, i).bytes());
        loop_->run_frame();
    }
    EXPECT_EQ(last_answer(cigi::Version::k33).last_host_frame_number, 1U);
    for (int i = 0; i < 200; ++i)
        loop_->run_frame();
    const RunReport report = loop_->report();
    EXPECT_EQ(count(report.rejects, "second_host"), 20U);
    EXPECT_EQ(report.host_losses, 1U);
    EXPECT_NEAR(painter_.last_scene.eye.latitude_deg, 45.0, 1e-9);
    const auto lines_with = [this](const char* part) {
        return std::count_if(lines_.begin(), lines_.end(), [part](const std::string& line) {
            return line.find(part) != std::string::npos;
        });
    };
    EXPECT_EQ(lines_with("second host"), 1);
    EXPECT_EQ(lines_with("lost"), 1);
    EXPECT_LE(lines_.size(), 4U) << ::testing::PrintToString(lines_);
}

TEST_F(FrameLoopTest, CountsAnswersThatCouldNotBeSent) {
    link_.sending_works = false;
    loop(10).run([] { return false; });
    EXPECT_EQ(loop_->report().start_of_frame_failed, 10U);
    EXPECT_EQ(loop_->report().start_of_frame_sent, 0U);
    EXPECT_EQ(lines_.size(), 1U);
}

TEST_F(FrameLoopTest, TellsOfDatagramsThatTheReceiverDropped) {
    loop();
    link_.received.not_allowed = 12;
    link_.received.ring_full = 3;
    loop_->run([this] { return loop_->report().frames >= 1100; });
    EXPECT_EQ(count(loop_->report().rejects, "not_allowed"), 12U);
    EXPECT_EQ(count(loop_->report().rejects, "ring_full"), 3U);
    ASSERT_EQ(lines_.size(), 2U);
    EXPECT_THAT(lines_[0], HasSubstr("12 datagrams dropped: their senders are not in allow"));
}

TEST_F(FrameLoopTest, HandsEveryNthFrameToTheImageWriter) {
    std::vector<std::string> paths;
    ImageWriter images(
        {"out", render_channels(config_), 8},
        [&](const std::string& path, const ImageWriter::Frame& frame, std::size_t channel, std::string&) {
            EXPECT_EQ(frame.channels[channel].size(), 8U * 4 * 4);
            EXPECT_EQ(frame.channels[channel][5], std::byte{1});
            paths.push_back(path);
            return true;
        });
    loop(20, &images, 5).run([] { return false; });
    images.finish();
    EXPECT_EQ(paths, (std::vector<std::string>{"out/centre_000005.png", "out/centre_000010.png",
                                               "out/centre_000015.png", "out/centre_000020.png"}));
    EXPECT_EQ(loop_->report().images_written, 4U);
}

TEST_F(FrameLoopTest, HandsScenesToWhoDrawsThemItself) {
    std::map<std::string, double> latitudes_deg;
    ImageWriter images(
        {"out", render_channels(config_), 8, ImageWriter::Takes::kScene, "exr"},
        [&](const std::string& path, const ImageWriter::Frame& frame, std::size_t, std::string&) {
            EXPECT_TRUE(frame.channels.empty());
            EXPECT_EQ(frame.scene.frame_number, frame.number);
            latitudes_deg[path] = frame.scene.eye.latitude_deg;
            return true;
        });
    link_.put(kHost, Message(cigi::Version::k33, cigi::IgMode::kOperate, 1).at(45.0).bytes());
    loop(10, &images, 5).run([] { return false; });
    images.finish();
    ASSERT_EQ(latitudes_deg.size(), 2U);
    EXPECT_NEAR(latitudes_deg.at("out/centre_000010.exr"), 45.0, 1e-9);
}

TEST_F(FrameLoopTest, PublishesASnapshotTenTimesASecond) {
    painter_.prepare_ns = 12 * kMs;
    loop();
    std::uint64_t published = 0;
    std::uint64_t frames = 0;
    const auto run = [&](std::uint64_t until) {
        while (loop_->frame_number() < until) {
            loop_->run_frame();
            if (status_->newest().frames == frames) continue;
            frames = status_->newest().frames;
            ++published;
        }
    };
    link_.put(kHost, Message(cigi::Version::k33, cigi::IgMode::kOperate, 1).at(45.0).bytes());
    run(100);
    const status::Snapshot& snapshot = status_->newest();
    EXPECT_NEAR(static_cast<double>(published), loop_->report().elapsed_s * 10.0, 3.0);
    EXPECT_GE(frames, 90U);
    EXPECT_NEAR(snapshot.world.ownship.position.latitude_deg, 45.0, 1e-9);
    EXPECT_NEAR(snapshot.world.sun_elevation_deg, 60.0, 15.0);
    EXPECT_EQ(snapshot.world.adaptation_cd_m2, 100.0);
    EXPECT_EQ(snapshot.sources[0].arrivals, 1U);
    EXPECT_EQ(snapshot.aspects[0].holder, 0U);
    EXPECT_EQ(snapshot.pass_count, 1U);
    // 14 ms of work on a 10 ms grid, most of it shared.
    EXPECT_EQ(snapshot.record.late(status::LateCause::kShared), snapshot.late_frames);
    EXPECT_GT(snapshot.late_frames, 80U);
}

TEST_F(FrameLoopTest, AllocatesNothingInSteadyState) {
    config_.overlay = {.mode = true, .rate = true, .host = true, .host_lost = true};
    ImageWriter images({"out", render_channels(config_), 2}, [](const std::string&, const ImageWriter::Frame&,
                                                                std::size_t, std::string&) { return true; });
    loop();
    std::deque<Message> messages;
    for (std::uint32_t i = 1; i <= 1100; ++i)
        messages.emplace_back(cigi::Version::k33, cigi::IgMode::kOperate, i, i > 1 ? i - 1 : 0)
            .at(45.0 + i * 1e-5);
    const auto run = [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            link_.put(kHost, messages[i].bytes());
            loop_->run_frame();
        }
    };
    run(0, 100);
    const std::uint64_t before = skyig::tests::allocation_count_of_this_thread();
    run(100, 1100);
    const std::uint64_t allocations = skyig::tests::allocation_count_of_this_thread() - before;
    std::printf("allocations in 1000 frames: %llu\n", static_cast<unsigned long long>(allocations));
    EXPECT_EQ(allocations, 0U);
    EXPECT_NEAR(painter_.last_scene.eye.latitude_deg, 45.011, 1e-6);
}

}  // namespace
}  // namespace skyig::server
