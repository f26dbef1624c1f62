// Which identifier carries which parameter, in which data types and units: data, with the standard's default
// distribution (and this program's proposal for weather) as its defaults. A configuration may move every
// parameter to another identifier.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/canaerospace/data_type.h"

namespace skyig::protocol::canaerospace {

enum class Parameter : std::uint8_t {
    kBodyLongitudinalAcceleration,
    kBodyLateralAcceleration,
    kBodyNormalAcceleration,
    kBodyPitchRate,
    kBodyRollRate,
    kBodyYawRate,
    kBodyPitchAngle,
    kBodyRollAngle,
    kBodySideslip,
    kAltitudeRate,
    kIndicatedAirspeed,
    kTrueAirspeed,
    kCalibratedAirspeed,
    kBaroCorrection,
    kBaroCorrectedAltitude,
    kHeadingAngle,
    kStandardAltitude,
    kTotalAirTemperature,
    kStaticAirTemperature,
    kStaticPressure,
    kHeadingRate,
    kTrueAltitude,
    kWindSpeed,
    kWindDirection,
    kOutsideAirTemperature,
    kBodyNormalVelocity,
    kBodyLongitudinalVelocity,
    kBodyLateralVelocity,
    kGpsLatitude,
    kGpsLongitude,
    kGpsHeight,
    kGpsGroundSpeed,
    kGpsTrueTrack,
    kGpsMagneticTrack,
    kInsLatitude,
    kInsLongitude,
    kInsHeight,
    kInsGroundSpeed,
    kInsTrueTrack,
    kAuxiliaryLatitude,
    kAuxiliaryLongitude,
    kAuxiliaryHeight,
    kMagneticHeading,
    kRadioHeight,
    kMagneticVariation,
    kTrueEastVelocity,
    kTrueNorthVelocity,
    kTrueUpVelocity,
    kTrueHeading,
    kUtc,
    kDate,
    // this program's proposal from here on
    kVisibility,
    kHazeScaleHeight,
    kRelativeHumidity,
    kSurfacePressure,
    kSurfaceTemperature,
    kLayerBase,
    kLayerTop,
    kLayerCoverage,
    kLayerType,
    kLayerDensity,
    kLayerTransition,
    kLayerEnable,
    kLayerWindEast,
    kLayerWindNorth,
    kLayerSeed,
    kUtcMilliseconds,
    kTimeRate,
    kJulianDate,
    kCommit,
    kEnd
};

inline constexpr std::size_t kParameters = static_cast<std::size_t>(Parameter::kEnd);
inline constexpr std::size_t kCloudLayers = 8;
[[nodiscard]] constexpr std::size_t index_of(Parameter parameter) noexcept {
    return static_cast<std::size_t>(parameter);
}

/// How the data of a parameter become its value.
enum class Meaning : std::uint8_t {
    kNumber,     // FLOAT and DOUBLEH/L: the value; SHORT2: value * scale / 32767; integers: the value
    kDegrees,    // as kNumber, but LONG and ULONG count 1e-7 deg
    kCoverage,   // integers count oktas (0..8), other numbers are 0..1
    kTimeOfDay,  // four bytes: hours, minutes, seconds, 0 (or hundredths)
    kDate,       // four bytes: day, month, century, year of the century
    kCommit      // no data, or the number of a cloud layer
};

/// How long a parameter stays valid and how often it is expected.
enum class Group : std::uint8_t { kAttitude, kPosition, kAirData, kTime, kWeather, kEnd };
inline constexpr std::size_t kGroups = static_cast<std::size_t>(Group::kEnd);

inline constexpr std::uint16_t kNoIdentifier = 0xFFFF;

struct MapEntry {
    Parameter parameter = Parameter::kEnd;
    /// 200..299, 300..1799, 1800..1899 or 1900..1999; kNoIdentifier: not received.
    std::uint16_t id = kNoIdentifier;
    Group group = Group::kAirData;
    Meaning meaning = Meaning::kNumber;
    /// One '#' stands for the number of the cloud layer; only `layered` entries have one.
    std::string_view name;
    std::string_view unit;
    TypeSet types = 0;
    /// Of the value in `unit`, both included.
    double low = 0.0;
    double high = 0.0;
    /// The service code is the number of a cloud layer, 0..7.
    bool layered = false;

    /// `unit`, or what the type makes of it.
    [[nodiscard]] std::string_view unit_of(DataType type) const noexcept;
};

/// Ways of writing time and date, which no receiver can tell from the frames.
struct Conventions {
    /// Time and date bytes are binary-coded decimal instead of binary.
    bool bcd = false;
    /// The fourth byte of UTC counts hundredths of a second instead of being ignored.
    bool hundredths = false;
    /// What January is: 1, or 0 for senders that count months from 0.
    std::uint8_t month_base = 1;
};

struct IdentifierMap {
    /// Indexed by Parameter.
    std::array<MapEntry, kParameters> entries;
    Conventions conventions;
    /// Sizes in bytes (0..4) of the user-defined data types 100..255; none: such a frame is refused.
    std::array<std::optional<std::uint8_t>, kUserTypes> user_type_bytes{};

    [[nodiscard]] MapEntry& operator[](Parameter parameter) noexcept { return entries[index_of(parameter)]; }
    [[nodiscard]] const MapEntry& operator[](Parameter parameter) const noexcept {
        return entries[index_of(parameter)];
    }
};

[[nodiscard]] const IdentifierMap& default_identifier_map() noexcept;

/// Empty if `map` can be used; else one sentence that names the parameter, what is wrong and what would be
/// right.
[[nodiscard]] std::string check(const IdentifierMap& map);

/// Finds the entry of an identifier in one step. Holds a copy of the map.
class IdentifierIndex {
  public:
    static constexpr std::size_t kIdentifiers = 2032;

    /// \param map  for which check() found no fault; of two entries with one identifier the later is found
    explicit IdentifierIndex(const IdentifierMap& map = default_identifier_map()) noexcept;

    /// Null if the map does not name `id`.
    [[nodiscard]] const MapEntry* find(std::uint32_t id) const noexcept {
        if (id >= kIdentifiers || at_[id] == kNothing) return nullptr;
        return &map_.entries[at_[id]];
    }
    [[nodiscard]] const IdentifierMap& map() const noexcept { return map_; }

  private:
    static constexpr std::uint8_t kNothing = 0xFF;
    static_assert(kParameters < kNothing);

    IdentifierMap map_;
    std::array<std::uint8_t, kIdentifiers> at_;
};

}  // namespace skyig::protocol::canaerospace
