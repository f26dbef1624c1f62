// What a host asks and switches, in real datagrams, and what the world says to it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "server/world/responder.h"
#include "tests/server/world/host_bench.h"

namespace skyig::server::world {
namespace {

namespace cigi = protocol::cigi;
using cigi::ComponentClass;

class WorldRequestsTest : public ::testing::Test {
  protected:
    /// Sends the request and takes the responses to it out of the world.
    template <class Packet>
    std::vector<Response> ask(const Packet& request) {
        bench_.send(kHostA, request);
        Outbox& outbox = bench_.world.outbox();
        outbox.requests.next_frame();
        std::vector<Response> all;
        for (; !outbox.requests.empty(); outbox.requests.pop()) {
            respond(bench_.world, outbox.requests.front(), outbox.responses);
            for (; !outbox.responses.empty(); outbox.responses.pop())
                all.push_back(outbox.responses.front());
        }
        return all;
    }
    template <class P, class Packet>
    P only(const Packet& request) {
        const std::vector<Response> all = ask(request);
        EXPECT_EQ(all.size(), 1U);
        const P* response = all.empty() ? nullptr : std::get_if<P>(&all.front());
        EXPECT_NE(response, nullptr);
        return response == nullptr ? P{} : *response;
    }
    void place(double latitude_deg, double longitude_deg, double height_m, float yaw_deg = 0.0F) {
        cigi::EntityControl ownship;
        ownship.entity_state = cigi::EntityState::kActive;
        ownship.lat_x = latitude_deg;
        ownship.lon_y = longitude_deg;
        ownship.alt_z = height_m;
        ownship.yaw = yaw_deg;
        bench_.send(kHostA, ownship);
    }

