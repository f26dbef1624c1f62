// How the drawing of one channel goes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace skyig::server::status {

struct ChannelHealth {
    /// It could not be drawn when that was last tried.
    bool failed = false;
    /// Its picture says so in red; else there is no device that could.
    bool crossed_out = false;
    /// How often it could not.
    std::uint64_t failures = 0;

    void set_reason(std::string_view text) noexcept {
        length_ = std::min(text.size(), reason_.size());
        std::copy_n(text.begin(), length_, reason_.begin());
    }
    /// Of the last failure; empty before the first.
    [[nodiscard]] std::string_view reason() const noexcept { return {reason_.data(), length_}; }

  private:
    std::array<char, 120> reason_{};
    std::size_t length_ = 0;
};

}  // namespace skyig::server::status
