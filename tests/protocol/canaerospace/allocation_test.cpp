// Receiving and logging allocate nothing; what a frame costs.
#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "protocol/canaerospace/receiver.h"
#include "protocol/recording/candump.h"
#include "tests/protocol/canaerospace/frames.h"
#include "tests/support/allocation_count.h"

namespace skyig::protocol::canaerospace {
namespace {

std::vector<std::string> golden_lines() {
    const std::string text = read_data("canaerospace_golden.log");
    std::vector<std::string> lines;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = text.find('\n', start);
        lines.push_back(text.substr(start, end - start));
        start = end + 1;
    }
    return lines;
}

TEST(Allocation, NoneInParsingReceivingAndWriting) {
    constexpr int kRounds = 5'000;
    const std::vector<std::string> lines = golden_lines();
    ASSERT_EQ(lines.size(), 34U);
    Receiver receiver;
    std::array<char, recording::kCandumpLineChars> buffer{};
    std::uint64_t characters = 0;
    const std::uint64_t before = skyig::tests::allocation_count();
    for (int round = 0; round < kRounds; ++round) {
        for (const std::string& text : lines) {
            auto line = recording::parse_candump(text);
            if (!line) continue;
            line->frame.received_ns += round * kSecond;
            static_cast<void>(receiver.receive(line->frame));
            characters += recording::write_candump(*line, buffer).size();
        }
    }
    const std::uint64_t counted = skyig::tests::allocation_count() - before;
    std::printf("%llu characters of log, %llu allocations\n", static_cast<unsigned long long>(characters),
                static_cast<unsigned long long>(counted));
    EXPECT_EQ(counted, 0U);
    EXPECT_GT(receiver.counters()[Event::kAccepted], 100'000U);
}

TEST(Cost, OfAFrame) {
    constexpr int kRounds = 20'000;
    std::vector<CanFrame> frames;
    for (const std::string& text : golden_lines())
        frames.push_back(recording::parse_candump(text)->frame);
    Receiver receiver;
    std::uint64_t published = 0;
    const auto begin = std::chrono::steady_clock::now();
    for (int round = 0; round < kRounds; ++round) {
        for (CanFrame& frame : frames) {
            frame.received_ns += 100 * kMs;
            frame.data[3] = static_cast<std::uint8_t>(frame.data[3] + 2);
            if (receiver.receive(frame).published) ++published;
        }
    }
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
    const double each_ns = time.count() / (kRounds * static_cast<double>(frames.size()));
    std::printf("%.1f ns a frame, %.1f million frames/s; a full bus brings 8000/s\n", each_ns, 1e3 / each_ns);
    EXPECT_GT(published, 100'000U);
    EXPECT_LT(each_ns, 20'000.0);  // far above any machine's figure, sanitizers included
}

}  // namespace
}  // namespace skyig::protocol::canaerospace
