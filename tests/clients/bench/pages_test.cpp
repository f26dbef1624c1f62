#include "clients/bench/pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/clients/bench/sample_report.h"

namespace skyig::clients::bench {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Every row of every table has as many cells as the line above it.
void expect_even_tables(const std::string& page) {
    std::istringstream lines(page);
    std::ptrdiff_t columns = 0;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with('|')) {
            columns = 0;
            continue;
        }
        std::ptrdiff_t bars = std::count(line.begin(), line.end(), '|');
        for (auto at = line.find("\\|"); at != std::string::npos; at = line.find("\\|", at + 2))
            --bars;
        if (columns != 0) {
            EXPECT_EQ(bars, columns) << line;
        }
        columns = bars;
    }
}

TEST(Pages, FamilyPageHoldsPlotsErrorsAndCosts) {
    const std::string page = family_page(tests::sample_report());
    expect_even_tables(page);
    for (const char* wanted :
         {"# Dials & hands", "(dials-hands.svg)", "### day", "### night",
          "| hour | rough | 40 | 20 | 39 | arcsec | 24 |",
          "| hour | fine | 0.08 | 0.04 | 0.07 | arcsec | 12 |", "| read | rough | 10 | 9 - 11 | 5 | 31 |",
          "| read | fine | 1000 | 900 - 1100 | 500 | not counted |", "a glance: 2 ns", "11 rounds",
          "| rough | day | noon \\| sharp | 12 | 11.9 | h | -360 |"})
        EXPECT_NE(page.find(wanted), std::string::npos) << wanted << " in\n" << page;
}

TEST(Pages, IndexHasOneLineAModel) {
    Report second = tests::sample_report();
    second.family = "clocks";
    second.models[0].name = "a | b";
    second.models[0].costs.push_back({"blink", {20.0, 30.0, 40.0}, {10.0, 15.0, 20.0}, {}});
    second.headline.worst_cost = "blink";
    const std::string page = index_page(std::vector<Report>{tests::sample_report(), second});
    expect_even_tables(page);
    EXPECT_NE(
        page.find("| [dials](dials.md) | rough | hour | day | 40 | 20 | arcsec | read | 10 | 5 |  | |  |"),
        std::string::npos)
        << page;
    EXPECT_NE(page.find("| [clocks](clocks.md) | a \\| b | hour | day | 40 | 20 | arcsec | read | 10 | 5 | "
                        "blink | 30 | 15 |"),
              std::string::npos)
        << page;
}

TEST(Pages, AFolderOfJsonBecomesPagesAndPlots) {
    const fs::path folder = fs::path(testing::TempDir()) / "skyig-pages";
    fs::remove_all(folder);
    fs::create_directories(folder);
    std::ofstream(folder / "dials.json") << to_json(tests::sample_report());
    const std::vector<fs::path> written = render_pages(folder);
    EXPECT_EQ(written, (std::vector<fs::path>{folder / "dials.md", folder / "dials-hands.svg",
                                              folder / "dials-noon.svg", folder / "index.md"}));
    EXPECT_EQ(read_text(folder / "dials.md"), family_page(tests::sample_report()));
    EXPECT_TRUE(read_text(folder / "dials-hands.svg").starts_with("<svg "));
    fs::remove_all(folder);
}

TEST(Pages, WhatCannotBeReadIsNamed) {
    const fs::path folder = fs::path(testing::TempDir()) / "skyig-bad-pages";
    fs::remove_all(folder);
    const auto message_of = [&folder]() -> std::string {
        try {
            (void)render_pages(folder);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "no complaint";
    };
    EXPECT_NE(message_of().find("skyig-bad-pages"), std::string::npos);
    fs::create_directories(folder);
    EXPECT_NE(message_of().find("no .json"), std::string::npos);
    std::ofstream(folder / "torn.json") << "{\"schema\":";
    EXPECT_NE(message_of().find("torn.json"), std::string::npos);
    fs::remove_all(folder);
}

}  // namespace
}  // namespace skyig::clients::bench
