// Random frames and damaged golden ones: what is accepted must keep its promises. The sanitizer build of this
// test watches the reads.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "protocol/canaerospace/receiver.h"
#include "protocol/recording/candump.h"
#include "tests/protocol/canaerospace/frames.h"

namespace skyig::protocol::canaerospace {
namespace {

std::vector<CanFrame> golden_frames() {
    const std::string text = read_data("canaerospace_golden.log");
    std::vector<CanFrame> frames;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = text.find('\n', start);
        const auto line = recording::parse_candump(std::string_view(text).substr(start, end - start));
        if (line) frames.push_back(line->frame);
        start = end + 1;
    }
    return frames;
}

void check_promises(const Reception& reception) {
    const Reading& reading = reception.reading;
    if (reading.reason != Reason::kNone) {
        ASSERT_FALSE(reception.published);
        ASSERT_EQ(reading.value.kind, Value::Kind::kNone);
        return;
    }
    ASSERT_TRUE(reading.message.has_header);
    ASSERT_TRUE(std::isfinite(reading.value.number));
    ASSERT_LE(reading.value.count, 4U);
    if (!reception.published) return;
    const MapEntry& entry = *reading.message.entry;
    ASSERT_EQ(entry.parameter, reception.update.parameter);
    ASSERT_LT(reception.update.layer, kCloudLayers);
    if (entry.meaning == Meaning::kNumber || entry.meaning == Meaning::kDegrees) {
        ASSERT_GE(reception.update.value, entry.low);
        ASSERT_LE(reception.update.value, entry.high);
    }
}

TEST(Damage, AMillionChangedFramesKeepThePromises) {
    const std::vector<CanFrame> golden = golden_frames();
    ASSERT_EQ(golden.size(), 34U);
    constexpr unsigned kSeed = 20240621;
    constexpr int kRounds = 1'000'000;
    std::mt19937 random(kSeed);
    Receiver receiver;
    std::int64_t now_ns = 0;
    for (int round = 0; round < kRounds; ++round) {
        CanFrame frame = golden[random() % golden.size()];
        now_ns += static_cast<std::int64_t>(random() % 2'000'000) - 100'000;
        frame.received_ns = now_ns;
        for (unsigned changes = random() % 4; changes > 0; --changes) {
            const auto dice = random();
            switch (dice % 8) {
                case 0:
                    frame.id ^= 1U << (dice >> 8) % 29;
                    break;
                case 1:
                    frame.length = static_cast<std::uint8_t>(dice >> 8);
                    break;
                case 2:
                    frame.extended = !frame.extended;
                    break;
                case 3:
                    frame.remote = (dice >> 8) % 8 == 0;
                    break;
                case 4:
                    frame.error = (dice >> 8) % 8 == 0;
                    break;
                case 5:
                    frame.fd = (dice >> 8) % 8 == 0;
                    break;
                case 6:
                    frame.data[(dice >> 8) % 8] = static_cast<std::uint8_t>(dice >> 16);
                    break;
                default:
                    frame.data[3] = static_cast<std::uint8_t>(round);
                    break;
            }
        }
        ASSERT_NO_FATAL_FAILURE(check_promises(receiver.receive(frame))) << "seed " << kSeed << " " << round;
        const std::optional<BusTime> time = receiver.clock().at(now_ns);
        ASSERT_TRUE(!time || (time->second_of_day >= 0.0 && time->second_of_day < 86'401.0));
    }
    const Counters& counters = receiver.counters();
    std::printf("seed %u: %d frames, %llu accepted, %llu published\n", kSeed, kRounds,
                static_cast<unsigned long long>(counters[Event::kAccepted]),
                static_cast<unsigned long long>(counters[Event::kPublished]));
    EXPECT_GT(counters[Event::kPublished], 10'000U);
    EXPECT_GT(counters[Outcome::kReject], 10'000U);
    std::uint64_t sum = 0;
    for (const std::uint64_t each : counters.reasons)
        sum += each;
    EXPECT_EQ(sum, counters[Event::kFrames]);
}

}  // namespace
}  // namespace skyig::protocol::canaerospace
