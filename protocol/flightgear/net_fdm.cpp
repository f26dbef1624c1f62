#include "protocol/flightgear/net_fdm.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "protocol/byte_order.h"

namespace skyig::protocol::flightgear {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegrees = 180.0 / kPi;
constexpr double kMetresPerFoot = 0.3048;
constexpr double kAny = std::numeric_limits<double>::max();
// The nearest single-precision numbers to pi and pi/2 lie 9e-8 and 4e-8 above them.
constexpr double kSlack_rad = 1.2e-7;
// Faster and farther than anything that FlightGear's models fly; garbage is mostly far beyond.
constexpr double kMaxSpeed_ft_s = 330'000.0;
constexpr double kMinAltitude_m = -12'000.0;
constexpr double kMaxAltitude_m = 1.0e8;

constexpr std::uint16_t kVersionOffset = 0;
constexpr std::uint16_t kTimeOffset = 356;

enum class WireType : std::uint8_t { kFloat, kDouble };

/// A field as it is on the wire and the member that it goes to.
struct Field {
    std::string_view name;
    std::uint16_t offset;
    WireType type;
    double NetFdm::*member;
    double scale;
    double least;  // in the unit of the wire, as `most`
    double most;
};

constexpr WireType kF32 = WireType::kFloat;
constexpr WireType kF64 = WireType::kDouble;
constexpr double kQuarter_rad = kPi / 2 + kSlack_rad;
constexpr double kHalf_rad = kPi + kSlack_rad;
constexpr double kTurn_rad = 2 * (kPi + kSlack_rad);

constexpr std::array kFields{
    Field{"longitude", 8, kF64, &NetFdm::longitude_deg, kDegrees, -kTurn_rad, kTurn_rad},
    Field{"latitude", 16, kF64, &NetFdm::latitude_deg, kDegrees, -kQuarter_rad, kQuarter_rad},
    Field{"altitude", 24, kF64, &NetFdm::altitude_msl_m, 1.0, kMinAltitude_m, kMaxAltitude_m},
    Field{"agl", 32, kF32, &NetFdm::height_above_ground_m, 1.0, -kMaxAltitude_m, kMaxAltitude_m},
    Field{"phi", 36, kF32, &NetFdm::roll_deg, kDegrees, -kHalf_rad, kHalf_rad},
    Field{"theta", 40, kF32, &NetFdm::pitch_deg, kDegrees, -kQuarter_rad, kQuarter_rad},
    Field{"psi", 44, kF32, &NetFdm::heading_deg, kDegrees, -kTurn_rad, kTurn_rad},
    Field{"phidot", 56, kF32, &NetFdm::roll_rate_deg_s, kDegrees, -kAny, kAny},
    Field{"thetadot", 60, kF32, &NetFdm::pitch_rate_deg_s, kDegrees, -kAny, kAny},
    Field{"psidot", 64, kF32, &NetFdm::heading_rate_deg_s, kDegrees, -kAny, kAny},
    Field{"v_north", 76, kF32, &NetFdm::velocity_north_m_s, kMetresPerFoot, -kMaxSpeed_ft_s, kMaxSpeed_ft_s},
    Field{"v_east", 80, kF32, &NetFdm::velocity_east_m_s, kMetresPerFoot, -kMaxSpeed_ft_s, kMaxSpeed_ft_s},
    Field{"v_down", 84, kF32, &NetFdm::velocity_down_m_s, kMetresPerFoot, -kMaxSpeed_ft_s, kMaxSpeed_ft_s},
    Field{"visibility", 364, kF32, &NetFdm::visibility_m, 1.0, 0.0, kAny},
};

double load_number(std::span<const std::byte> bytes, const Field& field) noexcept {
    const std::byte* at = bytes.data() + field.offset;
    if (field.type == WireType::kDouble) return load<double>(at, ByteOrder::kBig);
    return static_cast<double>(load<float>(at, ByteOrder::kBig));
}

Reason reason_of_version(std::uint32_t version) noexcept {
    if (version == 25) return Reason::kWithdrawnVersion;
    if (version == detail::swapped(kNetFdmVersion)) return Reason::kByteOrder;
    return Reason::kVersion;
}

void bring_into_range(NetFdm& state) noexcept {
    state.longitude_deg = std::remainder(state.longitude_deg, 360.0);
    state.latitude_deg = std::clamp(state.latitude_deg, -90.0, 90.0);
    state.roll_deg = std::clamp(state.roll_deg, -180.0, 180.0);
    state.pitch_deg = std::clamp(state.pitch_deg, -90.0, 90.0);
    state.heading_deg = std::fmod(state.heading_deg, 360.0);
    if (state.heading_deg < 0.0) state.heading_deg += 360.0;
    if (state.heading_deg >= 360.0) state.heading_deg = 0.0;  // a tiny negative one, rounded up by the sum
}

const Field* field_at(std::uint16_t offset) noexcept {
    const auto* const found = std::ranges::find(kFields, offset, &Field::offset);
    return found == kFields.end() ? nullptr : found;
}

}  // namespace

std::string_view reason_name(Reason reason) noexcept {
    constexpr std::array<std::string_view, kReasons> kNames{"size",       "version",   "withdrawn_version",
                                                            "byte_order", "nonfinite", "out_of_range"};
    return kNames[static_cast<std::size_t>(reason)];
}

Result<NetFdm, Refusal> decode_net_fdm(std::span<const std::byte> bytes) noexcept {
    if (bytes.size() != kNetFdmBytes)
        return Error{Refusal{Reason::kSize, 0, static_cast<double>(bytes.size())}};
    const auto version = load<std::uint32_t>(bytes.data() + kVersionOffset, ByteOrder::kBig);
    if (version != kNetFdmVersion)
        return Error{Refusal{reason_of_version(version), kVersionOffset, static_cast<double>(version)}};

    NetFdm state;
    for (const Field& field : kFields) {
        const double wire = load_number(bytes, field);
        if (!std::isfinite(wire)) return Error{Refusal{Reason::kNonFinite, field.offset, wire}};
        if (wire < field.least || wire > field.most)
            return Error{Refusal{Reason::kOutOfRange, field.offset, wire}};
        state.*(field.member) = wire * field.scale;
    }
    state.time_unix_s = load<std::uint32_t>(bytes.data() + kTimeOffset, ByteOrder::kBig);
    bring_into_range(state);
    return state;
}

std::string to_string(const Refusal& refusal) {
    switch (refusal.reason) {
        case Reason::kSize:
            return fmt::format("{:.0f} bytes; FGNetFDM version 24 has {}", refusal.found, kNetFdmBytes);
        case Reason::kVersion:
            return fmt::format("version {:.0f}; 24 is read", refusal.found);
        case Reason::kWithdrawnVersion:
            return "version 25 was withdrawn before any release sent it; 24 is read";
        case Reason::kByteOrder:
            return "little-endian; FGNetFDM is sent big-endian";
        case Reason::kNonFinite:
        case Reason::kOutOfRange:
            break;
    }
    const Field* field = field_at(refusal.offset);
    if (field == nullptr) return fmt::format("byte {}: {}", refusal.offset, refusal.found);
    if (refusal.reason == Reason::kNonFinite)
        return fmt::format("byte {}: {} is {}; a finite number", refusal.offset, field->name, refusal.found);
    return fmt::format("byte {}: {} is {:.6g}; {:.6g} to {:.6g}", refusal.offset, field->name, refusal.found,
                       field->least, field->most);
}

}  // namespace skyig::protocol::flightgear
