// In steady state neither a packet nor a frame allocates, whatever the host sends. Every operator new of this
// program is counted.
#include <gtest/gtest.h>

#include <cstdio>

#include "server/scene_builder.h"
#include "tests/server/world/host_bench.h"
#include "tests/support/allocation_count.h"

namespace skyig::server {
namespace {

namespace cigi = protocol::cigi;

/// A frame's worth of everything, with faults: other entities, unknown views, values out of range, a second
/// host.
void send_all(world::HostBench& bench, int frame) {
    cigi::EntityControl ownship, traffic, attached;
    ownship.entity_state = traffic.entity_state = attached.entity_state = cigi::EntityState::kActive;
    ownship.lat_x = 47.0 + frame * 1e-5;
    ownship.alt_z = 1000.0;
    ownship.roll = static_cast<float>(frame % 90);
    traffic.entity_id = 3;
    attached.attach_state = true;
    cigi::CelestialSphereControl sky;
    sky.hour = 18;
    sky.minute = static_cast<std::uint8_t>(frame / 60 % 60);
    sky.date = 6212026;
    sky.date_time_valid = sky.ephemeris_enable = sky.sun_enable = sky.moon_enable = sky.star_enable = true;
    sky.star_intensity = 100.0F;
    cigi::AtmosphereControl air;
    air.visibility = static_cast<float>(1000 + frame);
    air.pressure = 0.0F;
    cigi::WeatherControl layer;
    layer.layer_id = static_cast<std::uint8_t>(frame);
    layer.weather_enable = frame % 5 != 0;
    layer.cloud_type = cigi::CloudType::kCumulus;
    layer.scope = frame % 2 == 0 ? cigi::WeatherScope::kGlobal : cigi::WeatherScope::kRegional;
    layer.entity_region_id = static_cast<std::uint16_t>(frame % 300);
    layer.coverage = static_cast<float>(frame % 100);
    layer.thickness = 500.0F;
    cigi::EnvRegionControl region;
    region.region_id = static_cast<std::uint16_t>(frame % 300);
    region.region_state = frame % 7 == 0 ? cigi::RegionState::kDestroyed : cigi::RegionState::kActive;
    region.size_x = region.size_y = 1000.0F;
    cigi::ViewControl turn, unknown, group;
    turn.view_id = 2;
    turn.yaw_enable = turn.x_enable = true;
    turn.yaw = static_cast<float>(frame % 360);
    turn.x_offset = 3.0F;
    unknown.view_id = 500;
    group.group_id = 9;
    group.pitch_enable = true;
    cigi::ViewDefinition mirror;
    mirror.view_id = 1;
    mirror.mirror_mode = 1;
    bench.send(world::kHostA, ownship, traffic, attached, sky, air, layer, region, turn, unknown, group,
               mirror);
    --bench.frame;
    bench.send({0xC0A8640A, 50123}, ownship);
}

TEST(SteadyState, NeitherPacketsNorFramesAllocate) {
    world::HostBench bench;
    SceneBuilder builder;
    double sum = 0.0;
    const auto run = [&](int from, int to) {
        for (int frame = from; frame < to; ++frame) {
            send_all(bench, frame);
            bench.world.advance(1.0 / 60.0);
            sum += builder.build(bench.world, static_cast<std::uint64_t>(frame)).sun.direction_enu.z;
        }
    };
    run(0, 200);  // first lines of the log, first regions
    const std::uint64_t before = skyig::tests::allocation_count();
    run(200, 1200);
    const std::uint64_t made = skyig::tests::allocation_count() - before;
    std::printf("  %llu allocations in 1000 frames with 14 packets each; checksum %.3f\n",
                static_cast<unsigned long long>(made), sum);
    EXPECT_EQ(made, 0U);
    EXPECT_EQ(bench.world.counters().second_host, 1200U);
    EXPECT_GT(before, 0U) << "the count does not work";
}

}  // namespace
}  // namespace skyig::server
