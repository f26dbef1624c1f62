// The part of WebSockets (RFC 6455) that a server needs: the handshake's answer, messages in, frames out. No
// socket, no clock; no extension is spoken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "server/status/http.h"

namespace skyig::clients::instructor {

/// How a request to open a WebSocket stands (4.2.1).
enum class Handshake : std::uint8_t { kGood, kBad, kOtherVersion };
[[nodiscard]] Handshake check_handshake(const server::status::HttpRequest& request) noexcept;

/// What Sec-WebSocket-Accept says to a Sec-WebSocket-Key (4.2.2).
[[nodiscard]] std::string accept_key(std::string_view key);

enum class Opcode : std::uint8_t {
    kContinuation = 0,
    kText = 1,
    kBinary = 2,
    kClose = 8,
    kPing = 9,
    kPong = 10
};

/// Codes that a connection is closed with (7.4.1).
enum class CloseCode : std::uint16_t {
    kGoingAway = 1001,
    kProtocolError = 1002,
    kNotUnderstood = 1003,
    kPolicy = 1008,
    kTooBig = 1009
};

/// One unmasked frame, as a server sends it.
[[nodiscard]] std::string make_frame(Opcode opcode, std::string_view payload);
[[nodiscard]] std::string make_close(CloseCode code);

/// Puts the frames of one client together to messages. It keeps at most one message of `most_bytes`.
class MessageReader {
  public:
    enum class Event : std::uint8_t {
        kNothing,  // more has to come
        kText,     // message() is a whole text; whether it is UTF-8 is the reader's to see
        kPing,     // message() is what the answer has to say
        kClose,
        kTooBig,
        kBinary,  // not understood here
        kBroken   // no frames of a client
    };

    explicit MessageReader(std::size_t most_bytes) noexcept : most_bytes_(most_bytes) {}

    /// Takes bytes off the front of `bytes` up to the end of one event. After kTooBig, kBinary, kBroken and
    /// kClose nothing more is to be read.
    [[nodiscard]] Event take(std::span<const char>& bytes);
    /// Valid until the next take().
    [[nodiscard]] const std::string& message() const noexcept { return told_; }

  private:
    [[nodiscard]] Event begin_frame();
    [[nodiscard]] Event end_frame();

    std::size_t most_bytes_;
    /// Of the frame at hand: its head as far as it has come, then how much of its payload is missing.
    std::string head_;
    bool in_payload_ = false;
    bool final_ = false;
    Opcode opcode_ = Opcode::kText;
    std::size_t missing_ = 0;
    std::string payload_;
    /// Of a message in several frames.
    std::string message_;
    bool in_message_ = false;
    std::string told_;
};

}  // namespace skyig::clients::instructor
