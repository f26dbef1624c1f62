// Refused, wrapped, clamped or left alone: each rule with a value at the edge and one beyond it.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "protocol/cigi/layout_host.h"
#include "protocol/cigi/layout_ig.h"
#include "protocol/cigi/layout_sight.h"
#include "protocol/cigi/validate.h"

namespace skyig::protocol::cigi {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class P>
Verdict verdict_of(P packet, Version version = Version::k33) {
    return validate(packet, version);
}

template <class P>
void expect_refused(const P& packet, Count reason, std::string_view field, Version version = Version::k33) {
    const Verdict verdict = verdict_of(packet, version);
    EXPECT_FALSE(verdict.accepted);
    EXPECT_EQ(verdict.reason, reason);
    EXPECT_EQ(verdict.field, field);
}

EntityControl at_zurich() {
    return {.entity_state = EntityState::kActive, .lat_x = 47.0, .lon_y = 8.0, .alt_z = 400.0};
}

EnvRegionControl some_region() {
    return {.region_state = RegionState::kActive, .size_x = 100.0F, .size_y = 50.0F};
}

CelestialSphereControl some_noon() {
    return {.hour = 12, .date_time_valid = true, .date = 6212026};
}

template <std::size_t I = 0>
void each_float_of_every_packet(int& fields) {
    if constexpr (I < kPacketKinds) {
        using P = std::tuple_element_t<I, AllPackets>;
        for_each_field<P>([&fields](const auto& field) {
            using Value = typename std::decay_t<decltype(field)>::Value;
            if constexpr (std::is_floating_point_v<Value>) {
                for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
                    P packet{};
                    packet.*(field.member) = static_cast<Value>(bad);
                    const Version version = field.place(Version::k33).present ? Version::k33 : Version::k40;
                    const Verdict verdict = validate(packet, version);
                    // Either the packet goes, or the field did not count and is empty now.
                    EXPECT_TRUE(verdict.accepted ? std::isfinite(packet.*(field.member))
                                                 : verdict.reason == Count::kNonfinite ||
                                                       verdict.reason == Count::kOutOfRange)
                        << Layout<P>::kName << "." << field.name;
                }
                ++fields;
            }
        });
        each_float_of_every_packet<I + 1>(fields);
    }
}

TEST(Validate, NoNanOrInfinityPassesInAnyFieldOfAnyPacket) {
    int fields = 0;
    each_float_of_every_packet(fields);
    std::printf("%d fields\n", fields);
    EXPECT_GE(fields, 80);
}

TEST(Validate, NanRefusesThePacketAndNamesTheField) {
    EntityControl entity = at_zurich();
    entity.pitch = kNan;
    expect_refused(entity, Count::kNonfinite, "pitch");
    entity = at_zurich();
    entity.alt_z = kInfinity;
    expect_refused(entity, Count::kNonfinite, "alt_z");
}

TEST(Validate, WhatIsNoNumberIsToldBeforeWhatIsOutOfRange) {
    EnvRegionControl region = some_region();
    region.latitude = 95.0;
    expect_refused(region, Count::kOutOfRange, "latitude");
    region.rotation = kNan;
    expect_refused(region, Count::kNonfinite, "rotation");
}

TEST(Validate, AFieldWhoseEnableBitIsOffIsNotChecked) {
    ViewControl view{.x_enable = true, .x_offset = 1.0F, .y_offset = kNan};
    ASSERT_TRUE(validate(view, Version::k33).accepted);
    EXPECT_EQ(view.y_offset, 0.0F);
    view = {.x_enable = true, .x_offset = kNan};
    expect_refused(view, Count::kNonfinite, "x_offset");
    EXPECT_TRUE(verdict_of(ViewDefinition{.left_enable = true, .left = -30.0F, .right = -40.0F}).accepted);
    EXPECT_TRUE(verdict_of(CelestialSphereControl{.hour = 99, .date = 99999999}).accepted);
}

TEST(Validate, LatitudeBeyondThePoleIsRefusedUnlessItIsAnOffset) {
    for (const double latitude : {-90.0, 90.0}) {
        EntityControl entity = at_zurich();
        entity.lat_x = latitude;
        EXPECT_TRUE(verdict_of(entity).accepted);
        entity.lat_x = std::nextafter(latitude, 2 * latitude);
        expect_refused(entity, Count::kOutOfRange, "lat_x");
        entity.attach_state = true;
        EXPECT_TRUE(verdict_of(entity).accepted);
    }
    expect_refused(EntityPosition{.lat_x = 91.0}, Count::kOutOfRange, "lat_x", Version::k40);
    expect_refused(HatHotRequest{.lat_x = 91.0}, Count::kOutOfRange, "lat_x");
    EXPECT_TRUE(verdict_of(HatHotRequest{.coordinate_system = true, .lat_x = 91.0}).accepted);
    expect_refused(EnvConditionsRequest{.request_type = 4, .latitude = -91.0}, Count::kOutOfRange,
                   "latitude");
}

