#include <gtest/gtest.h>

#include <stdexcept>

#include "clients/bench/report.h"
#include "tests/clients/bench/sample_report.h"

namespace skyig::clients::bench {
namespace {

TEST(ReportJson, ComesBackAsItWasWritten) {
    const Report report = tests::sample_report();
    const std::string text = to_json(report);
    const Report again = report_from_json(text);
    EXPECT_EQ(to_json(again), text);
    ASSERT_EQ(again.models.size(), 2U);
    EXPECT_EQ(again.models[0].what, report.models[0].what);
    EXPECT_EQ(again.models[0].errors[1].figures, report.models[0].errors[1].figures);
    EXPECT_EQ(again.models[0].costs[0].floors, report.models[0].costs[0].floors);
    EXPECT_EQ(again.models[0].costs[0].instructions, 31.0);
    EXPECT_FALSE(again.models[1].costs[0].instructions.has_value());
    ASSERT_EQ(again.models[0].rows.size(), 1U);
    EXPECT_EQ(again.models[0].rows[0].row, "noon | sharp");
    EXPECT_EQ(again.models[0].rows[0].off, -360.0);
    EXPECT_EQ(again.plots[0].series[1].quantity, "minute");
    ASSERT_EQ(again.curves.size(), 1U);
    EXPECT_EQ(again.curves[0].curves[0].label, "a < b");
    EXPECT_EQ(again.curves[0].curves[0].points[3].y, 2.0);
    EXPECT_EQ(again.headline.cost, "read");
    EXPECT_EQ(again.headline.worst_cost, "");
    EXPECT_EQ(again.floor_ns, report.floor_ns);
}

TEST(ReportJson, FiguresKeepFourDigits) {
    Report report = tests::sample_report();
    report.models[0].costs[0].ns.median = 1234.5678;
    report.models[0].errors[0].figures.max = 0.000123456;
    const std::string text = to_json(report);
    EXPECT_NE(text.find("1235.0"), std::string::npos);
    EXPECT_NE(text.find("0.0001235"), std::string::npos);
}

TEST(ReportJson, AnotherShapeIsRefusedByName) {
    const auto message_of = [](std::string_view text) -> std::string {
        try {
            (void)report_from_json(text);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "no complaint";
    };
    EXPECT_NE(message_of("{").find("parse error"), std::string::npos);
    EXPECT_NE(message_of("{}").find("schema"), std::string::npos);
    EXPECT_NE(message_of(R"({"schema": "skyig-bench-0"})").find("skyig-bench-1"), std::string::npos);
    EXPECT_NE(message_of(R"({"schema": "skyig-bench-1", "family": 7})").find("string"), std::string::npos);
    std::string text = to_json(tests::sample_report());
    text.replace(text.find("\"rms\""), 5, "\"rmz\"");
    EXPECT_NE(message_of(text).find("rms"), std::string::npos);
}

TEST(ReportText, NumbersAreShort) {
    EXPECT_EQ(short_number(0.0), "0");
    EXPECT_EQ(short_number(0.031254), "0.03125");
    EXPECT_EQ(short_number(4.1684e-5), "4.168e-05");
    EXPECT_EQ(short_number(9036.4), "9036");
    EXPECT_EQ(short_number(134512.0), "134500");
    EXPECT_EQ(short_number(3.1e12), "3.1e+12");
}

TEST(ReportText, TellsEveryFigureInATable) {
    const std::string text = to_text(tests::sample_report());
    for (const char* wanted : {"dials", "a better dial", "a glance: 2 ns", "rough", "0.039", "900", "31"})
        EXPECT_NE(text.find(wanted), std::string::npos) << wanted << " in\n" << text;
}

}  // namespace
}  // namespace skyig::clients::bench
