// The world as sources without CIGI change it.
#include <cmath>
#include <glm/glm.hpp>

#include "server/world/weather_limits.h"
#include "server/world/world.h"

namespace skyig::server::world {

namespace {

/// Takes over what is there and what a sky can have. \return false when it is there and no sky has it
bool take(const std::optional<double>& value, double min, double max, double& out) noexcept {
    if (!value) return true;
    if (!(*value >= min && *value <= max)) return false;
    out = *value;
    return true;
}

}  // namespace

void World::heard(std::size_t source) {
    const auto change = authority_.heard(source);
    if (!change) return;
    const char* const what = change->from == LinkState::kWaiting ? "is heard" : "is back";
    if (change->from == LinkState::kStale) return;
    raise(Event::kSourceHeard, static_cast<std::uint32_t>(source), 0);
    log_.limited({"source heard", source}, kRepeatAfter_s, Severity::kNotice, "{} {}",
                 authority_.rule(source).name, what);
}

bool World::listens(std::size_t source, config::Aspect aspect) noexcept {
    const auto control = authority_.holder(config::Aspect::kControl);
    const LinkState host = control ? authority_.state(*control) : LinkState::kWaiting;
    const bool host_lives = host == LinkState::kLive || host == LinkState::kStale;
    if (host_lives && !in_operation()) {
        ++counters_.standby_ignored;
        return false;
    }
    if (authority_.claim(source, aspect)) return true;
    ++counters_.not_in_charge;
    return false;
}

void World::report(std::size_t source, const OwnshipReport& report) {
    if (!listens(source, config::Aspect::kOwnship)) return;
    if (report.position && !is_drawn(*report.position)) return;
    take_track(source);
    ownship_.exists = true;
    if (report.position) {
        ownship_.position = *report.position;
        own_.track.report_position(*report.position, elapsed_s_, report.sender_s);
        ownship_.placed_by_host = true;
    }
    if (report.velocity_enu_m_s) {
        if (glm::length(*report.velocity_enu_m_s) <= ToldMotion::kMostSpeed_m_s)
            own_.track.report_velocity(*report.velocity_enu_m_s, elapsed_s_);
        else
            ++counters_.rate_refused;
    }
    if (!report.yaw_deg && !report.pitch_deg && !report.roll_deg) return;
    // What is told by one is carried on from the angles as they were told last, not as they are drawn.
    const Pose told = own_.track.told();
    const double yaw_deg = report.yaw_deg.value_or(told.yaw_deg);
    const double pitch_deg = report.pitch_deg.value_or(told.pitch_deg);
    const double roll_deg = report.roll_deg.value_or(told.roll_deg);
    own_.track.report_attitude(yaw_deg, pitch_deg, roll_deg, elapsed_s_, report.sender_s);
    ownship_.yaw_deg = yaw_deg;
    ownship_.pitch_deg = pitch_deg;
    ownship_.roll_deg = roll_deg;
}

void World::report(std::size_t source, const AirReport& report) {
    if (!listens(source, config::Aspect::kWeather)) return;
    AirState air = air_;
    // The same limits as for Atmosphere Control; what no sky has is refused one by one.
    const bool good =
        static_cast<int>(take(report.visibility_m, 0.0, 1e7, air.visibility_m)) &
        static_cast<int>(take(report.temperature_c, -100.0, 100.0, air.temperature_c)) &
        static_cast<int>(take(report.pressure_hpa, 300.0, 1200.0, air.pressure_hpa)) &
        static_cast<int>(take(report.humidity_pct, 0.0, 100.0, air.humidity_pct)) &
        static_cast<int>(take(report.wind_horizontal_m_s, 0.0, kMostWind_m_s, air.wind_horizontal_m_s)) &
        static_cast<int>(take(report.wind_from_deg, -720.0, 720.0, air.wind_from_deg));
    if (!good) ++counters_.air_refused;
    air_ = air;
}

void World::report(std::size_t source, const protocol::cigi::WeatherControl& layer) {
    if (listens(source, config::Aspect::kWeather)) keep_weather(layer);
}

void World::report_time(std::size_t source, const ephemeris::UtcClockTime& utc, double rate) {
    if (!listens(source, config::Aspect::kTime)) return;
    const ephemeris::UtcClockTime before = clock_.utc();
    clock_ = UtcClock(utc, rate);
    note_clock_step(before);
}

}  // namespace skyig::server::world
