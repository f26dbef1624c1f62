// What one frame says without its neighbours, and every reason to refuse it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "protocol/canaerospace/reading.h"
#include "tests/protocol/canaerospace/frames.h"

namespace skyig::protocol::canaerospace {
namespace {

Reading read(std::string_view text, const IdentifierMap& map = default_identifier_map()) {
    static IdentifierIndex index;
    index = IdentifierIndex(map);
    return read_frame(frame(text), index);
}

std::string_view reason(std::string_view text, const IdentifierMap& map = default_identifier_map()) {
    return reason_name(read(text, map).reason);
}

TEST(Reading, RefusesWhatIsNoCanAerospace) {
    struct Case {
        const char* frame;
        const char* reason;
    };
    const Case cases[]{
        {"137#R8", "remote"},
        {"137#R", "remote"},
        {"137#010200", "short"},
        {"137#", "short"},
        {"137#01020010", "length"},        // FLOAT without data
        {"137#01020010402000", "length"},  // FLOAT of three bytes
        {"4B0#090F0001121E00", "length"},  // CHAR4 of three bytes
        {"73C#140A01020500", "length"},    // UCHAR of two bytes
        {"080#0500000000", "length"},      // NODATA with data
        {"137#0120001040200000", "reserved_type"},
        {"137#0163001040200000", "reserved_type"},
        {"137#0164001040200000", "user_type"},
        {"137#01FF001040200000", "user_type"},
        {"000107F0#0102001040200000", "identifier"},  // 2032 on channel 1
        {"0000FFFF#0102001040200000", "identifier"},
        {"1FFF0800#0102001040200000", "identifier"},
        {"000007F0#R8", "identifier"},
        {"005#0202000040200000", "type"},  // EED is ERROR
        {"137#010F001001020304", "type"},  // pitch as CHAR4
        {"137#0103001000000001", "type"},  // pitch as LONG: no scale is agreed
        {"4B0#0902000140200000", "type"},
        {"40E#0903004000000001", "type"},  // heights have no 1e-7
        {"750#1404000000000000", "type"},  // Julian date as ULONG
        {"137#010200107FC00000", "nonfinite"},
        {"137#010200107F800000", "nonfinite"},
        {"137#01020010FF800000", "nonfinite"},
        {"080#050200007FC00000", "nonfinite"},
        {"42D#010C0011C71D0000", "scale"},
        {"42D#010C0011C71DFF4C", "scale"},
        {"73A#140208014464999A", "layer"},
        {"758#140A000108", "layer"},
        {"40C#0902004042B40001", "range"},  // latitude just above 90
        {"40C#0903004035A4E901", "range"},  // 90.0000001 deg
        {"40D#0902004043B40001", "range"},  // longitude just above 360
        {"137#0102001042B40001", "range"},
        {"730#14020001BF800000", "range"},  // visibility -1 m
        {"732#140A000165", "range"},        // humidity 101 %
        {"740#140A000102", "range"},        // enable 2
        {"74E#1404000105265FE8", "range"},  // a millisecond too many
        {"4B0#090F0001180000", "length"},
        {"4B0#090F000118000000", "calendar"},  // 24:00:00
        {"4B0#090F0001123C0000", "calendar"},  // 18:60
        {"4B0#090F0001121E3C00", "calendar"},  // 18:30:60
        {"4B0#090F0001173B3D00", "calendar"},  // 23:59:61
        {"4B0#090F0001FF000000", "calendar"},  // -1 h
        {"4B6#090F000115001418", "calendar"},  // month 0
        {"4B6#090F0001150D1418", "calendar"},
        {"4B6#090F000100061418", "calendar"},
        {"4B6#090F00011F061418", "calendar"},  // 31 June
        {"4B6#090F00011D021417", "calendar"},  // 29 February 2023
        {"4B6#090F00011D021300", "calendar"},  // 29 February 1900
        {"4B6#090F000112061987", "calendar"},  // BCD where binary is agreed
        {"080#0517000080", "ascii"},
    };
    std::size_t count = 0;
    for (const Case& each : cases) {
        const Reading reading = read(each.frame);
        EXPECT_EQ(reason_name(reading.reason), each.reason) << each.frame;
        EXPECT_EQ(outcome_of(reading.reason), Outcome::kReject) << each.frame;
        EXPECT_EQ(reading.value.kind, Value::Kind::kNone);
        ++count;
    }
    std::printf("%zu frames refused, each for its reason\n", count);
    CanFrame nine = frame("137#0102001040200000");
    nine.length = 9;
    EXPECT_EQ(read_frame(nine, IdentifierIndex()).reason, Reason::kLength);
}

TEST(Reading, IgnoresWhatIsNotForIt) {
    EXPECT_EQ(reason("7F0#0102001040200000"), "unassigned");
    EXPECT_EQ(reason("7FF#"), "unassigned");
    EXPECT_EQ(reason("7F0#R8"), "unassigned");
    EXPECT_EQ(reason("0C8#01"), "user_range");
    EXPECT_EQ(reason("12B#0102001040200000"), "user_range");
    EXPECT_EQ(reason("708#"), "user_range");
    EXPECT_EQ(reason("7CF#FFFFFFFFFFFFFFFF"), "user_range");
    EXPECT_EQ(reason("5DC#0102001040200000"), "unknown");  // 1500, free for the user
    EXPECT_EQ(reason("132#0102001040200000"), "unknown");
    EXPECT_EQ(reason("080#05001000"), "service");
    EXPECT_EQ(reason("137##50102001040200000"), "fd");
    // What is no sound CANaerospace is told even where nobody listens: the header is due in these ranges.
    EXPECT_EQ(reason("5DC#01020010"), "length");
    EXPECT_EQ(reason("080#0500"), "short");
}

TEST(Reading, TellsErrorFramesByTheirClass) {
    EXPECT_EQ(reason("20000004#0001000000000000"), "controller");
    EXPECT_EQ(reason("20000040#0000000000000000"), "bus_off");
    EXPECT_EQ(reason("20000088#0000000000000000"), "protocol");
    EXPECT_EQ(reason("20000020#0000000000000000"), "no_acknowledge");
    EXPECT_EQ(reason("20000100#0000000000000000"), "restarted");
    EXPECT_EQ(reason("20000200#0000000000000000"), "bus_error");
    EXPECT_EQ(reason("20000000#0000000000000000"), "bus_error");
    EXPECT_EQ(outcome_of(read("20000002#").reason), Outcome::kBusError);
}

TEST(Reading, RangesHaveTheirBounds) {
    for (const auto& [id, range] : {std::pair(0U, Range::kEmergency),
                                    {127U, Range::kEmergency},
                                    {128U, Range::kServiceHigh},
                                    {199U, Range::kServiceHigh},
                                    {200U, Range::kUserHigh},
                                    {299U, Range::kUserHigh},
                                    {300U, Range::kNormal},
                                    {1799U, Range::kNormal},
                                    {1800U, Range::kUserLow},
                                    {1899U, Range::kUserLow},
                                    {1900U, Range::kDebug},
                                    {1999U, Range::kDebug},
                                    {2000U, Range::kServiceLow},
                                    {2031U, Range::kServiceLow},
                                    {2032U, Range::kUnassigned},
                                    {2047U, Range::kUnassigned}})
        EXPECT_EQ(range_of(id), range) << id;
}

TEST(Reading, BothIdentifierFormsMeanOneParameter) {
    const Reading normal = read("137#0102001040200000");
    const Reading extended = read("00000137#0102001040200000");
    const Reading last = read("1FFF0137#0102001040200000");
    EXPECT_EQ(normal.message.entry->parameter, Parameter::kBodyPitchAngle);
    EXPECT_EQ(extended.value.number, 2.5);
    EXPECT_TRUE(extended.message.extended);
    EXPECT_EQ(extended.message.channel, 0);
    EXPECT_EQ(last.reason, Reason::kNone);
    EXPECT_EQ(last.message.channel, 8191);
    EXPECT_EQ(last.message.id, 311);
}

TEST(Reading, TakesWhatIsJustInside) {
    EXPECT_EQ(read("40C#0902004042B40000").value.number, 90.0);
    EXPECT_EQ(read("40C#09030040CA5B1700").value.number, -90.0);
    EXPECT_DOUBLE_EQ(read("40D#090300406B49D200").value.number, 180.0);
    EXPECT_EQ(read("4B0#090F0001173B3C00").value.number, 86'400.0);  // 23:59:60
    EXPECT_EQ(read("4B6#090F00011D021418").value.items[1], 2);       // 29 February 2024
    EXPECT_EQ(reason("4B6#090F00011D021400"), "none");               // 29 February 2000
    EXPECT_EQ(read("74E#1404000105265FE7").reason, Reason::kNone);
    EXPECT_EQ(read("73C#140A010209").value.number, 9.0);  // told at the commit
    EXPECT_EQ(read("758#14000001").value.kind, Value::Kind::kNone);
    EXPECT_EQ(read("758#140A000107").value.number, 7.0);
    EXPECT_EQ(read("137#0102001080000000").value.number, 0.0);  // -0
    EXPECT_GT(read("137#0102001000000001").value.number, 0.0);  // the least denormal
}

TEST(Reading, AllDataTypes) {
    struct Case {
        unsigned type;
        const char* data;
        std::vector<std::int64_t> items;
    };
    const Case cases[]{{3, "80000000", {-2147483648LL}},
                       {4, "FFFFFFFF", {4294967295LL}},
                       {5, "80000001", {2147483649LL}},
                       {6, "8000", {-32768}},
                       {7, "FFFE", {65534}},
                       {8, "8001", {32769}},
                       {9, "80", {-128}},
                       {10, "FF", {255}},
                       {11, "81", {129}},
                       {12, "FFFF7FFF", {-1, 32767}},
                       {13, "FFFF7FFF", {65535, 32767}},
                       {14, "80000001", {32768, 1}},
                       {15, "FF01807F", {-1, 1, -128, 127}},
                       {16, "FF01807F", {255, 1, 128, 127}},
                       {17, "FF01807F", {255, 1, 128, 127}},
                       {18, "FF01", {-1, 1}},
                       {19, "FF01", {255, 1}},
                       {20, "FF01", {255, 1}},
                       {21, "DEADBEEF", {3735928559LL}},
                       {22, "DEADBEEF", {3735928559LL}},
                       {23, "41", {'A'}},
                       {24, "4142", {'A', 'B'}},
                       {25, "41424344", {'A', 'B', 'C', 'D'}},
                       {26, "FF0180", {-1, 1, -128}},
                       {27, "FF0180", {255, 1, 128}},
                       {28, "FF0180", {255, 1, 128}},
                       {29, "414243", {'A', 'B', 'C'}},
                       {1, "FF80FED4", {-1, -128, -300}}};
    for (const Case& each : cases) {
        char text[32];
        std::snprintf(text, sizeof text, "080#05%02X0000%s", each.type, each.data);
        const Reading reading = read(text);
        ASSERT_EQ(reading.reason, Reason::kNone) << text;
        ASSERT_EQ(reading.value.count, each.items.size()) << text;
        for (std::size_t i = 0; i < each.items.size(); ++i)
            EXPECT_EQ(reading.value.items[i], each.items[i]) << text;
    }
    EXPECT_EQ(read("080#05000000").value.kind, Value::Kind::kNone);
    EXPECT_EQ(read("080#05020000C2DC0000").value.number, -110.0);
    EXPECT_EQ(read("080#051E00004047CEA7").word, 0x4047CEA7U);
    EXPECT_EQ(read("080#051F0000381A2CED").word, 0x381A2CEDU);
}

TEST(Reading, ConventionsOfTimeAndDate) {
    IdentifierMap map = default_identifier_map();
    map.conventions.bcd = true;
    EXPECT_EQ(read("4B6#090F000112061987", map).value.items, (std::array<std::int64_t, 4>{12, 6, 1987, 0}));
    EXPECT_EQ(read("4B0#090F000113432200", map).value.number, 13 * 3600 + 43 * 60 + 22);
    EXPECT_EQ(reason("4B0#090F0001131A2200", map), "calendar");
    map.conventions = {.bcd = false, .hundredths = false, .month_base = 0};
    EXPECT_EQ(read("4B6#090F00011F001418", map).value.items, (std::array<std::int64_t, 4>{31, 1, 2024, 0}));
    EXPECT_EQ(reason("4B6#090F0001010C1418", map), "calendar");
    map.conventions = {.bcd = false, .hundredths = true, .month_base = 1};
    EXPECT_DOUBLE_EQ(read("4B0#090F0001121E0063", map).value.number, 66'600.99);
    EXPECT_EQ(reason("4B0#090F0001121E0064", map), "calendar");
    EXPECT_EQ(reason("4B0#090F0001121E0064"), "none");  // without the option the byte does not count
}

TEST(Reading, UserTypesOnceConfigured) {
    IdentifierMap map = default_identifier_map();
    map.user_type_bytes[0] = 2;
    const Reading reading = read("080#056400000102", map);
    EXPECT_EQ(reading.reason, Reason::kNone);
    EXPECT_EQ(reading.value.items[1], 2);
    EXPECT_EQ(reason("080#05640000010203", map), "length");
    EXPECT_EQ(reason("080#056500000102", map), "user_type");
    EXPECT_EQ(reason("137#016400000102", map), "type");
}

TEST(Map, MovesParameters) {
    IdentifierMap map = default_identifier_map();
    map[Parameter::kVisibility].id = 1750;
    map[Parameter::kUtc].id = kNoIdentifier;
    EXPECT_EQ(check(map), "");
    EXPECT_EQ(read("6D6#1402000145FA0000", map).value.number, 8000.0);
    EXPECT_EQ(reason("730#1402000145FA0000", map), "user_range");
    EXPECT_EQ(reason("4B0#090F0001121E0000", map), "unknown");
}

TEST(Map, FaultsAreTold) {
    EXPECT_EQ(check(default_identifier_map()), "");
    const auto fault = [](auto&& change) {
        IdentifierMap map = default_identifier_map();
        change(map);
        const std::string text = check(map);
        std::printf("%s\n", text.c_str());
        return text;
    };
    using P = Parameter;
    using testing::HasSubstr;
    EXPECT_THAT(fault([](auto& map) { map[P::kUtc].id = 1036; }), HasSubstr("'GPS latitude' and 'UTC'"));
    EXPECT_THAT(fault([](auto& map) { map[P::kUtc].id = 128; }), HasSubstr("200 to 1999"));
    EXPECT_THAT(fault([](auto& map) { map[P::kUtc].id = 2000; }), HasSubstr("200 to 1999"));
    EXPECT_THAT(fault([](auto& map) { map[P::kUtc].types = 0; }), HasSubstr("no data type"));
    EXPECT_THAT(fault([](auto& map) { map[P::kUtc].types = type_set(DataType::kFloat); }),
                HasSubstr("cannot carry"));
    EXPECT_THAT(fault([](auto& map) { map[P::kGpsHeight].types = type_set(DataType::kDoubleH); }),
                HasSubstr("go together"));
    EXPECT_THAT(fault([](auto& map) { map[P::kGpsHeight].low = std::nan(""); }), HasSubstr("lower bound"));
    EXPECT_THAT(fault([](auto& map) { map.conventions.month_base = 2; }), HasSubstr("January"));
    EXPECT_THAT(fault([](auto& map) { map.user_type_bytes[3] = 5; }), HasSubstr("type 103"));
    EXPECT_THAT(fault([](auto& map) { std::swap(map.entries[0], map.entries[1]); }), HasSubstr("elsewhere"));
}

TEST(Map, ReasonsHaveOneWordEach) {
    for (std::size_t i = 0; i < kReasons; ++i) {
        const auto name = std::string(reason_name(static_cast<Reason>(i)));
        EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos) << name;
        EXPECT_FALSE(reason_text(static_cast<Reason>(i)).empty());
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_NE(name, reason_name(static_cast<Reason>(j)));
    }
}

}  // namespace
}  // namespace skyig::protocol::canaerospace
