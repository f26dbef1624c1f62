// Reads captures as tcpdump, Wireshark and this project's recorder write them: pcapng and pcap, in either
// byte order, and candump logs, from a file, a pipe or memory, in fixed memory however long they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "protocol/recording/byte_window.h"
#include "protocol/recording/candump_reader.h"
#include "protocol/recording/capture.h"
#include "protocol/recording/link_layer.h"
#include "protocol/recording/pcap_reader.h"
#include "protocol/recording/pcapng_reader.h"
#include "protocol/result.h"

namespace skyig::protocol::recording {

class CaptureReader {
  public:
    enum class End : std::uint8_t {
        kNotYet,
        kComplete,   // the file ends behind its last block
        kTruncated,  // cut off, as by a crash of the writer: all whole blocks were given
        kDamaged,    // what follows is no capture, or could not be read
    };

    /// Opens `path` ("-": standard input) and reads the first header, so that the section's comment is known.
    /// The error is one line: "FILE: byte 0: ...; what would be right".
    [[nodiscard]] static Result<CaptureReader, std::string> open(const std::string& path);
    /// Over bytes that outlive the reader; `name` stands for the path in what is said.
    [[nodiscard]] static Result<CaptureReader, std::string> over(std::span<const std::byte> bytes,
                                                                 std::string name);

    /// The next UDP datagram or CAN frame, or null at the end. It lives until the next call. Packets of other
    /// kinds are counted and passed over. Allocates nothing for a packet.
    [[nodiscard]] const CapturedPacket* next();

    [[nodiscard]] End end() const noexcept { return end_; }
    /// Of an end that is not complete: one line "FILE: byte N: what is wrong; what would be right".
    [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }
    [[nodiscard]] const CaptureCounters& counters() const noexcept { return counters_; }

    /// Those of the section that is being read, as far as it has described them; sections mostly describe all
    /// of theirs before the first packet. A pcap file is one section with one interface, a candump log one
    /// with those that its lines have named so far.
    [[nodiscard]] std::span<const CaptureInterface> interfaces() const noexcept;
    /// The interface of the packet that next() has just given.
    [[nodiscard]] const CaptureInterface& interface_of_last() const noexcept;
    /// Free text, lines separated by line feeds; empty in pcap files and logs.
    [[nodiscard]] std::string_view section_comment() const noexcept;

  private:
    using Format = std::variant<PcapngReader, PcapReader, CandumpReader>;

    CaptureReader(ByteWindow window, Format format, std::string name) noexcept;
    [[nodiscard]] static Result<CaptureReader, std::string> begin(ByteWindow window, std::string name);
    [[nodiscard]] Step step();
    [[nodiscard]] Contents take_contents() noexcept;
    [[nodiscard]] bool take_packet() noexcept;
    void finish(Step last);

    ByteWindow window_;
    Format format_;
    std::string name_;
    RawPacket raw_;
    CapturedPacket packet_;
    CaptureCounters counters_;
    Trouble found_;
    std::string trouble_;
    End end_ = End::kNotYet;
};

}  // namespace skyig::protocol::recording
