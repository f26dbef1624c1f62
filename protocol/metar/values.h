// What the groups of a weather report say, as plain values. Units are those of the report unless a name tells
// another; what is missing or reported as /// is empty.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace skyig::protocol::metar {

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

}  // namespace skyig::protocol::metar
