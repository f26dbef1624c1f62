// Writes recordings as pcapng: UDP datagrams with the IPv4 and UDP headers that they came in (link type 101),
// CAN frames as SocketCAN has them (227), stamps in nanoseconds. Wireshark opens them, CaptureReader reads
// them back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/can_frame.h"
#include "protocol/result.h"
#include "protocol/transport/endpoint.h"

namespace skyig::protocol::recording {

/// Takes whole blocks, one or more in each call, and is to write them in the order of the calls; whatever
/// ends the program between two calls leaves a file that reads to its end. The bytes live only as long as the
/// call. False if they could not be taken: nothing of them may then be written.
using BlockSink = std::function<bool(std::span<const std::byte>)>;

struct RecordingHead {
    /// Free UTF-8 text, any number of lines: what made the recording, with which settings.
    std::string comment{};
    /// The program that writes, with its version, as capinfos shows it.
    std::string program = "skyig";
    /// Of the UDP interface, which is always there and the first.
    std::string udp_name = "udp";
    /// One CAN interface each; a frame goes to the one that its `bus` numbers.
    std::vector<std::string> can_names{};
};

class PcapngWriter {
  public:
    /// What a head's texts may come to, so that every reader takes them.
    static constexpr std::size_t kMaxCommentBytes = std::size_t{512} << 10U;
    static constexpr std::size_t kMaxNameBytes = 64;
    /// A packet's comment is cut here, between two characters.
    static constexpr std::size_t kMaxPacketCommentBytes = 4096;
    static constexpr std::size_t kMaxPayloadBytes = 65'507;

    /// Hands the header to the sink. The error says which text is too long, or that the sink refused.
    [[nodiscard]] static Result<PcapngWriter, std::string> begin(BlockSink sink, const RecordingHead& head);

    /// One block for one datagram. False, and counted, if the sink refuses it or the payload is longer than
    /// UDP can carry. Allocates nothing. \param time_ns  since 1970-01-01 UTC; earlier times are written as
    /// 1970
    bool write_udp(std::int64_t time_ns, const transport::Endpoint& from, const transport::Endpoint& to,
                   std::span<const std::byte> payload, std::string_view comment = {});

    /// One block for one frame, at its received_ns, on the interface of its bus. False, and counted, if the
    /// sink refuses it or there is no such interface. Allocates nothing.
    bool write_can(const CanFrame& frame, std::string_view comment = {});

    [[nodiscard]] std::uint64_t written() const noexcept { return written_; }
    [[nodiscard]] std::uint64_t written_bytes() const noexcept { return written_bytes_; }
    [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

  private:
    PcapngWriter(BlockSink sink, std::size_t can_interfaces);
    bool finish_packet(std::uint32_t interface, std::int64_t time_ns, std::size_t captured,
                       std::string_view comment);
    bool refuse() noexcept;

    BlockSink sink_;
    std::vector<std::byte> block_;  // one packet's block is built here
    std::size_t can_interfaces_ = 0;
    std::uint64_t written_ = 0;
    std::uint64_t written_bytes_ = 0;
    std::uint64_t refused_ = 0;
};

}  // namespace skyig::protocol::recording
