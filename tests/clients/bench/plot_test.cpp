#include "clients/bench/plot.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <regex>
#include <string>
#include <vector>

#include "tests/clients/bench/sample_report.h"

namespace skyig::clients::bench {
namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++count;
    return count;
}

/// Names of elements in the order they open; fails on one that does not close in its place.
std::vector<std::string> elements_of(const std::string& svg) {
    static const std::regex kTag(R"(<(/?)([a-z]+)[^<>]*?(/?)>)");
    std::vector<std::string> open;
    std::vector<std::string> names;
    for (std::sregex_iterator it(svg.begin(), svg.end(), kTag), end; it != end; ++it) {
        const std::string name = (*it)[2];
        if ((*it)[1].length() > 0) {
            EXPECT_FALSE(open.empty());
            if (open.empty()) return names;
            EXPECT_EQ(open.back(), name);
            open.pop_back();
            continue;
        }
        names.push_back(name);
        if ((*it)[3].length() == 0) open.push_back(name);
    }
    EXPECT_TRUE(open.empty());
    return names;
}

TEST(Plot, HasTheStructureOfItsReport) {
    const Report report = tests::sample_report();
    const std::string svg = to_svg(report, report.plots[0]);
    const std::vector<std::string> names = elements_of(svg);
    ASSERT_FALSE(names.empty());
    EXPECT_EQ(names.front(), "svg");
    // `hour` has two models; `minute` one, since the fine model's error is zero.
    EXPECT_EQ(count_of(svg, "<polyline"), 2U);
    EXPECT_EQ(count_of(svg, "<g><title>"), 3U);
    EXPECT_EQ(count_of(svg, "<circle"), 2U + 1U) << "two points of the first model and its legend";
    EXPECT_NE(svg.find("<title>fine, hour: 1000 ns, 0.04</title>"), std::string::npos);
    EXPECT_NE(svg.find("Hands &lt;of&gt; a dial, day"), std::string::npos);
    EXPECT_NE(svg.find("largest error, arcsec"), std::string::npos);
    EXPECT_NE(svg.find("prefers-color-scheme:dark"), std::string::npos);
    for (const char* label : {">hour<", ">minute<", ">rough<", ">fine<", ">0.1<", ">10<", ">1000<"})
        EXPECT_EQ(count_of(svg, label) > 0, true) << label;
}

TEST(Plot, AxesAreLogarithmicAndErrorGrowsUpwards) {
    const Report report = tests::sample_report();
    const std::string svg = to_svg(report, report.plots[0]);
    std::smatch points;
    ASSERT_TRUE(
        std::regex_search(svg, points, std::regex(R"re(points="([\d.]+),([\d.]+) ([\d.]+),([\d.]+)")re")));
    const double x0 = std::stod(points[1]);
    const double y0 = std::stod(points[2]);
    const double x1 = std::stod(points[3]);
    const double y1 = std::stod(points[4]);
    // Costs 10 and 1000 and errors 40 and 0.04, with a fifth of a decade of room at each end.
    const double cost_decades = 2.0 + 0.4;
    const double error_decades = 3.0 + 0.4;
    EXPECT_NEAR(x1 - x0, 2.0 / cost_decades * (648.0 - 76.0), 0.2);
    EXPECT_NEAR(y1 - y0, 3.0 / error_decades * (420.0 - 52.0), 0.2);
    EXPECT_NEAR(x0, 76.0 + 0.2 / cost_decades * (648.0 - 76.0), 0.1);
    EXPECT_NEAR(y1, 420.0 - 0.2 / error_decades * (420.0 - 52.0), 0.1);
}

TEST(Plot, NothingToDrawIsSaid) {
    Report report = tests::sample_report();
    report.plots[0].cases = "never";
    const std::string svg = to_svg(report, report.plots[0]);
    EXPECT_FALSE(elements_of(svg).empty());
    EXPECT_NE(svg.find("nothing to draw"), std::string::npos);
}

TEST(Plot, OnePointAloneHasAnAxis) {
    Report report = tests::sample_report();
    report.models.resize(1);
    report.plots[0].series.resize(1);
    const std::string svg = to_svg(report, report.plots[0]);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_EQ(count_of(svg, "<g><title>"), 1U);
    // Less than two decades are divided more finely.
    EXPECT_NE(svg.find(">20<"), std::string::npos);
}

TEST(Plot, EveryModelOfManyHasAShape) {
    Report report = tests::sample_report();
    const ModelEntry model = report.models[0];
    report.models.assign(7, model);
    const std::string svg = to_svg(report, report.plots[0]);
    EXPECT_FALSE(elements_of(svg).empty());
    EXPECT_EQ(count_of(svg, "<g><title>"), 14U);
    EXPECT_EQ(count_of(svg, "class=\"shape\""), 7U);
}

TEST(Plot, CurvesStandOnALogarithmicAxisAndStayInTheFrame) {
    const std::string svg = to_svg(tests::sample_report().curves[0]);
    EXPECT_FALSE(elements_of(svg).empty());
    EXPECT_EQ(count_of(svg, "<polyline"), 1U);
    EXPECT_NE(svg.find("Towards &lt;noon&gt;"), std::string::npos);
    EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
    // From the bottom over the middle to the top; the point at 0 has no place.
    const std::size_t begin = svg.find("points=\"") + 8;
    double x[3] = {};
    double y[3] = {};
    ASSERT_EQ(
        std::sscanf(svg.c_str() + begin, "%lf,%lf %lf,%lf %lf,%lf", &x[0], &y[0], &x[1], &y[1], &x[2], &y[2]),
        6);
    EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.11);
    EXPECT_NEAR(y[0] - y[1], y[1] - y[2], 0.11);
    EXPECT_NE(to_svg(CurvePlot{}).find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace skyig::clients::bench
