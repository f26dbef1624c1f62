// Ring of CAN frames between one producer thread and one consumer thread: fixed storage, no locks.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <limits>
#include <vector>

#include "protocol/can_frame.h"

namespace skyig::protocol::transport {

class CanRing {
  public:
    /// Capacity is the next power of two, 64 at least.
    explicit CanRing(std::size_t capacity_frames)
        : frames_(std::bit_ceil(capacity_frames < kLeast ? kLeast : capacity_frames)) {}

    [[nodiscard]] std::size_t capacity_frames() const noexcept { return frames_.size(); }

    /// Producer. False if there is no room; nothing is then changed.
    [[nodiscard]] bool push(const CanFrame& frame) noexcept {
        const std::size_t end = written_.load(std::memory_order_relaxed);
        if (end - released_.load(std::memory_order_acquire) == frames_.size()) return false;
        frames_[end & (frames_.size() - 1)] = frame;
        written_.store(end + 1, std::memory_order_release);
        return true;
    }

    /// Consumer: `take(const CanFrame&)` for each one that was there when the call began, `most_frames` at
    /// most. Returns how many.
    template <class Take>
    std::size_t drain(Take&& take, std::size_t most_frames = std::numeric_limits<std::size_t>::max()) {
        const std::size_t end = written_.load(std::memory_order_acquire);
        const std::size_t start = released_.load(std::memory_order_relaxed);
        const std::size_t count = end - start < most_frames ? end - start : most_frames;
        for (std::size_t i = start; i != start + count; ++i) {
            take(static_cast<const CanFrame&>(frames_[i & (frames_.size() - 1)]));
            released_.store(i + 1, std::memory_order_release);
        }
        return count;
    }

    /// Consumer: nothing waits.
    [[nodiscard]] bool empty() const noexcept {
        return released_.load(std::memory_order_relaxed) == written_.load(std::memory_order_acquire);
    }

  private:
    static constexpr std::size_t kLeast = 64;
    static constexpr std::size_t kCacheLine = 64;

    // Both count frames since the start; each is written by one side only and has its own line.
    alignas(kCacheLine) std::atomic<std::size_t> written_{0};
    std::vector<CanFrame> frames_;
    alignas(kCacheLine) std::atomic<std::size_t> released_{0};
};

}  // namespace skyig::protocol::transport