TEST(Validate, LongitudeIsWrappedWithinTwoTurns) {
    const struct {
        double in, out;
    } rows[] = {{180.0, 180.0}, {-180.0, -180.0}, {190.0, -170.0}, {-190.0, 170.0},
                {360.0, 0.0},   {719.0, -1.0},    {-720.0, 0.0},   {8.5, 8.5}};
    for (const auto& row : rows) {
        EntityControl entity = at_zurich();
        entity.lon_y = row.in;
        ASSERT_TRUE(validate(entity, Version::k33).accepted);
        EXPECT_DOUBLE_EQ(entity.lon_y, row.out) << row.in;
    }
    EntityControl entity = at_zurich();
    entity.lon_y = 720.5;
    expect_refused(entity, Count::kOutOfRange, "lon_y");
}

TEST(Validate, AnglesAreWrappedAndNeverClamped) {
    EntityControl entity = at_zurich();
    entity.yaw = -60.0F;
    entity.pitch = 120.0F;
    entity.roll = -350.0F;
    ASSERT_TRUE(validate(entity, Version::k33).accepted);
    EXPECT_EQ(entity.yaw, 300.0F);
    EXPECT_EQ(entity.pitch, 120.0F);
    EXPECT_EQ(entity.roll, 10.0F);
    entity.yaw = 721.0F;
    expect_refused(entity, Count::kOutOfRange, "yaw");
    AtmosphereControl air{.wind_direction = -45.0F};
    ASSERT_TRUE(validate(air, Version::k33).accepted);
    EXPECT_EQ(air.wind_direction, 315.0F);
}

TEST(Validate, WrappedAnglesKeepTheirDirectionToTheLastBit) {
    double worst_deg = 0.0;
    for (int i = -7200; i <= 7200; ++i) {
        const float in = static_cast<float>(i) * 0.1F;
        EntityControl entity = at_zurich();
        entity.yaw = in;
        ASSERT_TRUE(validate(entity, Version::k33).accepted);
        EXPECT_GE(entity.yaw, 0.0F);
        EXPECT_LE(entity.yaw, 360.0F);
        worst_deg = std::max(
            worst_deg,
            std::abs(std::remainder(static_cast<double>(entity.yaw) - static_cast<double>(in), 360.0)));
    }
    std::printf("largest error of a wrapped heading: %.3g deg\n", worst_deg);
    EXPECT_LE(worst_deg, 1.6e-5);  // half a unit in the last place of 360
}

TEST(Validate, PercentagesAreClamped) {
    AtmosphereControl air{.humidity = 200};
    EXPECT_TRUE(validate(air, Version::k33).clamped);
    EXPECT_EQ(air.humidity, 100);
    WeatherControl layer{.coverage = -3.0F};
    EXPECT_TRUE(validate(layer, Version::k40).clamped);
    EXPECT_EQ(layer.coverage, 0.0F);
    EXPECT_FALSE(verdict_of(WeatherControl{.coverage = 100.0F}).clamped);
    CelestialSphereControl sky{.star_intensity = 250.0F};
    EXPECT_TRUE(validate(sky, Version::k33).clamped);
    EXPECT_EQ(sky.star_intensity, 100.0F);
}

TEST(Validate, TimeOfDayStaysInTheDay) {
    CelestialSphereControl sky = some_noon();
    sky.hour = 23;
    sky.minute = 59;
    sky.seconds = 59.99F;
    EXPECT_TRUE(verdict_of(sky, Version::k40).accepted);
    sky.seconds = 60.0F;
    expect_refused(sky, Count::kOutOfRange, "seconds", Version::k40);
    sky.seconds = -0.5F;
    expect_refused(sky, Count::kOutOfRange, "seconds", Version::k40);
    sky = some_noon();
    sky.minute = 60;
    expect_refused(sky, Count::kOutOfRange, "minute");
    sky = some_noon();
    sky.hour = 24;
    expect_refused(sky, Count::kOutOfRange, "hour");
}

