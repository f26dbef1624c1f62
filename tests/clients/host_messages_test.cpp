#include "clients/skyig/host_messages.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "protocol/cigi/message.h"

namespace skyig::clients {
namespace {

namespace cigi = protocol::cigi;

/// Everything one message holds, as the image generator reads it.
struct Heard {
    std::optional<cigi::IgControl> control;
    std::optional<cigi::EntityControl> entity;
    std::optional<cigi::EntityPosition> position;
    std::optional<cigi::CelestialSphereControl> celestial;
    std::optional<cigi::AtmosphereControl> air;
    std::optional<cigi::ViewControl> view;

    void operator()(const cigi::IgControl& packet) { control = packet; }
    void operator()(const cigi::EntityControl& packet) { entity = packet; }
    void operator()(const cigi::EntityPosition& packet) { position = packet; }
    void operator()(const cigi::CelestialSphereControl& packet) { celestial = packet; }
    void operator()(const cigi::AtmosphereControl& packet) { air = packet; }
    void operator()(const cigi::ViewControl& packet) { view = packet; }
};

struct Link {
    cigi::Version version;
    cigi::ByteOrder order;
};

class HostMessagesTest : public ::testing::TestWithParam<Link> {
  protected:
    HostMessages messages(bool with_options = false) const {
        HostSettings settings;
        settings.version = GetParam().version;
        settings.order = GetParam().order;
        settings.utc = *server::ephemeris::parse_utc("2024-06-21T23:59:30Z");
        if (with_options) {
            settings.visibility_m = 12'000.0;
            settings.view_yaw_deg = -30.0;
            settings.view_id = 2;
        }
        return HostMessages(settings);
    }

