// Groups as stations of all regions send them. Expected values by hand from WMO No. 306 and FMH-1.
#include "protocol/metar/decode.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace skyig::protocol::metar {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A report of these groups, nothing of them left over.
Report read(const std::string& groups) {
    Report report = decode("METAR EGLL 151220Z " + groups);
    EXPECT_THAT(report.unparsed, IsEmpty()) << groups;
    EXPECT_TRUE(report.valid()) << groups << ": " << describe(report.problems.front());
    return report;
}

TEST(MetarHeader, TypesCorrectionsAndNil) {
    const Report bare = decode("KJFK 041651Z COR AUTO 18009KT");
    EXPECT_EQ(bare.type, ReportType::kNone);
    EXPECT_EQ(bare.station, "KJFK");
    EXPECT_TRUE(bare.corrected && bare.automatic && bare.valid());
    EXPECT_TRUE(decode("METAR CYVR 091700Z CCA 11008KT").corrected);
    EXPECT_TRUE(decode("SPECI COR OMDB 220900Z 33022KT").corrected);
    EXPECT_FALSE(decode("METAR CYVR 091700Z 11008KT").corrected);
    const Report nil = decode("METAR EHAM NIL=");
    EXPECT_TRUE(nil.nil && nil.valid());
    EXPECT_FALSE(nil.day);
    EXPECT_EQ(nil.raw, "METAR EHAM NIL=");
    const Report last = decode("METAR K1B9 312359Z NIL");
    EXPECT_TRUE(last.valid());
    EXPECT_EQ(last.day, 31);
    EXPECT_EQ(last.hour, 23);
    EXPECT_EQ(last.minute, 59);
}

TEST(MetarHeader, SmallLettersOddBlanksAndEnd) {
    const Report report =
        decode(" \tmetar  egll 151220z\r\n 24012kt   9999 nosig  rmk  ab  c = METAR LFPG\n");
    EXPECT_EQ(report.station, "EGLL");
    EXPECT_EQ(report.wind->speed, 12);
    EXPECT_EQ(report.trend, "NOSIG");
    EXPECT_EQ(report.remarks, "AB C");
    EXPECT_THAT(report.unparsed, IsEmpty());
    std::string_view text = "A=\n B = \n\nC D";
    EXPECT_EQ(next_report(text), "A=");
    EXPECT_EQ(next_report(text), "B =");
    EXPECT_EQ(next_report(text), "C D");
    EXPECT_FALSE(next_report(text));
}

TEST(MetarWind, EveryForm) {
    const Wind calm = *read("00000KT").wind;
    EXPECT_EQ(calm.direction_deg_true, 0);
    EXPECT_EQ(calm.speed, 0);
    const Wind storm = *read("240P99GP99KT 200V280").wind;
    EXPECT_EQ(storm.speed, 99);
    EXPECT_TRUE(storm.speed_above && storm.gust_above);
    EXPECT_EQ(storm.var_from_deg, 200);
    EXPECT_EQ(storm.var_to_deg, 280);
    const Wind kmh = *read("360100G130KMH").wind;
    EXPECT_EQ(kmh.speed, 100);
    EXPECT_EQ(kmh.gust, 130);
    EXPECT_NEAR(metres_per_second(*kmh.gust, kmh.unit), 36.111, 1e-3);
    EXPECT_TRUE(read("VRB02MPS").wind->variable);
    EXPECT_FALSE(read("VRB02MPS").wind->direction_deg_true);
    EXPECT_FALSE(read("/////KT").wind);
    EXPECT_FALSE(read("/////").wind);
    const Wind half = *read("///05MPS").wind;
    EXPECT_FALSE(half.direction_deg_true);
    EXPECT_EQ(half.speed, 5);
    EXPECT_FALSE(read("240//KT").wind->speed);
}

