// Where a host places ownship and entities and how it lets them move, in real datagrams.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/server/world/host_bench.h"

namespace skyig::server::world {
namespace {

namespace cigi = protocol::cigi;

constexpr double kMetresPerDegree = 111'319.49;  // of longitude, on the equator

class WorldEntitiesTest : public ::testing::Test {
  protected:
    template <class... Packets>
    void say(const Packets&... packets) {
        cigi::IgControl control;
        control.ig_mode = bench_.mode;
        control.host_frame_number = ++bench_.frame;
        control.extrapolation_enable = gate_;
        control.timestamp_valid = stamped_;
        control.timestamp = static_cast<std::uint32_t>(std::lround(bench_.world.time_s() * 1e5));
        bench_.send_as(kHostA, control, packets...);
    }
    [[nodiscard]] static cigi::EntityControl entity(int id, double longitude_deg = 0.0) {
        cigi::EntityControl control;
        control.entity_id = static_cast<std::uint16_t>(id);
        control.entity_state = cigi::EntityState::kActive;
        control.extrapolation_enable = true;
        control.lon_y = longitude_deg;
        control.alt_z = 1000.0;
        control.yaw = 90.0F;
        return control;
    }
    /// Own axes.
    [[nodiscard]] static cigi::RateControl ahead(int id, float speed_m_s, float yaw_deg_s = 0.0F) {
        cigi::RateControl rates;
        rates.entity_id = static_cast<std::uint16_t>(id);
        rates.coordinate_system = true;
        rates.x_rate = speed_m_s;
        rates.yaw_rate = yaw_deg_s;
        return rates;
    }
    /// 10 Hz with a host that lives; drawn is the instant before the last frame's step.
    void run(double seconds) {
        const int frames = static_cast<int>(std::lround(seconds * 10.0));
        for (int i = 0; i < frames; ++i) {
            bench_.world.advance(0.1);
            say();
        }
    }
    [[nodiscard]] double drawn_east_m() const {
        return bench_.world.ownship().position.longitude_deg * kMetresPerDegree;
    }

