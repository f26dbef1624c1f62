// Every field of every golden frame.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "protocol/canaerospace/receiver.h"
#include "tests/protocol/canaerospace/frames.h"

namespace skyig::protocol::canaerospace {
namespace {

using Json = nlohmann::json;

Json value_of(const Value& value) {
    switch (value.kind) {
        case Value::Kind::kNone:
            return nullptr;
        case Value::Kind::kReal:
            return value.number;
        case Value::Kind::kInteger:
            return static_cast<std::int64_t>(value.number);
        case Value::Kind::kText:
        case Value::Kind::kList:
            break;
    }
    Json list = Json::array();
    for (std::size_t i = 0; i < value.count; ++i)
        list.push_back(value.items[i]);
    return list;
}

TEST(Golden, EveryFieldOfEveryFrame) {
    const Json golden = Json::parse(read_data("canaerospace_golden.json"));
    Receiver receiver;
    std::size_t fields = 0;
    for (const Json& expected : golden["frames"]) {
        const auto after_ns =
            static_cast<std::int64_t>(std::llround((expected["t"].get<double>() - 1718994600.0) * 1e9));
        const Reception got = receiver.receive(frame(expected["frame"].get<std::string>(), after_ns));
        const Message& message = got.reading.message;
        const std::string line = "line " + expected["line"].dump();
        EXPECT_EQ(outcome_name(got.outcome()), expected["expect"].get<std::string>()) << line;
        EXPECT_EQ(message.id, expected["id"]) << line;
        EXPECT_EQ(message.channel, expected["redundancy"]) << line;
        EXPECT_EQ(message.extended, expected["extended"]) << line;
        EXPECT_EQ(message.node, expected["node"]) << line;
        EXPECT_EQ(type_name(static_cast<DataType>(message.type_code)), expected["type"].get<std::string>());
        EXPECT_EQ(message.service_code, expected["service_code"]) << line;
        EXPECT_EQ(message.message_code, expected["message_code"]) << line;
        EXPECT_EQ(message.dlc, expected["dlc"]) << line;
        EXPECT_EQ(value_of(got.reading.value), expected["value"]) << line;
        if (message.entry != nullptr) {
            const auto type = static_cast<DataType>(message.type_code);
            EXPECT_EQ(message.entry->unit_of(type), expected["unit"].get<std::string>()) << line;
            ++fields;
        }
        fields += 10;
    }
    std::printf("%zu fields of %zu golden frames agree\n", fields, golden["frames"].size());
    EXPECT_EQ(golden["frames"].size(), 34U);
    EXPECT_EQ(receiver.counters()[Outcome::kAccept], 34U);
    // Not handed on: two high halves, four of services and emergency, one of the other channel.
    EXPECT_EQ(receiver.counters()[Event::kPublished], 34U - 2 - 4 - 1);
    EXPECT_EQ(receiver.counters()[Event::kOtherChannel], 1U);
    EXPECT_EQ(receiver.counters()[Event::kLost], 0U);
}

TEST(Golden, TheSpecificationsShort2) {
    const Reading reading = read_frame(frame("143#7C0C004A400005DC"), IdentifierIndex());
    std::printf("SHORT2 16384 of 1500 K: %.4f K\n", reading.value.number);
    EXPECT_DOUBLE_EQ(reading.value.number, 16384.0 * 1500.0 / 32767.0);
}

TEST(Golden, SetsClockAndStagesWeather) {
    const Json golden = Json::parse(read_data("canaerospace_golden.json"));
    Receiver receiver;
    for (const Json& expected : golden["frames"])
        static_cast<void>(receiver.receive(frame(expected["frame"].get<std::string>())));
    const std::optional<BusTime> time = receiver.clock().at(kStart);
    ASSERT_TRUE(time);
    EXPECT_EQ(time->day, 19'895);  // 2024-06-21
    EXPECT_DOUBLE_EQ(time->second_of_day, 18.5 * 3600);
    EXPECT_EQ(receiver.weather().staged(Parameter::kVisibility), 8000.0);
    EXPECT_EQ(receiver.weather().applied(Parameter::kVisibility), std::nullopt);
    EXPECT_EQ(receiver.weather().staged(Parameter::kLayerCoverage, 1), 0.625);
    EXPECT_EQ(receiver.weather().staged(Parameter::kLayerCoverage, 0), std::nullopt);
}

}  // namespace
}  // namespace skyig::protocol::canaerospace