TEST(Validate, SecondsSentAsAnIntegerAreMended) {
    for (std::uint32_t second = 0; second < 60; ++second) {
        CelestialSphereControl sky = some_noon();
        sky.seconds = std::bit_cast<float>(second);
        ASSERT_TRUE(validate(sky, Version::k40).accepted);
        EXPECT_EQ(sky.seconds, static_cast<float>(second));
    }
    CelestialSphereControl sky = some_noon();
    sky.seconds = std::bit_cast<float>(std::uint32_t{60});
    expect_refused(sky, Count::kOutOfRange, "seconds", Version::k40);
}

TEST(Validate, DatesAreDaysOfTheCalendar) {
    const struct {
        std::uint32_t date;
        bool good;
    } rows[] = {{6212026, true},   {12312026, true},   {2292024, true},  {2292023, false}, {2292000, true},
                {2291900, false},  {2292100, false},   {2302024, false}, {4312026, false}, {13012026, false},
                {12026, false},    {1002026, false},   {1010000, true},  {12319999, true}, {0, false},
                {99999999, false}, {4294967295, false}};
    for (const auto& row : rows) {
        CelestialSphereControl sky = some_noon();
        sky.date = row.date;
        EXPECT_EQ(verdict_of(sky).accepted, row.good) << row.date;
        Date date;
        ASSERT_EQ(parse_date(row.date, date), row.good) << row.date;
        if (row.good) {
            EXPECT_EQ(make_date(date), row.date);
        }
    }
}

TEST(Validate, NegativeVisibilityIsRefused) {
    EXPECT_TRUE(verdict_of(AtmosphereControl{.visibility = 0.0F}).accepted);
    expect_refused(AtmosphereControl{.visibility = -1.0F}, Count::kOutOfRange, "visibility");
    expect_refused(WeatherControl{.visibility = -1.0F}, Count::kOutOfRange, "visibility");
}

TEST(Validate, AFrustumNeedsAVolume) {
    const ViewDefinition good{.near_enable = true,
                              .far_enable = true,
                              .left_enable = true,
                              .right_enable = true,
                              .top_enable = true,
                              .bottom_enable = true,
                              .near = 0.1F,
                              .far = 10.0F,
                              .left = -30.0F,
                              .right = 30.0F,
                              .top = 20.0F,
                              .bottom = -20.0F};
    EXPECT_TRUE(verdict_of(good).accepted);
    ViewDefinition view = good;
    view.left = 30.0F;
    expect_refused(view, Count::kOutOfRange, "left");
    view = good;
    view.bottom = 20.0F;
    expect_refused(view, Count::kOutOfRange, "bottom");
    view = good;
    view.near = 0.0F;
    expect_refused(view, Count::kOutOfRange, "near");
    view = good;
    view.far = 0.1F;
    expect_refused(view, Count::kOutOfRange, "far");
    view = good;
    view.right = 90.5F;
    expect_refused(view, Count::kOutOfRange, "right");
}

TEST(Validate, RegionsHaveASizeUnlessTheyAreDestroyed) {
    EXPECT_TRUE(verdict_of(some_region()).accepted);
    EnvRegionControl region = some_region();
    region.size_x = 0.0F;
    expect_refused(region, Count::kOutOfRange, "size_x");
    region.region_state = RegionState::kDestroyed;
    EXPECT_TRUE(verdict_of(region).accepted);
    region = some_region();
    region.corner_radius = 40.0F;
    EXPECT_TRUE(validate(region, Version::k33).clamped);
    EXPECT_EQ(region.corner_radius, 25.0F);
}

TEST(Validate, EnumerationsEndAtTheirLastValue) {
    expect_refused(IgControl{.ig_mode = IgMode::kOfflineMaintenance}, Count::kOutOfRange, "ig_mode");
    expect_refused(IgControl{.database_number = -1}, Count::kOutOfRange, "database_number");
    expect_refused(EntityControl{.entity_state = EntityState{3}}, Count::kOutOfRange, "entity_state");
    expect_refused(EntityPosition{.ground_clamp = GroundClamp{3}}, Count::kOutOfRange, "ground_clamp",
                   Version::k40);
    expect_refused(EnvRegionControl{.region_state = RegionState{3}}, Count::kOutOfRange, "region_state");
    expect_refused(WeatherControl{.scope = WeatherScope{3}}, Count::kOutOfRange, "scope");
    expect_refused(WeatherControl{.severity = 6}, Count::kOutOfRange, "severity");
    expect_refused(ComponentControl{.component_class = ComponentClass{16}}, Count::kOutOfRange,
                   "component_class");
    expect_refused(HatHotRequest{.request_type = HatHotType{3}}, Count::kOutOfRange, "request_type");
    expect_refused(PositionRequest{.object_class = 5}, Count::kOutOfRange, "object_class");
    expect_refused(EnvConditionsRequest{.request_type = 0}, Count::kOutOfRange, "request_type");
    EXPECT_TRUE(
        verdict_of(StartOfFrame{.database_number = -128, .ig_mode = IgMode::kOfflineMaintenance}).accepted);
}

