// The daemon and its host over loopback, as two programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "protocol/cigi/message.h"
#include "tests/e2e/process.h"
#include "tests/e2e/site.h"

namespace skyig::tests {
namespace {

namespace cigi = protocol::cigi;
using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr const char* kFlight = SKYIG_TEST_DATA "/flights/fg_c172p_takeoff_bikf.csv";

std::vector<std::string> daemon_command(const Site& site) {
    return {SKYIGD_PROGRAM, "--config", site.config_path, "--headless", "--report", site.report_path};
}

std::vector<std::string> host_command(const Site& site, const std::string& version, const std::string& order,
                                      const std::string& duration_s) {
    return {SKYIG_PROGRAM, "host",       "--flight",       kFlight,    "--utc",      "2024-06-21T21:30:15Z",
            "--cigi",      version,      "--order",        order,      "--to",       site.listen(),
            "--listen",    site.reply(), "--duration",     duration_s, "--start-s",  "20",
            "--wait",      "15",         "--visibility-m", "20000",    "--view-yaw", "-30",
            "--json"};
}

/// Ends the daemon as an operator does and reads its report.
Json stop(Process& daemon, const Site& site) {
    daemon.signal(SIGTERM);
    const Finished finished = daemon.wait();
    EXPECT_EQ(finished.status, 0) << finished.err;
    EXPECT_THAT(finished.out, HasSubstr("Start of Frame"));
    return Json::parse(read_text(site.report_path));
}

long lines_with(const std::string& text, const std::string& part) {
    long lines = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++lines;
    return lines;
}

struct Dialect {
    std::string version;
    std::string order;
};

void PrintTo(const Dialect& dialect, std::ostream* out) {
    *out << dialect.version << " " << dialect.order << "-endian";
}

class LinkTest : public ::testing::TestWithParam<Dialect> {};

TEST_P(LinkTest, FliesSixtyFramesAndIsAnswered) {
    const auto& [version, order] = GetParam();
    Site site;
    Process daemon(daemon_command(site));
    // It listens by then: no message is sent in vain.
    ASSERT_TRUE(daemon.wait_for_err("ephemeris"));
    const Finished host = run(host_command(site, version, order, "1"));
    ASSERT_EQ(host.status, 0) << host.err << daemon.err_so_far();
    const Json told = Json::parse(host.out);
    // By then every message of the host has been taken in.
    ASSERT_TRUE(daemon.wait_for_err(" lost: "));
    const Json report = stop(daemon, site);

    EXPECT_EQ(told.at("answers").at("version"), version);
    EXPECT_EQ(told.at("answers").at("mode"), "operate");
    EXPECT_EQ(told.at("answers").at("lost"), 0);
    EXPECT_EQ(told.at("answers").at("restarts"), 0);
    EXPECT_GE(told.at("answers").at("start_of_frame").get<int>(), 30);
    EXPECT_GE(told.at("round_trip").at("p50_frames").get<int>(), 1);
    std::printf("CIGI %s %s-endian: round trip p50 %d frames, %.1f ms\n", version.c_str(), order.c_str(),
                told.at("round_trip").at("p50_frames").get<int>(),
                told.at("round_trip").at("p50_ms").get<double>());

    EXPECT_EQ(report.at("host").at("protocol"), version + " " + order + "-endian");
    EXPECT_EQ(report.at("host").at("address"), site.reply());
    const Json& packets = report.at("packets");
    EXPECT_EQ(packets.at("ig_control"), told.at("messages"));
    EXPECT_EQ(packets.at("celestial_sphere_control"), 1);
    EXPECT_EQ(packets.at("atmosphere_control"), 1);
    EXPECT_EQ(packets.at("view_control"), 1);
    EXPECT_GE(packets.at(version == "4.0" ? "entity_position" : "entity_control").get<int>(), 60);
    for (const auto& [reason, count] : report.at("rejects").items())
        EXPECT_EQ(count, 0) << reason;
    EXPECT_EQ(report.at("start_of_frame").at("sent"), report.at("frames"));
    EXPECT_EQ(report.at("start_of_frame").at("failed"), 0);
    EXPECT_EQ(report.at("gl_errors"), 0);
}

INSTANTIATE_TEST_SUITE_P(BothVersionsAndOrders, LinkTest,
                         ::testing::Values(Dialect{"3.3", "little"}, Dialect{"3.3", "big"},
                                           Dialect{"4.0", "little"}, Dialect{"4.0", "big"}),
                         [](const auto& dialect) {
                             return (dialect.param.version == "3.3" ? "Cigi33_" : "Cigi40_") +
                                    dialect.param.order;
                         });

TEST(Link, SecondHostGarbageAndSilenceAreCountedAndToldOnce) {
    Site site;
    Process daemon(daemon_command(site));
    Process host(host_command(site, "3.3", "big", "2"));
    ASSERT_TRUE(daemon.wait_for_err("set mode operate")) << daemon.err_so_far();

    constexpr int kTimes = 20;
    const TestSocket stranger;
    std::array<std::byte, 64> buffer{};
    for (std::uint32_t i = 1; i <= kTimes; ++i) {
        cigi::MessageWriter writer(buffer, cigi::Version::k40, cigi::ByteOrder::kLittle);
        cigi::IgControl control;
        control.host_frame_number = i;
        ASSERT_TRUE(writer.add(control));
        stranger.send(site.listen_port, writer.bytes());
        stranger.send(site.listen_port, std::vector<std::byte>(48, std::byte{0x5A}));
        stranger.send(site.listen_port, std::vector<std::byte>(5, std::byte{1}));
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const Finished flown = host.wait();
    EXPECT_EQ(flown.status, 0) << flown.err;
    EXPECT_EQ(Json::parse(flown.out).at("answers").at("mode"), "operate");
    ASSERT_TRUE(daemon.wait_for_err(" lost: "));
    const std::string log = daemon.err_so_far();
    const Json report = stop(daemon, site);

    EXPECT_EQ(report.at("rejects").at("second_host"), kTimes);
    EXPECT_EQ(report.at("rejects").at("first_packet"), kTimes);
    EXPECT_EQ(report.at("rejects").at("short"), kTimes);
    EXPECT_EQ(report.at("host").at("address"), site.reply());
    EXPECT_EQ(report.at("host").at("losses"), 1);
    EXPECT_EQ(lines_with(log, "second host"), 1) << log;
    EXPECT_EQ(lines_with(log, " dropped: "), 1) << log;
    EXPECT_EQ(lines_with(log, " lost: "), 1) << log;
}

TEST(Link, StatusShowsTheHostLiveAndItsCountersRise) {
    Site site;
    Process daemon(daemon_command(site));
    const std::string url = status_url(daemon);
    const auto status = [&url] {
        const Finished told = run({SKYIG_PROGRAM, "status", "--url", url, "--json"});
        EXPECT_EQ(told.status, 0) << told.err;
        return Json::parse(told.out);
    };
    const Json before = status();
    EXPECT_EQ(before.at("sources").at(0).at("link"), "waiting");
    EXPECT_TRUE(before.at("authority").at("control").at("holder").is_null());

    Process host(host_command(site, "4.0", "little", "1.5"));
    ASSERT_TRUE(daemon.wait_for_err("set mode operate")) << daemon.err_so_far();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const Json first = status();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const Json second = status();
    EXPECT_EQ(second.at("sources").at(0).at("link"), "live");
    EXPECT_EQ(second.at("sources").at(0).at("peer"), site.reply());
    EXPECT_EQ(second.at("sources").at(0).at("heard_at"), site.listen());
    EXPECT_EQ(second.at("authority").at("ownship").at("holder"), "host");
    EXPECT_EQ(second.at("world").at("mode"), "operate");
    const auto rise = [&](const char* key) {
        return second.at("packets").at(key).get<int>() - first.at("packets").at(key).get<int>();
    };
    std::printf("in half a second %d more IG Control, %d more frames\n", rise("ig_control"),
                second.at("frames").get<int>() - first.at("frames").get<int>());
    EXPECT_GE(rise("ig_control"), 5);
    EXPECT_GE(rise("entity_position"), 5);
    EXPECT_GT(second.at("frames"), first.at("frames"));
    EXPECT_GT(second.at("world").at("scene_time_s"), first.at("world").at("scene_time_s"));

    EXPECT_EQ(host.wait().status, 0);
    ASSERT_TRUE(daemon.wait_for_err(" lost: "));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const Json after = status();
    EXPECT_EQ(after.at("sources").at(0).at("link"), "lost");
    EXPECT_EQ(after.at("sources").at(0).at("losses"), 1);
    EXPECT_THAT(run({SKYIG_PROGRAM, "status", "--url", url}).out, HasSubstr("packets         ig_control "));
    stop(daemon, site);
    const Finished gone = run({SKYIG_PROGRAM, "status", "--url", url});
    EXPECT_EQ(gone.status, 1);
    EXPECT_THAT(gone.err, HasSubstr("nobody listens there"));
}

TEST(Link, ATakenStatusPortIsAnErrorOnlyWhereTheSettingsNameIt) {
    const Site first;
    Process daemon(daemon_command(first));
    const std::string address = status_url(daemon).substr(7);
    const Site second;
    std::string settings = read_text(second.config_path);
    settings.replace(settings.find("127.0.0.1:0"), 11, address);
    const Finished refused =
        run({SKYIGD_PROGRAM, "--config", second.scratch.write("same.toml", settings), "--frames", "1"});
    EXPECT_EQ(refused.status, 1);
    EXPECT_THAT(refused.err, HasSubstr("skyigd: status: tcp " + address + ": address already in use"));
}

TEST(Link, HostComesBackAfterSilence) {
    Site site;
    Process daemon(daemon_command(site));
    for (int i = 0; i < 2; ++i) {
        const Finished host = run(host_command(site, i == 0 ? "3.3" : "4.0", "little", "0.5"));
        ASSERT_EQ(host.status, 0) << host.err;
        std::this_thread::sleep_for(std::chrono::milliseconds(700));
    }
    const Json report = stop(daemon, site);
    EXPECT_EQ(report.at("host").at("losses"), 2);
    EXPECT_EQ(report.at("host").at("protocol"), "4.0 little-endian");
    EXPECT_EQ(report.at("packets").at("celestial_sphere_control"), 2);
}

TEST(Link, HostSaysWhenNobodyAnswers) {
    Site site;
    std::vector<std::string> command = host_command(site, "3.3", "little", "1");
    *(std::find(command.begin(), command.end(), "--wait") + 1) = "0.3";
    const Finished host = run(command);
    EXPECT_EQ(host.status, 1);
    EXPECT_EQ(host.err, "skyig host: no answer from " + site.listen() +
                            " in 0.3 s: is skyigd running there, and does it answer to " + site.reply() +
                            "?\n");
    EXPECT_EQ(host.out, "");
}

TEST(Link, HostSaysWhenTheDaemonDiesInMidFlight) {
    Site site;
    Process daemon(daemon_command(site));
    Process host(host_command(site, "3.3", "little", "30"));
    ASSERT_TRUE(daemon.wait_for_err("clock set to"));
    daemon.signal(SIGKILL);
    const Finished flown = host.wait();
    EXPECT_EQ(flown.status, 1);
    EXPECT_THAT(flown.err, HasSubstr(site.listen() + " stopped answering"));
}

TEST(Link, BusyPortIsOneLineAndStatusOne) {
    Site site;
    const TestSocket squatter(site.listen_port);
    const Finished daemon = run(daemon_command(site));
    EXPECT_EQ(daemon.status, 1);
    EXPECT_THAT(daemon.err, HasSubstr("udp " + site.listen() + ": address already in use"));
    EXPECT_EQ(std::count(daemon.err.begin(), daemon.err.end(), '\n'), 1) << daemon.err;
}

}  // namespace
}  // namespace skyig::tests
