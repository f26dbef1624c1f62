#include "protocol/cigi/validate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

#include "protocol/cigi/field_access.h"
#include "protocol/cigi/layout.h"
#include "protocol/cigi/layout_host.h"
#include "protocol/cigi/layout_ig.h"
#include "protocol/cigi/layout_sight.h"

namespace skyig::protocol::cigi {
namespace {

constexpr double kTurn = 360.0;
/// Angles within two turns are taken for angles, larger ones for garbage.
constexpr double kLargestAngle = 720.0;
/// Positive seconds below this are an unsigned integer that was read as a float: 1..59 read as 1.4e-45
/// .. 8.3e-44.
constexpr float kSmallestSeconds = 1.0e-30F;

Verdict refuse(Count reason, std::string_view field) noexcept {
    return {false, false, reason, field};
}

struct Bounds {
    double low = 0.0;
    double high = 0.0;
};

/// Where an angle may stay as it came.
constexpr Bounds turn_bounds(Range::Kind kind) noexcept {
    if (kind == Range::Kind::kFullTurn) return {0.0, kTurn};
    if (kind == Range::Kind::kTwoTurns) return {-kTurn, kTurn};
    return {-kTurn / 2, kTurn / 2};
}

/// Brings an angle into its bounds if it is outside; false if it is no angle.
template <class T>
bool wrap(T& angle, Range::Kind kind) noexcept {
    const double value = static_cast<double>(angle);
    if (std::abs(value) > kLargestAngle) return false;
    const Bounds bounds = turn_bounds(kind);
    if (value >= bounds.low && value <= bounds.high) return true;
    double wrapped = std::remainder(value, kTurn);
    if (wrapped < bounds.low) wrapped += kTurn;
    angle = static_cast<T>(wrapped);
    return true;
}

/// What a value may be without anything to do about it.
template <class T>
constexpr Bounds plain_bounds(const Range& range) noexcept {
    const double largest = static_cast<double>(std::numeric_limits<T>::max());
    const double smallest = static_cast<double>(std::numeric_limits<T>::lowest());
    switch (range.kind) {
        case Range::Kind::kAny:
            return {smallest, largest};
        case Range::Kind::kClosed:
        case Range::Kind::kHalfOpen:
            return {range.low > smallest ? range.low : smallest, range.high < largest ? range.high : largest};
        case Range::Kind::kPositive:
            return {0.0, largest};
        case Range::Kind::kPercent:
            return {0.0, 100.0};
        case Range::Kind::kHalfTurn:
        case Range::Kind::kFullTurn:
        case Range::Kind::kTwoTurns:
            break;
    }
    return turn_bounds(range.kind);
}

/// 1 if the value is finite and in its range, else 0. No branches: nearly all values of nearly all packets
/// are.
template <class P, Version V, std::size_t I>
[[gnu::always_inline]] inline unsigned field_is_plain(const P& packet) noexcept {
    constexpr const auto& kField = std::get<I>(Layout<P>::kFields);
    using Value = typename std::decay_t<decltype(kField)>::Value;
    if constexpr (!kField.place(V).present || std::is_same_v<Value, bool> ||
                  std::is_same_v<Value, std::string_view>) {
        return 1;
    } else if constexpr (std::is_floating_point_v<Value>) {
        constexpr Bounds kBounds = plain_bounds<Value>(kField.range);
        constexpr auto kLow = static_cast<Value>(kBounds.low);
        constexpr auto kHigh = static_cast<Value>(kBounds.high);
        const Value value = packet.*(kField.member);
        const bool above = kField.range.kind == Range::Kind::kPositive ? value > kLow : value >= kLow;
        const bool below = kField.range.kind == Range::Kind::kHalfOpen ? value < kHigh : value <= kHigh;
        return unsigned{above} & unsigned{below};
    } else {
        using Number = typename Raw<Value>::Type;
        constexpr Bounds kBounds = plain_bounds<Number>(kField.range);
        const auto value = static_cast<std::int64_t>(static_cast<Number>(packet.*(kField.member)));
        const bool above = value >= static_cast<std::int64_t>(kBounds.low);
        const bool below = value <= static_cast<std::int64_t>(kBounds.high);
        return unsigned{above} & unsigned{below};
    }
}

template <class P, Version V, std::size_t... I>
[[gnu::always_inline]] inline bool all_plain(const P& packet, std::index_sequence<I...> /*fields*/) noexcept {
    return (field_is_plain<P, V, I>(packet) & ...) != 0;
}

template <class P>
bool is_plain(const P& packet, Version version) noexcept {
    constexpr std::make_index_sequence<kFieldCount<P>> kFields;
    return version == Version::k33 ? all_plain<P, Version::k33>(packet, kFields)
                                   : all_plain<P, Version::k40>(packet, kFields);
}

/// Applies the range of one field; false if the value is out of it.
template <class T>
bool apply(const Range& range, T& value, bool& clamped) noexcept {
    using Kind = Range::Kind;
    if constexpr (std::is_enum_v<T>) {
        return range.kind == Kind::kAny || static_cast<double>(value) <= range.high;
    } else if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
        const auto number = static_cast<double>(value);
        switch (range.kind) {
            case Kind::kAny:
                return true;
            case Kind::kClosed:
                return number >= range.low && number <= range.high;
            case Kind::kHalfOpen:
                return number >= range.low && number < range.high;
            case Kind::kPositive:
                return number > 0.0;
            case Kind::kPercent:
                clamped = clamped || number < 0.0 || number > 100.0;
                value = static_cast<T>(std::clamp(number, 0.0, 100.0));
                return true;
            case Kind::kHalfTurn:
            case Kind::kFullTurn:
            case Kind::kTwoTurns:
                if constexpr (std::is_floating_point_v<T>) return wrap(value, range.kind);
                return true;
        }
    }
    return true;
}

template <class P, class T>
bool value_counts(const P& packet, const Field<P, T>& field) noexcept {
    return field.counts == nullptr || field.counts(packet);
}

/// A NaN or an infinity refuses the packet, or is emptied where it does not count.
template <class P, class T>
void check_finite(P& packet, const Field<P, T>& field, Verdict& verdict) noexcept {
    if constexpr (std::is_floating_point_v<T>) {
        T& value = packet.*(field.member);
        if (std::isfinite(value)) return;
        if (value_counts(packet, field)) {
            verdict = refuse(Count::kNonfinite, field.name);
        } else {
            value = P{}.*(field.member);
        }
    }
}

template <class P, class T>
void check_range(P& packet, const Field<P, T>& field, Verdict& verdict) noexcept {
    if (value_counts(packet, field) && !apply(field.range, packet.*(field.member), verdict.clamped))
        verdict = refuse(Count::kOutOfRange, field.name);
}

/// Field by field, for a packet in which not all is plain; what is no number at all is told first.
template <class P>
void check_fields(P& packet, Version version, Verdict& verdict) noexcept {
    for_each_field<P>([&](const auto& field) {
        if (verdict.accepted && field.place(version).present) check_finite(packet, field, verdict);
    });
    for_each_field<P>([&](const auto& field) {
        if (verdict.accepted && field.place(version).present) check_range(packet, field, verdict);
    });
}

void check_geodetic(double latitude, double& longitude, std::string_view latitude_field,
                    std::string_view longitude_field, Verdict& verdict) noexcept {
    if (latitude < -90.0 || latitude > 90.0) {
        verdict = refuse(Count::kOutOfRange, latitude_field);
    } else if (!wrap(longitude, Range::Kind::kHalfTurn)) {
        verdict = refuse(Count::kOutOfRange, longitude_field);
    }
}

template <class P>
void check_geodetic(P& packet, Verdict& verdict) noexcept {
    check_geodetic(packet.lat_x, packet.lon_y, "lat_x", "lon_y", verdict);
}

template <class P>
void check_source(P& packet, Verdict& verdict) noexcept {
    if (packet.source_coordinate_system) return;
    check_geodetic(packet.source_lat_x, packet.source_lon_y, "source_lat_x", "source_lon_y", verdict);
}

// prepare: what a sender is known to do wrong, mended before the fields are checked.
// check_together: what ties fields together, after each is good by itself.

template <class P>
void prepare(P& /*packet*/) noexcept {}
template <class P>
void check_together(P& /*packet*/, Version /*version*/, Verdict& /*verdict*/) noexcept {}

template <>
void prepare(CelestialSphereControl& packet) noexcept {
    // Compared as integers: a processor that flushes denormals would see 0.
    const auto word = std::bit_cast<std::uint32_t>(packet.seconds);
    if (word > 0 && word < std::bit_cast<std::uint32_t>(kSmallestSeconds))
        packet.seconds = static_cast<float>(word);
}

template <>
void check_together(CelestialSphereControl& packet, Version /*version*/, Verdict& verdict) noexcept {
    Date date;
    if (packet.date_time_valid && !parse_date(packet.date, date))
        verdict = refuse(Count::kOutOfRange, "date");
}

template <>
void check_together(EntityControl& packet, Version version, Verdict& verdict) noexcept {
    if (version == Version::k33 && !packet.attach_state && packet.entity_state != EntityState::kDestroyed) {
        check_geodetic(packet, verdict);
    }
}

template <>
void check_together(EntityPosition& packet, Version /*version*/, Verdict& verdict) noexcept {
    if (!packet.attach_state) check_geodetic(packet, verdict);
}

template <>
void check_together(HatHotRequest& packet, Version /*version*/, Verdict& verdict) noexcept {
    if (!packet.coordinate_system) check_geodetic(packet, verdict);
}

template <>
void check_together(LosSegmentRequest& packet, Version /*version*/, Verdict& verdict) noexcept {
    check_source(packet, verdict);
    if (!verdict.accepted || packet.destination_coordinate_system) return;
    check_geodetic(packet.destination_lat_x, packet.destination_lon_y, "destination_lat_x",
                   "destination_lon_y", verdict);
}

template <>
void check_together(LosVectorRequest& packet, Version /*version*/, Verdict& verdict) noexcept {
    check_source(packet, verdict);
}

template <>
void check_together(PositionResponse& packet, Version /*version*/, Verdict& verdict) noexcept {
    if (packet.coordinate_system == 0) check_geodetic(packet, verdict);
}

template <>
void check_together(EnvRegionControl& packet, Version /*version*/, Verdict& verdict) noexcept {
    if (packet.region_state == RegionState::kDestroyed) return;
    const float largest = std::min(packet.size_x, packet.size_y) / 2.0F;
    if (packet.corner_radius > largest) {
        packet.corner_radius = largest;
        verdict.clamped = true;
    }
}

template <>
void check_together(WeatherControl& packet, Version version, Verdict& /*verdict*/) noexcept {
    if (version != Version::k33) return;
    packet.top_scud_enable = packet.scud_enable;
    packet.top_scud_frequency = packet.scud_frequency;
    packet.top_transition_band = packet.transition_band;
}

/// A wave that is switched off may have no size.
template <>
void check_together(WaveControl& packet, Version /*version*/, Verdict& verdict) noexcept {
    if (!packet.wave_enable) return;
    if (packet.wavelength <= 0.0F) {
        verdict = refuse(Count::kOutOfRange, "wavelength");
    } else if (packet.period <= 0.0F) {
        verdict = refuse(Count::kOutOfRange, "period");
    }
}

template <>
void check_together(ViewDefinition& packet, Version /*version*/, Verdict& verdict) noexcept {
    if (packet.left_enable && packet.right_enable && packet.left >= packet.right) {
        verdict = refuse(Count::kOutOfRange, "left");
    } else if (packet.bottom_enable && packet.top_enable && packet.bottom >= packet.top) {
        verdict = refuse(Count::kOutOfRange, "bottom");
    } else if (packet.near_enable && packet.far_enable && packet.far <= packet.near) {
        verdict = refuse(Count::kOutOfRange, "far");
    }
}

/// True if all is plain. No byte of `bytes` can be one of a packet of one's own: so values stay in registers
/// until they are checked.
template <class P, Version V, ByteOrder Order>
bool read_own(std::span<const std::byte> bytes, P& packet) noexcept {
    constexpr std::make_index_sequence<kFieldCount<P>> kFields;
    P own;
    detail::read_fields<P, V, Order>(bytes, own, kFields);
    prepare(own);
    const bool plain = all_plain<P, V>(own, kFields);
    packet = own;
    return plain;
}

constexpr bool is_leap(int year) noexcept {
    return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
}

constexpr int days_in_month(int year, int month) noexcept {
    constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return month == 2 && is_leap(year) ? 29 : kDays[month - 1];
}

}  // namespace

