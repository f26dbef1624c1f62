// Any bytes as an FGNetFDM packet: a state within its ranges, or a refusal that can be told.
#include <cmath>
#include <cstdlib>

#include "protocol/flightgear/net_fdm.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace skyig::protocol::flightgear;
    const auto decoded = decode_net_fdm(std::as_bytes(std::span(data, size)));
    if (!decoded) {
        if (to_string(decoded.error()).empty() || reason_name(decoded.error().reason).empty()) std::abort();
        return 0;
    }
    const NetFdm& state = *decoded;
    const bool within = std::abs(state.longitude_deg) <= 180.0 && std::abs(state.latitude_deg) <= 90.0 &&
                        std::abs(state.roll_deg) <= 180.0 && std::abs(state.pitch_deg) <= 90.0 &&
                        state.heading_deg >= 0.0 && state.heading_deg < 360.0 && state.visibility_m >= 0.0;
    const bool finite = std::isfinite(state.roll_rate_deg_s) && std::isfinite(state.pitch_rate_deg_s) &&
                        std::isfinite(state.heading_rate_deg_s) && std::isfinite(state.velocity_north_m_s) &&
                        std::isfinite(state.velocity_east_m_s) && std::isfinite(state.velocity_down_m_s) &&
                        std::isfinite(state.altitude_msl_m) && std::isfinite(state.height_above_ground_m) &&
                        std::isfinite(state.visibility_m);
    if (!within || !finite) std::abort();
    return 0;
}
