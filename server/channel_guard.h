// Keeps a channel that cannot be drawn from holding up the others: it is tried again in the next frame, then
// ever more rarely.
#pragma once

#include <algorithm>
#include <string_view>

#include "server/status/channel_health.h"

namespace skyig::server {

class ChannelGuard {
  public:
    /// Frames between two tries at most.
    static constexpr int kLongestPause = 63;

    /// Once a frame. \return whether the channel is to be drawn in it
    [[nodiscard]] bool try_now() noexcept {
        if (wait_ == 0) return true;
        --wait_;
        return false;
    }
    void drawn() noexcept {
        health_.failed = health_.crossed_out = false;
        pause_ = 0;
    }
    /// \param crossed_out  whether its picture will show that
    void failed(std::string_view reason, bool crossed_out) noexcept {
        health_.failed = true;
        health_.crossed_out = crossed_out;
        ++health_.failures;
        health_.set_reason(reason);
        wait_ = pause_;
        pause_ = std::min(2 * pause_ + 1, kLongestPause);
    }
    /// What it failed on is gone: tried at once.
    void begin_anew() noexcept { wait_ = pause_ = 0; }
    [[nodiscard]] const status::ChannelHealth& health() const noexcept { return health_; }

  private:
    status::ChannelHealth health_;
    int wait_ = 0;
    int pause_ = 0;
};

}  // namespace skyig::server
