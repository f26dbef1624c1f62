// Message codes and halves of doubles: what must be remembered of each sender of each identifier. Memory is
// fixed: a bus full of invented senders pushes out those heard longest ago, no more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "protocol/canaerospace/reason.h"

namespace skyig::protocol::canaerospace {

/// `to` - `from`, 0 where time runs backwards.
[[nodiscard]] constexpr std::int64_t elapsed_ns(std::int64_t from_ns, std::int64_t to_ns) noexcept {
    if (to_ns <= from_ns) return 0;
    const std::uint64_t elapsed = static_cast<std::uint64_t>(to_ns) - static_cast<std::uint64_t>(from_ns);
    return elapsed > INT64_MAX ? INT64_MAX : static_cast<std::int64_t>(elapsed);
}

/// Who sends what: identifier (11 bits), redundancy channel (13 bits), node (8 bits).
struct StreamKey {
    std::uint32_t value = 0;

    [[nodiscard]] static constexpr StreamKey of(std::uint16_t id, std::uint16_t channel,
                                                std::uint8_t node) noexcept {
        return {std::uint32_t{id} << 21 | (std::uint32_t{channel} & 0x1FFFU) << 8 | node};
    }
    friend bool operator==(const StreamKey&, const StreamKey&) = default;
};

struct HighHalf {
    bool waiting = false;
    std::uint8_t message_code = 0;
    std::uint8_t service_code = 0;
    std::uint32_t word = 0;
    std::int64_t received_ns = 0;
};

struct Stream {
    StreamKey key;
    bool used = false;
    /// Its codes do not change: they say nothing and are not looked at.
    bool unchecked = false;
    std::uint8_t message_code = 0;
    /// Frames since the start that carried one and the same code at distinct times; 0 once a code differed.
    std::uint8_t equal_codes = 0;
    std::int64_t seen_ns = 0;
    std::int64_t accepted_ns = 0;
    HighHalf high;
};

struct CodeVerdict {
    /// kNone, kDuplicate or kOlder
    Reason reason = Reason::kNone;
    /// Messages missing before this one.
    std::uint8_t lost = 0;
    bool restarted = false;
    bool became_unchecked = false;
};

/// So many frames with one code from the start on show a sender that does not count.
inline constexpr std::uint8_t kConstantCodeFrames = 8;

/// Judges the message code of a frame of `stream` that is sound otherwise, and remembers it if it is
/// accepted. \param may_repeat  the low half of a double may carry its high half's code \param timeout_ns
/// after so long without an accepted frame any code is a new start
[[nodiscard]] CodeVerdict judge_code(Stream& stream, std::uint8_t message_code, bool may_repeat,
                                     std::int64_t received_ns, std::int64_t timeout_ns) noexcept;

/// Sets of 8 streams each. Allocates at construction only.
class StreamTable {
  public:
    /// \param sets  a power of two
    explicit StreamTable(std::size_t sets = 256);

    /// The stream of `key`; a new one (`used` false) takes the place of that of its set heard longest ago.
    [[nodiscard]] Stream& find(StreamKey key) noexcept;
    [[nodiscard]] std::uint64_t evicted() const noexcept { return evicted_; }

  private:
    static constexpr std::size_t kWays = 8;

    std::vector<Stream> streams_;
    std::size_t sets_;
    std::uint64_t evicted_ = 0;
};

}  // namespace skyig::protocol::canaerospace
