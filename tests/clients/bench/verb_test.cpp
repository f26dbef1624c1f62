// The words of `skyig bench`.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "clients/skyig/bench.h"
#include "clients/skyig/options.h"

namespace skyig::clients {
namespace {

Invocation invoke(std::vector<const char*> words) {
    words.insert(words.begin(), {"skyig", "bench"});
    return read_command_line(static_cast<int>(words.size()), words.data());
}

BenchOptions bench_options(const std::vector<const char*>& words) {
    const Invocation invocation = invoke(words);
    EXPECT_EQ(invocation.error, "");
    const auto* options = std::get_if<BenchOptions>(&invocation.options);
    EXPECT_NE(options, nullptr);
    return options ? *options : BenchOptions{};
}

TEST(BenchVerb, ReadsAFamilyAndItsOptions) {
    const BenchOptions options = bench_options(
        {"wire", "--truth", "there", "--rounds", "9", "--instructions", "counts.csv", "--json"});
    EXPECT_EQ(options.family, "wire");
    EXPECT_EQ(options.truth_folder, "there");
    EXPECT_EQ(options.rounds, 9);
    EXPECT_EQ(options.instructions_path, "counts.csv");
    EXPECT_TRUE(options.json);
    EXPECT_FALSE(options.counted_calls.has_value());
    EXPECT_EQ(bench_options({"wire"}).truth_folder, "tests/data");
    EXPECT_EQ(bench_options({"wire", "--counted-calls", "5"}).counted_calls, 5U);
}

TEST(BenchVerb, ReadsTheOtherTwoThingsToDo) {
    EXPECT_TRUE(bench_options({"--list"}).list);
    EXPECT_EQ(bench_options({"--render", "docs"}).render_folder, "docs");
}

TEST(BenchVerb, WrongUseIsRefusedInOneLine) {
    for (const std::vector<const char*>& words : {std::vector<const char*>{},
                                                  {"wire", "--list"},
                                                  {"wire", "--render", "docs"},
                                                  {"wire", "--rounds", "0"},
                                                  {"--list", "--counted-calls", "3"},
                                                  {"wire", "--counted-calls", "0"},
                                                  {"wire", "night"}}) {
        const Invocation invocation = invoke(words);
        EXPECT_EQ(invocation.exit_status, 2);
        EXPECT_EQ(std::count(invocation.error.begin(), invocation.error.end(), '\n'), 1) << invocation.error;
        EXPECT_NE(invocation.error.find("skyig bench --help"), std::string::npos) << invocation.error;
    }
}

TEST(BenchVerb, AnUnknownFamilyIsWrongUse) {
    BenchOptions options;
    options.family = "dial";
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_bench(options), 2);
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_NE(told.find("'dial'"), std::string::npos);
    EXPECT_NE(told.find("wire"), std::string::npos);
}

TEST(BenchVerb, HelpTellsTheOptions) {
    const Invocation invocation = invoke({"--help"});
    EXPECT_EQ(invocation.exit_status, 0);
    for (const char* word : {"FAMILY", "--list", "--render", "--truth", "--json"})
        EXPECT_NE(invocation.output.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace skyig::clients
