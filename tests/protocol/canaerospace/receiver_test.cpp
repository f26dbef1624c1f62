// What only the frames before can tell: message codes, halves of doubles, redundancy channels, staged
// weather.
#include <gtest/gtest.h>

#include "protocol/canaerospace/receiver.h"
#include "tests/protocol/canaerospace/frames.h"

namespace skyig::protocol::canaerospace {
namespace {

constexpr std::uint32_t kPitch = 311;

class Bus : public testing::Test {
  protected:
    /// Pitch with this message code; "accept" or the reason.
    std::string_view pitch(int code, std::int64_t after_ns, std::uint16_t channel = 0, float value = 1.0F) {
        return told(float_frame(kPitch, static_cast<std::uint8_t>(code), value, after_ns, channel));
    }
    std::string_view told(const CanFrame& frame) {
        last_ = receiver_.receive(frame);
        return reason_name(last_.reading.reason);
    }
    std::string_view told(std::string_view text, std::int64_t after_ns) {
        return told(frame(text, after_ns));
    }
    std::uint64_t count(Event event) const { return receiver_.counters()[event]; }

    Receiver receiver_;
    Reception last_;
};

using MessageCodes = Bus;
using Doubles = Bus;
using Channels = Bus;
using Weather = Bus;

TEST_F(MessageCodes, CountLossOverTheWrap) {
    EXPECT_EQ(pitch(253, 0), "none");
    EXPECT_EQ(pitch(254, 10 * kMs), "none");
    EXPECT_EQ(pitch(255, 20 * kMs), "none");
    EXPECT_EQ(pitch(0, 30 * kMs), "none");
    EXPECT_EQ(count(Event::kLost), 0U);
    EXPECT_EQ(pitch(3, 40 * kMs), "none");
    EXPECT_EQ(count(Event::kLost), 2U);
    EXPECT_EQ(pitch(130, 50 * kMs), "none");  // a step of 127
    EXPECT_EQ(count(Event::kLost), 2U + 126U);
}

TEST_F(MessageCodes, DropTheSameAndTheOlder) {
    EXPECT_EQ(pitch(10, 0), "none");
    EXPECT_EQ(pitch(10, 1 * kMs), "duplicate");
    EXPECT_FALSE(last_.published);
    EXPECT_EQ(last_.outcome(), Outcome::kDuplicate);
    EXPECT_EQ(pitch(9, 2 * kMs), "older");
    EXPECT_EQ(last_.outcome(), Outcome::kStale);
    EXPECT_EQ(pitch(138, 3 * kMs), "older");  // a step of 128
    EXPECT_EQ(pitch(11, 4 * kMs), "none");
    EXPECT_EQ(count(Event::kLost), 0U);
}

TEST_F(MessageCodes, AreCountedForEachIdentifierChannelAndNode) {
    EXPECT_EQ(pitch(10, 0), "none");
    EXPECT_EQ(pitch(10, 1 * kMs, 1), "none");
    EXPECT_EQ(told(float_frame(312, 10, 0.0F, 2 * kMs)), "none");
    CanFrame other_node = float_frame(kPitch, 9, 0.0F, 3 * kMs);
    other_node.data[0] = 2;
    EXPECT_EQ(told(other_node), "none");
    EXPECT_EQ(pitch(10, 4 * kMs), "duplicate");
}

TEST_F(MessageCodes, BeginAnewAfterASilence) {
    EXPECT_EQ(pitch(10, 0), "none");
    EXPECT_EQ(pitch(10, 1000 * kMs), "duplicate");
    EXPECT_EQ(pitch(3, 1001 * kMs), "none");
    EXPECT_EQ(count(Event::kRestarted), 1U);
    EXPECT_EQ(count(Event::kLost), 0U);
    // Time comes each second: ten of them.
    EXPECT_EQ(told("4B0#090F0005121E0000", 0), "none");
    EXPECT_EQ(told("4B0#090F0005121E0000", 10 * kSecond), "duplicate");
    EXPECT_EQ(told("4B0#090F0005121E0000", 10 * kSecond + 1), "none");
}

TEST_F(MessageCodes, OfRefusedFramesAreNotCounted) {
    EXPECT_EQ(pitch(10, 0), "none");
    EXPECT_EQ(told("137#0102000B7FC00000", 1 * kMs), "nonfinite");
    EXPECT_EQ(pitch(11, 2 * kMs), "none");
    EXPECT_EQ(count(Event::kLost), 0U);
}

TEST_F(MessageCodes, OfASenderThatDoesNotCountAreNotChecked) {
    EXPECT_EQ(pitch(0, 0), "none");
    for (int i = 1; i < 7; ++i)
        EXPECT_EQ(pitch(0, i * 20 * kMs), "duplicate") << i;
    EXPECT_EQ(pitch(0, 140 * kMs), "none");  // the eighth
    EXPECT_EQ(count(Event::kUnchecked), 1U);
    EXPECT_EQ(pitch(0, 160 * kMs), "none");
    EXPECT_EQ(pitch(0, 3000 * kMs), "none");
    EXPECT_EQ(count(Event::kRestarted), 0U);
    // It counts after all.
    EXPECT_EQ(pitch(200, 3010 * kMs), "none");
    EXPECT_EQ(pitch(200, 3020 * kMs), "duplicate");
}

TEST_F(MessageCodes, RepeatedAtOneTimeAreNoConstantSender) {
    EXPECT_EQ(pitch(0, 0), "none");
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(pitch(0, 0), "duplicate");
    EXPECT_EQ(count(Event::kUnchecked), 0U);
}

TEST_F(MessageCodes, RepeatedLaterThanTheStartAreDuplicates) {
    EXPECT_EQ(pitch(0, 0), "none");
    EXPECT_EQ(pitch(1, 1 * kMs), "none");
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(pitch(1, (2 + i) * kMs), "duplicate");
}

TEST_F(MessageCodes, OfServicesAndEmergenciesDoNotCount) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(told("080#05000000", i * kMs), "none");
        EXPECT_EQ(told("005#020100000311FED4", i * kMs), "none");
    }
}