    Heard hear(HostMessages& messages, double flown_s = 0.0) const {
        const FlightPoint pose{0.0, 63.99, -22.6, 44.5, 359.5, -3.25, -20.75};
        const auto bytes = messages.next(pose, flown_s, 1'234'567'890);
        Heard heard;
        cigi::Counters counters;
        const cigi::MessageSummary summary = cigi::decode_host_message(bytes, heard, counters);
        EXPECT_TRUE(summary.accepted);
        EXPECT_FALSE(summary.fault);
        EXPECT_EQ(summary.version, GetParam().version);
        EXPECT_EQ(summary.order, GetParam().order);
        for (std::size_t i = 0; i < cigi::kCounts; ++i)
            EXPECT_EQ(counters.counts[i], 0U) << cigi::count_name(static_cast<cigi::Count>(i));
        return heard;
    }

    static void answer(HostMessages& messages, cigi::IgMode mode, std::uint32_t frame = 100) {
        cigi::StartOfFrame start_of_frame;
        start_of_frame.ig_mode = mode;
        start_of_frame.ig_frame_number = frame;
        start_of_frame.last_host_frame_number = messages.frame_number();
        messages.answered(start_of_frame);
    }

    void start_flight(HostMessages& messages) const {
        hear(messages);
        answer(messages, cigi::IgMode::kStandby);
        hear(messages);
        answer(messages, cigi::IgMode::kOperate);
    }
};

TEST_P(HostMessagesTest, AsksForStandbyAndSaysNothingElseUntilAnswered) {
    HostMessages host = messages(true);
    for (std::uint32_t i = 1; i <= 3; ++i) {
        const Heard heard = hear(host);
        ASSERT_TRUE(heard.control);
        EXPECT_EQ(heard.control->ig_mode, cigi::IgMode::kStandby);
        EXPECT_EQ(heard.control->host_frame_number, i);
        EXPECT_EQ(heard.control->database_number, 0);
        EXPECT_TRUE(heard.control->timestamp_valid);
        EXPECT_EQ(heard.control->timestamp, 123'456U);
        EXPECT_FALSE(heard.entity || heard.position || heard.celestial || heard.air || heard.view);
    }
}

TEST_P(HostMessagesTest, DoesNotTakeAnotherHostsOperateForItsOwn) {
    HostMessages host = messages();
    hear(host);
    answer(host, cigi::IgMode::kOperate);
    EXPECT_FALSE(host.operating());
    EXPECT_EQ(hear(host).control->ig_mode, cigi::IgMode::kStandby);
}

TEST_P(HostMessagesTest, SendsSettingsOnceAndThePoseInEveryMessage) {
    HostMessages host = messages(true);
    start_flight(host);
    EXPECT_TRUE(host.operating());
    const Heard first = hear(host);
    EXPECT_EQ(first.control->ig_mode, cigi::IgMode::kOperate);
    EXPECT_EQ(first.control->last_ig_frame_number, 100U);
    ASSERT_TRUE(first.celestial && first.air && first.view && first.entity);
    EXPECT_EQ(first.celestial->hour, 23);
    EXPECT_EQ(first.celestial->minute, 59);
    EXPECT_EQ(first.celestial->date, 6'212'024U);
    EXPECT_EQ(first.celestial->seconds, GetParam().version == cigi::Version::k40 ? 30.0F : 0.0F);
    EXPECT_TRUE(first.celestial->ephemeris_enable && first.celestial->date_time_valid);
    EXPECT_EQ(first.air->visibility, 12'000.0F);
    EXPECT_TRUE(first.air->model_enable);
    EXPECT_EQ(first.view->view_id, 2);
    EXPECT_TRUE(first.view->yaw_enable);
    EXPECT_FALSE(first.view->pitch_enable);
    EXPECT_FLOAT_EQ(first.view->yaw, 330.0F);
    EXPECT_EQ(first.entity->entity_state, cigi::EntityState::kActive);

    const Heard second = hear(host, 1.0 / 60.0);
    EXPECT_FALSE(second.celestial || second.air || second.view);
    if (GetParam().version == cigi::Version::k33) {
        ASSERT_TRUE(second.entity);
        EXPECT_DOUBLE_EQ(second.entity->lat_x, 63.99);
        EXPECT_DOUBLE_EQ(second.entity->lon_y, -22.6);
        EXPECT_DOUBLE_EQ(second.entity->alt_z, 44.5);
        EXPECT_FLOAT_EQ(second.entity->yaw, 359.5F);
        EXPECT_FLOAT_EQ(second.entity->pitch, -3.25F);
        EXPECT_FLOAT_EQ(second.entity->roll, -20.75F);
    } else {
        EXPECT_FALSE(second.entity);
        ASSERT_TRUE(second.position);
        EXPECT_DOUBLE_EQ(second.position->lat_x, 63.99);
        EXPECT_DOUBLE_EQ(second.position->lon_y, -22.6);
        EXPECT_DOUBLE_EQ(second.position->alt_z, 44.5);
        EXPECT_FLOAT_EQ(second.position->yaw, 359.5F);
        EXPECT_FLOAT_EQ(second.position->pitch, -3.25F);
        EXPECT_FLOAT_EQ(second.position->roll, -20.75F);
    }
}

TEST_P(HostMessagesTest, SendsTheSettingsAgainAfterARestartAtTheTimeThatHasPassed) {
    HostMessages host = messages();
    start_flight(host);
    hear(host);
    answer(host, cigi::IgMode::kStandby, 1);
    EXPECT_FALSE(host.operating());
    const Heard asking = hear(host, 40.0);
    EXPECT_EQ(asking.control->ig_mode, cigi::IgMode::kOperate);
    EXPECT_FALSE(asking.entity || asking.celestial);
    answer(host, cigi::IgMode::kOperate, 2);
    const Heard back = hear(host, 45.0);
    ASSERT_TRUE(back.celestial);
    EXPECT_EQ(back.celestial->hour, 0);
    EXPECT_EQ(back.celestial->minute, 0);
    EXPECT_EQ(back.celestial->date, 6'222'024U);
}

INSTANTIATE_TEST_SUITE_P(BothVersionsAndOrders, HostMessagesTest,
                         ::testing::Values(Link{cigi::Version::k33, cigi::ByteOrder::kLittle},
                                           Link{cigi::Version::k33, cigi::ByteOrder::kBig},
                                           Link{cigi::Version::k40, cigi::ByteOrder::kLittle},
                                           Link{cigi::Version::k40, cigi::ByteOrder::kBig}),
                         [](const auto& link) {
                             return std::string(link.param.version == cigi::Version::k33 ? "Cigi33"
                                                                                         : "Cigi40") +
                                    (link.param.order == cigi::ByteOrder::kBig ? "Big" : "Little");
                         });

TEST(CelestialSetting, NeverSaysSecondSixty) {
    for (const char* text : {"2016-12-31T23:59:60.5Z", "2016-06-30T12:00:59.999999999Z"}) {
        const auto utc = server::ephemeris::parse_utc(text);
        ASSERT_TRUE(utc) << text;
        EXPECT_LT(celestial_setting(*utc).seconds, 60.0F) << text;
    }
}

}  // namespace
}  // namespace skyig::clients
