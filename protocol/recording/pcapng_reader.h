// Blocks of a pcapng file, one after the other: both byte orders, any number of sections and interfaces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "protocol/recording/byte_window.h"
#include "protocol/recording/raw_packet.h"

namespace skyig::protocol::recording {

class PcapngReader {
  public:
    static constexpr std::size_t kMaxInterfaces = 4096;  // of a section; bounds what a bad file can ask for

    /// Reads one block. Memory is asked for only by section and interface blocks, and by `trouble`.
    [[nodiscard]] Step next(ByteWindow& window, RawPacket& packet, Trouble& trouble);

    /// Of the section that the last block was in.
    [[nodiscard]] std::span<const CaptureInterface> interfaces() const noexcept { return interfaces_; }
    [[nodiscard]] std::uint32_t first_interface() const noexcept { return first_interface_; }
    /// The section's comments, a line feed between them.
    [[nodiscard]] const std::string& section_comment() const noexcept { return section_comment_; }

  private:
    using Bytes = std::span<const std::byte>;

    [[nodiscard]] Step begin_section_order(Bytes head, Trouble& trouble);
    [[nodiscard]] Step pass_over(ByteWindow& window, std::uint32_t length, Trouble& trouble);
    [[nodiscard]] Step read_section(Bytes block, Trouble& trouble);
    [[nodiscard]] Step read_interface(Bytes block, Trouble& trouble);
    [[nodiscard]] Step read_packet(Bytes block, std::uint32_t interface, RawPacket& packet, Trouble& trouble);
    [[nodiscard]] Step read_simple_packet(Bytes block, RawPacket& packet, Trouble& trouble);
    [[nodiscard]] Step read_block(std::uint32_t type, Bytes block, RawPacket& packet, Trouble& trouble);
    [[nodiscard]] bool find_interface(std::uint32_t interface, std::size_t at, RawPacket& packet,
                                      Trouble& trouble) const;
    [[nodiscard]] Step damaged(std::uint64_t at, std::string text, Trouble& trouble) const;

    ByteOrder order_ = ByteOrder::kLittle;
    std::vector<CaptureInterface> interfaces_;
    std::uint32_t first_interface_ = 0;
    std::string section_comment_;
    std::uint64_t block_offset_ = 0;  // of the block that is read
    std::int64_t last_time_ns_ = 0;
    std::uint8_t can_interfaces_ = 0;
};

}  // namespace skyig::protocol::recording