TEST_F(MessageCodes, SurviveATimeThatRunsBackwards) {
    EXPECT_EQ(pitch(10, 100 * kMs), "none");
    EXPECT_EQ(pitch(11, 50 * kMs), "none");
    EXPECT_EQ(pitch(11, -kStart), "duplicate");
    EXPECT_EQ(pitch(11, INT64_MAX - kStart), "none");  // a very long silence
}

constexpr const char* kHigh = "419#011E00424047CEA7";
constexpr const char* kLow = "419#011F0043381A2CED";
constexpr const char* kLowSameCode = "419#011F0042381A2CED";

TEST_F(Doubles, ArePublishedOnTheLowHalf) {
    EXPECT_EQ(told(kHigh, 0), "none");
    EXPECT_FALSE(last_.published);
    EXPECT_EQ(last_.reading.value.kind, Value::Kind::kNone);
    EXPECT_EQ(told(kLow, 50 * kMs), "none");
    ASSERT_TRUE(last_.published);
    EXPECT_EQ(last_.update.value, 47.614478123456);
    EXPECT_EQ(last_.update.parameter, Parameter::kInsLatitude);
    EXPECT_EQ(told(kLow, 51 * kMs), "duplicate");
}

TEST_F(Doubles, MayCarryOneCode) {
    EXPECT_EQ(told(kHigh, 0), "none");
    EXPECT_EQ(told(kLowSameCode, 1 * kMs), "none");
    EXPECT_EQ(last_.update.value, 47.614478123456);
    EXPECT_EQ(told(kLowSameCode, 2 * kMs), "duplicate");
    EXPECT_EQ(told("419#011E00434047CEA7", 3 * kMs), "none");
    EXPECT_EQ(count(Event::kLost), 0U);
}

TEST_F(Doubles, PairOverTheWrap) {
    EXPECT_EQ(told("419#011E00FF4047CEA7", 0), "none");
    EXPECT_EQ(told("419#011F0000381A2CED", 1 * kMs), "none");
    EXPECT_TRUE(last_.published);
}

TEST_F(Doubles, LoneLowIsMalformed) {
    EXPECT_EQ(told(kLow, 0), "lone_low");
    EXPECT_EQ(last_.outcome(), Outcome::kReject);
    EXPECT_EQ(told(kHigh, 1 * kMs), "none");
    EXPECT_EQ(told(kLow, 2 * kMs), "none");
}

