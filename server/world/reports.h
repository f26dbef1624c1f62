// What sources say that speak no CIGI, in the world's own words. What is absent stays as it is.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "server/ephemeris/sky_state.h"

namespace skyig::server::world {

struct OwnshipReport {
    /// Whole, or not at all.
    std::optional<ephemeris::Geodetic> position;
    /// Clockwise from true north, nose up, right wing down.
    std::optional<double> yaw_deg;
    std::optional<double> pitch_deg;
    std::optional<double> roll_deg;
    /// East, north, up.
    std::optional<glm::dvec3> velocity_enu_m_s;
    /// The sender's own time, of any origin, if place and attitude may be carried on by it.
    std::optional<double> sender_s;
};

struct AirReport {
    std::optional<double> visibility_m;
    std::optional<double> temperature_c;
    std::optional<double> pressure_hpa;
    std::optional<double> humidity_pct;
    std::optional<double> wind_horizontal_m_s;
    std::optional<double> wind_from_deg;
};

}  // namespace skyig::server::world