bool parse_date(std::uint32_t mmddyyyy, Date& date) noexcept {
    const auto year = static_cast<int>(mmddyyyy % 10000U);
    const auto day = static_cast<int>(mmddyyyy / 10000U % 100U);
    const auto month = static_cast<int>(mmddyyyy / 1000000U);
    if (month < 1 || month > 12 || day < 1 || day > days_in_month(year, month)) return false;
    date = {year, month, day};
    return true;
}

std::uint32_t make_date(const Date& date) noexcept {
    return static_cast<std::uint32_t>(date.month * 1000000 + date.day * 10000 + date.year);
}

template <class P>
Verdict validate(P& packet, Version version) noexcept {
    Verdict verdict;
    prepare(packet);
    if (!is_plain(packet, version)) check_fields(packet, version, verdict);
    if (verdict.accepted) check_together(packet, version, verdict);
    return verdict;
}

template <class P>
bool read_valid(std::span<const std::byte> bytes, Version version, ByteOrder order, P& packet,
                Verdict& verdict) noexcept {
    if (!detail::fits<P>(bytes.size(), version)) return false;
    bool plain = true;
    detail::with_constants(version, order, [&](auto v, auto o) {
        plain = read_own<P, decltype(v)::value, decltype(o)::value>(bytes, packet);
    });
    verdict = {};
    if (!plain) check_fields(packet, version, verdict);
    if (verdict.accepted) check_together(packet, version, verdict);
    return true;
}

// The argument is a type, so no parentheses. NOLINTBEGIN(bugprone-macro-parentheses)
#define SKYIG_CIGI_INSTANTIATE(P)                       \
    template Verdict validate<P>(P&, Version) noexcept; \
    template bool read_valid<P>(std::span<const std::byte>, Version, ByteOrder, P&, Verdict&) noexcept;
SKYIG_CIGI_HOST_PACKETS(SKYIG_CIGI_INSTANTIATE)
SKYIG_CIGI_IG_PACKETS(SKYIG_CIGI_INSTANTIATE)
#undef SKYIG_CIGI_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace skyig::protocol::cigi