TEST_F(Doubles, LateLowIsRefusedAndTheHighForgotten) {
    EXPECT_EQ(told(kHigh, 0), "none");
    EXPECT_EQ(told(kLow, 50 * kMs + 1), "late_low");
    EXPECT_EQ(told(kLow, 51 * kMs), "lone_low");
    EXPECT_EQ(count(Event::kUnfinished), 1U);
}

TEST_F(Doubles, NewHighReplacesTheUnfinishedOne) {
    EXPECT_EQ(told("419#011E004140480000", 0), "none");
    EXPECT_EQ(told(kHigh, 1 * kMs), "none");
    EXPECT_EQ(told(kLow, 2 * kMs), "none");
    EXPECT_EQ(last_.update.value, 47.614478123456);
    EXPECT_EQ(count(Event::kUnfinished), 1U);
    EXPECT_EQ(count(Event::kLost), 0U);
}

TEST_F(Doubles, HalvesMustBelongTogether) {
    EXPECT_EQ(told(kHigh, 0), "none");
    EXPECT_EQ(told("419#011F0044381A2CED", 1 * kMs), "pair");      // code H + 2
    EXPECT_EQ(told("419#021F0043381A2CED", 2 * kMs), "lone_low");  // another node
    EXPECT_EQ(told("41A#011F0043381A2CED", 3 * kMs), "lone_low");  // another identifier
    EXPECT_EQ(told("419#011E004540000000", 4 * kMs), "none");
    EXPECT_EQ(told("00010419#011F004600000000", 5 * kMs), "lone_low");  // another channel
    EXPECT_EQ(told("419#011F014600000000", 6 * kMs), "pair");           // another service code
    EXPECT_EQ(told("419#011E004540000000", 7 * kMs), "duplicate");
    EXPECT_EQ(told(kLow, 8 * kMs), "older");
}

TEST_F(Doubles, AreCheckedAsAWhole) {
    EXPECT_EQ(told("419#011E000140568000", 0), "none");
    EXPECT_EQ(told("419#011F000200000001", 1 * kMs), "range");  // the least above 90
    EXPECT_EQ(told("419#011E00037FF00000", 2 * kMs), "none");
    EXPECT_EQ(told("419#011F000400000000", 3 * kMs), "nonfinite");
    EXPECT_EQ(told("419#011E000540568000", 4 * kMs), "none");
    EXPECT_EQ(told("419#011F000600000000", 5 * kMs), "none");
    EXPECT_EQ(last_.update.value, 90.0);
}

TEST_F(Channels, OneIsUsedWhileItIsHeard) {
    int code = 0;
    for (int i = 0; i < 100; ++i, ++code) {
        EXPECT_EQ(pitch(code, i * 20 * kMs, 0), "none");
        EXPECT_TRUE(last_.published);
        EXPECT_EQ(pitch(code, i * 20 * kMs + kMs, 1), "none");
        EXPECT_FALSE(last_.published);
    }
    EXPECT_EQ(count(Event::kOtherChannel), 100U);
    EXPECT_EQ(receiver_.channel_of(Parameter::kBodyPitchAngle), 0);
    EXPECT_EQ(receiver_.channel_of(Parameter::kBodyRollAngle), std::nullopt);
}

TEST_F(Channels, FallOverWhenSilentAndReturnAfterAWhile) {
    const auto run = [this](int from_ms, int to_ms, bool zero, bool one) {
        for (int t = from_ms; t < to_ms; t += 20) {
            const int code = t / 20;
            if (zero) {
                EXPECT_EQ(pitch(code, t * kMs, 0), "none") << t;
            }
            if (one) {
                EXPECT_EQ(pitch(code, t * kMs + kMs, 1), "none") << t;
            }
        }
        return receiver_.channel_of(Parameter::kBodyPitchAngle).value_or(99);
    };
    EXPECT_EQ(run(0, 1000, true, true), 0);
    EXPECT_EQ(run(1000, 1480, false, true), 0);  // 500 ms are not over
    EXPECT_EQ(run(1480, 1500, false, true), 1);
    EXPECT_EQ(count(Event::kFellOver), 1U);
    EXPECT_EQ(run(1500, 3000, false, true), 1);
    EXPECT_EQ(run(3000, 4000, true, true), 1);  // back, not yet for a second
    EXPECT_EQ(run(4000, 4020, true, true), 0);
    EXPECT_EQ(count(Event::kReturned), 1U);
    EXPECT_EQ(run(4020, 5000, true, true), 0);
}