    HostBench bench_;
};

cigi::HatHotRequest hat_hot(cigi::HatHotType type, double height_m) {
    cigi::HatHotRequest request;
    request.request_id = 0xBEEF;
    request.request_type = type;
    request.lat_x = 47.0;
    request.lon_y = 8.0;
    request.alt_z = height_m;
    return request;
}

TEST_F(WorldRequestsTest, HeightsAreThoseOverEllipsoidAndSea) {
    bench_.frame = 0x123;
    const auto hat = only<cigi::HatHotResponse>(hat_hot(cigi::HatHotType::kHat, 1234.5));
    EXPECT_EQ(hat.request_id, 0xBEEF);
    EXPECT_TRUE(hat.valid);
    EXPECT_FALSE(hat.response_type);
    EXPECT_EQ(hat.host_frame_lsn, 4) << "low bits of frame 0x124";
    EXPECT_EQ(hat.height, 1234.5);
    cigi::MaritimeSurfaceControl tide;
    tide.enable = true;
    tide.sea_surface_height = 2.5F;
    bench_.send(kHostA, tide);
    const auto hot = only<cigi::HatHotResponse>(hat_hot(cigi::HatHotType::kHot, 1234.5));
    EXPECT_TRUE(hot.response_type);
    EXPECT_EQ(hot.height, 2.5);
    const auto both = only<cigi::HatHotExtendedResponse>(hat_hot(cigi::HatHotType::kExtended, -100.0));
    EXPECT_TRUE(both.valid);
    EXPECT_EQ(both.hot, 2.5);
    EXPECT_EQ(both.hat, -102.5) << "below the surface it is negative";
    EXPECT_EQ(both.normal_elevation, 90.0F);
}

TEST_F(WorldRequestsTest, PointsOnTheOwnshipAreFoundAlongItsAxes) {
    place(10.0, 20.0, 5000.0, 90.0F);
    cigi::HatHotRequest request = hat_hot(cigi::HatHotType::kHat, 30.0);
    request.coordinate_system = true;
    request.lat_x = 100.0;  // forward
    request.lon_y = -50.0;
    // 100 m along the tangent plane lie 112^2 / 2R above it.
    EXPECT_NEAR(only<cigi::HatHotResponse>(request).height, 4970.0 + 112.0 * 112.0 / 2.0 / 6.37e6, 1e-3);
    request.entity_id = 3;
    EXPECT_FALSE(only<cigi::HatHotResponse>(request).valid) << "no such entity";
    request.entity_id = 0;
    request.alt_z = 1e300;
    const auto far = only<cigi::HatHotResponse>(request);
    EXPECT_FALSE(far.valid);
    EXPECT_EQ(far.height, 0.0);
}

TEST_F(WorldRequestsTest, WhatIsNoPointHasNoValidAnswer) {
    EXPECT_FALSE(only<cigi::HatHotResponse>(hat_hot(cigi::HatHotType::kHat, 1e12)).valid);
    EXPECT_FALSE(only<cigi::HatHotExtendedResponse>(hat_hot(cigi::HatHotType::kExtended, -20'000.0)).valid);
    // Not a number is refused before it comes here.
    EXPECT_TRUE(ask(hat_hot(cigi::HatHotType::kHat, std::numeric_limits<double>::quiet_NaN())).empty());
    EXPECT_EQ(bench_.counters[cigi::Count::kNonfinite], 1U);
}

TEST_F(WorldRequestsTest, OwnshipAndViewsSayWhereTheyAre) {
    place(47.0, 8.0, 1000.0, 350.0F);
    cigi::PositionRequest request;
    const auto own = only<cigi::PositionResponse>(request);
    EXPECT_EQ(own.lat_x, 47.0);
    EXPECT_EQ(own.lon_y, 8.0);
    EXPECT_EQ(own.alt_z, 1000.0);
    EXPECT_EQ(own.yaw, 350.0F);
    // The view to the right: turned by 60 degrees, at the ownship's place.
    request.object_class = 2;
    request.object_id = 3;
    const auto right = only<cigi::PositionResponse>(request);
    EXPECT_EQ(right.object_class, 2);
    EXPECT_EQ(right.object_id, 3);
    EXPECT_EQ(right.lat_x, 47.0);
    EXPECT_NEAR(right.yaw, 50.0F, 1e-4F);
    EXPECT_NEAR(right.pitch, 0.0F, 1e-4F);
    // Moved 100 m ahead of the ownship, which looks 10 degrees west of north.
    cigi::ViewControl move;
    move.view_id = 3;
    move.x_enable = true;
    move.x_offset = 100.0F;
    bench_.send(kHostA, move);
    const auto moved = only<cigi::PositionResponse>(request);
    EXPECT_NEAR((moved.lat_x - 47.0) * 111'170.0, 100.0 * std::cos(0.174532925), 0.1);
    EXPECT_NEAR((moved.lon_y - 8.0) * 76'057.0, -100.0 * std::sin(0.174532925), 0.1);
    request.coordinate_system = 1;
    const auto offset = only<cigi::PositionResponse>(request);
    EXPECT_EQ(offset.coordinate_system, 1);
    EXPECT_EQ(offset.lat_x, 100.0);
    EXPECT_EQ(offset.lon_y, 0.0);
    EXPECT_NEAR(offset.yaw, 60.0F, 1e-4F);
}

TEST_F(WorldRequestsTest, GroupCarriesItsViews) {
    place(0.0, 0.0, 0.0);
    cigi::ViewDefinition member;
    member.view_id = 2;
    member.group_id = 4;
    cigi::ViewControl turn;
    turn.group_id = 4;
    turn.yaw_enable = turn.x_enable = true;
    turn.yaw = 90.0F;
    turn.x_offset = 10.0F;
    cigi::ViewControl ahead;
    ahead.view_id = 2;
    ahead.x_enable = true;
    ahead.x_offset = 5.0F;
    bench_.send(kHostA, member, turn, ahead);
    cigi::PositionRequest request;
    request.object_class = 3;
    request.object_id = 4;
    request.coordinate_system = 1;
    EXPECT_NEAR(only<cigi::PositionResponse>(request).yaw, 90.0F, 1e-4F);
    request.object_class = 2;
    request.object_id = 2;
    const auto view = only<cigi::PositionResponse>(request);
    EXPECT_NEAR(view.lat_x, 10.0, 1e-6);
    EXPECT_NEAR(view.lon_y, 5.0, 1e-6) << "ahead of a group that looks right is right";
}

TEST_F(WorldRequestsTest, ViewAttitudeHoldsNextToAPole) {
    place(90.0, 0.0, 0.0, 0.0F);
    cigi::ViewControl ahead;
    ahead.view_id = 2;
    ahead.x_enable = true;
    ahead.x_offset = 1000.0F;
    bench_.send(kHostA, ahead);
    cigi::PositionRequest request;
    request.object_class = 2;
    request.object_id = 2;
    const auto view = only<cigi::PositionResponse>(request);
    // Beyond the pole on the other side of the world, looking south.
    EXPECT_NEAR(std::abs(view.lon_y), 180.0, 1e-9);
    EXPECT_NEAR(view.yaw, 180.0F, 1e-3F);
    EXPECT_NEAR(view.alt_z, 1000.0 * 1000.0 / 2.0 / 6.4e6, 1e-3);
    EXPECT_NEAR(view.pitch, std::atan(1000.0 / 6.4e6) * 57.2957795, 1e-4);
}

TEST_F(WorldRequestsTest, UnknownThingsAreCountedNotAnswered) {
    cigi::PositionRequest request;
    request.object_id = 7;
    EXPECT_TRUE(ask(request).empty()) << "another entity";
    request.object_class = 2;
    request.object_id = 500;
    EXPECT_TRUE(ask(request).empty()) << "no such view";
    request.object_class = 3;
    request.object_id = 9;
    EXPECT_TRUE(ask(request).empty()) << "a group without views";
    request.object_class = 4;
    EXPECT_TRUE(ask(request).empty()) << "a motion tracker";
    EXPECT_EQ(bench_.world.counters().request_unknown, 4U);
    EXPECT_EQ(bench_.world.outbox().requests.waiting(), 0U);
}

TEST_F(WorldRequestsTest, LinesOfSightAreAnsweredAsNotValid) {
    bench_.frame = 0x31;
    cigi::LosSegmentRequest segment;
    segment.request_id = 0xABCD;
    segment.destination_lat_x = 1.0;
    const auto basic = only<cigi::LosResponse>(segment);
    EXPECT_EQ(basic.request_id, 0xABCD);
    EXPECT_FALSE(basic.valid);
    EXPECT_FALSE(basic.visible);
    EXPECT_EQ(basic.host_frame_lsn, 2);
    EXPECT_EQ(basic.response_count, 1);
    EXPECT_EQ(basic.range, 0.0);
    cigi::LosVectorRequest vector;
    vector.request_id = 0xABCD;
    vector.request_type = true;
    vector.azimuth = 30.0F;
    const auto extended = only<cigi::LosExtendedResponse>(vector);
    EXPECT_EQ(extended.request_id, 0xABCD);
    EXPECT_FALSE(extended.valid);
    EXPECT_FALSE(extended.range_valid);
    EXPECT_EQ(extended.response_count, 1);
    segment.source_lat_x = 91.0;
    EXPECT_TRUE(ask(segment).empty()) << "refused by the decoder";
    EXPECT_EQ(bench_.counters[cigi::Count::kOutOfRange], 1U);
}

TEST_F(WorldRequestsTest, WeatherThatHangsOnAnEntityIsFoundWhereItIs) {
    cigi::EntityControl storm;
    storm.entity_id = 30;
    storm.entity_state = cigi::EntityState::kActive;
    storm.lat_x = 10.0;
    storm.lon_y = 20.0;
    storm.alt_z = 3000.0;
    cigi::WeatherControl rain;
    rain.scope = cigi::WeatherScope::kEntity;
    rain.entity_region_id = 30;
    rain.weather_enable = true;
    rain.visibility = 800.0F;
    rain.humidity = 99;
    rain.air_temperature = 3.0F;
    rain.pressure = 700.0F;
    rain.wind_horizontal = 20.0F;
    rain.wind_direction = 270.0F;
    rain.transition_band = 4000.0F;
    cigi::EnvConditionsRequest request;
    request.request_type = 4;
    request.latitude = 10.0;
    request.longitude = 20.0;
    request.altitude = 3000.0;
    bench_.send(kHostA, rain);
    EXPECT_EQ(only<cigi::WeatherConditionsResponse>(request).humidity, 50) << "its entity is not there yet";
    bench_.send(kHostA, storm);
    const auto inside = only<cigi::WeatherConditionsResponse>(request);
    EXPECT_NEAR(inside.visibility, 800.0F, 0.01F);
    EXPECT_EQ(inside.humidity, 99);
    EXPECT_NEAR(inside.wind_horizontal, 20.0F, 1e-3F);
    EXPECT_NEAR(inside.wind_direction, 270.0F, 1e-3F);
    EXPECT_NEAR(inside.pressure, 700.0F, 1e-2F);
    request.altitude = 5000.0;
    EXPECT_NEAR(only<cigi::WeatherConditionsResponse>(request).air_temperature, 9.0F, 0.01F)
        << "half way out";
    request.altitude = 7001.0;
    EXPECT_EQ(only<cigi::WeatherConditionsResponse>(request).humidity, 50);
    // It goes with its entity.
    storm.lon_y = 21.0;
    bench_.send(kHostA, storm);
    request.altitude = 3000.0;
    EXPECT_EQ(only<cigi::WeatherConditionsResponse>(request).humidity, 50);
    request.longitude = 21.0;
    EXPECT_EQ(only<cigi::WeatherConditionsResponse>(request).humidity, 99);
    // No layer, so no aerosol; and gone with its entity, also when that comes again.
    request.request_type = 8;
    EXPECT_TRUE(ask(request).empty());
    storm.entity_state = cigi::EntityState::kDestroyed;
    bench_.send(kHostA, storm);
    storm.entity_state = cigi::EntityState::kActive;
    bench_.send(kHostA, storm);
    request.request_type = 4;
    EXPECT_EQ(only<cigi::WeatherConditionsResponse>(request).humidity, 50);
    // On the ownship itself.
    place(50.0, 0.0, 1000.0);
    rain.entity_region_id = 0;
    bench_.send(kHostA, rain);
    request.latitude = 50.0;
    request.longitude = 0.0;
    request.altitude = 1000.0;
    EXPECT_EQ(only<cigi::WeatherConditionsResponse>(request).humidity, 99);
}

TEST_F(WorldRequestsTest, EntitiesSayWhereTheyAre) {
    cigi::EntityControl ship;
    ship.entity_id = 7;
    ship.entity_state = cigi::EntityState::kActive;
    ship.lat_x = 50.0;
    ship.lon_y = -4.0;
    ship.alt_z = 20.0;
    ship.yaw = 300.0F;
    cigi::EntityControl mast = ship;
    mast.entity_id = 8;
    mast.attach_state = true;
    mast.parent_id = 7;
    mast.lat_x = -10.0;
    mast.lon_y = 0.0;
    mast.alt_z = -30.0;
    mast.yaw = 5.0F;
    bench_.send(kHostA, ship, mast);
    cigi::PositionRequest request;
    request.object_id = 7;
    request.coordinate_system = 1;
    const auto hull = only<cigi::PositionResponse>(request);
    EXPECT_EQ(hull.coordinate_system, 0) << "attached to nothing";
    EXPECT_EQ(hull.lon_y, -4.0);
    EXPECT_EQ(hull.yaw, 300.0F);
    request.object_id = 8;
    const auto offset = only<cigi::PositionResponse>(request);
    EXPECT_EQ(offset.coordinate_system, 1);
    EXPECT_EQ(offset.lat_x, -10.0);
    EXPECT_EQ(offset.alt_z, -30.0);
    EXPECT_EQ(offset.yaw, 5.0F);
    request.coordinate_system = 0;
    const auto top = only<cigi::PositionResponse>(request);
    EXPECT_NEAR(top.alt_z, 50.0, 1e-4);
    EXPECT_NEAR(top.yaw, 305.0F, 1e-3F);
    cigi::HatHotRequest height = hat_hot(cigi::HatHotType::kHat, 5.0);
    height.coordinate_system = true;
    height.entity_id = 7;
    height.lat_x = height.lon_y = 0.0;
    EXPECT_NEAR(only<cigi::HatHotResponse>(height).height, 15.0, 1e-6);
}

TEST_F(WorldRequestsTest, ConditionsOfAllKindsInOneRequest) {
    cigi::AtmosphereControl air;
    air.model_enable = true;
    air.visibility = 9000.0F;
    air.air_temperature = 20.0F;
    air.humidity = 60;
    air.pressure = 1000.0F;
    air.wind_horizontal = 5.0F;
    air.wind_direction = 270.0F;
    cigi::WeatherControl sand;
    sand.layer_id = 8;
    sand.weather_enable = true;
    sand.visibility = 300.0F;
    sand.thickness = 500.0F;
    sand.aerosol = 0.75F;
    cigi::TerrestrialSurfaceControl wet;
    wet.condition_id = 12;
    wet.enable = true;
    bench_.send(kHostA, air, sand, wet);
    cigi::EnvConditionsRequest request;
    request.request_type = 15;
    request.request_id = 200;
    request.altitude = 100.0;
    const std::vector<Response> all = ask(request);
    ASSERT_EQ(all.size(), 4U);
    const auto sea = std::get<cigi::MaritimeSurfaceResponse>(all[0]);
    EXPECT_EQ(sea.request_id, 200);
    EXPECT_EQ(sea.clarity, 100.0F);
    EXPECT_EQ(std::get<cigi::TerrestrialSurfaceResponse>(all[1]).condition_id, 12U);
    EXPECT_EQ(std::get<cigi::WeatherConditionsResponse>(all[2]).visibility, 300.0F);
    const auto aerosol = std::get<cigi::AerosolResponse>(all[3]);
    EXPECT_EQ(aerosol.layer_id, 8);
    EXPECT_EQ(aerosol.aerosol, 0.75F);
    request.request_type = 4;
    request.altitude = 501.0;
    const auto above = only<cigi::WeatherConditionsResponse>(request);
    EXPECT_EQ(above.visibility, 9000.0F);
    EXPECT_EQ(above.humidity, 60);
    EXPECT_EQ(above.wind_direction, 270.0F);
    request.request_type = 8;
    EXPECT_TRUE(ask(request).empty()) << "no layer encloses the point";
}

TEST_F(WorldRequestsTest, ADestroyedRegionTakesItsSeaWithIt) {
    cigi::EnvRegionControl region;
    region.region_id = 3;
    region.region_state = cigi::RegionState::kActive;
    region.latitude = 47.0;
    region.longitude = 8.0;
    region.size_x = region.size_y = 1000.0F;
    cigi::MaritimeSurfaceControl lake;
    lake.scope = cigi::WeatherScope::kRegional;
    lake.entity_region_id = 3;
    lake.enable = true;
    lake.sea_surface_height = 400.0F;
    bench_.send(kHostA, region, lake);
    EXPECT_EQ(only<cigi::HatHotResponse>(hat_hot(cigi::HatHotType::kHot, 0.0)).height, 400.0);
    region.region_state = cigi::RegionState::kDestroyed;
    bench_.send(kHostA, region);
    region.region_state = cigi::RegionState::kActive;
    bench_.send(kHostA, region);
    EXPECT_EQ(only<cigi::HatHotResponse>(hat_hot(cigi::HatHotType::kHot, 0.0)).height, 0.0);
    lake.scope = cigi::WeatherScope::kEntity;
    bench_.send(kHostA, lake);
    EXPECT_EQ(bench_.world.counters().surface_entity, 1U);
}

TEST_F(WorldRequestsTest, EventsTellOfClockAndLinks) {
    for (const int id : {1, 2, 3})
        bench_.control(ComponentClass::kEvent, 0, id, 1);
    cigi::CelestialSphereControl sky;
    sky.hour = 18;
    sky.minute = 30;
    sky.date = 12312026;
    sky.date_time_valid = sky.ephemeris_enable = true;
    bench_.send(kHostA, sky);
    Events& events = bench_.world.outbox().events;
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.front().event_id, 3);
    EXPECT_EQ(events.front().data_1, 12312026U);
    EXPECT_EQ(events.front().data_2, 183000U);
    events.pop();
    bench_.wait(30.0);
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.front().event_id, 2);
    EXPECT_EQ(events.front().data_1, 0U);
    EXPECT_EQ(events.front().data_2, 1U) << "its first loss";
    events.pop();
    // The same host is back: it finds its events as they were.
    bench_.send(kHostA);
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.front().event_id, 1);
    events.pop();
    EXPECT_TRUE(events.empty());
    // Another host is told nothing that it has not asked for.
    bench_.wait(30.0);
    bench_.send(kHostB);
    EXPECT_TRUE(events.empty());
}

TEST_F(WorldRequestsTest, StandbyForgetsWhatWasAsked) {
    cigi::HatHotRequest request = hat_hot(cigi::HatHotType::kHat, 0.0);
    request.update_period = 1;
    cigi::MaritimeSurfaceControl tide;
    tide.enable = true;
    tide.sea_surface_height = 5.0F;
    bench_.send(kHostA, request, tide);
    EXPECT_EQ(bench_.world.outbox().requests.standing(), 1U);
    bench_.mode = cigi::IgMode::kStandby;
    bench_.send(kHostA, request);
    EXPECT_EQ(bench_.world.outbox().requests.standing(), 0U);
    EXPECT_EQ(bench_.world.counters().standby_ignored, 1U);
    EXPECT_EQ(bench_.world.surfaces().sea(cigi::WeatherScope::kGlobal, 0), nullptr);
}

TEST_F(WorldRequestsTest, OnlyTheHostInControlIsAnswered) {
    bench_.send(kHostA);
    bench_.send(kHostB, hat_hot(cigi::HatHotType::kHat, 0.0));
    EXPECT_EQ(bench_.world.outbox().requests.waiting(), 0U);
    EXPECT_EQ(bench_.world.counters().second_host, 1U);
}

TEST(WorldRequests, ASourceWithoutControlIsNotAnswered) {
    config::Config config = three_channels();
    config::Source instructor;
    instructor.name = "instructor";
    instructor.kind = config::SourceKind::kCigi;
    config.sources.push_back(instructor);
    config.sources[0].rights.owns.reset();
    config.sources[0].rights.owns.set(static_cast<std::size_t>(config::Aspect::kWeather));
    HostBench bench(config);
    bench.send(kHostA);
    bench.source = 1;
    cigi::MaritimeSurfaceControl tide;
    tide.enable = true;
    bench.send(kHostB, hat_hot(cigi::HatHotType::kHat, 0.0), tide);
    EXPECT_EQ(bench.world.outbox().requests.waiting(), 0U);
    EXPECT_EQ(bench.world.counters().not_in_charge, 1U);
    EXPECT_NE(bench.world.surfaces().sea(cigi::WeatherScope::kGlobal, 0), nullptr)
        << "its word on the weather counts";
}

}  // namespace
}  // namespace skyig::server::world
