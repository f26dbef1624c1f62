// Records of a classic pcap file: both byte orders, stamps in microseconds or nanoseconds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/recording/byte_window.h"
#include "protocol/recording/raw_packet.h"

namespace skyig::protocol::recording {

class PcapReader {
  public:
    static constexpr std::uint32_t kMaxPacketBytes = 262'144;  // what the usual programs write at most

    /// True if a file that begins like this is one.
    [[nodiscard]] static bool recognises(std::span<const std::byte> head) noexcept;

    /// Reads the file header, then one record a call. Memory is asked for by `trouble` alone.
    [[nodiscard]] Step next(ByteWindow& window, RawPacket& packet, Trouble& trouble);

    /// One, once the file header is read.
    [[nodiscard]] std::span<const CaptureInterface> interfaces() const noexcept {
        return std::span(&interface_, header_read_ ? 1U : 0U);
    }

  private:
    [[nodiscard]] Step read_header(ByteWindow& window, Trouble& trouble);

    CaptureInterface interface_;
    ByteOrder order_ = ByteOrder::kLittle;
    bool header_read_ = false;
};

}  // namespace skyig::protocol::recording
