// [weather.keyframes]: the look of the day as eight sets of values, each for good and for bad weather.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace skyig::config {

inline constexpr std::array<std::string_view, 8> kKeyframeNames{
    "night", "early_morning", "morning", "late_morning", "day", "early_evening", "evening", "late_evening"};

/// Colours are linear red, green, blue, 0..10, in units of [sky.windlight].
struct Keyframe {
    std::array<double, 3> sky_colour{};
    std::array<double, 3> fog_colour{};
    /// Where fog begins and where it hides all, metres, near < far.
    double sky_fog_near_m = 0.0;
    double sky_fog_far_m = 80000.0;
    /// 0..1
    double star_opacity = 0.0;
    std::array<double, 3> sun_colour{};
    std::array<double, 3> ambient_colour{};
    /// Of the layers' own coverage, 0..2; the result is held to the whole sky.
    double cloud_cover = 1.0;

    friend bool operator==(const Keyframe&, const Keyframe&) = default;
};

struct Keyframes {
    /// 1 = good weather, 0 = bad, linear between them.
    double good = 1.0;
    /// In the order of kKeyframeNames; night is the day's beginning and its end.
    std::array<Keyframe, 8> good_day{};
    std::array<Keyframe, 8> bad_day{};

    /// A plain day: blue, orange at both ends, dark at night; grey in bad weather.
    Keyframes();
};

}  // namespace skyig::config
