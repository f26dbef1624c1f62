// The reports of the examples, and what each must make of the weather: written by hand from the rules.
#include "server/start_weather/metar_weather.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "protocol/metar/decode.h"
#include "render/precipitation/extinction.h"
#include "server/start_weather/start_weather.h"

namespace skyig::server {
namespace {

using config::LayerType;

struct Cloud {
    LayerType type;
    double base_ft, thickness_m, coverage_pct;
};
struct Falls {
    LayerType type;
    double rate_mm_h, top_ft;
};
struct Expected {
    const char* report;
    /// At the ground, of air and all that falls or blows; 0: as before.
    double visibility_m;
    std::vector<Cloud> clouds;
    std::vector<Falls> falls;
    double wind_m_s, wind_from_deg;
    /// 0: none.
    double fog_top_ft = 0.0, fog_extinction_per_m = 0.0;
    bool lightning = false;
};

const std::vector<Expected>& examples() {
    static const std::vector<Expected> all{
        {"METAR EGLL 151220Z 24012KT 9999 FEW025 SCT040 15/08 Q1018 NOSIG",
         0,
         {{LayerType::kCumulus, 2500, 800, 18.75}, {LayerType::kCumulus, 4000, 800, 43.75}},
         {},
         6.173,
         240},
        {"METAR LFPG 020600Z 00000KT 0350 R26R/0500N R09L/P2000U FG VV001 03/03 Q1029 BECMG 0800",
         350,
         {},
         {},
         0,
         0,
         100,
         3.0 / 30.48},
        {"METAR EDDF 101450Z 31015G27KT 280V350 CAVOK M02/M11 Q0998", 0, {}, {}, 7.717, 310},
        // Sums: 6 oktas up to the first, 8 with the second, which is (8 - 6) / (8 - 6) by itself.
        {"METAR KJFK 041651Z 18009KT 1 1/2SM R04R/4500VP6000FT/D -RA BR BKN007 OVC015 12/11 A2984 RMK AO2",
         2414.0,
         {{LayerType::kStratus, 700, 300, 75}, {LayerType::kStratus, 1500, 300, 100}},
         {{LayerType::kRain, 1, 700}},
         4.630,
         180},
        {"METAR KDEN 211253Z VRB03KT M1/4SM R35L/M0600FT FZFG SN VV002 M08/M09 A3012",
         402.3,
         {},
         {{LayerType::kSnow, 2, 1500 / 0.3048}},
         1.543,
         0,
         200,
         3.0 / 60.96},
        {"SPECI UUEE 301333Z 09006MPS 2100 +SHRA BKN012CB OVC020 18/16 Q1003 TEMPO 1000 +TSRA",
         2100,
         {{LayerType::kCumulonimbus, 1200, 8000, 75}, {LayerType::kStratocumulus, 2000, 500, 100}},
         {{LayerType::kRain, 15, 1200}},
         6.0,
         90},
        {"METAR ENGM 120720Z AUTO 35004KT 9999 NCD M15/M18 Q1041", 0, {}, {}, 2.058, 350},
        {"METAR COR OMDB 220900Z 33022KT 0800 BLDU NSC 38/09 Q1001",
         800,
         {},
         {{LayerType::kDust, 0, 1500 / 0.3048}},
         11.318,
         330},
        {"METAR RJTT 180500Z 20032G48KT 3000 1200SW TSRA FEW008 SCT015CB BKN025 26/24 Q0988",
         3000,
         {{LayerType::kCumulus, 800, 800, 18.75},
          {LayerType::kCumulonimbus, 1500, 8000, 43.75},
          {LayerType::kStratocumulus, 2500, 500, 75}},
         {{LayerType::kRain, 5, 1500}},
         16.462,
         200,
         0,
         0,
         true},
        {"METAR LOWI 270650Z 26003KT 9999 MIFG VCFG FEW060 SCT100 00/M00 Q1025",
         0,
         {{LayerType::kCumulus, 6000, 800, 18.75}, {LayerType::kAltocumulus, 10000, 400, 43.75}},
         {},
         1.543,
         260,
         2 / 0.3048,
         3.0 / 500.0},
        {"METAR CYVR 091700Z 11008KT 15SM FEW030 SCT120 BKN220 09/05 A2992 RMK SC1AC3CI3 SLP134",
         24140.2,
         {{LayerType::kCumulus, 3000, 800, 18.75},
          {LayerType::kAltocumulus, 12000, 400, 43.75},
          {LayerType::kCirrus, 22000, 1000, 75}},
         {},
         4.116,
         110},
        {"METAR ZSPD 050330Z 04007MPS 010V080 1500 R17L/1100V1700D BR SCT004 OVC010TCU 07/06 Q1022",
         1500,
         {{LayerType::kCumulus, 400, 800, 43.75}, {LayerType::kCumulus, 1000, 3000, 100}},
         {},
         7.0,
         40},
        {"METAR BIKF 141400Z 02045G62KT 0200 +BLSN VV/// M05/M07 Q0962 RESN", 200, {}, {}, 23.150, 20},
        {"METAR PANC 110553Z 36012KT 10SM CLR M21/M26 A3040 RMK AO2", 16093.4, {}, {}, 6.173, 360},
        {"METAR EHAM 250525Z NIL", 0, {}, {}, 0, 0},
    };
    return all;
}

double extinction(double visibility_m) {
    return -std::log(0.05) / visibility_m;
}

void check(const Expected& expected) {
    SCOPED_TRACE(expected.report);
    const config::Air before;
    const MetarWeather made = metar_weather(protocol::metar::decode(expected.report), before);
    EXPECT_NEAR(made.air.wind_m_s, expected.wind_m_s, 0.001);
    EXPECT_NEAR(made.air.wind_from_deg, expected.wind_from_deg, 1e-9);
    const double air = extinction(made.air.visibility_m);
    double ground = air;
    std::size_t clouds = 0, falls = 0;
    bool lightning = false, fog = false;
    for (const config::WeatherLayer& layer : made.layers) {
        const double top_m = layer.base_m + layer.thickness_m;
        if (config::is_cloud(layer.type)) {
            ASSERT_LT(clouds, expected.clouds.size());
            const Cloud& cloud = expected.clouds[clouds++];
            EXPECT_EQ(layer.type, cloud.type);
            EXPECT_NEAR(layer.base_m, cloud.base_ft * 0.3048, 1e-6);
            EXPECT_DOUBLE_EQ(layer.thickness_m, cloud.thickness_m);
            EXPECT_NEAR(100.0 * layer.coverage, cloud.coverage_pct, 1e-9);
            lightning = lightning || layer.lightning;
        } else if (layer.type == LayerType::kFog) {
            fog = true;
            EXPECT_NEAR(top_m, expected.fog_top_ft * 0.3048, 1e-6);
            EXPECT_NEAR(extinction(layer.visibility_m), expected.fog_extinction_per_m,
                        0.002 * expected.fog_extinction_per_m);
        } else {
            ASSERT_LT(falls, expected.falls.size());
            const Falls& fall = expected.falls[falls++];
            EXPECT_EQ(layer.type, fall.type);
            EXPECT_DOUBLE_EQ(layer.rate_mm_h, fall.rate_mm_h);
            EXPECT_NEAR(top_m, fall.top_ft * 0.3048, 1e-6);
            ground += extinction(layer.visibility_m) - air;
        }
    }
    EXPECT_EQ(clouds, expected.clouds.size());
    EXPECT_EQ(falls, expected.falls.size());
    EXPECT_EQ(lightning, expected.lightning);
    EXPECT_EQ(fog, expected.fog_top_ft > 0.0);
    const double visibility_m = expected.visibility_m > 0.0 ? expected.visibility_m : before.visibility_m;
    EXPECT_NEAR(ground, extinction(visibility_m), 0.0002 * extinction(visibility_m));
}

TEST(MetarWeather, TheExamplesMakeTheWeatherThatTheRulesSay) {
    ASSERT_EQ(examples().size(), 15U);
    for (const Expected& expected : examples())
        check(expected);
}

MetarWeather of(const char* report) {
    return metar_weather(protocol::metar::decode(report), {});
}

TEST(MetarWeather, LayersAreTheirOwnAmountOutsideOfTheStates) {
    const char* europe = "METAR EDDF 011200Z 9999 SCT020 BKN050 20/10 Q1013";
    const char* states = "METAR KORD 011200Z 9999 SCT020 BKN050 20/10 Q1013";
    EXPECT_DOUBLE_EQ(of(europe).layers[1].coverage, 6.0 / 8.0);
    EXPECT_DOUBLE_EQ(of(states).layers[1].coverage, (6.0 - 3.5) / (8.0 - 3.5));
    EXPECT_DOUBLE_EQ(of(states).layers[0].coverage, 3.5 / 8.0);
}

TEST(MetarWeather, RatesGoByIntensity) {
    struct Row {
        const char* report;
        LayerType type;
        double rate_mm_h;
    };
    for (const Row& row : {Row{"METAR EDDF 011200Z 5000 -DZ OVC005", LayerType::kDrizzle, 0.2},
                           Row{"METAR EDDF 011200Z 5000 DZ OVC005", LayerType::kDrizzle, 0.5},
                           Row{"METAR EDDF 011200Z 5000 +DZ OVC005", LayerType::kDrizzle, 1.0},
                           Row{"METAR EDDF 011200Z 5000 -SN OVC005", LayerType::kSnow, 0.5},
                           Row{"METAR EDDF 011200Z 5000 +SN OVC005", LayerType::kSnow, 4.0},
                           Row{"METAR EDDF 011200Z 5000 -FZRA OVC005", LayerType::kRain, 1.0},
                           Row{"METAR EDDF 011200Z 5000 +SHGR OVC005", LayerType::kHail, 15.0}}) {
        const MetarWeather made = of(row.report);
        ASSERT_EQ(made.layers.size(), 2U) << row.report;
        EXPECT_EQ(made.layers[1].type, row.type) << row.report;
        EXPECT_DOUBLE_EQ(made.layers[1].rate_mm_h, row.rate_mm_h) << row.report;
    }
}

TEST(MetarWeather, WhatFallsDimsWhereTheReportTellsNoVisibilityOrTenKilometresAndMore) {
    const config::Air before;
    const double haze = extinction(before.visibility_m);
    for (const char* wet : {"RA OVC010", "-RA OVC010", "+SN OVC010", "DZ OVC010"}) {
        const MetarWeather far = of((std::string{"METAR LSZH 221520Z 24010KT 9999 "} + wet).c_str());
        EXPECT_DOUBLE_EQ(far.air.visibility_m, before.visibility_m) << wet << ": not cleared";
        const config::WeatherLayer& falls = far.layers.back();
        const double own = extinction(falls.visibility_m) - haze;
        const auto kind = falls.type == LayerType::kRain   ? render::Precipitation::Kind::kRain
                          : falls.type == LayerType::kSnow ? render::Precipitation::Kind::kSnow
                                                           : render::Precipitation::Kind::kDrizzle;
        const double law = render::precipitation::extinction_per_m(kind, falls.rate_mm_h, 15.0);
        EXPECT_NEAR(own, std::min(law, extinction(10e3) - haze), 1e-9) << wet << ": 10 km are left";
        const MetarWeather untold = of((std::string{"METAR LSZH 221520Z 24010KT //// "} + wet).c_str());
        EXPECT_EQ(untold.layers.back().visibility_m, 0.0) << wet << ": left to the rate";
        EXPECT_DOUBLE_EQ(untold.air.visibility_m, before.visibility_m) << wet;
    }
    // A report of a number leaves the haze too; one that is clearer than the air before makes it clearer.
    const MetarWeather near = of("METAR LSZH 221520Z 24010KT 5000 RA OVC010");
    EXPECT_NEAR(extinction(near.layers.back().visibility_m), extinction(5000.0), 1e-9);
    EXPECT_LE(near.air.visibility_m, before.visibility_m * 1.000001);
    config::Air hazy;
    hazy.visibility_m = 5000.0;
    const MetarWeather clearer =
        metar_weather(protocol::metar::decode("METAR LSZH 221520Z 24010KT 9999 RA OVC010"), hazy);
    EXPECT_NEAR(extinction(clearer.layers.back().visibility_m), extinction(10e3), 1e-9);
    EXPECT_GT(clearer.layers.back().visibility_m, 0.0);
}

TEST(MetarWeather, AThunderstormWithoutCloudsGetsOne) {
    const MetarWeather made = of("METAR EDDF 011200Z 9999 TS NCD 25/15 Q1010");
    ASSERT_EQ(made.layers.size(), 1U);
    EXPECT_EQ(made.layers[0].type, LayerType::kCumulonimbus);
    EXPECT_TRUE(made.layers[0].lightning);
    EXPECT_TRUE(of("METAR EDDF 011200Z 9999 VCTS SCT030CB 25/15 Q1010").layers[0].lightning);
}

TEST(MetarWeather, HumidityAndPressureFollow) {
    const config::Air air = of("METAR EDDF 011200Z 9999 NSC 15/08 Q0998").air;
    // Magnus by hand: exp(17.625 * 8 / 251.04 - 17.625 * 15 / 258.04).
    EXPECT_NEAR(air.humidity_pct, 62.9, 0.1);
    EXPECT_DOUBLE_EQ(air.pressure_hpa, 998.0);
    EXPECT_DOUBLE_EQ(air.temperature_c, 15.0);
}

TEST(MetarWeather, WithoutABaseATowerStandsOnTheDewPointSpread) {
    const MetarWeather made = of("METAR EDDF 011200Z AUTO 9999 //////TCU 20/12 Q1013");
    ASSERT_EQ(made.layers.size(), 1U);
    EXPECT_DOUBLE_EQ(made.layers[0].base_m, 1000.0);
}

TEST(MetarWeather, GroupsOfNoKnownKindAreNamed) {
    config::Config config = config::default_config();
    config.weather.metar = "METAR LSZH 011250Z 24012KT XYZZY 9999 QQ FEW025 15/08 Q1018 NOSIG RMK WHAT";
    EXPECT_EQ(metar_fault(config, "a.toml"), "");
    EXPECT_EQ(metar_left_out(config, "a.toml"),
              "a.toml: weather.metar: 'XYZZY', 'QQ': of no known kind, left out");
    config.weather.metar = "METAR LSZH 011250Z 24012KT 9999 FEW025 15/08 Q1018 NOSIG RMK WHAT";
    EXPECT_EQ(metar_left_out(config, "a.toml"), "");
    config.weather.metar.clear();
    EXPECT_EQ(metar_left_out(config, "a.toml"), "");
}

}  // namespace
}  // namespace skyig::server
