// A CANaerospace bus in the world: places and attitudes put together from single frames, time, weather.
#include "server/bus_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "server/clock.h"

namespace skyig::server {
namespace {

using protocol::canaerospace::DataType;
using ::testing::HasSubstr;

constexpr std::int64_t kMs = 1'000'000;

config::Config with_bus() {
    config::Config config = config::default_config();
    config.start.utc = config::UtcDateTime{2026, 6, 21, 12, 0, 0.0};
    config.host.enabled = false;
    config::Source& bus = config.sources.emplace_back();
    bus.name = "bus";
    bus.kind = config::SourceKind::kCanAerospace;
    bus.interface = "can0";
    bus.rights.owns.reset(static_cast<std::size_t>(config::Aspect::kControl));
    return config;
}

class BusInputTest : public ::testing::Test {
  protected:
    void data(std::uint32_t id, DataType type, std::initializer_list<std::uint8_t> bytes,
              std::uint8_t service = 0) {
        protocol::CanFrame frame;
        frame.received_ns = now_ns_;
        frame.id = id;
        frame.length = static_cast<std::uint8_t>(4 + bytes.size());
        frame.data[0] = 1;
        frame.data[1] = static_cast<std::uint8_t>(type);
        frame.data[2] = service;
        frame.data[3] = codes_[id]++;
        std::copy(bytes.begin(), bytes.end(), frame.data.begin() + 4);
        bus_.take(frame);
    }
    void real(std::uint32_t id, double value, std::uint8_t service = 0) {
        word(id, DataType::kFloat, std::bit_cast<std::uint32_t>(static_cast<float>(value)), service);
    }
    void word(std::uint32_t id, DataType type, std::uint32_t bits, std::uint8_t service = 0) {
        data(id, type,
             {static_cast<std::uint8_t>(bits >> 24U), static_cast<std::uint8_t>(bits >> 16U),
              static_cast<std::uint8_t>(bits >> 8U), static_cast<std::uint8_t>(bits)},
             service);
    }
    void degrees(std::uint32_t id, double value_deg) {
        word(id, DataType::kLong,
             static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(value_deg * 1e7))));
    }
    void wait_ms(std::int64_t ms) {
        now_ns_ += ms * kMs;
        world_.advance(static_cast<double>(ms) * 1e-3);
    }

    config::Config config_ = with_bus();
    ManualClock clock_;
    Log log_{clock_, [](Severity, std::string_view) {}};
    world::World world_{config_, ephemeris::parse_utc("2026-06-21T12:00:00Z").value(), log_};
    BusInput bus_{1, identifier_map(config_.sources[0]), world_};
    std::int64_t now_ns_ = 1'700'000'000'000'000'000;
    std::array<std::uint8_t, 2048> codes_{};
};

TEST_F(BusInputTest, PlaceIsTakenWhenBothOfItsHalvesAreNew) {
    real(1038, 1500.0);
    degrees(1036, 47.5);
    EXPECT_FALSE(world_.ownship().placed_by_host);
    degrees(1037, 8.5);
    EXPECT_NEAR(world_.ownship().position.latitude_deg, 47.5, 1e-9);
    EXPECT_NEAR(world_.ownship().position.longitude_deg, 8.5, 1e-9);
    EXPECT_EQ(world_.ownship().position.height_m, 1500.0);
    // A new latitude alone waits for its longitude.
    wait_ms(10);
    degrees(1036, 47.6);
    EXPECT_NEAR(world_.ownship().position.latitude_deg, 47.5, 1e-9);
    degrees(1037, 8.6);
    EXPECT_NEAR(world_.ownship().position.latitude_deg, 47.6, 1e-9);
}

TEST_F(BusInputTest, InsLeadsUntilItIsStaleThenGpsCounts) {
    real(1051, 100.0);
    real(1038, 200.0);
    for (int i = 0; i < 3; ++i) {
        degrees(1049, 10.0);
        degrees(1050, 20.0);
        degrees(1036, 11.0);
        degrees(1037, 21.0);
        wait_ms(100);
    }
    EXPECT_NEAR(world_.ownship().position.latitude_deg, 10.0, 1e-6);
    for (int i = 0; i < 8; ++i) {
        degrees(1036, 11.0);
        degrees(1037, 21.0);
        real(1038, 200.0);
        wait_ms(100);
    }
    EXPECT_NEAR(world_.ownship().position.latitude_deg, 11.0, 1e-6);
    EXPECT_NEAR(world_.ownship().position.height_m, 200.0, 1e-3);
}

