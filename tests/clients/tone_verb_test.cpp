// The words of `skyig tone`.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "clients/skyig/options.h"

namespace skyig::clients {
namespace {

Invocation invoke(std::vector<const char*> words) {
    words.insert(words.begin(), {"skyig", "tone"});
    return read_command_line(static_cast<int>(words.size()), words.data());
}

ToneOptions tone_options(const std::vector<const char*>& words) {
    const Invocation invocation = invoke(words);
    EXPECT_EQ(invocation.error, "");
    const auto* options = std::get_if<ToneOptions>(&invocation.options);
    EXPECT_NE(options, nullptr);
    return options ? *options : ToneOptions{};
}

TEST(ToneVerb, ReadsOperatorScreenAndLuminances) {
    const ToneOptions options = tone_options({"--operator", "tumblin-safe", "--adaptation", "1e-3",
                                              "--display-max", "100", "--display-adaptation", "50",
                                              "--ambient", "1", "--gamma", "2.2", "0", "1e-310", "inf"});
    EXPECT_EQ(options.tone_operator, "tumblin-safe");
    EXPECT_EQ(options.adaptation_cd_m2, 1e-3);
    EXPECT_EQ(options.display_max_cd_m2, 100.0);
    EXPECT_EQ(options.display_adaptation_cd_m2, 50.0);
    EXPECT_EQ(options.ambient_cd_m2, 1.0);
    EXPECT_EQ(options.gamma, 2.2);
    ASSERT_EQ(options.luminance_cd_m2.size(), 3U);
    EXPECT_EQ(options.luminance_cd_m2[0], 0.0);
    EXPECT_TRUE(std::isinf(options.luminance_cd_m2[2]));
}

TEST(ToneVerb, AdaptsToEachLuminanceOnAnSrgbScreenUnlessTold) {
    const ToneOptions options = tone_options({"--adaptation", "self", "--gamma", "srgb", "5"});
    EXPECT_FALSE(options.adaptation_cd_m2);
    EXPECT_FALSE(options.gamma);
    EXPECT_FALSE(options.display_adaptation_cd_m2);
    EXPECT_FALSE(options.picture);
}

TEST(ToneVerb, WrongWordsAreWrongUsageInOneLine) {
    for (const std::vector<const char*>& words : {std::vector<const char*>{},
                                                  {"nan"},
                                                  {"x"},
                                                  {"--", "-1"},
                                                  {"--operator", "best", "1"},
                                                  {"--gamma", "9", "1"},
                                                  {"--adaptation", "0", "1"},
                                                  {"--display-max", "0", "1"},
                                                  {"--display-adaptation", "0.01", "1"},
                                                  {"--ambient", "-1", "1"}}) {
        const Invocation invocation = invoke(words);
        EXPECT_EQ(invocation.exit_status, 2) << (words.empty() ? "" : words.front());
        EXPECT_TRUE(invocation.error.starts_with("skyig tone: ")) << invocation.error;
        EXPECT_EQ(invocation.error.find('\n'), invocation.error.size() - 1);
    }
}

}  // namespace
}  // namespace skyig::clients
