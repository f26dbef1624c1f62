// What a METAR or SPECI says, as plain values: the routine weather report of an aerodrome, WMO No. 306 FM
// 15/16, ICAO Annex 3, and the forms of North America (FMH-1, MANOBS).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/metar/values.h"

namespace skyig::protocol::metar {

/// kNone: the report begins with its station, as many feeds have it.
enum class ReportType : std::uint8_t { kNone, kMetar, kSpeci };

/// What is wrong with a group.
enum class Fault : std::uint8_t {
    kStation,
    kTime,
    kWind,
    kVariation,
    kVisibility,
    kRunway,
    kWeather,
    kCloud,
    kTemperature,
    kPressure,
    kSea,
    kShear,
    kTwice,
    kEnd
};

struct Problem {
    Fault fault = Fault::kEnd;
    /// In capitals; empty: the report ended where it should stand.
    std::string group;
};

struct Report {
    /// As given, without blanks around it.
    std::string raw;
    ReportType type = ReportType::kNone;
    std::string station;
    /// UTC, all three or none: 1..31, 0..23, 0..59.
    std::optional<int> day;
    std::optional<int> hour;
    std::optional<int> minute;
    bool automatic = false;
    bool corrected = false;
    /// Announced, but there is none.
    bool nil = false;
    std::optional<Wind> wind;
    bool cavok = false;
    std::optional<Visibility> visibility;
    std::vector<RunwayRange> runway_ranges;
    /// Snow, water and friction, as written: "27/450093", "27/SNOCLO".
    std::vector<std::string> runway_states;
    std::vector<Weather> weather;
    /// Of the hour before, no longer there.
    std::vector<Weather> recent;
    std::vector<Cloud> clouds;
    std::optional<ClearCode> clear_code;
    /// With `obscured`, which a vertical visibility of /// leaves alone.
    std::optional<int> vertical_visibility_ft;
    bool obscured = false;
    std::optional<int> temperature_c;
    std::optional<int> dewpoint_c;
    std::optional<Pressure> pressure;
    std::optional<Sea> sea;
    /// Where wind shear is told: "ALL RWY", "R27", "TKOF RWY09".
    std::vector<std::string> wind_shear;
    /// Military: "BLU", "BLACKWHT".
    std::vector<std::string> colour_states;
    /// From NOSIG, BECMG, TEMPO or Australia's INTER, PROB30, FM1200 on, and behind RMK; not read, groups
    /// between single blanks, in capitals.
    std::string trend;
    std::string remarks;
    /// Groups that stand in none of the members above: of no known kind, or told in `problems`.
    std::vector<std::string> unparsed;
    std::vector<Problem> problems;

    /// Nothing in it is wrong; groups of no known kind are not wrong.
    [[nodiscard]] bool valid() const noexcept { return problems.empty(); }
};

/// What would be right in the group's place.
[[nodiscard]] std::string_view fault_text(Fault fault) noexcept;
/// "'40012KT': write the wind as ..."
[[nodiscard]] std::string describe(const Problem& problem);

}  // namespace skyig::protocol::metar
