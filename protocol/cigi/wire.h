// Which CIGI is spoken, and in which byte order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/byte_order.h"

namespace skyig::protocol::cigi {

using protocol::ByteOrder;
using protocol::kNativeOrder;
using protocol::load;
using protocol::store;

/// k33 is spoken with hosts of minor version 2 and 3 alike; k40 is SISO-STD-013-2014.
enum class Version : std::uint8_t { k33, k40 };

/// The largest UDP payload over IPv4, bytes: no message is longer.
inline constexpr std::size_t kMaxMessageBytes = 65507;

}  // namespace skyig::protocol::cigi
