// Damaged reports: whatever comes, every value stays in its range and every group is accounted for.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <string>

#include "protocol/metar/decode.h"
#include "tests/protocol/metar/report_check.h"

namespace skyig::protocol::metar {
namespace {

constexpr std::string_view kReports[]{
    "METAR KJFK 041651Z 18009KT 1 1/2SM R04R/4500VP6000FT/D -RA BR BKN007 OVC015 12/11 A2984 RMK AO2 SLP105",
    "METAR RJTT 180500Z 20032G48KT 150V240 3000 1200SW TSRA FEW008 SCT015CB BKN025 26/24 Q0988 RETS NOSIG=",
    "SPECI COR ENZV 301333Z AUTO 09006MPS //// // VV/// //////CB M00/M01 Q//// W15/S2 WS R27L R27/450093 BLU "
    "TEMPO 1000",
};

TEST(MetarMutations, NothingLeavesItsRange) {
    constexpr unsigned kSeed = 21;
    std::mt19937 random(kSeed);
    std::size_t valid = 0;
    constexpr int kRounds = 60'000;
    for (int round = 0; round < kRounds; ++round) {
        std::string text(kReports[random() % std::size(kReports)]);
        if (random() % 4 == 0) text.resize(random() % text.size());
        for (auto changes = 1 + random() % 4; changes > 0 && !text.empty(); --changes) {
            const std::size_t at = random() % text.size();
            switch (random() % 4) {
                case 0:
                    text[at] = static_cast<char>(random());
                    break;
                case 1:
                    text.erase(at, 1 + random() % 3);
                    break;
                case 2:
                    text.insert(at, text.substr(random() % text.size(), random() % 8));
                    break;
                default:
                    text[at] = "0123456789/MPVRKT +-="[random() % 21];
            }
        }
        const Report report = decode(text);
        ASSERT_EQ(tests::broken_promise(report), "") << text << " seed " << kSeed;
        valid += report.valid() ? 1U : 0U;
    }
    std::printf("%zu of %d damaged reports had nothing wrong that shows\n", valid, kRounds);
    EXPECT_GT(valid, 1000U);
    EXPECT_LT(valid, kRounds / 2U);
}

TEST(MetarMutations, NoiseAndLongLines) {
    std::mt19937 random(3);
    for (int round = 0; round < 200; ++round) {
        std::string noise(10'000, ' ');
        for (char& c : noise)
            c = static_cast<char>(random());
        ASSERT_EQ(tests::broken_promise(decode(noise)), "");
    }
    std::string many = "METAR EGLL 151220Z";
    while (many.size() < 10'000)
        many += " FEW025 40012KT R27/0600";
    const Report report = decode(many);
    EXPECT_EQ(tests::broken_promise(report), "");
    EXPECT_EQ(report.clouds.size(), report.problems.size());
    EXPECT_EQ(report.clouds.size(), report.runway_ranges.size());
    EXPECT_EQ(tests::broken_promise(decode(std::string(10'000, '/'))), "");
}

}  // namespace
}  // namespace skyig::protocol::metar
