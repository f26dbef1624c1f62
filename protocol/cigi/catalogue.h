// Every packet that the two standards define, those that this library does not read included: so that what is
// passed over can be named.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "protocol/cigi/wire.h"

namespace skyig::protocol::cigi {

enum class Sender : std::uint8_t { kHost, kImageGenerator };

/// Id and size in one version. Size 0: the version has no such packet; a size that varies is given by what it
/// has at least.
struct ListedShape {
    std::uint16_t id = 0;
    std::uint16_t size = 0;
    bool varies = false;
};

struct ListedPacket {
    std::string_view name;
    Sender sender = Sender::kHost;
    ListedShape v33;
    ListedShape v40;

    [[nodiscard]] constexpr const ListedShape& shape(Version version) const noexcept {
        return version == Version::k33 ? v33 : v40;
    }
};

/// In the order of their 3.3 ids, then of their 4.0 ids.
[[nodiscard]] std::span<const ListedPacket> listed_packets() noexcept;

/// "articulated_part_control", ..., for any id of either direction; "user_defined" for ids that the standard
/// leaves to its users (201..255 in 3.3, 0x1000..0xFFFE in 4.0), "unassigned" for the others.
[[nodiscard]] std::string_view listed_packet_name(Version version, std::uint16_t id) noexcept;

}  // namespace skyig::protocol::cigi