TEST_F(Channels, AFlickeringChannelIsNotTakenBack) {
    for (int t = 0; t < 10'000; t += 20) {
        if (t < 100 || t % 1200 < 100) {
            EXPECT_EQ(pitch(t / 20, t * kMs, 0), "none") << t;
        }
        EXPECT_EQ(pitch(t / 20, t * kMs + kMs, 1), "none") << t;
    }
    EXPECT_EQ(receiver_.channel_of(Parameter::kBodyPitchAngle), 1);
    EXPECT_EQ(count(Event::kReturned), 0U);
}

TEST_F(Channels, StalenessIsByTimeAlone) {
    EXPECT_TRUE(receiver_.is_stale(Parameter::kBodyPitchAngle, kStart));
    EXPECT_EQ(pitch(0, 0), "none");
    EXPECT_FALSE(receiver_.is_stale(Parameter::kBodyPitchAngle, kStart + 500 * kMs));
    EXPECT_TRUE(receiver_.is_stale(Parameter::kBodyPitchAngle, kStart + 500 * kMs + 1));
    EXPECT_EQ(pitch(0, 400 * kMs), "duplicate");  // says nothing new
    EXPECT_TRUE(receiver_.is_stale(Parameter::kBodyPitchAngle, kStart + 501 * kMs));
    EXPECT_EQ(told("4B0#090F0001121E0000", 0), "none");
    EXPECT_FALSE(receiver_.is_stale(Parameter::kUtc, kStart + 3 * kSecond));
    EXPECT_TRUE(receiver_.is_stale(Parameter::kUtc, kStart + 3 * kSecond + 1));
    EXPECT_EQ(told("730#1402000145FA0000", 0), "none");
    EXPECT_FALSE(receiver_.is_stale(Parameter::kVisibility, INT64_MAX));
}

TEST_F(Weather, AppliesAtTheCommit) {
    const WeatherStage& weather = receiver_.weather();
    EXPECT_EQ(told(float_frame(1840, 0, 8000.0F, 0)), "none");
    EXPECT_EQ(told(float_frame(1850, 0, 1000.0F, 0, 0, 3)), "none");
    EXPECT_EQ(told(float_frame(1851, 0, 1500.0F, 0, 0, 3)), "none");
    EXPECT_EQ(told("73C#140A030004", 0), "none");
    EXPECT_EQ(last_.update.layer, 3);
    EXPECT_EQ(last_.update.value, 0.5);
    EXPECT_EQ(weather.applied(Parameter::kLayerBase, 3), std::nullopt);
    EXPECT_FALSE(weather.is_drawable(3));
    EXPECT_EQ(told("758#14000000", kMs), "none");
    ASSERT_TRUE(last_.published);
    EXPECT_EQ(last_.update.parameter, Parameter::kCommit);
    EXPECT_EQ(last_.update.held_layers, 0);
    EXPECT_EQ(weather.applied(Parameter::kVisibility), 8000.0);
    EXPECT_EQ(weather.applied(Parameter::kLayerBase, 3), 1000.0);
    EXPECT_TRUE(weather.is_drawable(3));
    EXPECT_FALSE(weather.is_drawable(2));
    EXPECT_EQ(told("740#140A030000", 2 * kMs), "none");  // disabled
    EXPECT_TRUE(weather.is_drawable(3));
    EXPECT_EQ(told("758#140A000103", 3 * kMs), "none");
    EXPECT_FALSE(weather.is_drawable(3));
}

