// Candump logs: byte for byte there and back, and what is said of a bad line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

#include "protocol/recording/candump.h"

namespace skyig::protocol::recording {
namespace {

std::string written(const CandumpLine& line) {
    std::array<char, kCandumpLineChars> buffer{};
    return std::string(write_candump(line, buffer));
}

std::string there_and_back(const std::string& text) {
    const auto line = parse_candump(text);
    return line ? written(*line) : describe(line.error(), "-", 1);
}

TEST(Candump, GoldenLogByteForByte) {
    std::ifstream file(SKYIG_TEST_DATA "/canaerospace/canaerospace_golden.log");
    std::size_t lines = 0;
    for (std::string text; std::getline(file, text); ++lines)
        EXPECT_EQ(there_and_back(text), text);
    std::printf("%zu lines byte for byte\n", lines);
    EXPECT_EQ(lines, 34U);
}

TEST(Candump, WhateverCanUtilsWritesByteForByte) {
    const char* lines[]{
        "(0000000000.000000) vcan0 000#",
        "(1718994600.999999) can0 7FF#00",
        "(1718994600.000001) can0 00000000#1122334455667788",
        "(1718994600.000001) can0 1FFFFFFF#AABBCCDDEEFF0011",
        "(1718994600.000001) slcan0 123#R",
        "(1718994600.000001) can0 123#R8",
        "(1718994600.000001) can0 12345678#R4",
        "(1718994600.000001) can0 123#R8_E",
        "(1718994600.000001) can0 123#1122334455667788_9",
        "(1718994600.000001) can0 123##0",
        "(1718994600.000001) can0 123##5112233",
        "(1718994600.000001) can0 12345678##4112233445566778899AABBCC",
        "(1718994600.000001) can0 20000004#0001000000000000",
        "(1718994600.000001) can0 200001FF#0000000000000000",
        "(1718994600.000001)  can0 123#11",
        "(1718994600.123456789) can0 123#11",
        "(1718994600.000001) can0 123#11 R",
        "(1718994600.000001) can0 123##111 T",
    };
    for (const char* line : lines)
        EXPECT_EQ(there_and_back(line), line);
    std::string longest = "(9223372034.999999999) abcdefghijklmno 1FFFFFFF##F";
    for (int i = 0; i < 64; ++i)
        longest += "A5";
    EXPECT_EQ(there_and_back(longest), longest);
}

TEST(Candump, FieldsOfEachKind) {
    const auto error = parse_candump("(1.500000) can0 20000004#0001000000000000");
    ASSERT_TRUE(error);
    EXPECT_TRUE(error->frame.error && !error->frame.extended);
    EXPECT_EQ(error->frame.id, 4U);
    EXPECT_EQ(error->frame.received_ns, 1'500'000'000);
    const auto fd = parse_candump("(0.000000001) vcan1 123##3AABB\r");
    ASSERT_TRUE(fd);
    EXPECT_TRUE(fd->frame.fd);
    EXPECT_EQ(fd->frame.fd_flags, 3);
    EXPECT_EQ(fd->frame.length, 2);
    EXPECT_EQ(fd->frame.received_ns, 1);
    EXPECT_EQ(fd->interface, "vcan1");
    const auto remote = parse_candump("(0.0) c 00000123#R3");
    ASSERT_TRUE(remote);
    EXPECT_TRUE(remote->frame.remote && remote->frame.extended);
    EXPECT_EQ(remote->frame.length, 3);
    const auto lower = parse_candump("(0.0) c 7ab#deadBEEF   ");
    ASSERT_TRUE(lower);
    EXPECT_EQ(written(*lower), "(0000000000.0) c 7AB#DEADBEEF");
}

TEST(Candump, SaysWhereALineIsWrongAndWhatWouldBeRight) {
    struct Case {
        const char* line;
        std::uint32_t column;
        CandumpFault fault;
    };
    const Case cases[]{
        {"", 1, CandumpFault::kTime},
        {"can0 123#11", 1, CandumpFault::kTime},
        {"(123) can0 123#11", 5, CandumpFault::kTime},
        {"(.5) can0 123#11", 2, CandumpFault::kTime},
        {"(1.) can0 123#11", 4, CandumpFault::kTime},
        {"(1.1234567890) can0 123#11", 14, CandumpFault::kTime},
        {"(9223372036.0) can0 123#11", 2, CandumpFault::kTime},
        {"(99999999999999999999.0) can0 123#11", 2, CandumpFault::kTime},
        {"(-1.0) can0 123#11", 2, CandumpFault::kTime},
        {"(1.0)can0 123#11", 6, CandumpFault::kInterface},
        {"(1.0) ", 7, CandumpFault::kInterface},
        {"(1.0) can0", 11, CandumpFault::kInterface},
        {"(1.0) can0123456789abcd 123#11", 7, CandumpFault::kInterface},
        {"(1.0) can0  123#11", 12, CandumpFault::kIdentifier},
        {"(1.0) can0 12#11", 12, CandumpFault::kIdentifier},
        {"(1.0) can0 1234#11", 12, CandumpFault::kIdentifier},
        {"(1.0) can0 #11", 12, CandumpFault::kIdentifier},
        {"(1.0) can0 123456789#11", 12, CandumpFault::kIdentifier},
        {"(1.0) can0 800#11", 12, CandumpFault::kStandardRange},
        {"(1.0) can0 40000000#11", 12, CandumpFault::kExtendedRange},
        {"(1.0) can0 FFFFFFFF#11", 12, CandumpFault::kExtendedRange},
        {"(1.0) can0 123", 15, CandumpFault::kSeparator},
        {"(1.0) can0 123 11", 15, CandumpFault::kSeparator},
        {"(1.0) can0 123#1", 17, CandumpFault::kDigits},
        {"(1.0) can0 123#1G", 17, CandumpFault::kDigits},
        {"(1.0) can0 123#G", 16, CandumpFault::kDigits},
        {"(1.0) can0 123#11.22", 18, CandumpFault::kDigits},
        {"(1.0) can0 123#112233445566778899", 16, CandumpFault::kClassicLength},
        {"(1.0) can0 123##", 17, CandumpFault::kFlags},
        {"(1.0) can0 123##0112233445566778899", 18, CandumpFault::kFdLength},
        {"(1.0) can0 20000004##00", 21, CandumpFault::kDigits},
        {"(1.0) can0 123#R9", 17, CandumpFault::kRemoteLength},
        {"(1.0) can0 123#R44", 18, CandumpFault::kRemoteLength},
        {"(1.0) can0 123#11_9", 19, CandumpFault::kLengthCode},
        {"(1.0) can0 123#1122334455667788_8", 33, CandumpFault::kLengthCode},
        {"(1.0) can0 123#11 X", 19, CandumpFault::kTrailing},
        {"(1.0) can0 123#11 R R", 21, CandumpFault::kTrailing},
    };
    for (const Case& each : cases) {
        const auto line = parse_candump(each.line);
        ASSERT_FALSE(line) << each.line;
        EXPECT_EQ(line.error().column, each.column) << each.line;
        EXPECT_EQ(candump_fault_text(line.error().fault), candump_fault_text(each.fault)) << each.line;
    }
    EXPECT_EQ(describe(parse_candump("(1.0) can0 800#11").error(), "a.log", 7),
              "a.log:7:12: an identifier of three digits is at most 7FF");
}

TEST(Candump, BlankLinesAndComments) {
    EXPECT_TRUE(is_blank_or_comment(""));
    EXPECT_TRUE(is_blank_or_comment(" \t\r"));
    EXPECT_TRUE(is_blank_or_comment("  # device: none"));
    EXPECT_FALSE(is_blank_or_comment("(1.0) can0 123#11"));
}

TEST(Candump, RandomFramesReadBackAsWritten) {
    constexpr unsigned kSeed = 7;
    std::mt19937 random(kSeed);
    constexpr std::array<std::uint8_t, 16> kLengths{0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
    for (int round = 0; round < 100'000; ++round) {
        CandumpLine line;
        line.interface = "can1";
        line.fraction_digits = 9;
        CanFrame& frame = line.frame;
        frame.received_ns = static_cast<std::int64_t>(random()) * 1'000'003;
        const auto kind = random() % 4;
        frame.error = kind == 1;
        frame.remote = kind == 2;
        frame.fd = kind == 3;
        frame.extended = !frame.error && random() % 2 == 0;
        frame.id = static_cast<std::uint32_t>(random()) &
                   (frame.extended || frame.error ? kMaxExtendedId : kMaxStandardId);
        frame.length = kLengths[random() % (frame.fd ? 16 : 9)];
        if (frame.fd) frame.fd_flags = random() % 16;
        for (std::size_t i = 0; i < frame.length && !frame.remote; ++i)
            frame.data[i] = static_cast<std::uint8_t>(random());
        const std::string text = written(line);
        const auto again = parse_candump(text);
        ASSERT_TRUE(again) << text << " seed " << kSeed;
        ASSERT_EQ(again->frame, frame) << text;
    }
}

TEST(Candump, DamagedLinesAreReadOrRefused) {
    const std::string good = "(1718994600.065000) can0 00010130#01020012C0400000";
    std::mt19937 random(11);
    std::size_t read = 0;
    for (int round = 0; round < 300'000; ++round) {
        std::string text = good.substr(0, random() % 4 == 0 ? random() % good.size() : good.size());
        for (auto changes = 1 + random() % 3; changes > 0 && !text.empty(); --changes)
            text[random() % text.size()] =
                static_cast<char>(random() % 4 == 0 ? random() : 32 + random() % 95);
        const auto line = parse_candump(text);
        if (!line) {
            ASSERT_LE(line.error().column, text.size() + 1);
            continue;
        }
        ++read;
        ASSERT_TRUE(parse_candump(written(*line))) << text;
    }
    std::printf("%zu of 300000 damaged lines could still be read\n", read);
    EXPECT_GT(read, 1000U);
}

}  // namespace
}  // namespace skyig::protocol::recording
