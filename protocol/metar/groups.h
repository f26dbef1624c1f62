// One group of a report, in capitals and without blanks, to its value. For each kind: whether the group is
// meant as one, and its value, or nothing if it is written wrongly.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/metar/values.h"

namespace skyig::protocol::metar {

/// Slashes alone, with the unit of a visibility behind them or not: a group that is not available.
[[nodiscard]] bool is_missing(std::string_view group) noexcept;

struct DayTime {
    int day;
    int hour;
    int minute;
};
[[nodiscard]] bool looks_like_time(std::string_view group) noexcept;
[[nodiscard]] std::optional<DayTime> read_time(std::string_view group) noexcept;

[[nodiscard]] bool looks_like_wind(std::string_view group) noexcept;
/// /////KT is a wind without direction and speed.
[[nodiscard]] std::optional<Wind> read_wind(std::string_view group) noexcept;

struct Sector {
    int from_deg;
    int to_deg;
};
[[nodiscard]] bool looks_like_variation(std::string_view group) noexcept;
[[nodiscard]] std::optional<Sector> read_variation(std::string_view group) noexcept;

/// Anything that begins with a digit and is none of the other kinds is meant as a visibility.
[[nodiscard]] bool looks_like_visibility(std::string_view group) noexcept;
/// Metres or kilometres; a direction behind them makes it a minimum.
[[nodiscard]] std::optional<Visibility> read_visibility(std::string_view group) noexcept;
[[nodiscard]] bool looks_like_miles(std::string_view group) noexcept;
/// One or two digits, whole miles before a fraction.
[[nodiscard]] std::optional<int> read_whole_miles(std::string_view group) noexcept;
/// \param whole  miles before a fraction; 0: none
[[nodiscard]] std::optional<Visibility> read_miles(std::string_view group, int whole) noexcept;

[[nodiscard]] bool looks_like_runway(std::string_view group) noexcept;
/// A runway's state as "27/450093"; the form of eight digits at a report's end as it stands.
[[nodiscard]] std::optional<std::string> read_runway_state(std::string_view group);
[[nodiscard]] std::optional<RunwayRange> read_runway_range(std::string_view group);

[[nodiscard]] bool looks_like_weather(std::string_view group) noexcept;
[[nodiscard]] std::optional<Weather> read_weather(std::string_view group) noexcept;

[[nodiscard]] bool looks_like_cloud(std::string_view group) noexcept;
[[nodiscard]] std::optional<Cloud> read_cloud(std::string_view group) noexcept;

struct VerticalVisibility {
    std::optional<int> height_ft;
};
[[nodiscard]] bool looks_like_vertical_visibility(std::string_view group) noexcept;
[[nodiscard]] std::optional<VerticalVisibility> read_vertical_visibility(std::string_view group) noexcept;

struct Temperatures {
    std::optional<int> air_c;
    std::optional<int> dewpoint_c;
};
[[nodiscard]] bool looks_like_temperature(std::string_view group) noexcept;
[[nodiscard]] std::optional<Temperatures> read_temperature(std::string_view group) noexcept;

/// Q////, A////
[[nodiscard]] bool is_missing_pressure(std::string_view group) noexcept;
[[nodiscard]] bool looks_like_pressure(std::string_view group) noexcept;
[[nodiscard]] std::optional<Pressure> read_pressure(std::string_view group) noexcept;

[[nodiscard]] bool looks_like_sea(std::string_view group) noexcept;
[[nodiscard]] std::optional<Sea> read_sea(std::string_view group) noexcept;

/// A word that tells where wind shear is: ALL, RWY, TKOF, LDG, R27L, RWY27, 27.
[[nodiscard]] bool is_shear_place(std::string_view group) noexcept;
[[nodiscard]] bool is_colour_state(std::string_view group) noexcept;

}  // namespace skyig::protocol::metar
