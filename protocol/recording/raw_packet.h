// What the two file formats hand to the layers above: one captured packet, or why there is none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "protocol/byte_order.h"
#include "protocol/recording/capture.h"

namespace skyig::protocol::recording {

struct RawPacket {
    std::uint64_t offset_bytes = 0;
    std::int64_t time_ns = 0;
    bool stamped = true;
    std::uint32_t interface = 0;  // counted on over the sections
    const CaptureInterface* origin = nullptr;
    /// A CAN frame of a file that holds it taken apart, in place of its bytes; else null.
    const CanFrame* frame = nullptr;
    std::span<const std::byte> bytes;
    std::uint64_t original_bytes = 0;  // on the wire; more than bytes.size() if captured with a limit
    std::string_view comment;
    ByteOrder file_order = ByteOrder::kLittle;
};

enum class Step : std::uint8_t {
    kPacket,
    kOversized,  // a packet larger than the window was passed over
    kOther,      // something else was read or passed over
    kEnd,        // behind the last whole block, and nothing follows
    kTruncated,  // something follows, but it is cut off
    kDamaged,    // what follows is no block
};

/// Where a file stops making sense and what would be right.
struct Trouble {
    std::uint64_t offset_bytes = 0;
    std::string text;
};

}  // namespace skyig::protocol::recording
