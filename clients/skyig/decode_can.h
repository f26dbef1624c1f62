// skyig decode --can: what each frame of a candump log says, as CANaerospace and in the order of the log.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "clients/skyig/options.h"
#include "protocol/canaerospace/receiver.h"

namespace skyig::clients {

/// Decodes the lines of one log. What needs the frames before (message codes, doubles, redundancy) is kept
/// for each interface apart.
class CanLogDecoder {
  public:
    static constexpr std::size_t kMostInterfaces = 64;

    /// \param name  the log's name in error lines
    CanLogDecoder(std::string name, bool json) : name_(std::move(name)), json_(json) {}

    struct Line {
        std::string text;  ///< without end of line
        bool is_error = false;
    };
    /// The next line of the log; nothing for a blank line or a comment (`#`).
    [[nodiscard]] std::optional<Line> decode(std::string_view line);

    /// "34 frames: 34 accept", ...
    [[nodiscard]] std::string summary() const;

  private:
    using Receivers = std::map<std::string, protocol::canaerospace::Receiver, std::less<>>;

    [[nodiscard]] protocol::canaerospace::Receiver* receiver_of(std::string_view interface);

    std::string name_;
    bool json_;
    std::uint64_t line_ = 0;
    Receivers receivers_;
};

/// An empty log has no frames and no fault.
/// \return the exit status; a line that is none has then been told on stderr, and the others decoded
[[nodiscard]] int run_decode_can(const DecodeOptions& options);

}  // namespace skyig::clients
