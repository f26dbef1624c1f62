// Lines for the host's developer (Image Generator Message): in Debug mode only.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace skyig::server::world {

/// What a line is about: its message id on the wire.
enum class Matter : std::uint16_t {
    kPacketRefused = 1,   ///< a value that is no number or out of its range
    kMessageCut = 2,      ///< a message whose framing is lost
    kPacketIgnored = 3,   ///< a valid packet that asks for what is not there or cannot be drawn
    kRequestIgnored = 4,  ///< a request without an answer
};

/// Keeps the lines until they are sent. At most one line a matter each kRepeatAfter_s; the rest is counted.
/// Allocates nothing.
class IgMessages {
  public:
    static constexpr std::size_t kMostWaiting = 16;
    /// What 3.3 can carry, without the NUL.
    static constexpr std::size_t kMostText = 99;
    static constexpr double kRepeatAfter_s = 0.5;

    struct Line {
        Matter matter = Matter::kPacketRefused;
        std::size_t size = 0;
        std::array<char, kMostText> bytes{};

        [[nodiscard]] std::string_view text() const noexcept { return {bytes.data(), size}; }
    };

    /// Closed, it takes nothing; closing forgets what waits.
    void open(bool open) noexcept {
        open_ = open;
        if (!open) count_ = 0;
    }
    [[nodiscard]] bool is_open() const noexcept { return open_; }

    /// A line longer than kMostText is cut.
    template <class... Args>
    void add(Matter matter, fmt::format_string<Args...> format, Args&&... args) {
        if (!open_) return;
        double& since_s = since_s_[static_cast<std::size_t>(matter)];
        if (count_ == kMostWaiting || since_s < kRepeatAfter_s) {
            ++left_out_;
            return;
        }
        since_s = 0.0;
        Line& line = waiting_[(first_ + count_++) % kMostWaiting];
        line.matter = matter;
        const auto end =
            fmt::format_to_n(line.bytes.data(), line.bytes.size(), format, std::forward<Args>(args)...);
        line.size = std::min(end.size, line.bytes.size());
    }

    void advance(double step_s) noexcept {
        for (double& since_s : since_s_)
            since_s += step_s;
    }

    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    /// The first; only while not empty.
    [[nodiscard]] const Line& front() const noexcept { return waiting_[first_]; }
    void pop() noexcept {
        if (count_ == 0) return;
        first_ = (first_ + 1) % kMostWaiting;
        --count_;
    }
    [[nodiscard]] std::uint64_t left_out() const noexcept { return left_out_; }

  private:
    static constexpr std::size_t kMatters = 5;

    bool open_ = false;
    std::array<Line, kMostWaiting> waiting_{};
    std::size_t first_ = 0;
    std::size_t count_ = 0;
    /// Since the last line of each matter, by id.
    std::array<double, kMatters> since_s_{kRepeatAfter_s, kRepeatAfter_s, kRepeatAfter_s, kRepeatAfter_s,
                                          kRepeatAfter_s};
    std::uint64_t left_out_ = 0;
};

}  // namespace skyig::server::world
