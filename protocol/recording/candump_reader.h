// A candump log read as a capture: one CAN frame a line, its interfaces in the order in which they first
// appear.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "protocol/recording/byte_window.h"
#include "protocol/recording/raw_packet.h"

namespace skyig::protocol::recording {

class CandumpReader {
  public:
    /// What recognises() wants to see of a file, or all of a shorter one.
    static constexpr std::size_t kHeadBytes = 4096;

    /// True if a file that begins like this may be one: its first line that is neither blank nor comment
    /// begins with a time stamp, or there are comments alone.
    [[nodiscard]] static bool recognises(std::span<const std::byte> head) noexcept;

    /// The first call reads nothing; then a line a call, blank lines and comments passed over. A line that is
    /// no frame ends the log, as cut off if it is the last and has no end. Memory is asked for by `trouble`
    /// and by an interface that appears alone.
    [[nodiscard]] Step next(ByteWindow& window, RawPacket& packet, Trouble& trouble);

    [[nodiscard]] std::span<const CaptureInterface> interfaces() const noexcept { return interfaces_; }

  private:
    [[nodiscard]] std::uint32_t interface_of(std::string_view name);
    [[nodiscard]] Step take_line(std::string_view line, bool ended, RawPacket& packet, Trouble& trouble);

    std::vector<CaptureInterface> interfaces_;
    CanFrame frame_;
    std::uint64_t lines_ = 0;
    bool begun_ = false;
};

}  // namespace skyig::protocol::recording
