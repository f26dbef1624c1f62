#include "clients/skyig/host_messages.h"

#include <algorithm>

#include "protocol/cigi/validate.h"

namespace skyig::clients {

namespace cigi = protocol::cigi;
namespace ephemeris = server::ephemeris;

namespace {

/// CIGI's time stamps count 10 microseconds.
constexpr std::int64_t kTickNs = 10'000;

cigi::EntityControl ownship_control(const FlightPoint& pose) noexcept {
    cigi::EntityControl control;
    control.entity_id = 0;
    control.entity_state = cigi::EntityState::kActive;
    control.roll = static_cast<float>(pose.roll_deg);
    control.pitch = static_cast<float>(pose.pitch_deg);
    control.yaw = static_cast<float>(pose.yaw_deg);
    control.lat_x = pose.latitude_deg;
    control.lon_y = pose.longitude_deg;
    control.alt_z = pose.altitude_m;
    return control;
}

cigi::EntityPosition ownship_position(const FlightPoint& pose) noexcept {
    cigi::EntityPosition position;
    position.entity_id = 0;
    position.roll = static_cast<float>(pose.roll_deg);
    position.pitch = static_cast<float>(pose.pitch_deg);
    position.yaw = static_cast<float>(pose.yaw_deg);
    position.lat_x = pose.latitude_deg;
    position.lon_y = pose.longitude_deg;
    position.alt_z = pose.altitude_m;
    return position;
}

cigi::AtmosphereControl air(double visibility_m) noexcept {
    cigi::AtmosphereControl control;
    control.model_enable = true;
    control.humidity = 50;
    control.air_temperature = 15.0F;
    control.visibility = static_cast<float>(visibility_m);
    control.pressure = 1013.25F;
    return control;
}

cigi::ViewControl view_turn(std::uint16_t view_id, double yaw_deg) noexcept {
    cigi::ViewControl control;
    control.view_id = view_id;
    control.yaw_enable = true;
    control.yaw = static_cast<float>(yaw_deg < 0.0 ? yaw_deg + 360.0 : yaw_deg);
    return control;
}

}  // namespace

cigi::CelestialSphereControl celestial_setting(const ephemeris::UtcClockTime& utc) noexcept {
    const ephemeris::CivilTime civil = utc.civil();
    cigi::CelestialSphereControl control;
    control.hour = static_cast<std::uint8_t>(civil.hour);
    control.minute = static_cast<std::uint8_t>(civil.minute);
    // Neither a leap second nor one that a float would round up to 60 can be said.
    control.seconds = std::min(static_cast<float>(civil.second), 59.999F);
    control.ephemeris_enable = true;
    control.sun_enable = true;
    control.moon_enable = true;
    control.star_enable = true;
    control.date_time_valid = true;
    control.date = cigi::make_date({civil.year, civil.month, civil.day});
    control.star_intensity = 100.0F;
    return control;
}

void HostMessages::answered(const cigi::StartOfFrame& start_of_frame) noexcept {
    last_ig_frame_number_ = start_of_frame.ig_frame_number;
    // An answer that echoes no frame of ours says nothing about what became of our request.
    const bool heard_us = start_of_frame.last_host_frame_number != 0;
    if (start_of_frame.ig_mode == cigi::IgMode::kStandby && heard_us) heard_in_standby_ = true;
    operating_ = heard_in_standby_ && (start_of_frame.ig_mode == cigi::IgMode::kOperate ||
                                       start_of_frame.ig_mode == cigi::IgMode::kDebug);
    if (!operating_) settings_sent_ = false;
}

std::span<const std::byte> HostMessages::next(const FlightPoint& pose, double flown_s,
                                              std::int64_t now_ns) noexcept {
    ++frame_number_;
    cigi::MessageWriter writer(buffer_, settings_.version, settings_.order);
    cigi::IgControl control;
    control.minor_version = settings_.version == cigi::Version::k33 ? 3 : 0;
    control.ig_mode = heard_in_standby_ ? cigi::IgMode::kOperate : cigi::IgMode::kStandby;
    control.timestamp_valid = true;
    control.host_frame_number = frame_number_;
    control.timestamp = static_cast<std::uint32_t>(now_ns / kTickNs);
    control.last_ig_frame_number = last_ig_frame_number_;
    // Everything below fits the buffer many times over.
    (void)writer.add(control);
    if (!operating_) return writer.bytes();
    const bool first = !settings_sent_;
    if (first) add_settings(writer, flown_s);
    add_pose(writer, pose, first);
    settings_sent_ = true;
    return writer.bytes();
}

void HostMessages::add_settings(cigi::MessageWriter& writer, double flown_s) const noexcept {
    ephemeris::UtcClockTime utc = settings_.utc;
    utc.advance(flown_s);
    (void)writer.add(celestial_setting(utc));
    if (settings_.visibility_m) (void)writer.add(air(*settings_.visibility_m));
    if (settings_.view_yaw_deg) (void)writer.add(view_turn(settings_.view_id, *settings_.view_yaw_deg));
}

void HostMessages::add_pose(cigi::MessageWriter& writer, const FlightPoint& pose, bool first) const noexcept {
    if (settings_.version == cigi::Version::k33) {
        (void)writer.add(ownship_control(pose));
        return;
    }
    if (first) (void)writer.add(ownship_control(pose));
    (void)writer.add(ownship_position(pose));
}

}  // namespace skyig::clients
