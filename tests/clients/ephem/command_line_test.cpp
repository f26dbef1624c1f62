// What skyig ephem takes, refuses, and leaves with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "clients/skyig/ephem.h"
#include "clients/skyig/options.h"

namespace skyig::clients {
namespace {

using ::testing::HasSubstr;

Invocation read(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), {"skyig", "ephem"});
    return read_command_line(static_cast<int>(arguments.size()), arguments.data());
}

void expect_wrong_usage(const std::vector<const char*>& arguments, const std::string& part) {
    const Invocation invocation = read(arguments);
    EXPECT_EQ(invocation.exit_status, 2);
    EXPECT_THAT(invocation.error, HasSubstr(part));
    EXPECT_EQ(std::count(invocation.error.begin(), invocation.error.end(), '\n'), 1) << invocation.error;
}

TEST(EphemCommandLine, OptionsArrive) {
    const Invocation invocation =
        read({"--utc", "2024-04-08T19:12:34Z", "--lat", "41", "--lon=-83", "--alt", "200", "--model", "erfa",
              "--body", "sun,Moon", "--star", "Vega,424", "--json"});
    const auto& options = std::get<EphemOptions>(invocation.options);
    EXPECT_EQ(options.longitude_deg, -83.0);
    EXPECT_EQ(options.height_m, 200.0);
    EXPECT_EQ(options.model, "erfa");
    EXPECT_THAT(options.bodies, ::testing::ElementsAre("sun", "Moon"));
    EXPECT_THAT(options.stars, ::testing::ElementsAre("Vega", "424"));
    EXPECT_TRUE(options.json);
}

TEST(EphemCommandLine, HelpTellsTheTablesAndConventions) {
    const Invocation invocation = read({"--help"});
    EXPECT_EQ(invocation.exit_status, 0);
    for (const char* part : {"--batch", "--events", "--time-column", "jd_tt", "J2000", "34'", "exit status",
                             "--lat, --lon and --alt are not used", "the first in this order"})
        EXPECT_THAT(invocation.output, HasSubstr(part));
}

TEST(EphemCommandLine, WrongUsageIsOneLineAndStatusTwo) {
    expect_wrong_usage({"--utc", "yesterday"}, "is no UTC time");
    expect_wrong_usage({"--lat", "41"}, "--lon");
    expect_wrong_usage({"--lat", "91", "--lon", "0"}, "[-90, 90]");
    expect_wrong_usage({"--body", "pluto"}, "none of sun, moon");
    expect_wrong_usage({"--star", "Nibiru"}, "Sirius");
    expect_wrong_usage({"--model", "vsop"}, "--model");
    expect_wrong_usage({"--events", "2026-06-01"}, "2026-06-01..2026-06-30");
    expect_wrong_usage({"--out", "x.csv"}, "--batch");
    expect_wrong_usage({"--batch", "x.csv", "--utc", "2024-04-08T19:12:34Z"}, "--utc");
    expect_wrong_usage({"--json", "--text"}, "--text");
    expect_wrong_usage({"--horizon", "eye"}, "--horizon requires");
    expect_wrong_usage({"--utc", "1850-01-01T00:00:00Z"}, "1900..2100");
    expect_wrong_usage({"--batch", ""}, "--batch");
    expect_wrong_usage({"--batch", "x.csv", "--out", ""}, "--out");
    expect_wrong_usage({"--batch", "x.csv", "--time-column", ""}, "--time-column");
    expect_wrong_usage({"--batch", "x.csv", "--body", "sun,moon"}, "a table takes one body");
    expect_wrong_usage({"--json", "--text"}, "skyig ephem --help");
}

class EphemFiles : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() /
                  ("skyig_ephem_" + std::to_string(::getpid()) + "_" +
                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }
    [[nodiscard]] std::string text(const std::string& name) const {
        std::ifstream file(path(name));
        return {std::istreambuf_iterator<char>(file), {}};
    }
    [[nodiscard]] EphemOptions batch(const std::string& in, const std::string& out) const {
        EphemOptions options;
        options.batch_path = path(in);
        options.out_path = path(out);
        return options;
    }

  private:
    std::filesystem::path folder_;
};

