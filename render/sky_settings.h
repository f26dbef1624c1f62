// Which model of the day sky a scene asks for, with the parameters of each: plain values.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string_view>

namespace skyig::render {

/// From truest to simplest; render/sky/models says what each one is good for.
enum class SkyModel { kMulti, kSingle, kDayCycle, kCie, kPreetham, kWindlight };

inline constexpr std::array<std::string_view, 6> kSkyModelNames{"multi", "single",   "daycycle",
                                                                "cie",   "preetham", "windlight"};

[[nodiscard]] constexpr std::string_view name_of(SkyModel model) noexcept {
    return kSkyModelNames[static_cast<std::size_t>(model)];
}

struct DayCycleSettings {
    /// Part of the colour that is taken away, 0..1: stands for the light scattered more than once, which is
    /// less blue. Luminance stays.
    double desaturation = 0.0;

    friend bool operator==(const DayCycleSettings&, const DayCycleSettings&) = default;
};

struct CieSettings {
    /// ISO 15469, 1..15; 16 is the traditional overcast sky.
    int type = 12;
    /// As measured, by day; not given: that of `multi`.
    std::optional<double> zenith_luminance_cd_m2;

    friend bool operator==(const CieSettings&, const CieSettings&) = default;
};

struct PreethamSettings {
    /// 2..10; not given: from the optical depths of the scene's air.
    std::optional<double> turbidity;
    /// Luminance and colour of the zenith from `multi` in place of the printed formulas.
    bool zenith_of_multi = false;

    friend bool operator==(const PreethamSettings&, const PreethamSettings&) = default;
};

/// Colours are linear Rec.709, 1 = `unit_cd_m2`.
struct WindlightSettings {
    glm::dvec3 blue_horizon{0.5, 0.5, 0.64};
    double haze_horizon = 0.19;
    glm::dvec3 blue_density{0.25, 0.45, 0.76};
    double haze_density = 0.35;
    double density_per_m = 1e-4;
    double max_altitude_m = 4000.0;
    glm::dvec3 sunlight{0.73, 0.78, 0.9};
    glm::dvec3 ambient{0.35, 0.35, 0.35};
    /// Glow = (max(1 - cos, floor) * size)^power + 0.25
    double glow_size = 5.0;
    double glow_floor = 0.001;
    double glow_power = -0.48;
    double horizon_drop = 0.0;
    double unit_cd_m2 = 30000.0;
    /// The Sun stands where the two angles say: `sun_angle_rad` up from the horizon, along the half circle
    /// that rises `east_angle_rad` clockwise of east and goes through the zenith.
    bool places_sun = false;
    double sun_angle_rad = 0.7;
    double east_angle_rad = 0.0;

    friend bool operator==(const WindlightSettings&, const WindlightSettings&) = default;
};

/// The direction that the two angles give the Sun, east-north-up.
[[nodiscard]] inline glm::dvec3 placed_sun_enu(const WindlightSettings& settings) noexcept {
    const double level = std::cos(settings.sun_angle_rad);
    return {level * std::cos(settings.east_angle_rad), -level * std::sin(settings.east_angle_rad),
            std::sin(settings.sun_angle_rad)};
}

struct SkySettings {
    SkyModel model = SkyModel::kMulti;
    DayCycleSettings day_cycle;
    CieSettings cie;
    PreethamSettings preetham;
    WindlightSettings windlight;
    /// The air's eddies make stars flicker.
    bool star_scintillation = false;

    friend bool operator==(const SkySettings&, const SkySettings&) = default;
};

}  // namespace skyig::render
