// The page's colours against WCAG 2.1 AA: text 4.5 (1.4.3), edges and states of what is touched 3 (1.4.11),
// by the relative luminance that it defines, from the style sheet that is served.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <string>
#include <string_view>

#include "clients/instructor/page_files.h"

namespace skyig::clients::instructor {
namespace {

using Colours = std::map<std::string, std::string, std::less<>>;

/// The "--name: #rrggbb" of one theme.
Colours colours_of(std::string_view theme) {
    const std::string_view sheet = page_file("app.css").value_or("");
    Colours colours;
    const std::size_t begin = sheet.find("[data-theme=" + std::string(theme) + "]");
    if (begin == std::string_view::npos) return colours;
    const std::string_view block = sheet.substr(begin, sheet.find('}', begin) - begin);
    for (std::size_t at = block.find("--"); at != std::string_view::npos; at = block.find("--", at + 2)) {
        const std::size_t colon = block.find(':', at);
        const std::size_t hash = block.find_first_not_of(": ", colon);
        if (block[hash] != '#') continue;
        std::string hex(block.substr(hash + 1, block.find_first_of(";}", hash) - hash - 1));
        if (hex.size() == 3) hex = {hex[0], hex[0], hex[1], hex[1], hex[2], hex[2]};
        colours.emplace(block.substr(at + 2, colon - at - 2), hex);
    }
    return colours;
}

double relative_luminance(const std::string& hex) {
    constexpr double kWeights[] = {0.2126, 0.7152, 0.0722};
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double code = std::stoi(hex.substr(2 * i, 2), nullptr, 16) / 255.0;
        sum += kWeights[i] * (code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4));
    }
    return sum;
}

double contrast(const std::string& a, const std::string& b) {
    const auto [low, high] = std::minmax({relative_luminance(a), relative_luminance(b)});
    return (high + 0.05) / (low + 0.05);
}

TEST(Contrast, IsThatOfTheStandardsExamples) {
    EXPECT_DOUBLE_EQ(contrast("000000", "ffffff"), 21.0);
    EXPECT_NEAR(contrast("777777", "ffffff"), 4.48, 0.005);
}

class Theme : public testing::TestWithParam<const char*> {};

TEST_P(Theme, TextAndEdgesStandOutByWcagAa) {
    const Colours colours = colours_of(GetParam());
    double least_text = 21.0, least_edge = 21.0;
    const auto expect = [&](std::string_view front, std::string_view back, double bound, double& least) {
        const auto a = colours.find(front), b = colours.find(back);
        ASSERT_TRUE(a != colours.end() && b != colours.end()) << front << " on " << back;
        const double ratio = contrast(a->second, b->second);
        EXPECT_GE(ratio, bound) << front << " on " << back;
        least = std::min(least, ratio);
    };
    for (const char* back : {"ground", "card", "field"}) {
        for (const char* front : {"text", "quiet", "strong", "warm", "bad", "good"})
            expect(front, back, 4.5, least_text);
        expect("edge", back, 3.0, least_edge);
    }
    expect("on-text", "on", 4.5, least_text);
    // A pressed button stands out by its fill or by its edge, which has the colour of its text.
    ASSERT_TRUE(colours.contains("on"));
    EXPECT_GE(std::max(contrast(colours.at("on"), colours.at("card")),
                       contrast(colours.at("on-text"), colours.at("card"))),
              3.0);
    std::printf("%s: least contrast of text %.2f, of edges %.2f\n", GetParam(), least_text, least_edge);
    RecordProperty("least_text", std::to_string(least_text));
    RecordProperty("least_edge", std::to_string(least_edge));
}

INSTANTIATE_TEST_SUITE_P(Page, Theme, testing::Values("night", "day"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace skyig::clients::instructor