TEST_F(Weather, OneLayerCanBeCommittedAlone) {
    EXPECT_EQ(told(float_frame(1840, 0, 8000.0F, 0)), "none");
    EXPECT_EQ(told(float_frame(1850, 0, 1000.0F, 0, 0, 0)), "none");
    EXPECT_EQ(told(float_frame(1850, 1, 2000.0F, 0, 0, 1)), "none");
    EXPECT_EQ(told("758#140A000001", kMs), "none");
    EXPECT_EQ(last_.update.layer, 1);
    EXPECT_EQ(receiver_.weather().applied(Parameter::kLayerBase, 1), 2000.0);
    EXPECT_EQ(receiver_.weather().applied(Parameter::kLayerBase, 0), std::nullopt);
    EXPECT_EQ(receiver_.weather().applied(Parameter::kVisibility), std::nullopt);
}

TEST_F(Weather, LayersThatCannotBeDrawnStayStaged) {
    EXPECT_EQ(told(float_frame(1850, 0, 1500.0F, 0, 0, 2)), "none");
    EXPECT_EQ(told(float_frame(1851, 0, 1500.0F, 0, 0, 2)), "none");  // top = base
    EXPECT_EQ(told("73C#140A050009", 0), "none");                     // nine oktas
    EXPECT_EQ(told(float_frame(1852, 1, -0.1F, kMs, 0, 6)), "none");
    EXPECT_EQ(told("758#14000000", 2 * kMs), "none");
    EXPECT_EQ(last_.update.held_layers, 0b0110'0100);
    EXPECT_EQ(count(Event::kLayersHeld), 3U);
    EXPECT_EQ(receiver_.weather().applied(Parameter::kLayerBase, 2), std::nullopt);
    EXPECT_EQ(told(float_frame(1851, 1, 1600.0F, 3 * kMs, 0, 2)), "none");
    EXPECT_EQ(told("758#14000001", 4 * kMs), "none");
    EXPECT_EQ(last_.update.held_layers, 0b0110'0000);
    EXPECT_EQ(receiver_.weather().applied(Parameter::kLayerTop, 2), 1600.0);
}

TEST(WeatherWithoutCommit, AppliesAtOnceWhereConfigured) {
    ReceiverOptions options;
    options.weather = WeatherMode::kAtOnce;
    Receiver receiver(default_identifier_map(), options);
    static_cast<void>(receiver.receive(float_frame(1840, 0, 8000.0F, 0)));
    EXPECT_EQ(receiver.weather().applied(Parameter::kVisibility), 8000.0);
    static_cast<void>(receiver.receive(float_frame(1850, 0, 900.0F, 0, 0, 7)));
    EXPECT_EQ(receiver.weather().applied(Parameter::kLayerBase, 7), 900.0);
}

TEST(Memory, IsFixedAndForgetsTheOldest) {
    Receiver receiver;
    // A stranger invents senders: a thousand times more than are remembered of them.
    for (std::uint32_t i = 0; i < 200'000; ++i) {
        CanFrame each = float_frame(kPitch, 0, 1.0F, i, static_cast<std::uint16_t>(1 + i % 8191));
        each.data[0] = static_cast<std::uint8_t>(i / 8191);
        static_cast<void>(receiver.receive(each));
    }
    EXPECT_EQ(receiver.counters()[Event::kAccepted], 200'000U);
    static_cast<void>(receiver.receive(float_frame(kPitch, 5, 1.0F, kMs)));
    EXPECT_EQ(receiver.receive(float_frame(kPitch, 5, 1.0F, 2 * kMs)).reading.reason, Reason::kDuplicate);
}

TEST(Counters, AddUp) {
    Receiver receiver;
    for (const char* text : {"137#0102001040200000", "137#0102001040200000", "137#010200", "7F0#",
                             "20000004#0001000000000000", "137#0102000F40200000"})
        static_cast<void>(receiver.receive(frame(text)));
    const Counters& counters = receiver.counters();
    EXPECT_EQ(counters[Event::kFrames], 6U);
    for (const Outcome outcome : {Outcome::kAccept, Outcome::kReject, Outcome::kIgnore, Outcome::kDuplicate,
                                  Outcome::kStale, Outcome::kBusError})
        EXPECT_EQ(counters[outcome], 1U) << outcome_name(outcome);
    EXPECT_EQ(counters[Reason::kShort], 1U);
}

}  // namespace
}  // namespace skyig::protocol::canaerospace
