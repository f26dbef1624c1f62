#include "server/flightgear_input.h"

#include "server/endpoint_format.h"

namespace skyig::server {

namespace flightgear = protocol::flightgear;

namespace {

constexpr double kNsToSeconds = 1e-9;
constexpr std::int64_t kSecondsPerDay = 86400;
/// JSBSim on its own sends this, or a count of its steps from 0: no time of day.
constexpr std::int64_t kNoTime_s = 1234567890;
constexpr std::int64_t kFirstTime_s = 100'000'000;

}  // namespace

void FlightGearInput::take(const protocol::transport::Datagram& datagram) {
    const auto packet = flightgear::decode_net_fdm(datagram.bytes);
    if (!packet) {
        ++refused_[static_cast<std::size_t>(packet.error().reason)];
        log_.limited({"flight model refused", source_}, kRepeatAfter_s, Severity::kWarning,
                     "datagram from {} dropped: {}", datagram.from, flightgear::to_string(packet.error()));
        return;
    }
    ++packets_;
    world_.heard(source_);
    const flightgear::NetFdm& fdm = *packet;
    world::OwnshipReport report;
    report.position = {fdm.latitude_deg, fdm.longitude_deg, fdm.altitude_msl_m};
    report.yaw_deg = fdm.heading_deg;
    report.pitch_deg = fdm.pitch_deg;
    report.roll_deg = fdm.roll_deg;
    report.velocity_enu_m_s = {fdm.velocity_east_m_s, fdm.velocity_north_m_s, -fdm.velocity_down_m_s};
    report.sender_s = static_cast<double>(datagram.arrival_ns) * kNsToSeconds;
    world_.report(source_, report);
    report_time(fdm.time_unix_s, datagram.arrival_ns);
}

void FlightGearInput::report_time(std::int64_t unix_s, std::int64_t arrival_ns) {
    if (unix_s == kNoTime_s || unix_s < kFirstTime_s) return;
    clock_.set_date(unix_s / kSecondsPerDay, arrival_ns);
    clock_.set_time_of_day(static_cast<double>(unix_s % kSecondsPerDay), 1.0, arrival_ns);
    const auto time = clock_.at(arrival_ns);
    if (!time) return;
    ephemeris::UtcClockTime utc = ephemeris::UtcClockTime::from_unix(time->day * kSecondsPerDay);
    utc.advance(time->second_of_day);
    world_.report_time(source_, utc, 1.0);
}

}  // namespace skyig::server
