// How the drawing of one channel goes.
#pragma once

#include <cstdint>
#include <string_view>

#include "server/status/fixed_text.h"

namespace skyig::server::status {

struct ChannelHealth {
    /// It could not be drawn when that was last tried.
    bool failed = false;
    /// Its picture says so in red; else there is no device that could.
    bool crossed_out = false;
    /// How often it could not.
    std::uint64_t failures = 0;

    void set_reason(std::string_view text) noexcept { reason_.set(text); }
    /// Of the last failure; empty before the first.
    [[nodiscard]] std::string_view reason() const noexcept { return reason_.get(); }

  private:
    FixedText<120> reason_;
};

}  // namespace skyig::server::status
