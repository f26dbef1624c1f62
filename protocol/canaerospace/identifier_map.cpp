#include "protocol/canaerospace/identifier_map.h"

#include <fmt/format.h>

#include <limits>

namespace skyig::protocol::canaerospace {
namespace {

using P = Parameter;
using G = Group;
using M = Meaning;

constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kAboveZero = std::numeric_limits<double>::min();

constexpr TypeSet kAnalogue =
    type_set(DataType::kFloat, DataType::kShort2, DataType::kDoubleH, DataType::kDoubleL);
constexpr TypeSet kAngle = kAnalogue | type_set(DataType::kLong);
constexpr TypeSet kOctet = type_set(DataType::kUChar);
constexpr TypeSet kWord = type_set(DataType::kULong);
constexpr TypeSet kFourBytes = type_set(DataType::kChar4, DataType::kUChar4);
constexpr TypeSet kDouble = type_set(DataType::kDoubleH, DataType::kDoubleL);
constexpr TypeSet kCommitTypes = type_set(DataType::kNoData, DataType::kUChar);

/// A number that may be anything finite.
constexpr MapEntry any(std::uint16_t id, P parameter, G group, std::string_view name, std::string_view unit) {
    return {parameter, id, group, M::kNumber, name, unit, kAnalogue, -kLargest, kLargest, false};
}
constexpr MapEntry number(std::uint16_t id, P parameter, G group, std::string_view name,
                          std::string_view unit, double low, double high = kLargest) {
    return {parameter, id, group, M::kNumber, name, unit, kAnalogue, low, high, false};
}
constexpr MapEntry degrees(std::uint16_t id, P parameter, std::string_view name, double largest) {
    return {parameter, id, G::kPosition, M::kDegrees, name, "deg", kAngle, -largest, largest, false};
}
constexpr MapEntry weather(std::uint16_t id, P parameter, std::string_view name, std::string_view unit,
                           TypeSet types, double low, double high = kLargest) {
    return {parameter, id, G::kWeather, M::kNumber, name, unit, types, low, high, false};
}
constexpr MapEntry layer(std::uint16_t id, P parameter, std::string_view name, std::string_view unit,
                         TypeSet types, double low, double high, M meaning = M::kNumber) {
    return {parameter, id, G::kWeather, meaning, name, unit, types, low, high, true};
}

// Headings and tracks may come as -180..180 (the standard) or 0..360; so may longitudes. The coverage of a
// layer has no range here: one out of 0..1 is told when the layer is committed.
constexpr std::array<MapEntry, kParameters> kDefaults{{
    any(300, P::kBodyLongitudinalAcceleration, G::kAttitude, "body longitudinal acceleration", "g"),
    any(301, P::kBodyLateralAcceleration, G::kAttitude, "body lateral acceleration", "g"),
    any(302, P::kBodyNormalAcceleration, G::kAttitude, "body normal acceleration", "g"),
    any(303, P::kBodyPitchRate, G::kAttitude, "body pitch rate", "deg/s"),
    any(304, P::kBodyRollRate, G::kAttitude, "body roll rate", "deg/s"),
    any(305, P::kBodyYawRate, G::kAttitude, "body yaw rate", "deg/s"),
    number(311, P::kBodyPitchAngle, G::kAttitude, "body pitch angle", "deg", -90.0, 90.0),
    number(312, P::kBodyRollAngle, G::kAttitude, "body roll angle", "deg", -180.0, 180.0),
    number(313, P::kBodySideslip, G::kAttitude, "body sideslip", "deg", -180.0, 180.0),
    any(314, P::kAltitudeRate, G::kPosition, "altitude rate", "m/s"),
    any(315, P::kIndicatedAirspeed, G::kAirData, "indicated airspeed", "m/s"),
    any(316, P::kTrueAirspeed, G::kAirData, "true airspeed", "m/s"),
    any(317, P::kCalibratedAirspeed, G::kAirData, "calibrated airspeed", "m/s"),
    number(319, P::kBaroCorrection, G::kAirData, "baro correction", "hPa", kAboveZero),
    any(320, P::kBaroCorrectedAltitude, G::kPosition, "baro-corrected altitude", "m"),
    number(321, P::kHeadingAngle, G::kAttitude, "heading angle", "deg", -360.0, 360.0),
    any(322, P::kStandardAltitude, G::kPosition, "standard altitude", "m"),
    number(323, P::kTotalAirTemperature, G::kAirData, "total air temperature", "K", kAboveZero),
    number(324, P::kStaticAirTemperature, G::kAirData, "static air temperature", "K", kAboveZero),
    number(326, P::kStaticPressure, G::kAirData, "static pressure", "hPa", 0.0),
    any(327, P::kHeadingRate, G::kAttitude, "heading rate", "deg/s"),
    any(332, P::kTrueAltitude, G::kPosition, "true altitude (MSL)", "m"),
    number(333, P::kWindSpeed, G::kAirData, "wind speed", "m/s", 0.0),
    number(334, P::kWindDirection, G::kAirData, "wind direction", "deg", -360.0, 360.0),
    number(335, P::kOutsideAirTemperature, G::kAirData, "outside air temperature", "K", kAboveZero),
    any(336, P::kBodyNormalVelocity, G::kPosition, "body normal velocity", "m/s"),
    any(337, P::kBodyLongitudinalVelocity, G::kPosition, "body longitudinal velocity", "m/s"),
    any(338, P::kBodyLateralVelocity, G::kPosition, "body lateral velocity", "m/s"),
    degrees(1036, P::kGpsLatitude, "GPS latitude", 90.0),
    degrees(1037, P::kGpsLongitude, "GPS longitude", 360.0),
    any(1038, P::kGpsHeight, G::kPosition, "GPS height above ellipsoid", "m"),
    number(1039, P::kGpsGroundSpeed, G::kPosition, "GPS ground speed", "m/s", 0.0),
    number(1040, P::kGpsTrueTrack, G::kPosition, "GPS true track", "deg", -360.0, 360.0),
    number(1041, P::kGpsMagneticTrack, G::kPosition, "GPS magnetic track", "deg", -360.0, 360.0),
    degrees(1049, P::kInsLatitude, "INS latitude", 90.0),
    degrees(1050, P::kInsLongitude, "INS longitude", 360.0),
    any(1051, P::kInsHeight, G::kPosition, "INS height above ellipsoid", "m"),
    number(1052, P::kInsGroundSpeed, G::kPosition, "INS ground speed", "m/s", 0.0),
    number(1053, P::kInsTrueTrack, G::kPosition, "INS true track", "deg", -360.0, 360.0),
    degrees(1059, P::kAuxiliaryLatitude, "auxiliary nav latitude", 90.0),
    degrees(1060, P::kAuxiliaryLongitude, "auxiliary nav longitude", 360.0),
    any(1061, P::kAuxiliaryHeight, G::kPosition, "auxiliary nav height above ellipsoid", "m"),
    number(1069, P::kMagneticHeading, G::kAttitude, "magnetic heading", "deg", -360.0, 360.0),
    any(1070, P::kRadioHeight, G::kPosition, "radio height", "m"),
    number(1121, P::kMagneticVariation, G::kAirData, "magnetic variation", "deg", -180.0, 180.0),
    any(1130, P::kTrueEastVelocity, G::kPosition, "true east velocity", "m/s"),
    any(1131, P::kTrueNorthVelocity, G::kPosition, "true north velocity", "m/s"),
    any(1132, P::kTrueUpVelocity, G::kPosition, "true up velocity", "m/s"),
    number(1133, P::kTrueHeading, G::kAttitude, "true heading", "deg", -360.0, 360.0),
    {P::kUtc, 1200, G::kTime, M::kTimeOfDay, "UTC", "h,min,s,-", kFourBytes, 0.0, 0.0, false},
    {P::kDate, 1206, G::kTime, M::kDate, "date", "day,month,century,year", kFourBytes, 0.0, 0.0, false},
    weather(1840, P::kVisibility, "proposed: visibility", "m", kAnalogue, 0.0),
    weather(1841, P::kHazeScaleHeight, "proposed: haze scale height", "m", kAnalogue, kAboveZero),
    weather(1842, P::kRelativeHumidity, "proposed: relative humidity", "%", kAnalogue | kOctet, 0.0, 100.0),
    weather(1843, P::kSurfacePressure, "proposed: surface pressure (QNH)", "hPa", kAnalogue, kAboveZero),
    weather(1844, P::kSurfaceTemperature, "proposed: surface temperature", "K", kAnalogue, kAboveZero),
    layer(1850, P::kLayerBase, "proposed: cloud layer # base", "m MSL", kAnalogue, -kLargest, kLargest),
    layer(1851, P::kLayerTop, "proposed: cloud layer # top", "m MSL", kAnalogue, -kLargest, kLargest),
    layer(1852, P::kLayerCoverage, "proposed: cloud layer # coverage", "fraction", kAnalogue | kOctet,
          -kLargest, kLargest, M::kCoverage),
    layer(1853, P::kLayerType, "proposed: cloud layer # type", "CIGI cloud type", kOctet, 0.0, 15.0),
    layer(1854, P::kLayerDensity, "proposed: cloud layer # density", "1/km", kAnalogue, 0.0, kLargest),
    layer(1855, P::kLayerTransition, "proposed: cloud layer # transition band", "m", kAnalogue, 0.0,
          kLargest),
    layer(1856, P::kLayerEnable, "proposed: cloud layer # enable", "0/1", kOctet, 0.0, 1.0),
    layer(1857, P::kLayerWindEast, "proposed: cloud layer # wind east", "m/s", kAnalogue, -kLargest,
          kLargest),
    layer(1858, P::kLayerWindNorth, "proposed: cloud layer # wind north", "m/s", kAnalogue, -kLargest,
          kLargest),
    layer(1859, P::kLayerSeed, "proposed: cloud layer # scroll origin", "", kWord, 0.0, 4294967295.0),
    {P::kUtcMilliseconds, 1870, G::kTime, M::kNumber, "proposed: UTC milliseconds of the day", "ms", kWord,
     0.0, 86'400'999.0, false},
    {P::kTimeRate, 1871, G::kTime, M::kNumber, "proposed: time rate", "", kAnalogue, 0.0, 1e6, false},
    {P::kJulianDate, 1872, G::kTime, M::kNumber, "proposed: Julian date UTC", "day", kDouble, 1721425.5,
     5373484.5, false},
    {P::kCommit, 1880, G::kWeather, M::kCommit, "proposed: commit", "", kCommitTypes, 0.0, 0.0, false},
}};

constexpr bool in_order() {
    for (std::size_t i = 0; i < kParameters; ++i) {
        if (index_of(kDefaults[i].parameter) != i) return false;
    }
    return true;
}
static_assert(in_order(), "one entry a parameter, in the order of the enumeration");

/// What the meaning cannot make a value of.
constexpr TypeSet readable(M meaning) {
    switch (meaning) {
        case M::kTimeOfDay:
        case M::kDate:
            return type_set(DataType::kChar4, DataType::kUChar4, DataType::kBChar4);
        case M::kCommit:
            return kCommitTypes;
        case M::kNumber:
        case M::kDegrees:
        case M::kCoverage:
            break;
    }
    return kAngle | kOctet | kWord |
           type_set(DataType::kShort, DataType::kUShort, DataType::kChar, DataType::kBLong, DataType::kBShort,
                    DataType::kBChar);
}

std::string entry_fault(const MapEntry& entry) {
    if (entry.id < 200 || entry.id > 1999)
        return fmt::format("'{}' has identifier {}: 200 to 1999 carry parameters", entry.name, entry.id);
    if (entry.types == 0) return fmt::format("'{}' has no data type: name at least one", entry.name);
    if ((entry.types & ~readable(entry.meaning)) != 0)
        return fmt::format("'{}' has a data type that cannot carry its value", entry.name);
    const TypeSet halves = entry.types & kDouble;
    if (halves != 0 && halves != kDouble)
        return fmt::format("'{}' has one half of a double: DOUBLEH and DOUBLEL go together", entry.name);
    if (!(entry.low <= entry.high))
        return fmt::format("'{}' has the range {:g} to {:g}: the lower bound comes first", entry.name,
                           entry.low, entry.high);
    return {};
}

}  // namespace

std::string_view MapEntry::unit_of(DataType type) const noexcept {
    if (meaning == Meaning::kCoverage && shape_of(type).form == Form::kUnsigned) return "oktas";
    return unit;
}

const IdentifierMap& default_identifier_map() noexcept {
    static constexpr IdentifierMap kMap{kDefaults, {}, {}};
    return kMap;
}

std::string check(const IdentifierMap& map) {
    std::array<const MapEntry*, 2000> taken{};
    for (std::size_t i = 0; i < kParameters; ++i) {
        const MapEntry& entry = map.entries[i];
        if (index_of(entry.parameter) != i)
            return fmt::format("entry {} of the identifier map is '{}', which belongs elsewhere", i,
                               entry.name);
        if (entry.id == kNoIdentifier) continue;
        if (std::string fault = entry_fault(entry); !fault.empty()) return fault;
        const MapEntry*& holder = taken[entry.id];
        if (holder != nullptr)
            return fmt::format("'{}' and '{}' both have identifier {}: one identifier carries one parameter",
                               holder->name, entry.name, entry.id);
        holder = &entry;
    }
    if (map.conventions.month_base > 1)
        return fmt::format("month_base is {}: January is 0 or 1", map.conventions.month_base);
    for (std::size_t i = 0; i < kUserTypes; ++i) {
        if (map.user_type_bytes[i].value_or(0) > 4)
            return fmt::format("user-defined data type {} has {} bytes: a frame has room for 0 to 4",
                               kFirstUserType + i, *map.user_type_bytes[i]);
    }
    return {};
}

IdentifierIndex::IdentifierIndex(const IdentifierMap& map) noexcept : map_(map) {
    at_.fill(kNothing);
    for (std::size_t i = 0; i < kParameters; ++i) {
        const std::uint16_t id = map_.entries[i].id;
        if (id < kIdentifiers) at_[id] = static_cast<std::uint8_t>(i);
    }
}

}  // namespace skyig::protocol::canaerospace
