#include "tests/support/cockpit_traffic.h"

#include <bit>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "protocol/cigi/message.h"

namespace skyig::tests {

namespace cigi = protocol::cigi;

namespace {

constexpr double kTurn_rad_s = 0.05;
constexpr double kSpeed_m_s = 90.0;
constexpr double kMetresPerDegree = 111'120.0;

/// A turn with the waves of a light wind.
struct Flight {
    double yaw_deg, pitch_deg, roll_deg;
    double yaw_rate_deg_s, pitch_rate_deg_s, roll_rate_deg_s;
    double latitude_deg, longitude_deg, height_m;
    double east_m_s, north_m_s, up_m_s;
};

Flight flight_at(double time_s) {
    constexpr double kDeg = 180.0 / std::numbers::pi;
    const double course_rad = kTurn_rad_s * time_s;
    const double radius_m = kSpeed_m_s / kTurn_rad_s;
    Flight flight{};
    flight.yaw_deg = std::fmod(course_rad * kDeg, 360.0);
    flight.yaw_rate_deg_s = kTurn_rad_s * kDeg;
    flight.pitch_deg = 3.0 + 2.0 * std::sin(0.7 * time_s);
    flight.pitch_rate_deg_s = 1.4 * std::cos(0.7 * time_s);
    flight.roll_deg = 25.0 + 4.0 * std::sin(1.1 * time_s);
    flight.roll_rate_deg_s = 4.4 * std::cos(1.1 * time_s);
    flight.north_m_s = kSpeed_m_s * std::cos(course_rad);
    flight.east_m_s = kSpeed_m_s * std::sin(course_rad);
    flight.up_m_s = 2.0 * std::cos(0.1 * time_s);
    flight.latitude_deg = 47.0 + radius_m * std::sin(course_rad) / kMetresPerDegree;
    flight.longitude_deg =
        8.0 + radius_m * (1.0 - std::cos(course_rad)) / (kMetresPerDegree * std::cos(47.0 / kDeg));
    flight.height_m = 1500.0 + 20.0 * std::sin(0.1 * time_s);
    return flight;
}

struct Calendar {
    std::uint8_t day, month;
    int year;
    std::uint8_t hour, minute, second;
};

Calendar calendar_of(std::int64_t utc_ns) {
    using namespace std::chrono;
    const sys_time<nanoseconds> time{nanoseconds(utc_ns)};
    const year_month_day date(floor<days>(time));
    const hh_mm_ss clock(floor<seconds>(time) - floor<days>(time));
    return {static_cast<std::uint8_t>(unsigned{date.day()}),
            static_cast<std::uint8_t>(unsigned{date.month()}),
            int{date.year()},
            static_cast<std::uint8_t>(clock.hours().count()),
            static_cast<std::uint8_t>(clock.minutes().count()),
            static_cast<std::uint8_t>(clock.seconds().count())};
}

template <class Packet>
void add(cigi::MessageWriter& writer, const Packet& packet) {
    if (!writer.add(packet)) throw std::logic_error("no room for a host's message");
}

void add_weather(cigi::MessageWriter& writer, double time_s) {
    const auto wave = static_cast<float>(0.5 + 0.5 * std::sin(0.13 * time_s));
    cigi::AtmosphereControl air;
    air.model_enable = true;
    air.humidity = 60;
    air.air_temperature = 12.0F;
    air.visibility = 8000.0F + 60'000.0F * wave;
    air.pressure = 1013.0F;
    add(writer, air);
    cigi::WeatherControl clouds;
    clouds.layer_id = 1;
    clouds.weather_enable = true;
    clouds.cloud_type = cigi::CloudType::kCumulus;
    clouds.coverage = 80.0F * wave;
    clouds.base_elevation = 2500.0F;
    clouds.thickness = 600.0F;
    clouds.air_temperature = 5.0F;
    clouds.visibility = 200.0F;
    clouds.pressure = 800.0F;
    add(writer, clouds);
}

void add_time(cigi::MessageWriter& writer, const Calendar& now) {
    cigi::CelestialSphereControl sky;
    sky.hour = now.hour;
    sky.minute = now.minute;
    sky.ephemeris_enable = sky.sun_enable = sky.moon_enable = sky.star_enable = sky.date_time_valid = true;
    sky.star_intensity = 100.0F;
    sky.date = now.month * 1'000'000U + now.day * 10'000U + static_cast<unsigned>(now.year);
    add(writer, sky);
}

using Bytes4 = std::array<std::uint8_t, 4>;

Bytes4 big_endian(std::uint32_t word) {
    return {static_cast<std::uint8_t>(word >> 24U), static_cast<std::uint8_t>(word >> 16U),
            static_cast<std::uint8_t>(word >> 8U), static_cast<std::uint8_t>(word)};
}

/// One of CANaerospace's messages, without its head's counter.
struct BusMessage {
    std::uint16_t id;
    std::uint8_t type;
    Bytes4 data;
};

BusMessage real(std::uint16_t id, double value) {
    constexpr std::uint8_t kFloat = 2;
    return {id, kFloat, big_endian(std::bit_cast<std::uint32_t>(static_cast<float>(value)))};
}

BusMessage degrees(std::uint16_t id, double value_deg) {
    constexpr std::uint8_t kLong = 3;
    return {id, kLong, big_endian(static_cast<std::uint32_t>(std::lround(value_deg * 1e7)))};
}

BusMessage octets(std::uint16_t id, Bytes4 data) {
    constexpr std::uint8_t kUChar4 = 16;
    return {id, kUChar4, data};
}

/// What is sent ten times a second, each in its turn.
BusMessage slow_message(std::int64_t turn, const Flight& flight, const Calendar& now) {
    switch (turn % 10) {
        case 0:
            return octets(1200, {now.hour, now.minute, now.second, 0});
        case 1:
            return octets(1206, {now.day, now.month, static_cast<std::uint8_t>(now.year / 100),
                                 static_cast<std::uint8_t>(now.year % 100)});
        case 2:
            return real(1130, flight.east_m_s);
        case 3:
            return real(1131, flight.north_m_s);
        case 4:
            return real(1132, flight.up_m_s);
        case 5:
            return real(316, kSpeed_m_s);
        case 6:
            return real(324, 278.0);
        case 7:
            return real(326, 845.0);
        case 8:
            return real(333, 6.0);
        default:
            return real(334, 250.0);
    }
}

BusMessage bus_message(std::int64_t number, const Flight& flight, const Calendar& now) {
    switch (number % 10) {
        case 0:
            return real(311, flight.pitch_deg);
        case 1:
            return real(312, flight.roll_deg);
        case 2:
            return real(1133, flight.yaw_deg);
        case 3:
            return real(303, flight.pitch_rate_deg_s);
        case 4:
            return real(304, flight.roll_rate_deg_s);
        case 5:
            return real(305, flight.yaw_rate_deg_s);
        case 6:
            return degrees(1036, flight.latitude_deg);
        case 7:
            return degrees(1037, flight.longitude_deg);
        case 8:
            return real(1038, flight.height_m);
        default:
            return slow_message(number / 10, flight, now);
    }
}

bool bus_is_silent(double time_s) {
    const double second = std::fmod(time_s, 60.0);
    return second >= 4.0 && second < 5.5;
}

}  // namespace

const CockpitTraffic::Arrival& CockpitTraffic::next() {
    constexpr double kNsToSeconds = 1e-9;
    while (bus_is_silent(static_cast<double>(frames_ * kBusStep_ns) * kNsToSeconds))
        ++frames_;
    arrival_.is_can = frames_ * kBusStep_ns < messages_ * kHostStep_ns;
    const std::int64_t since_start_ns = arrival_.is_can ? frames_ * kBusStep_ns : messages_ * kHostStep_ns;
    arrival_.utc_ns = start_utc_ns_ + since_start_ns;
    const double time_s = static_cast<double>(since_start_ns) * kNsToSeconds;
    if (arrival_.is_can) {
        make_frame(time_s);
        ++frames_;
    } else {
        make_message(time_s);
        ++messages_;
    }
    return arrival_;
}

void CockpitTraffic::make_message(double time_s) {
    const Flight flight = flight_at(time_s);
    cigi::MessageWriter writer(buffer_, cigi::Version::k33, cigi::ByteOrder::kBig);
    cigi::IgControl control;
    control.minor_version = 3;
    control.ig_mode = cigi::IgMode::kOperate;
    control.host_frame_number = static_cast<std::uint32_t>(messages_ + 1);
    add(writer, control);
    cigi::EntityControl ownship;
    ownship.entity_state = cigi::EntityState::kActive;
    ownship.yaw = static_cast<float>(flight.yaw_deg);
    ownship.pitch = static_cast<float>(flight.pitch_deg);
    ownship.roll = static_cast<float>(flight.roll_deg);
    ownship.lat_x = flight.latitude_deg;
    ownship.lon_y = flight.longitude_deg;
    ownship.alt_z = flight.height_m;
    add(writer, ownship);
    if (messages_ % 60 == 30) {
        cigi::ViewControl view;
        view.view_id = 1;
        view.yaw_enable = true;
        view.yaw = static_cast<float>(20.0 * std::sin(0.3 * time_s));
        add(writer, view);
    }
    if (messages_ % 300 == 20) add_weather(writer, time_s);
    if (messages_ % 1200 == 10) add_time(writer, calendar_of(arrival_.utc_ns));
    arrival_.message = writer.bytes();
}

void CockpitTraffic::make_frame(double time_s) {
    const BusMessage message = bus_message(frames_, flight_at(time_s), calendar_of(arrival_.utc_ns));
    constexpr std::uint8_t kNode = 1;
    constexpr std::uint8_t kNoService = 0;
    protocol::CanFrame& frame = arrival_.frame;
    frame = {};
    frame.received_ns = arrival_.utc_ns;
    frame.id = message.id;
    frame.length = 8;
    frame.data = {kNode,           message.type,    kNoService,      sent_by_id_[message.id]++,
                  message.data[0], message.data[1], message.data[2], message.data[3]};
}

}  // namespace skyig::tests
