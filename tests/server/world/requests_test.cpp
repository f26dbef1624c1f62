#include "server/world/requests.h"

#include <gtest/gtest.h>

#include "server/world/events.h"
#include "server/world/ig_messages.h"

namespace skyig::server::world {
namespace {

using protocol::cigi::EnvConditionsRequest;
using protocol::cigi::HatHotRequest;
using protocol::cigi::PositionRequest;

HatHotRequest hat(int id, int period = 0) {
    HatHotRequest request;
    request.request_id = static_cast<std::uint16_t>(id);
    request.update_period = static_cast<std::uint8_t>(period);
    return request;
}

PositionRequest position(int id, bool continuous) {
    PositionRequest request;
    request.object_id = static_cast<std::uint16_t>(id);
    request.object_class = 2;
    request.update_mode = continuous;
    return request;
}

/// Takes out all that waits.
std::size_t answer_all(Requests& requests) {
    std::size_t count = 0;
    for (; !requests.empty(); requests.pop())
        ++count;
    return count;
}

TEST(Requests, AreAnsweredOnceInTheirOrder) {
    Requests requests;
    EnvConditionsRequest weather;
    weather.request_id = 9;
    ASSERT_TRUE(requests.ask(hat(1)) && requests.ask(weather) && requests.ask(hat(1)));
    requests.next_frame();
    EXPECT_EQ(std::get<HatHotRequest>(requests.front()).request_id, 1);
    requests.pop();
    EXPECT_EQ(std::get<EnvConditionsRequest>(requests.front()).request_id, 9);
    EXPECT_EQ(answer_all(requests), 2U);
    requests.next_frame();
    EXPECT_TRUE(requests.empty());
    requests.pop();  // nothing there: nothing happens
    EXPECT_TRUE(requests.empty());
}

TEST(Requests, BothKindsOfSightShareTheirIds) {
    Requests requests;
    protocol::cigi::LosSegmentRequest segment;
    segment.request_id = 4;
    segment.update_period = 2;
    protocol::cigi::LosVectorRequest vector;
    vector.request_id = 4;
    ASSERT_TRUE(requests.ask(segment) && requests.ask(hat(4, 1)));
    EXPECT_EQ(requests.standing(), 2U) << "heights have ids of their own";
    ASSERT_TRUE(requests.ask(vector));
    EXPECT_EQ(requests.standing(), 1U) << "a vector that is asked once ends the segment";
    requests.next_frame();
    EXPECT_EQ(answer_all(requests), 2U);
    vector.update_period = 1;
    ASSERT_TRUE(requests.ask(vector));
    requests.next_frame();
    EXPECT_EQ(answer_all(requests), 2U);
}

TEST(Requests, ComeAgainEveryPeriod) {
    Requests requests;
    ASSERT_TRUE(requests.ask(hat(5, 3)));
    std::vector<std::size_t> answered;
    for (int frame = 0; frame < 9; ++frame) {
        requests.next_frame();
        answered.push_back(answer_all(requests));
    }
    EXPECT_EQ(answered, (std::vector<std::size_t>{1, 0, 0, 1, 0, 0, 1, 0, 0}));
    // The same id with period 0: once more, then never.
    ASSERT_TRUE(requests.ask(hat(5)));
    requests.next_frame();
    EXPECT_EQ(answer_all(requests), 1U);
    for (int frame = 0; frame < 6; ++frame) {
        requests.next_frame();
        EXPECT_TRUE(requests.empty());
    }
}

TEST(Requests, PeriodOneIsEveryFrame) {
    Requests requests;
    ASSERT_TRUE(requests.ask(hat(5, 1)) && requests.ask(position(2, true)));
    for (int frame = 0; frame < 5; ++frame) {
        requests.next_frame();
        EXPECT_EQ(answer_all(requests), 2U);
    }
    ASSERT_TRUE(requests.ask(position(2, false)));
    EXPECT_EQ(requests.standing(), 1U);
    requests.next_frame();
    EXPECT_EQ(answer_all(requests), 2U);
    requests.next_frame();
    EXPECT_EQ(answer_all(requests), 1U);
}

TEST(Requests, AStandingOneReplacesThatOfTheSameId) {
    Requests requests;
    HatHotRequest request = hat(5, 1);
    ASSERT_TRUE(requests.ask(request));
    request.lat_x = 50.0;
    ASSERT_TRUE(requests.ask(request));
    EXPECT_EQ(requests.standing(), 1U);
    requests.next_frame();
    EXPECT_EQ(std::get<HatHotRequest>(requests.front()).lat_x, 50.0);
    EXPECT_EQ(answer_all(requests), 1U);
    // Another object of the same id is another matter.
    PositionRequest group = position(5, true);
    group.object_class = 3;
    ASSERT_TRUE(requests.ask(position(5, true)) && requests.ask(group));
    EXPECT_EQ(requests.standing(), 3U);
}

TEST(Requests, AFloodIsBoundedAndKeepsNobodyFromHisTurn) {
    Requests requests;
    for (int i = 0; i < 300; ++i)
        EXPECT_EQ(requests.ask(hat(i, 1)), i < static_cast<int>(Requests::kMostStanding));
    std::size_t taken = 0;
    for (int i = 0; i < 5000; ++i)
        taken += requests.ask(hat(10'000 + i)) ? 1U : 0U;
    EXPECT_EQ(taken, Requests::kMostWaiting);
    // As many as fit a message are answered a frame; every standing one comes to its turn.
    std::array<int, Requests::kMostStanding> answers{};
    for (int frame = 0; frame < 100; ++frame) {
        requests.next_frame();
        for (int i = 0; i < 90 && !requests.empty(); ++i, requests.pop()) {
            const auto id = std::get<HatHotRequest>(requests.front()).request_id;
            if (id < answers.size()) ++answers[id];
        }
        EXPECT_LE(requests.waiting(), Requests::kMostWaiting);
    }
    EXPECT_GE(*std::min_element(answers.begin(), answers.end()), 20);
    requests.clear();
    requests.next_frame();
    EXPECT_TRUE(requests.empty());
    EXPECT_EQ(requests.standing(), 0U);
}

TEST(Events, AreToldOnlyWhenEnabled) {
    Events events;
    EXPECT_TRUE(events.raise(Event::kSourceLost, 1, 2));
    EXPECT_TRUE(events.empty());
    EXPECT_TRUE(events.enable(2, true));
    EXPECT_FALSE(events.enable(0, true));
    EXPECT_FALSE(events.enable(5, true));
    EXPECT_TRUE(events.raise(Event::kSourceLost, 1, 2));
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.front().event_id, 2);
    EXPECT_EQ(events.front().data_2, 2U);
    events.pop();
    for (std::size_t i = 0; i < Events::kMostWaiting; ++i)
        EXPECT_TRUE(events.raise(Event::kSourceLost, 0, 0));
    EXPECT_FALSE(events.raise(Event::kSourceLost, 0, 0));
    events.clear();
    EXPECT_TRUE(events.raise(Event::kSourceLost, 0, 0));
    EXPECT_TRUE(events.empty());
}

TEST(IgMessages, AreFewAndShort) {
    IgMessages messages;
    messages.add(Matter::kPacketRefused, "not open");
    EXPECT_TRUE(messages.empty());
    EXPECT_EQ(messages.left_out(), 0U);
    messages.open(true);
    messages.add(Matter::kPacketRefused, "{:x>200}", "");
    messages.add(Matter::kPacketRefused, "too soon");
    messages.add(Matter::kPacketIgnored, "another matter");
    EXPECT_EQ(messages.front().text().size(), IgMessages::kMostText);
    EXPECT_EQ(messages.left_out(), 1U);
    messages.pop();
    EXPECT_EQ(messages.front().text(), "another matter");
    messages.pop();
    EXPECT_TRUE(messages.empty());
    for (int i = 0; i < 100; ++i) {
        messages.advance(1.0);
        messages.add(Matter::kPacketRefused, "{}", i);
    }
    std::size_t count = 0;
    for (; !messages.empty(); messages.pop())
        ++count;
    EXPECT_EQ(count, IgMessages::kMostWaiting);
    messages.open(false);
    EXPECT_TRUE(messages.empty());
}

}  // namespace
}  // namespace skyig::server::world