TEST_F(EphemFiles, GoodTablesLeaveWithZeroAndBadRowsWithOne) {
    write("good.csv", "utc,body\n2024-04-08T19:12:34Z,sun\n");
    EXPECT_EQ(run_ephem(batch("good.csv", "out.csv")), 0);
    EXPECT_THAT(text("out.csv"), HasSubstr("2024-04-08T19:12:34Z,sun,17."));
    write("bad.csv", "utc,body\n2024-04-08T19:12:34Z,sun\n2024-04-08,sun\n");
    EXPECT_EQ(run_ephem(batch("bad.csv", "out.csv")), 1);
    EXPECT_THAT(text("out.csv"), HasSubstr("\n2024-04-08,sun,,,"));
}

TEST_F(EphemFiles, TableIsNeverWrittenOverItself) {
    write("same.csv", "utc,body\n2024-04-08T19:12:34Z,sun\n");
    EXPECT_EQ(run_ephem(batch("same.csv", "same.csv")), 2);
    EXPECT_EQ(text("same.csv"), "utc,body\n2024-04-08T19:12:34Z,sun\n");
}

TEST_F(EphemFiles, FilesThatCannotBeReadOrWrittenFail) {
    EXPECT_EQ(run_ephem(batch("missing.csv", "out.csv")), 1);
    EXPECT_EQ(run_ephem(batch("", "out.csv")), 1);
    write("good.csv", "utc,body\n2024-04-08T19:12:34Z,sun\n");
    EXPECT_EQ(run_ephem(batch("good.csv", "no/such/folder/out.csv")), 1);
    write("empty.csv", "");
    EXPECT_EQ(run_ephem(batch("empty.csv", "out.csv")), 1);
}

TEST_F(EphemFiles, ReadErrorsAreTold) {
    EphemOptions options = batch("", "out.csv");
    // The memory of a process can be opened, and its first page cannot be read.
    for (const std::string& unreadable : {path(""), std::string("/proc/self/mem")}) {
        options.batch_path = unreadable;
        testing::internal::CaptureStderr();
        EXPECT_EQ(run_ephem(options), 1);
        EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr(unreadable + ":1: cannot be read"));
    }
}

TEST_F(EphemFiles, RefusedTablesLeaveTheOldOutputAlone) {
    write("out.csv", "precious\n");
    write("bad.csv", "when,body\n");
    EXPECT_EQ(run_ephem(batch("bad.csv", "out.csv")), 1);
    EXPECT_EQ(run_ephem(batch("missing.csv", "out.csv")), 1);
    EXPECT_EQ(text("out.csv"), "precious\n");
}

std::string told_by(const EphemOptions& options) {
    testing::internal::CaptureStdout();
    EXPECT_EQ(run_ephem(options), 0);
    std::fflush(stdout);
    return testing::internal::GetCapturedStdout();
}

TEST(Ephem, WhatIsAskedTwiceIsToldOnce) {
    EphemOptions options;
    options.utc = "2024-04-08T19:12:34Z";
    options.bodies = {"sun", "Mars", "SUN"};
    options.stars = {"Vega", "7001", "Sirius", "hr 7001"};
    options.json = true;
    const auto json = nlohmann::json::parse(told_by(options));
    ASSERT_EQ(json["bodies"].size(), 2U);
    EXPECT_EQ(json["bodies"][1]["body"], "mars");
    ASSERT_EQ(json["stars"].size(), 2U);
    EXPECT_EQ(json["stars"][1]["name"], "Sirius");
}

TEST(Ephem, TheEyesHorizonFromACruisingAircraftIsLow) {
    EphemOptions options;
    options.events = "2026-03-20..2026-03-20";
    options.latitude_deg = 0.0;
    options.longitude_deg = 0.0;
    options.height_m = 10972.8;
    options.bodies = {"sun"};
    options.eye_horizon = true;
    options.json = true;
    const auto json = nlohmann::json::parse(told_by(options));
    std::map<std::string, double> limbs_deg;
    std::map<std::string, std::string> times;
    for (const auto& event : json["events"]) {
        if (event["event"] != "rise" && event["event"] != "set") continue;
        constexpr double kSemidiameter_deg = 0.2677;
        limbs_deg[event["event"]] = event["elevation_deg"].get<double>() + kSemidiameter_deg;
        times[event["event"]] = event["utc"];
    }
    EXPECT_EQ(times["rise"], "2026-03-20T05:49:41Z");
    EXPECT_EQ(times["set"], "2026-03-20T18:25:11Z");
    for (const char* event : {"rise", "set"}) {
        std::printf("%s: upper limb at %.3f deg\n", event, limbs_deg[event]);
        // Traced through the standard atmosphere: dip and refraction along the ray that grazes the sea.
        EXPECT_NEAR(limbs_deg[event], -4.2, 0.05) << event;
    }
}

}  // namespace
}  // namespace skyig::clients
