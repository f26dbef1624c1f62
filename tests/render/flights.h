// Flights to replay without a host: what the eye, the Sun and the air do from frame to frame, 30 a second.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/render/scenes.h"

namespace skyig::render::tests {

/// At 250 m/s along a meridian, climbing, the Sun at its real pace; visibility changes by a steady factor.
struct Flight {
    std::string name;
    double sun_deg = 30.0;
    /// Of the Sun's elevation: 15 deg an hour at most.
    double sun_deg_per_s = -15.0 / 3600.0;
    double height_m = 1000.0;
    double climb_m_s = 10.0;
    double visibility_m = 80e3;
    double last_visibility_m = 80e3;
    double ramp_s = 60.0;

    [[nodiscard]] Scene scene(int frame) const {
        const double time_s = frame / 30.0;
        // Along the way the vertical turns under the Sun.
        const double travelled_deg = 250.0 * time_s / 6371e3 / kDegree;
        Scene scene = make_scene(sun_deg + sun_deg_per_s * time_s - travelled_deg,
                                 200.0 + 15.0 / 3600.0 * time_s, -30.0, 40.0, height_m + climb_m_s * time_s);
        scene.time_s = time_s;
        const double share = std::clamp(time_s / ramp_s, 0.0, 1.0);
        scene.air.visibility_m = visibility_m * std::pow(last_visibility_m / visibility_m, share);
        return scene;
    }
};

inline std::vector<Flight> upkeep_flights() {
    Flight low{"climb from 300 m"};
    low.height_m = 300.0;
    Flight day{"climb from 1 km"};
    Flight high{"climb from 8 km"};
    high.height_m = 8e3;
    Flight sunset{"climb from 1 km at sunset"};
    sunset.sun_deg = 1.0;
    Flight ramp{"visibility 80 to 8 km in 60 s"};
    ramp.last_visibility_m = 8e3;
    return {low, day, high, sunset, ramp};
}

/// What has made skies flicker: sunset, a climb through haze, visibility that ramps, stars that come out.
inline std::vector<Flight> steadiness_flights() {
    Flight sunset{"sunset"};
    sunset.sun_deg = 1.0;
    Flight haze{"climb through haze"};
    haze.sun_deg = 15.0;
    haze.height_m = 300.0;
    haze.visibility_m = haze.last_visibility_m = 8e3;
    Flight ramp{"visibility 80 to 8 km in 60 s"};
    ramp.last_visibility_m = 8e3;
    Flight stars{"dusk"};
    stars.sun_deg = -5.0;
    stars.climb_m_s = 0.0;
    return {sunset, haze, ramp, stars};
}

}  // namespace skyig::render::tests
