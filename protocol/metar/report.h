// What a METAR or SPECI says, as plain values: the routine weather report of an aerodrome, WMO No. 306 FM
// 15/16, ICAO Annex 3, and the forms of North America (FMH-1, MANOBS). Units are those of the report unless a
// name tells another; what is missing or reported as /// is empty.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skyig::protocol::metar {

/// kNone: the report begins with its station, as many feeds have it.
enum class ReportType : std::uint8_t { kNone, kMetar, kSpeci };
/// Of a number with the true value.
enum class Comparison : std::uint8_t { kEqual, kBelow, kAbove, kAtLeast };

enum class SpeedUnit : std::uint8_t { kKnots, kMetresPerSecond, kKilometresPerHour };

struct Wind {
    /// Where it blows from, 0..360; empty when variable or missing.
    std::optional<int> direction_deg_true;
    bool variable = false;
    std::optional<int> speed;
    std::optional<int> gust;
    /// More than `speed`, `gust` (P99).
    bool speed_above = false;
    bool gust_above = false;
    SpeedUnit unit = SpeedUnit::kKnots;
    /// The sector that its direction varies in, clockwise, 0..360.
    std::optional<int> var_from_deg;
    std::optional<int> var_to_deg;
};

struct Visibility {
    /// 9999 and CAVOK are 10,000 and more, 0000 is below 50; empty where only a minimum is told.
    std::optional<double> prevailing_m;
    Comparison comparison = Comparison::kEqual;
    /// Reported in statute miles.
    bool in_miles = false;
    /// The least of all directions, and where: 0, 45 .. 315 degrees.
    std::optional<double> minimum_m;
    std::optional<int> minimum_direction_deg;
    /// The station cannot tell directions apart (NDV).
    bool no_directions = false;
};

struct RunwayRange {
    /// "26R"
    std::string runway;
    std::optional<double> range_m;
    Comparison comparison = Comparison::kEqual;
    /// Upper end where it varies.
    std::optional<double> maximum_m;
    Comparison maximum_comparison = Comparison::kEqual;
    /// Reported in feet.
    bool in_feet = false;
    /// 'U' better, 'D' worse, 'N' neither; 0: not told.
    char trend = 0;
};

enum class Intensity : std::uint8_t { kLight, kModerate, kHeavy };
enum class Descriptor : std::uint8_t {
    kShallow,
    kPatches,
    kPartial,
    kDrifting,
    kBlowing,
    kShower,
    kThunderstorm,
    kFreezing,
    kEnd
};
enum class Phenomenon : std::uint8_t {
    kDrizzle,
    kRain,
    kSnow,
    kSnowGrains,
    kIceCrystals,
    kIcePellets,
    kHail,
    kSmallHail,
    kUnknownPrecipitation,
    kMist,
    kFog,
    kSmoke,
    kVolcanicAsh,
    kDust,
    kSand,
    kHaze,
    kSpray,
    kDustWhirls,
    kSqualls,
    kFunnelCloud,
    kSandstorm,
    kDuststorm,
    kEnd
};

inline constexpr std::size_t kMostPhenomena = 4;

struct Weather {
    Intensity intensity = Intensity::kModerate;
    /// Not at the aerodrome, within about 8 to 16 km.
    bool vicinity = false;
    std::optional<Descriptor> descriptor;
    std::array<Phenomenon, kMostPhenomena> phenomenon{};
    std::size_t phenomenon_count = 0;

    [[nodiscard]] std::span<const Phenomenon> phenomena() const noexcept {
        return std::span(phenomenon).first(phenomenon_count);
    }
};

enum class CloudAmount : std::uint8_t { kFew, kScattered, kBroken, kOvercast, kEnd };
enum class Convective : std::uint8_t { kNone, kCumulonimbus, kToweringCumulus };

struct Cloud {
    /// Both are empty where an automatic station saw no more than that there is one.
    std::optional<CloudAmount> amount;
    /// Above the aerodrome, in hundreds.
    std::optional<int> base_ft_agl;
    Convective convective = Convective::kNone;
};

/// Why no cloud is told: clear sky, none found by a machine, none of significance, none detected.
enum class ClearCode : std::uint8_t { kSkc, kClr, kNsc, kNcd, kEnd };

struct Pressure {
    /// 850..1100; the first of two that are told in two units.
    double qnh_hpa = 0.0;
    /// Reported in hundredths of an inch of mercury.
    bool in_inches = false;
};

struct Sea {
    std::optional<int> temperature_c;
    /// WMO code 3700, 0..9.
    std::optional<int> state;
    std::optional<int> wave_height_dm;
};

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
    /// From NOSIG, BECMG or TEMPO on, and behind RMK; groups between single blanks, in capitals.
    std::string trend;
    std::string remarks;
    /// Groups that stand in none of the members above: of no known kind, or told in `problems`.
    std::vector<std::string> unparsed;
    std::vector<Problem> problems;

    /// Nothing in it is wrong; groups of no known kind are not wrong.
    [[nodiscard]] bool valid() const noexcept { return problems.empty(); }
};

/// "moderate", "SH", "RA", "BKN", "NSC", "KT".
[[nodiscard]] std::string_view name(Intensity intensity) noexcept;
[[nodiscard]] std::string_view name(Descriptor descriptor) noexcept;
[[nodiscard]] std::string_view name(Phenomenon phenomenon) noexcept;
[[nodiscard]] std::string_view name(CloudAmount amount) noexcept;
[[nodiscard]] std::string_view name(ClearCode code) noexcept;
[[nodiscard]] std::string_view name(SpeedUnit unit) noexcept;
/// Of a multiple of 45 degrees: "N", "NE" .. "NW".
[[nodiscard]] std::string_view compass_name(int direction_deg) noexcept;

struct Oktas {
    int least;
    int most;
};
[[nodiscard]] Oktas oktas(CloudAmount amount) noexcept;
/// Of the sky by this layer alone, seen straight down: the middle of its oktas.
[[nodiscard]] double coverage_percent(CloudAmount amount) noexcept;
[[nodiscard]] double metres_per_second(int speed, SpeedUnit unit) noexcept;

inline constexpr double kMetresPerFoot = 0.3048;
inline constexpr double kMetresPerMile = 1609.344;
inline constexpr double kHpaPerInch = 33.86389;

/// What would be right in the group's place.
[[nodiscard]] std::string_view fault_text(Fault fault) noexcept;
/// "'40012KT': write the wind as ..."
[[nodiscard]] std::string describe(const Problem& problem);

}  // namespace skyig::protocol::metar
