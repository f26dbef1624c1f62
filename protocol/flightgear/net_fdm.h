// FlightGear's native flight-model packet (`fgfs --native-fdm=socket,out,30,HOST,5500,udp`; JSBSim sends the
// same): FGNetFDM version 24, one datagram of 408 bytes, big-endian, one an output step, without a sequence
// number. Weather and clouds are not in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "protocol/result.h"

namespace skyig::protocol::flightgear {

inline constexpr std::size_t kNetFdmBytes = 408;
inline constexpr std::uint32_t kNetFdmVersion = 24;

/// What a sky wants of the packet. Not taken: air data, engines, tanks, gear and control surfaces.
struct NetFdm {
    /// Geodetic, WGS 84, -180..180 and -90..90. FlightGear's degrees are 7.75e-9 of their value too small
    /// (0.1 m at 122 deg west).
    double longitude_deg = 0.0;
    double latitude_deg = 0.0;
    /// Above mean sea level, not above the ellipsoid.
    double altitude_msl_m = 0.0;
    double height_above_ground_m = 0.0;
    /// Right wing down +, nose up +, true heading 0..360 (360 itself comes as 0). Single precision on the
    /// wire: steps of 1.4e-5 deg at 180 deg.
    double roll_deg = 0.0;
    double pitch_deg = 0.0;
    double heading_deg = 0.0;
    /// Rates of the three angles above (not body rates); any size near the vertical.
    double roll_rate_deg_s = 0.0;
    double pitch_rate_deg_s = 0.0;
    double heading_rate_deg_s = 0.0;
    double velocity_north_m_s = 0.0;
    double velocity_east_m_s = 0.0;
    double velocity_down_m_s = 0.0;
    double visibility_m = 0.0;
    /// Whole seconds since 1970-01-01 UTC of the simulated clock, warp included. The seconds between two
    /// steps of it are the receiver's to count. JSBSim on its own sends 1234567890 or a count of its steps.
    std::int64_t time_unix_s = 0;

    friend bool operator==(const NetFdm&, const NetFdm&) = default;
};

enum class Reason : std::uint8_t {
    kSize,              // not 408 bytes
    kVersion,           // another packet, or no FGNetFDM at all
    kWithdrawnVersion,  // 25, which no release ever sent
    kByteOrder,         // 24 in little-endian order
    kNonFinite,         // NaN or infinity in a field that is taken
    kOutOfRange,
};
inline constexpr std::size_t kReasons = 6;

/// A short word for counters and logs: "size", "version", ...
[[nodiscard]] std::string_view reason_name(Reason reason) noexcept;

struct Refusal {
    Reason reason = Reason::kSize;
    /// Byte of the field that is wrong.
    std::uint16_t offset = 0;
    /// What was found: the number of bytes, the version, or the field's value in the unit of the wire.
    double found = 0.0;
};

/// One line for a log that says what would be right, e.g. "version 25 was withdrawn before any release sent
/// it; 24 is read".
[[nodiscard]] std::string to_string(const Refusal& refusal);

/// Reads one datagram. Longitude is accepted up to a whole turn either way and folded; latitude, pitch and
/// roll are accepted a single-precision step beyond their ends and clamped. Allocates nothing; never throws.
[[nodiscard]] Result<NetFdm, Refusal> decode_net_fdm(std::span<const std::byte> bytes) noexcept;

}  // namespace skyig::protocol::flightgear