    HostBench bench_;
    bool gate_ = true;
    bool stamped_ = true;
};

TEST_F(WorldEntitiesTest, RatesMoveTheOwnshipBetweenItsPositions) {
    say(entity(0), ahead(0, 100.0F));
    run(5.1);
    EXPECT_NEAR(drawn_east_m(), 500.0, 0.2);
    EXPECT_NEAR(bench_.world.ownship().position.height_m, 1000.0, 1e-6);
    // Another position moves it, the rates stay.
    say(entity(0, 1.0));
    run(2.1);
    EXPECT_NEAR(drawn_east_m(), kMetresPerDegree + 200.0, 0.3);
    // New rates alone go on from where it is.
    say(ahead(0, 10.0F));
    run(1.1);
    EXPECT_NEAR(drawn_east_m(), kMetresPerDegree + 220.0, 12.0);
    say(ahead(0, 0.0F));
    run(0.1);
    const Pose stood = bench_.world.ownship();
    run(60.0);
    EXPECT_EQ(static_cast<const Pose&>(bench_.world.ownship()), stood);
}

TEST_F(WorldEntitiesTest, RatesWaitForBothSmoothingBits) {
    gate_ = false;
    say(entity(0), ahead(0, 100.0F));
    run(1.0);
    EXPECT_EQ(drawn_east_m(), 0.0) << "IG Control says no";
    gate_ = true;
    cigi::EntityControl rough = entity(0);
    rough.extrapolation_enable = false;
    say(rough);
    run(1.0);
    EXPECT_EQ(drawn_east_m(), 0.0) << "the entity says no";
    say(entity(0));
    run(1.1);
    EXPECT_NEAR(drawn_east_m(), 100.0, 0.1);
    gate_ = false;
    say();
    run(0.1);
    const double stood_m = drawn_east_m();
    run(5.0);
    EXPECT_EQ(drawn_east_m(), stood_m);
}

TEST_F(WorldEntitiesTest, RatesNeedNoStamp) {
    stamped_ = false;
    say(entity(0), ahead(0, 100.0F));
    run(1.1);
    EXPECT_NEAR(drawn_east_m(), 100.0, 0.1);
}

TEST_F(WorldEntitiesTest, ALostHostsOwnshipIsHeldAndGoesOnWithIt) {
    say(entity(0), ahead(0, 100.0F));
    bench_.wait(20.0);
    const double lost_after_s = bench_.config.host.rights.lost_after_s;
    EXPECT_EQ(bench_.world.link().state, LinkState::kLost);
    EXPECT_NEAR(drawn_east_m(), 100.0 * lost_after_s, 100.0);
    const double held_m = drawn_east_m();
    say();
    run(1.1);
    EXPECT_NEAR(drawn_east_m(), held_m + 100.0, 15.0);
}

TEST_F(WorldEntitiesTest, StandbyForgetsRatesEntitiesAndEarth) {
    bench_.version = cigi::Version::k33;
    cigi::EarthModelDefinition sphere;
    sphere.custom_enable = true;
    sphere.equatorial_radius = 6'371'000.0;
    sphere.flattening = 0.0;
    say(entity(0), ahead(0, 100.0F), entity(7), sphere);
    EXPECT_TRUE(bench_.world.entity_pose(7));
    EXPECT_TRUE(bench_.world.earth().custom);
    bench_.mode = cigi::IgMode::kStandby;
    say();
    EXPECT_FALSE(bench_.world.entity_pose(7));
    EXPECT_FALSE(bench_.world.earth().custom);
    const Pose start = bench_.world.ownship();
    bench_.mode = cigi::IgMode::kOperate;
    say();
    run(3.0);
    EXPECT_EQ(static_cast<const Pose&>(bench_.world.ownship()), start);
}

TEST_F(WorldEntitiesTest, VelocityAndAccelerationOfCigi4) {
    bench_.version = cigi::Version::k40;
    cigi::EntityControl control = entity(0);
    cigi::EntityPosition place;
    place.alt_z = 1000.0;
    cigi::RateControl climb;
    climb.y_rate = 50.0F;  // east
    climb.z_rate = -10.0F;
    cigi::AccelerationControl push;
    push.z_acceleration = -2.0F;
    push.yaw_acceleration = 4.0F;
    say(control, place, climb, push);
    run(3.1);
    EXPECT_NEAR(drawn_east_m(), 150.0, 0.1);
    EXPECT_NEAR(bench_.world.ownship().position.height_m, 1000.0 + 30.0 + 9.0, 1e-6);
    EXPECT_NEAR(bench_.world.ownship().yaw_deg, 18.0, 1e-4);
}

TEST_F(WorldEntitiesTest, OtherEntitiesMoveToo) {
    cigi::EntityControl child = entity(9);
    child.attach_state = true;
    child.parent_id = 7;
    child.lat_x = 100.0;  // ahead of its parent
    child.lon_y = 0.0;
    child.alt_z = 0.0;
    child.yaw = 10.0F;
    say(entity(7), child, ahead(7, 20.0F));
    run(10.1);
    const auto parent = bench_.world.entity_pose(7);
    ASSERT_TRUE(parent);
    EXPECT_NEAR(parent->position.longitude_deg * kMetresPerDegree, 200.0, 0.1);
    const auto carried = bench_.world.entity_pose(9);
    ASSERT_TRUE(carried);
    EXPECT_NEAR(carried->position.longitude_deg * kMetresPerDegree, 300.0, 0.1);
    EXPECT_NEAR(carried->yaw_deg, 100.0, 0.01);
    // An inactive one is nowhere, and what it carries with it; one that is destroyed is forgotten.
    cigi::EntityControl sleeping = entity(9);
    sleeping.entity_state = cigi::EntityState::kInactive;
    cigi::EntityControl destroyed = entity(7);
    destroyed.entity_state = cigi::EntityState::kDestroyed;
    say(sleeping);
    EXPECT_FALSE(bench_.world.entity_pose(9));
    say(child, destroyed);
    EXPECT_FALSE(bench_.world.entity_pose(7));
    EXPECT_FALSE(bench_.world.entity_pose(9)) << "its parent is gone";
    EXPECT_EQ(bench_.world.ownship().placed_by_host, false);
}

TEST_F(WorldEntitiesTest, ChainsOfParentsEnd) {
    const auto attached = [](int id, int parent) {
        cigi::EntityControl control = entity(id);
        control.attach_state = true;
        control.parent_id = static_cast<std::uint16_t>(parent);
        control.lon_y = control.alt_z = 0.0;
        control.lat_x = 1.0;
        control.yaw = 0.0F;
        return control;
    };
    say(entity(0), attached(1, 2), attached(2, 1), attached(3, 3));
    EXPECT_FALSE(bench_.world.entity_pose(1));
    EXPECT_FALSE(bench_.world.entity_pose(3));
    say(attached(1, 0));
    run(0.1);
    for (int id = 2; id <= 9; ++id)
        say(attached(id, id - 1));
    const auto deepest = bench_.world.entity_pose(8);
    ASSERT_TRUE(deepest);
    EXPECT_NEAR(deepest->position.longitude_deg * kMetresPerDegree, 8.0, 0.01) << "the ownship looks east";
    EXPECT_FALSE(bench_.world.entity_pose(9)) << "deeper than is followed";
    cigi::EntityControl far = attached(5, 0);
    far.lat_x = 1e9;
    say(far);
    EXPECT_EQ(bench_.world.counters().position_refused, 1U);
}

TEST_F(WorldEntitiesTest, WhatIsRefusedIsCounted) {
    say(entity(0));
    cigi::RateControl part = ahead(0, 10.0F);
    part.apply_to_part = true;
    cigi::RateControl wild = ahead(0, 1e6F);
    say(part, wild, ahead(44, 10.0F));
    EXPECT_EQ(bench_.world.counters().rate_refused, 2U);
    EXPECT_EQ(bench_.world.counters().entity_unknown, 1U);
    run(1.0);
    EXPECT_EQ(drawn_east_m(), 0.0);
    cigi::EntityControl space = entity(5);
    space.alt_z = 1e12;
    say(space);
    EXPECT_EQ(bench_.world.counters().position_refused, 1U);
    for (int id = 100; id < 100 + static_cast<int>(EntityStore::kMost); ++id)
        say(entity(id));
    EXPECT_EQ(bench_.world.counters().entity_full, 1U) << "5 has its place";
    cigi::EarthModelDefinition moon;
    moon.custom_enable = true;
    moon.equatorial_radius = 1'738'100.0;
    cigi::EarthModelDefinition flat = moon;
    flat.equatorial_radius = 6'378'137.0;
    flat.flattening = 0.01;
    say(moon, flat);
    EXPECT_EQ(bench_.world.counters().earth_refused, 2U);
    EXPECT_FALSE(bench_.world.earth().custom);
    EXPECT_EQ(bench_.lines_with("Earth model"), 1U);
}

TEST_F(WorldEntitiesTest, EarthModelIsTakenAndGivenBack) {
    cigi::EarthModelDefinition bessel;
    bessel.custom_enable = true;
    bessel.equatorial_radius = 6'377'397.155;
    bessel.flattening = 1.0 / 299.1528128;
    say(bessel, entity(0, 3.0));
    EXPECT_TRUE(bench_.world.earth().custom);
    EXPECT_EQ(bench_.world.earth().equatorial_radius_m, 6'377'397.155);
    EXPECT_EQ(bench_.world.ownship().position, (ephemeris::Geodetic{0.0, 3.0, 1000.0}));
    say(cigi::EarthModelDefinition{});
    EXPECT_FALSE(bench_.world.earth().custom);
}

TEST_F(WorldEntitiesTest, WhatIsClampedRidesOnTheSea) {
    cigi::MaritimeSurfaceControl tide;
    tide.enable = true;
    tide.sea_surface_height = 2.0F;
    cigi::ConformalClamped ship;
    ship.latitude = 50.0;
    ship.longitude = -3.0;
    ship.yaw = 200.0F;
    cigi::ConformalClamped other = ship;
    other.entity_id = 4;
    cigi::EntityControl tilted = entity(0);
    tilted.roll = 20.0F;
    say(tide, tilted, ship, other);
    const Ownship& ownship = bench_.world.ownship();
    EXPECT_EQ(ownship.position, (ephemeris::Geodetic{50.0, -3.0, 2.0}));
    EXPECT_EQ(ownship.yaw_deg, 200.0);
    EXPECT_EQ(ownship.roll_deg, 0.0);
    EXPECT_EQ(bench_.world.entity_pose(4)->position.height_m, 2.0);
    tide.sea_surface_height = -1.0F;
    say(tide);
    run(0.1);
    EXPECT_EQ(ownship.position.height_m, -1.0);
    say(entity(0));
    run(0.1);
    EXPECT_EQ(ownship.position.height_m, 1000.0) << "placed freely, it leaves the sea";
    tide.sea_surface_height = 3e38F;
    say(tide, ship);
    run(0.1);
    EXPECT_EQ(ownship.position.height_m, ephemeris::kMaxEyeHeight_m) << "no sea stands higher than is drawn";
}

TEST_F(WorldEntitiesTest, ADestroyedOwnshipStaysWhereItWas) {
    cigi::EntityControl control = entity(0);
    say(control, ahead(0, 100.0F));
    run(1.0);
    control.entity_state = cigi::EntityState::kDestroyed;
    say(control);
    run(0.1);
    const ephemeris::Geodetic last = bench_.world.ownship().position;
    run(5.0);
    EXPECT_EQ(bench_.world.ownship().position, last);
}

}  // namespace
}  // namespace skyig::server::world
