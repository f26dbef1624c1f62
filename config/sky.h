// [sky] and its tables: what shines, and which model draws the day sky.
#pragma once

#include <array>
#include <optional>

namespace skyig::config {

enum class SkyModel { kMulti, kSingle, kDayCycle, kCie, kPreetham, kWindlight };

/// [sky.daycycle]
struct DayCycleSky {
    /// 0..1
    double desaturation = 0.0;
};

/// [sky.cie]
struct CieSky {
    /// ISO 15469, 1..15; 16: the traditional overcast sky.
    int type = 12;
    /// As measured; not given: from `multi`. 0..1e6
    std::optional<double> zenith_luminance_cd_m2;
};

/// [sky.preetham]
struct PreethamSky {
    /// 2..10; not given: from the air.
    std::optional<double> turbidity;
    /// Key "zenith": "multi" or "printed".
    bool zenith_of_multi = false;
};

/// [sky.windlight]; colours are linear red, green, blue, 0..10.
struct WindlightSky {
    std::array<double, 3> blue_horizon{0.5, 0.5, 0.64};
    double haze_horizon = 0.19;
    /// Relative; the optical density per metre is these times `density_per_m`.
    std::array<double, 3> blue_density{0.25, 0.45, 0.76};
    double haze_density = 0.35;
    double density_per_m = 1e-4;
    double max_altitude_m = 4000.0;
    std::array<double, 3> sunlight{0.73, 0.78, 0.9};
    std::array<double, 3> ambient{0.35, 0.35, 0.35};
    double glow_size = 5.0;
    double glow_floor = 0.001;
    double glow_power = -0.48;
    double horizon_drop = 0.0;
    /// Luminance of a colour's unit.
    double unit_cd_m2 = 30000.0;
    /// Key "sun_angle_deg": given, the Sun stands there, whatever the date.
    std::optional<double> sun_angle_deg;
    double east_angle_deg = 0.0;
};

struct Sky {
    /// What shines at start-up and after Standby.
    bool sun = true;
    bool moon = true;
    bool stars = true;
    double star_intensity_pct = 100.0;
    /// They twinkle.
    bool star_scintillation = true;

    SkyModel model = SkyModel::kMulti;
    DayCycleSky day_cycle;
    CieSky cie;
    PreethamSky preetham;
    WindlightSky windlight;
};

}  // namespace skyig::config