TEST_F(BusInputTest, AttitudeIsTakenWholeWithTheBestHeading) {
    real(311, 5.0);
    real(312, -20.0);
    EXPECT_EQ(world_.ownship().roll_deg, 0.0);
    real(1121, 3.0);
    real(1069, 90.0);
    EXPECT_EQ(world_.ownship().yaw_deg, 93.0);
    EXPECT_EQ(world_.ownship().roll_deg, -20.0);
    wait_ms(10);
    real(1133, -100.0);
    real(311, 5.0);
    real(312, -20.0);
    EXPECT_EQ(world_.ownship().yaw_deg, -100.0);
    // Magnetic heading goes on, and does not count while a true one is fresh.
    wait_ms(10);
    real(1069, 91.0);
    real(311, 6.0);
    real(312, -20.0);
    EXPECT_EQ(world_.ownship().pitch_deg, 5.0);
}

TEST_F(BusInputTest, PlaceIsCarriedOnBetweenFrames) {
    for (int i = 0; i < 10; ++i) {
        degrees(1036, 0.0);
        degrees(1037, 0.0001 * i);
        wait_ms(100);
    }
    wait_ms(50);
    EXPECT_NEAR(world_.ownship().position.longitude_deg, 0.0001 * 10, 2e-6);
}

TEST_F(BusInputTest, TimeAndDateSetTheClockOnceBothHaveCome) {
    data(1200, DataType::kChar4, {13, 43, 22, 0});
    EXPECT_EQ(ephemeris::to_iso(world_.clock().utc()), "2026-06-21T12:00:00Z");
    data(1206, DataType::kChar4, {12, 6, 19, 87});
    EXPECT_EQ(ephemeris::to_iso(world_.clock().utc()), "1987-06-12T13:43:22Z");
    EXPECT_TRUE(world_.clock().running());
    real(1871, 0.0);
    EXPECT_FALSE(world_.clock().running());
}

TEST_F(BusInputTest, WeatherCountsWhenItIsCommitted) {
    real(1840, 1200.0);
    real(1844, 278.15);
    real(1850, 500.0, 2);
    real(1851, 900.0, 2);
    data(1852, DataType::kUChar, {6}, 2);
    data(1853, DataType::kUChar, {9}, 2);
    EXPECT_EQ(world_.air().visibility_m, 80000.0);
    EXPECT_TRUE(world_.weather().layers().empty());
    data(1880, DataType::kNoData, {});
    EXPECT_EQ(world_.air().visibility_m, 1200.0);
    EXPECT_NEAR(world_.air().temperature_c, 5.0, 1e-4);
    ASSERT_EQ(world_.weather().layers().size(), 1U);
    const auto& layer = world_.weather().layers()[0];
    EXPECT_EQ(layer.layer_id, 3);
    EXPECT_EQ(layer.base_elevation, 500.0F);
    EXPECT_EQ(layer.thickness, 400.0F);
    EXPECT_EQ(layer.coverage, 75.0F);
    EXPECT_TRUE(layer.weather_enable);
    data(1856, DataType::kUChar, {0}, 2);
    data(1880, DataType::kNoData, {});
    EXPECT_FALSE(world_.weather().layers()[0].weather_enable);
}

TEST_F(BusInputTest, ValuesThatNoSkyHasAreRefusedAndTheRestStands) {
    degrees(1036, 47.5);
    degrees(1037, 8.5);
    real(1843, 1e6);
    real(1840, 5000.0);
    data(1880, DataType::kNoData, {});
    EXPECT_EQ(world_.air().visibility_m, 5000.0);
    EXPECT_EQ(world_.air().pressure_hpa, 1013.25);
    EXPECT_EQ(world_.counters().air_refused, 1U);
}

TEST(BusIdentifiers, AreMovedByName) {
    config::Config config = with_bus();
    config.sources[0].identifiers = {{"gps_latitude", 1500}, {"visibility", 1889}};
    const auto map = identifier_map(config.sources[0]);
    EXPECT_EQ(map[protocol::canaerospace::Parameter::kGpsLatitude].id, 1500);
    EXPECT_EQ(map[protocol::canaerospace::Parameter::kVisibility].id, 1889);
    EXPECT_EQ(map[protocol::canaerospace::Parameter::kGpsLongitude].id, 1037);
}

TEST(BusIdentifiers, UnknownNameAndDoubleUseAreToldInOneLine) {
    config::Config config = with_bus();
    config.sources[0].identifiers = {{"lattitude", 1500}};
    try {
        (void)identifier_map(config.sources[0]);
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("source bus: identifiers.lattitude: no parameter has this name"));
    }
    EXPECT_THAT(identifier_fault(config), HasSubstr("identifiers.lattitude"));
    config.sources[0].identifiers = {{"gps_latitude", 1037}};
    EXPECT_THAT(identifier_fault(config), HasSubstr("GPS longitude"));
    EXPECT_THROW((void)identifier_map(config.sources[0]), std::runtime_error);
}

}  // namespace
}  // namespace skyig::server
