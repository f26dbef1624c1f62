// When what one frame has taken came, by the kernel's stamps, freed from steps of the clock.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace skyig::server {

/// Of the kMost first messages of a frame; a host sends a few. Allocates nothing.
class Arrivals {
  public:
    static constexpr std::size_t kMost = 64;

    struct HostMessage {
        std::uint32_t frame_number = 0;
        std::int64_t arrival_ns = 0;
    };

    void clear() noexcept { count_ = host_count_ = 0; }
    /// Of Clock::steady_utc_ns().
    void add(std::int64_t arrival_ns) noexcept {
        if (count_ < kMost) times_ns_[count_++] = arrival_ns;
    }
    /// Of the host in control.
    void add(const HostMessage& message) noexcept {
        if (host_count_ < kMost) host_[host_count_++] = message;
    }

    [[nodiscard]] std::span<const std::int64_t> times_ns() const noexcept {
        return {times_ns_.data(), count_};
    }
    [[nodiscard]] std::span<const HostMessage> host() const noexcept { return {host_.data(), host_count_}; }

  private:
    std::array<std::int64_t, kMost> times_ns_{};
    std::array<HostMessage, kMost> host_{};
    std::size_t count_ = 0;
    std::size_t host_count_ = 0;
};

}  // namespace skyig::server
