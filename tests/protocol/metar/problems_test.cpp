// What is wrong is named, and the rest stands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "protocol/metar/decode.h"

namespace skyig::protocol::metar {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(MetarProblems, ABadGroupIsNamedAndTheRestStands) {
    struct Case {
        const char* group;
        Fault fault;
    };
    const Case cases[]{
        {"40012KT", Fault::kWind},        {"2401KT", Fault::kWind},
        {"24012GKT", Fault::kWind},       {"24012G3KT", Fault::kWind},
        {"VRBKT", Fault::kWind},          {"24O12KT", Fault::kWind},
        {"280V361", Fault::kVariation},   {"28V350", Fault::kVariation},
        {"280V350", Fault::kVariation},   {"99999", Fault::kVisibility},
        {"800", Fault::kVisibility},      {"1200SSW", Fault::kVisibility},
        {"9999NDVN", Fault::kVisibility}, {"1/0SM", Fault::kVisibility},
        {"11/2SM", Fault::kVisibility},   {"2/1/2SM", Fault::kVisibility},
        {"R37/0600", Fault::kRunway},     {"R00/0600", Fault::kRunway},
        {"R27/600", Fault::kRunway},      {"R27", Fault::kRunway},
        {"R27/", Fault::kRunway},         {"R27/0600X", Fault::kRunway},
        {"R27/0600VU", Fault::kRunway},   {"R40/450093", Fault::kRunway},
        {"-RAXX", Fault::kWeather},       {"+", Fault::kWeather},
        {"VC", Fault::kWeather},          {"-FZ", Fault::kWeather},
        {"-RARASNDZPL", Fault::kWeather}, {"FEW0X5", Fault::kCloud},
        {"BKN12", Fault::kCloud},         {"OVC", Fault::kCloud},
        {"SCT025CU", Fault::kCloud},      {"VV02", Fault::kCloud},
        {"///0150", Fault::kCloud},       {"15/8", Fault::kTemperature},
        {"M2/M11", Fault::kTemperature},  {"15/08/03", Fault::kTemperature},
        {"Q0849", Fault::kPressure},      {"Q1101", Fault::kPressure},
        {"Q998", Fault::kPressure},       {"A2509", Fault::kPressure},
        {"A29921", Fault::kPressure},     {"Q2992INS0", Fault::kPressure},
        {"Q1013/29", Fault::kPressure},   {"W15/X2", Fault::kSea},
        {"W1/S2", Fault::kSea},           {"WS", Fault::kShear},
    };
    for (const Case& each : cases) {
        const Report report = decode(std::string("METAR EGLL 151220Z ") + each.group + " NSC BLU");
        EXPECT_EQ(report.clear_code, ClearCode::kNsc) << each.group;
        EXPECT_THAT(report.colour_states, ElementsAre("BLU")) << each.group;
        ASSERT_EQ(report.problems.size(), 1U) << each.group;
        EXPECT_EQ(fault_text(report.problems[0].fault), fault_text(each.fault)) << each.group;
        EXPECT_EQ(report.problems[0].group, each.group);
        EXPECT_THAT(report.unparsed, ElementsAre(each.group));
        EXPECT_FALSE(report.wind || report.visibility || report.pressure || report.sea) << each.group;
    }
    std::printf("%zu bad groups, each named\n", std::size(cases));
}

TEST(MetarProblems, SaysWhatWouldBeRight) {
    const Report report = decode("METAR EGLL 151220Z 40012KT");
    EXPECT_EQ(
        describe(report.problems.at(0)),
        "'40012KT': write the wind as 24012KT, 24012G25KT or VRB03MPS: direction 000 to 360, speed of two or "
        "three digits, KT, MPS or KMH");
    const Report longest = decode("METAR EGLL 151220Z " + std::string(10'000, '9'));
    EXPECT_EQ(describe(longest.problems.at(0)).find("'" + std::string(40, '9') + "...': "), 0U);
}

TEST(MetarProblems, TheHeader) {
    const auto faults = [](std::string_view text) {
        std::vector<std::string> told;
        for (const Problem& problem : decode(text).problems)
            told.push_back((problem.fault == Fault::kStation ? "station " : "time ") + problem.group);
        return told;
    };
    EXPECT_THAT(faults(""), ElementsAre("station ", "time "));
    EXPECT_THAT(faults("METAR"), ElementsAre("station ", "time "));
    EXPECT_THAT(faults("METAR EGLL"), ElementsAre("time "));
    EXPECT_THAT(faults("METAR 151220Z"), ElementsAre("station 151220Z"));
    EXPECT_THAT(faults("METAR EGL 151220Z"), ElementsAre("station EGL"));
    for (const char* time : {"321220Z", "001220Z", "152420Z", "151260Z", "15122Z", "1512200Z", "151220"}) {
        const Report report = decode(std::string("METAR EGLL ") + time + " 24012KT");
        EXPECT_THAT(faults(report.raw), ElementsAre(std::string("time ") + time));
        EXPECT_FALSE(report.day || report.hour || report.minute);
        EXPECT_EQ(report.wind->speed, 12);
        EXPECT_THAT(report.unparsed, IsEmpty());
    }
    EXPECT_THAT(faults("METAR EGLL 24012KT"), ElementsAre("time 24012KT"));
    EXPECT_EQ(decode("METAR EGLL 24012KT").wind->speed, 12);
}

TEST(MetarProblems, WhatIsToldTwiceKeepsTheFirst) {
    const Report report = decode(
        "METAR EGLL 151220Z 24012KT 9999 15/08 Q1018 25013KT 5000 2SM CAVOK 16/09 Q1019 W15/S2 W16/S3");
    EXPECT_EQ(report.wind->speed, 12);
    EXPECT_EQ(report.visibility->prevailing_m, 10'000.0);
    EXPECT_FALSE(report.cavok);
    EXPECT_EQ(report.temperature_c, 15);
    EXPECT_EQ(report.pressure->qnh_hpa, 1018.0);
    EXPECT_EQ(report.sea->state, 2);
    EXPECT_THAT(report.unparsed, ElementsAre("25013KT", "5000", "2SM", "CAVOK", "16/09", "Q1019", "W16/S3"));
    for (const Problem& problem : report.problems)
        EXPECT_EQ(problem.fault, Fault::kTwice);
}

TEST(MetarProblems, GroupsOfNoKnownKindAreNoErrors) {
    const Report report = decode("METAR EGLL 151220Z 24012KT XX/YY WIND SKEID RAXX RERAXX $ Q1018");
    EXPECT_TRUE(report.valid());
    EXPECT_THAT(report.unparsed, ElementsAre("XX/YY", "WIND", "SKEID", "RAXX", "RERAXX", "$"));
    EXPECT_EQ(report.pressure->qnh_hpa, 1018.0);
}

}  // namespace
}  // namespace skyig::protocol::metar
