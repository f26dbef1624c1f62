// The words of `skyig rvr`.
#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "clients/skyig/options.h"

namespace skyig::clients {
namespace {

Invocation invoke(std::vector<const char*> words) {
    words.insert(words.begin(), {"skyig", "rvr"});
    return read_command_line(static_cast<int>(words.size()), words.data());
}

TEST(RvrVerb, ReadsWhatIsKnownAndTheLights) {
    const Invocation invocation =
        invoke({"--rvr", "350", "--intensity", "5000", "--background", "12", "--contrast", "0.02", "--json"});
    EXPECT_EQ(invocation.error, "");
    const auto* options = std::get_if<RvrOptions>(&invocation.options);
    ASSERT_NE(options, nullptr);
    EXPECT_EQ(options->rvr_m, 350.0);
    EXPECT_FALSE(options->visibility_m || options->extinction_per_m);
    EXPECT_EQ(options->intensity_cd, 5000.0);
    EXPECT_EQ(options->background_cd_m2, 12.0);
    EXPECT_EQ(options->contrast, 0.02);
    EXPECT_TRUE(options->json);
}

TEST(RvrVerb, TakesExactlyOneOfVisibilityExtinctionAndRange) {
    for (const std::vector<const char*>& words : {std::vector<const char*>{},
                                                  {"--visibility", "300", "--rvr", "350"},
                                                  {"--visibility", "nan"},
                                                  {"--extinction", "-1"},
                                                  {"--rvr", "0"}}) {
        const Invocation invocation = invoke(words);
        EXPECT_EQ(invocation.exit_status, 2);
        EXPECT_TRUE(invocation.error.starts_with("skyig rvr: ")) << invocation.error;
    }
}

}  // namespace
}  // namespace skyig::clients