TEST(Validate, OneBandOf33StandsForBothSides) {
    WeatherControl layer{.scud_enable = true, .scud_frequency = 30.0F, .transition_band = 80.0F};
    WeatherControl newer = layer;
    ASSERT_TRUE(validate(layer, Version::k33).accepted);
    EXPECT_EQ(layer.top_transition_band, 80.0F);
    EXPECT_EQ(layer.top_scud_frequency, 30.0F);
    EXPECT_TRUE(layer.top_scud_enable);
    ASSERT_TRUE(validate(newer, Version::k40).accepted);
    EXPECT_EQ(newer.top_transition_band, 0.0F);
}

TEST(Validate, AWaveNeedsALengthAndAPeriodOnlyWhileItIsOn) {
    const WaveControl good{.wave_enable = true, .height = 1.0F, .wavelength = 50.0F, .period = 6.0F};
    EXPECT_TRUE(verdict_of(good).accepted);
    WaveControl wave = good;
    wave.wavelength = 0.0F;
    expect_refused(wave, Count::kOutOfRange, "wavelength");
    wave = good;
    wave.period = 0.0F;
    expect_refused(wave, Count::kOutOfRange, "period");
    wave = good;
    wave.height = -0.1F;
    expect_refused(wave, Count::kOutOfRange, "height", Version::k40);
    EXPECT_TRUE(verdict_of(WaveControl{}).accepted);
    expect_refused(WaveControl{.breaker_type = BreakerType{3}}, Count::kOutOfRange, "breaker_type");
    expect_refused(WaveControl{.scope = WeatherScope{3}}, Count::kOutOfRange, "scope");
}

TEST(Validate, WaveAnglesAreWrappedIntoTheirOwnBounds) {
    WaveControl wave{.direction = -90.0F, .phase_offset = -360.0F, .leading = 200.0F};
    ASSERT_TRUE(validate(wave, Version::k33).accepted);
    EXPECT_EQ(wave.direction, 270.0F);
    EXPECT_EQ(wave.phase_offset, -360.0F);
    EXPECT_EQ(wave.leading, -160.0F);
    wave.phase_offset = 400.0F;
    ASSERT_TRUE(validate(wave, Version::k33).accepted);
    EXPECT_EQ(wave.phase_offset, 40.0F);
    expect_refused(WaveControl{.phase_offset = 721.0F}, Count::kOutOfRange, "phase_offset");
}

TEST(Validate, SurfacesKeepTheirRanges) {
    MaritimeSurfaceControl sea{.clarity = 120.0F};
    EXPECT_TRUE(validate(sea, Version::k33).clamped);
    EXPECT_EQ(sea.clarity, 100.0F);
    expect_refused(MaritimeSurfaceControl{.scope = WeatherScope{3}}, Count::kOutOfRange, "scope");
    expect_refused(MaritimeSurfaceControl{.water_temperature = kNan}, Count::kNonfinite, "water_temperature");
    TerrestrialSurfaceControl land{.severity = 31, .coverage = 101};
    EXPECT_TRUE(validate(land, Version::k40).clamped);
    EXPECT_EQ(land.coverage, 100);
    expect_refused(TerrestrialSurfaceControl{.scope = WeatherScope{3}}, Count::kOutOfRange, "scope");
    expect_refused(ConformalClamped{.latitude = 90.5}, Count::kOutOfRange, "latitude");
    expect_refused(RateControl{.yaw_rate = kNan}, Count::kNonfinite, "yaw_rate");
    EXPECT_TRUE(verdict_of(RateControl{.roll_rate = -900.0F}).accepted);
}

TEST(Validate, AnEarthModelCountsOnlyWhileItIsCustom) {
    EarthModelDefinition earth{.equatorial_radius = kInfinity, .flattening = -5.0};
    ASSERT_TRUE(validate(earth, Version::k33).accepted);
    EXPECT_EQ(earth.equatorial_radius, 6378137.0);
    EXPECT_TRUE(verdict_of(EarthModelDefinition{.custom_enable = true}).accepted);
    expect_refused(EarthModelDefinition{.custom_enable = true, .equatorial_radius = 0.0}, Count::kOutOfRange,
                   "equatorial_radius");
    expect_refused(EarthModelDefinition{.custom_enable = true, .flattening = 1.0}, Count::kOutOfRange,
                   "flattening");
}

}  // namespace
}  // namespace skyig::protocol::cigi