TEST(MetarVisibility, MetresWithDirections) {
    EXPECT_EQ(read("9999").visibility->comparison, Comparison::kAtLeast);
    EXPECT_EQ(read("9999NDV").visibility->prevailing_m, 10'000.0);
    EXPECT_TRUE(read("9999NDV").visibility->no_directions);
    EXPECT_EQ(read("0000").visibility->prevailing_m, 50.0);
    EXPECT_EQ(read("0000").visibility->comparison, Comparison::kBelow);
    const Visibility minimum = *read("4000 1500N 0900NW 3000E").visibility;
    EXPECT_EQ(minimum.prevailing_m, 4000.0);
    EXPECT_EQ(minimum.minimum_m, 900.0);
    EXPECT_EQ(minimum.minimum_direction_deg, 315);
    const Visibility turned = *read("0900SW 4000").visibility;
    EXPECT_EQ(turned.prevailing_m, 4000.0);
    EXPECT_EQ(turned.minimum_m, 900.0);
    EXPECT_FALSE(read("////").visibility);
    EXPECT_FALSE(read("////SM").visibility);
    EXPECT_EQ(read("40KM").visibility->prevailing_m, 40'000.0);
    const Report cavok = read("CAVOK");
    EXPECT_TRUE(cavok.cavok);
    EXPECT_EQ(cavok.visibility->prevailing_m, 10'000.0);
}

TEST(MetarVisibility, StatuteMiles) {
    const auto miles = [](const std::string& text) {
        const Visibility visibility = *read(text).visibility;
        EXPECT_TRUE(visibility.in_miles);
        return *visibility.prevailing_m / kMetresPerMile;
    };
    EXPECT_DOUBLE_EQ(miles("10SM"), 10.0);
    EXPECT_DOUBLE_EQ(miles("1/16SM"), 0.0625);
    EXPECT_DOUBLE_EQ(miles("1 1/2SM"), 1.5);
    EXPECT_DOUBLE_EQ(miles("2 3/4SM"), 2.75);
    EXPECT_DOUBLE_EQ(miles("0SM"), 0.0);
    EXPECT_EQ(read("M1/4SM").visibility->comparison, Comparison::kBelow);
    EXPECT_EQ(read("P6SM").visibility->comparison, Comparison::kAbove);
    EXPECT_DOUBLE_EQ(miles("P6SM"), 6.0);
}

TEST(MetarRunway, RangesAndStates) {
    const auto ranges =
        read("R09L/P2000U R04R/4500VP6000FT/D R27/M0050 R18C/0600V1000N R36LL/0800 R27/////").runway_ranges;
    ASSERT_EQ(ranges.size(), 6U);
    EXPECT_EQ(ranges[0].runway, "09L");
    EXPECT_EQ(ranges[0].range_m, 2000.0);
    EXPECT_EQ(ranges[0].comparison, Comparison::kAbove);
    EXPECT_EQ(ranges[0].trend, 'U');
    EXPECT_NEAR(*ranges[1].range_m, 1371.6, 1e-9);
    EXPECT_NEAR(*ranges[1].maximum_m, 1828.8, 1e-9);
    EXPECT_EQ(ranges[1].maximum_comparison, Comparison::kAbove);
    EXPECT_EQ(ranges[1].trend, 'D');
    EXPECT_EQ(ranges[2].comparison, Comparison::kBelow);
    EXPECT_EQ(ranges[2].trend, 0);
    EXPECT_EQ(ranges[3].maximum_m, 1000.0);
    EXPECT_EQ(ranges[4].runway, "36LL");
    EXPECT_FALSE(ranges[5].range_m);
    const Report states =
        read("R27/450093 R09L/CLRD70 R88/CLRD// R27/SNOCLO R/SNOCLO SNOCLO R24/4///93 8849//91");
    EXPECT_THAT(states.runway_ranges, IsEmpty());
    EXPECT_THAT(states.runway_states, ElementsAre("27/450093", "09L/CLRD70", "88/CLRD//", "27/SNOCLO",
                                                  "R/SNOCLO", "SNOCLO", "24/4///93", "8849//91"));
}

/// "+ SH RA SN", "VC TS", as read.
std::string written(const Weather& weather) {
    std::string text = weather.intensity == Intensity::kHeavy   ? "+"
                       : weather.intensity == Intensity::kLight ? "-"
                       : weather.vicinity                       ? "VC"
                                                                : "";
    if (weather.descriptor) text += name(*weather.descriptor);
    for (const Phenomenon phenomenon : weather.phenomena())
        text += name(phenomenon);
    return text;
}

TEST(MetarWeather, ReadsBackAsWritten) {
    for (const char* group :
         {"-SHSNRA", "+TSRAGR", "VCTS", "VCSH", "VCFG", "VCBLSN", "TS",      "TSRA",    "FZFG",
          "FZRASN",  "MIFG",    "BCFG", "PRFG", "DRSN", "BLDU",   "SQ",      "+FC",     "FC",
          "VCPO",    "UP",      "FZUP", "-DZ",  "PL",   "IC",     "SG",      "SHGS",    "VA",
          "FU",      "HZ",      "SA",   "PY",   "+SS",  "DS",     "-RADZBR", "SHRASNPL"}) {
        const Report report = read(group);
        ASSERT_EQ(report.weather.size(), 1U) << group;
        EXPECT_EQ(written(report.weather.front()), group);
    }
    EXPECT_THAT(read("// RE// NSW").weather, IsEmpty());
    const Report recent = read("BR RETS RESHRA REFZRA");
    EXPECT_EQ(recent.weather.size(), 1U);
    ASSERT_EQ(recent.recent.size(), 3U);
    EXPECT_EQ(written(recent.recent[1]), "SHRA");
}

TEST(MetarCloud, AmountsKindsAndWhatMachinesDoNotSee) {
    const auto clouds =
        read("FEW000 SCT025CB BKN030TCU OVC100/// FEW///CB ///015 //////CB ///TCU CB/// BKN///").clouds;
    ASSERT_EQ(clouds.size(), 10U);
    EXPECT_EQ(clouds[0].base_ft_agl, 0);
    EXPECT_EQ(clouds[1].convective, Convective::kCumulonimbus);
    EXPECT_EQ(clouds[2].convective, Convective::kToweringCumulus);
    EXPECT_EQ(clouds[3].base_ft_agl, 10'000);
    EXPECT_EQ(clouds[3].convective, Convective::kNone);
    EXPECT_FALSE(clouds[4].base_ft_agl);
    EXPECT_EQ(clouds[4].amount, CloudAmount::kFew);
    EXPECT_FALSE(clouds[5].amount);
    EXPECT_EQ(clouds[5].base_ft_agl, 1500);
    for (const std::size_t i : {6U, 7U, 8U}) {
        EXPECT_FALSE(clouds[i].amount || clouds[i].base_ft_agl) << i;
        EXPECT_NE(clouds[i].convective, Convective::kNone) << i;
    }
    EXPECT_EQ(clouds[9].amount, CloudAmount::kBroken);
    EXPECT_THAT(read("//////").clouds, IsEmpty());
    EXPECT_EQ(read("SKC").clear_code, ClearCode::kSkc);
    EXPECT_EQ(read("CLR").clear_code, ClearCode::kClr);
    EXPECT_EQ(read("NSC").clear_code, ClearCode::kNsc);
    EXPECT_EQ(read("NCD").clear_code, ClearCode::kNcd);
    EXPECT_EQ(read("VV003").vertical_visibility_ft, 300);
    const Report hidden = read("VV///");
    EXPECT_TRUE(hidden.obscured);
    EXPECT_FALSE(hidden.vertical_visibility_ft);
}

TEST(MetarAir, TemperaturesAndPressure) {
    const Report frost = read("M00/M01");
    EXPECT_EQ(frost.temperature_c, 0);
    EXPECT_EQ(frost.dewpoint_c, -1);
    const Report dry = read("15///");
    EXPECT_EQ(dry.temperature_c, 15);
    EXPECT_FALSE(dry.dewpoint_c);
    EXPECT_EQ(read("15/").temperature_c, 15);
    EXPECT_EQ(read("///M08").dewpoint_c, -8);
    EXPECT_FALSE(read("/////").temperature_c);
    EXPECT_EQ(read("Q0998").pressure->qnh_hpa, 998.0);
    EXPECT_EQ(read("QNH1013HPA").pressure->qnh_hpa, 1013.0);
    EXPECT_NEAR(read("A2992").pressure->qnh_hpa, 1013.2075888, 1e-6);
    EXPECT_TRUE(read("A2992").pressure->in_inches);
    EXPECT_NEAR(read("QNH2992INS").pressure->qnh_hpa, 1013.2075888, 1e-6);
    for (const char* both : {"Q1013/29.92", "Q1013/2992", "Q1013 A2992"}) {
        EXPECT_EQ(read(both).pressure->qnh_hpa, 1013.0);
        EXPECT_FALSE(read(both).pressure->in_inches);
    }
    EXPECT_FALSE(read("Q////").pressure);
    EXPECT_FALSE(read("A////").pressure);
}

TEST(MetarRest, SeaShearColoursTrendsAndRemarks) {
    const Report sea = read("WM01/S2");
    EXPECT_EQ(sea.sea->temperature_c, -1);
    EXPECT_EQ(sea.sea->state, 2);
    EXPECT_EQ(read("W15/H12").sea->wave_height_dm, 12);
    EXPECT_FALSE(read("W///H///").sea->wave_height_dm);
    EXPECT_EQ(read("W///S3").sea->state, 3);
    EXPECT_THAT(read("WS ALL RWY WS R27L WS TKOF RWY09 Q1018").wind_shear,
                ElementsAre("ALL RWY", "R27L", "TKOF RWY09"));
    EXPECT_THAT(read("GRN BLACKBLU YLO1 RED").colour_states, ElementsAre("GRN", "BLACKBLU", "YLO1", "RED"));
    const Report trends = read("9999 BECMG FM1230 TL1330 3000 BR TEMPO AT1300 0800 FG RMK TEMPO A3012 $");
    EXPECT_EQ(trends.trend, "BECMG FM1230 TL1330 3000 BR TEMPO AT1300 0800 FG");
    EXPECT_EQ(trends.remarks, "TEMPO A3012 $");
    EXPECT_EQ(trends.visibility->prevailing_m, 10'000.0);
    EXPECT_FALSE(trends.pressure);
    for (const char* word : {"INTER", "PROB30", "FM1300"}) {
        const Report other = read(std::string("9999 ") + word + " 3000 +TSRA");
        EXPECT_EQ(other.trend, std::string(word) + " 3000 +TSRA");
        EXPECT_THAT(other.weather, IsEmpty());
    }
}

TEST(MetarUnits, CoverageIsTheMiddleOfTheOktas) {
    EXPECT_EQ(coverage_percent(CloudAmount::kFew), 18.75);
    EXPECT_EQ(coverage_percent(CloudAmount::kScattered), 43.75);
    EXPECT_EQ(coverage_percent(CloudAmount::kBroken), 75.0);
    EXPECT_EQ(coverage_percent(CloudAmount::kOvercast), 100.0);
}

}  // namespace
}  // namespace skyig::protocol::metar
