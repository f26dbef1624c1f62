// skyig plan as it is run: what it tells of a noon and of a night.
#include "clients/skyig/plan.h"
#include "render/quality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace skyig::clients {
namespace {

using testing::HasSubstr;

StillOptions still_at(const std::string& utc) {
    StillOptions still;
    still.latitude_deg = 47.46;
    still.longitude_deg = 8.55;
    still.height_m = 500.0;
    still.utc = utc;
    return still;
}

std::string told(const PlanOptions& options, int status) {
    testing::internal::CaptureStdout();
    EXPECT_EQ(run_plan(options), status);
    return testing::internal::GetCapturedStdout();
}

std::map<std::string, nlohmann::json> passes_of(const nlohmann::json& plan) {
    std::map<std::string, nlohmann::json> passes;
    for (const nlohmann::json& pass : plan.at("passes"))
        passes[pass.at("pass")] = pass;
    return passes;
}

TEST(SkyigPlan, NoonHasNoMoonlightAndItsDomeKeepsToTheBudget) {
    const nlohmann::json plan = nlohmann::json::parse(told({still_at("2026-01-10T11:30:00Z"), true}, 0));
    EXPECT_EQ(plan.at("sky_model"), "multi");
    EXPECT_EQ(plan.at("budget_codes"), 0.5);
    const auto passes = passes_of(plan);
    ASSERT_EQ(passes.size(), render::kPassCount);
    for (const char* of_night : {"night sky", "milky way", "stars", "moon glare"})
        EXPECT_FALSE(passes.at(of_night).at("needed")) << of_night;
    EXPECT_TRUE(passes.at("sun sky").at("needed"));
    EXPECT_FALSE(passes.at("sun sky").at("needed_later")) << "the first frame has built it";
    EXPECT_EQ(passes.at("sun sky").at("cost"), "per table");
    EXPECT_FALSE(passes.at("moon sky").at("needed"));
    EXPECT_FALSE(passes.at("corona").at("needed"));
    EXPECT_TRUE(passes.at("sun disc").at("needed"));
    EXPECT_LT(passes.at("dome").at("error_codes"), 0.5);
    EXPECT_GT(passes.at("dome").at("columns"), 40);
    EXPECT_EQ(passes.at("dome").at("cost"), "per channel");
}

TEST(SkyigPlan, NightHasStarsAndNoSunlight) {
    const std::string text = told({still_at("2026-01-10T23:30:00Z"), false}, 0);
    EXPECT_THAT(text, HasSubstr("some stars outshine the sky"));
    EXPECT_THAT(text, HasSubstr("the source is too low to light the air"));
}

TEST(SkyigPlan, BudgetOfTheSettingsDecidesTheDome) {
    const std::string path = testing::TempDir() + "plan.toml";
    int last = 1000;
    for (const char* quality : {"error_codes = 0.25", "error_codes = 1.0", "error_pct = 6.8"}) {
        std::ofstream(path) << "version = 1\n[quality]\n"
                            << quality << R"(
[[channel]]
name = "centre"
width_px = 1280
height_px = 1024
left_deg = -30
right_deg = 30
bottom_deg = -25
top_deg = 25
)";
        PlanOptions options{still_at("2026-01-10T11:30:00Z"), true};
        options.still.config_path = path;
        const auto passes = passes_of(nlohmann::json::parse(told(options, 0)));
        const int columns = passes.at("dome").at("columns");
        EXPECT_LT(columns, last) << quality;
        last = columns;
    }
    std::filesystem::remove(path);
}

TEST(SkyigPlan, WrongSettingsAreToldAndLeaveWithTwo) {
    PlanOptions options{still_at("2026-01-10T11:30:00Z"), false};
    options.still.config_path = "/nowhere/site.toml";
    EXPECT_EQ(told(options, 2), "");
}

}  // namespace
}  // namespace skyig::clients
