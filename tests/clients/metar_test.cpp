// skyig metar: the examples key by key, the page, exit statuses.
#include "clients/skyig/metar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace skyig::clients {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

struct Told {
    int exit_status;
    std::string out;
    std::string error;
};

Told tell(const MetarOptions& options, const std::string& input = "") {
    std::istringstream in(input);
    std::ostringstream out;
    testing::internal::CaptureStderr();
    const int exit_status = run_metar(options, in, out);
    return {exit_status, out.str(), testing::internal::GetCapturedStderr()};
}

TEST(Metar, ExamplesKeyByKey) {
    const Json examples =
        Json::parse(std::ifstream(SKYIG_TEST_DATA "/metar/metar_examples.json")).at("examples");
    std::size_t keys = 0;
    for (const Json& expected : examples) {
        const Told done = tell({.reports = {expected.at("raw")}, .json = true});
        EXPECT_EQ(done.exit_status, 0);
        EXPECT_EQ(done.error, "");
        const Json got = Json::parse(done.out);
        EXPECT_EQ(got, expected) << Json::diff(expected, got).dump(1);
        // A number's kind, too: 10000 and not 10000.0.
        EXPECT_EQ(got.dump(), expected.dump());
        keys += got.size();
    }
    std::printf("%zu keys of %zu reports agree\n", keys, examples.size());
    EXPECT_EQ(examples.size(), 15U);
    EXPECT_EQ(keys, 15U * 27U);
}

TEST(Metar, TheStateIsWhatIsDrawnWithHeightsAboveTheEllipsoid) {
    MetarOptions options;
    options.reports = {"METAR UUEE 301333Z 09006MPS 2100 +SHRA BKN012CB 18/16 Q1003"};
    options.state = true;
    options.elevation_m = 200.0;
    const Told done = tell(options);
    EXPECT_EQ(done.exit_status, 0);
    const Json got = Json::parse(done.out);
    EXPECT_EQ(got.at("station"), "UUEE");
    EXPECT_EQ(got.at("layers").size(), 2U);
    EXPECT_EQ(got.at("layers")[0].at("type"), "cumulonimbus");
    EXPECT_NEAR(got.at("layers")[0].at("base_m").get<double>(), 200.0 + 1200.0 * 0.3048, 1e-9);
    EXPECT_EQ(got.at("layers")[1].at("rate_mm_h"), 15.0);
    EXPECT_NEAR(got.at("air").at("wind_m_s").get<double>(), 6.0, 1e-9);
}

TEST(Metar, ABadGroupIsToldAndTheRestStands) {
    const Told done = tell({.reports = {"METAR EGLL 151220Z 40012KT 9999 FEW0X5 SKEID Q1018"}, .json = true});
    EXPECT_EQ(done.exit_status, 1);
    EXPECT_THAT(done.error, HasSubstr("skyig metar: argument 1: '40012KT': write the wind as 24012KT"));
    const Json got = Json::parse(done.out);
    EXPECT_FALSE(got.at("valid").get<bool>());
    EXPECT_THAT(got.at("error").get<std::string>(), HasSubstr("; 'FEW0X5': write cloud as"));
    EXPECT_TRUE(got.at("wind").is_null());
    EXPECT_EQ(got.at("qnh_hpa"), 1018);
    EXPECT_EQ(got.at("unparsed"), Json({"40012KT", "FEW0X5", "SKEID"}));
}

TEST(Metar, WordsQuotedReportsAndLines) {
    const std::vector<std::string> words{"EGLL", "151220Z", "NIL",
                                         "METAR LFPG 020600Z NIL= METAR EHAM 250525Z NIL"};
    const Told arguments = tell({.reports = words});
    EXPECT_EQ(arguments.exit_status, 0);
    EXPECT_EQ(arguments.out,
              "METAR EGLL, day 15, 12:20 UTC, no report (NIL)\n\n"
              "METAR LFPG, day 2, 06:00 UTC, no report (NIL)\n\n"
              "METAR EHAM, day 25, 05:25 UTC, no report (NIL)\n");
    const Told lines = tell({.reports = {"-"}}, "EGLL 151220Z NIL\r\n\n  \nEGLL 24012KT\n");
    EXPECT_EQ(lines.exit_status, 1);
    EXPECT_THAT(lines.error, HasSubstr("line 4: '24012KT': write day"));
    EXPECT_THAT(lines.out, HasSubstr("(6.2 m/s)"));
    const Told nothing = tell({}, "\n \n");
    EXPECT_EQ(nothing.exit_status, 1);
    EXPECT_EQ(nothing.error, "skyig metar: there is no report to read\n");
}

TEST(Metar, ThePageOfAWinterDay) {
    const Told done =
        tell({.reports = {"SPECI BIKF 141400Z AUTO 02045G62KT 350V050 M1/4SM R01/0400VP0800U +BLSN VCTS "
                          "FEW008CB VV002 M05/M07 A2841 RESN W04/H32 WS R01 BLU NOSIG RMK X"}});
    EXPECT_EQ(done.exit_status, 0);
    EXPECT_EQ(done.out,
              "SPECI BIKF, day 14, 14:00 UTC, automatic\n"
              "  wind        from 20 deg true, 45 KT (23.1 m/s), gusts 62 KT (31.9 m/s), varying from 350 to "
              "50 deg\n"
              "  visibility  below 402 m\n"
              "  runway      01: 400 m to above 800 m, getting better\n"
              "  weather     heavy blowing snow; thunderstorm in the vicinity\n"
              "  recent      snow\n"
              "  cloud       FEW (1 to 2 oktas), cumulonimbus, base 800 ft (244 m) above the aerodrome\n"
              "  sky         hidden, vertical visibility 200 ft (61 m)\n"
              "  temperature -5 C\n"
              "  dew point   -7 C\n"
              "  QNH         962.1 hPa\n"
              "  wind shear  R01\n"
              "  sea         4 C\n"
              "  sea         waves of 3.2 m\n"
              "  colour      BLU\n"
              "  trend       NOSIG\n"
              "  remarks     X\n");
}

TEST(Metar, BytesThatAreNoText) {
    const Told done = tell({.reports = {"METAR EGLL 151220Z \xFF\xFE \"\\\x01 Q1018"}, .json = true});
    EXPECT_EQ(done.exit_status, 0);
    EXPECT_EQ(Json::parse(done.out).at("qnh_hpa"), 1018);
}

}  // namespace
}  // namespace skyig::clients
