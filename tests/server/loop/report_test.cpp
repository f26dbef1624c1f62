#include "server/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>

namespace skyig::server {
namespace {

TEST(TimeHistogram, QuantilesStayWithinHalfAPercentOfTheExactOnes) {
    std::mt19937_64 random(7);
    std::lognormal_distribution<double> times_ms(1.0, 1.5);
    TimeHistogram histogram;
    std::vector<double> exact;
    for (int i = 0; i < 20'001; ++i) {
        const auto ns = static_cast<std::int64_t>(times_ms(random) * 1e6);
        histogram.add(ns);
        exact.push_back(static_cast<double>(ns) * 1e-6);
    }
    std::sort(exact.begin(), exact.end());
    double worst = 0.0;
    for (const double q : {0.01, 0.25, 0.5, 0.75, 0.95, 0.99}) {
        const auto rank = static_cast<std::size_t>(std::ceil(q * 20'001.0)) - 1;
        worst = std::max(worst, std::abs(histogram.quantile_ms(q) / exact[rank] - 1.0));
    }
    std::printf("largest relative error of a quantile: %.5f\n", worst);
    EXPECT_LE(worst, 0.005);
    EXPECT_DOUBLE_EQ(histogram.largest_ms(), exact.back());
}

TEST(TimeHistogram, TakesNothingZeroAndHours) {
    TimeHistogram histogram;
    EXPECT_EQ(histogram.quantile_ms(0.5), 0.0);
    histogram.add(0);
    EXPECT_EQ(histogram.quantile_ms(0.5), 0.0);
    histogram.add(-5);
    histogram.add(3'600'000'000'000'000);
    EXPECT_EQ(histogram.count(), 3U);
    EXPECT_GT(histogram.quantile_ms(1.0), 9e4);
    EXPECT_DOUBLE_EQ(histogram.largest_ms(), 3.6e9);
}

TEST(FramesBehind, TellsQuantilesAndLargest) {
    FramesBehind behind;
    EXPECT_EQ(behind.quantile(0.5), 0U);
    for (const std::uint32_t frames : {1U, 1U, 2U, 1U, 9000U})
        behind.add(frames);
    EXPECT_EQ(behind.quantile(0.5), 1U);
    EXPECT_EQ(behind.quantile(0.8), 2U);
    EXPECT_EQ(behind.largest(), FramesBehind::kLargest);
    EXPECT_EQ(behind.count(), 5U);
}

RunReport example() {
    RunReport report;
    report.version = "0.1.0";
    report.renderer = "4.5 \"quoted\"";
    report.rate_hz = 60.0;
    report.elapsed_s = 2.5;
    report.cpu_s = 0.75;
    report.frames = 150;
    report.late_frames = 3;
    report.slots_left_out = 1;
    report.times = {{"shared", 1.0, 2.0, 3.0}, {"left", 4.25, 5.0, 6.0}, {"frame", 7.0, 8.0, 9.0}};
    report.host = "127.0.0.1:8005";
    report.host_protocol = "4.0 big-endian";
    report.host_losses = 2;
    report.datagrams = 149;
    report.buses = {{"cockpit", "can0", "down", {{"received", 9}, {"dropped", 0}}}};
    report.packets = {{"ig_control", 149}, {"view_control", 0}};
    report.rejects = {{"short", 0}, {"truncated", 2}};
    report.start_of_frame_sent = 150;
    report.host_frames_behind_median = 1;
    report.host_frames_behind_largest = 4;
    report.images_written = 6;
    report.ephemeris = "erfa";
    report.earth_orientation = "1962-01-01..2026-08-21";
    report.leap_seconds_assumed = true;
    return report;
}

TEST(Report, TableShowsWhatHappenedAndNoZeros) {
    const std::string table = to_table(example());
    using ::testing::HasSubstr;
    using ::testing::Not;
    EXPECT_THAT(table, HasSubstr("150 in 2.5 s at 60 Hz: 3 late, 1 left out"));
    EXPECT_THAT(table, HasSubstr("processor       0.8 s, 30.0 % of one\n"));
    EXPECT_THAT(table, HasSubstr("  left                                 4.25       5.00       6.00\n"));
    EXPECT_THAT(
        table,
        HasSubstr("127.0.0.1:8005, CIGI 4.0 big-endian, 1 frames behind (median; largest 4), lost 2 times"));
    EXPECT_THAT(table, HasSubstr("bus             cockpit on can0, down: received 9\n"));
    EXPECT_THAT(table, HasSubstr("packets         ig_control 149\n"));
    EXPECT_THAT(table, HasSubstr("rejected        truncated 2\n"));
    EXPECT_THAT(table, HasSubstr("150 sent, 0 failed"));
    EXPECT_THAT(table, Not(HasSubstr("GL errors")));
    EXPECT_THAT(table,
                HasSubstr("ephemeris       erfa, Earth orientation measured 1962-01-01..2026-08-21; leap "
                          "seconds are held at the last announced\n"));
}

TEST(Report, TableWithoutAHostSaysSo) {
    EXPECT_THAT(to_table(RunReport{}), ::testing::HasSubstr("none heard"));
}

TEST(Report, JsonHoldsEveryCount) {
    const auto json = nlohmann::json::parse(to_json(example()));
    EXPECT_EQ(json.at("frames"), 150);
    EXPECT_EQ(json.at("cpu_s"), 0.75);
    EXPECT_EQ(json.at("renderer"), "4.5 \"quoted\"");
    EXPECT_EQ(json.at("times").at(1).at("name"), "left");
    EXPECT_EQ(json.at("times").at(1).at("median_ms"), 4.25);
    EXPECT_EQ(json.at("buses").at(0).at("interface"), "can0");
    EXPECT_EQ(json.at("buses").at(0).at("counts").at("dropped"), 0);
    EXPECT_EQ(json.at("packets").at("view_control"), 0);
    EXPECT_EQ(json.at("rejects").at("truncated"), 2);
    EXPECT_EQ(json.at("host").at("protocol"), "4.0 big-endian");
    EXPECT_EQ(json.at("start_of_frame").at("sent"), 150);
    EXPECT_EQ(json.at("ephemeris").at("model"), "erfa");
    EXPECT_EQ(json.at("ephemeris").at("earth_orientation"), "1962-01-01..2026-08-21");
    EXPECT_EQ(json.at("ephemeris").at("date_clamped"), false);
    EXPECT_EQ(json.at("ephemeris").at("leap_seconds_assumed"), true);
    EXPECT_EQ(json.at("images").at("written"), 6);
}

}  // namespace
}  // namespace skyig::server
