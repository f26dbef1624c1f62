// Which redundancy channel of a parameter is listened to: the one in use as long as it is heard, then the
// next that speaks; a lower channel that has come back is taken again after it has been heard for a while.
#pragma once

#include <cstdint>

namespace skyig::protocol::canaerospace {

enum class ChannelStep : std::uint8_t {
    kUsed,      // the channel in use
    kFirst,     // the first one heard
    kFellOver,  // the one in use was silent: this one is in use now
    kReturned,  // a lower one is back for long enough: it is in use now
    kIdle       // another one is in use
};

class ChannelChoice {
  public:
    /// A value came on `channel`.
    /// \param silent_after_ns  so long without a value, a channel is silent
    /// \param return_after_ns  so long a lower channel must have been heard, without being silent between
    [[nodiscard]] ChannelStep hear(std::uint16_t channel, std::int64_t received_ns,
                                   std::int64_t silent_after_ns, std::int64_t return_after_ns) noexcept;

    /// A value was taken.
    [[nodiscard]] bool heard() const noexcept { return heard_; }
    [[nodiscard]] std::uint16_t channel() const noexcept { return channel_; }
    /// When the last value was taken.
    [[nodiscard]] std::int64_t last_ns() const noexcept { return last_ns_; }

  private:
    void take(std::uint16_t channel, std::int64_t received_ns) noexcept;

    bool heard_ = false;
    bool candidate_heard_ = false;
    std::uint16_t channel_ = 0;
    std::uint16_t candidate_ = 0;
    std::int64_t last_ns_ = 0;
    std::int64_t candidate_since_ns_ = 0;
    std::int64_t candidate_last_ns_ = 0;
};

}  // namespace skyig::protocol::canaerospace
