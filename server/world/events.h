// What the host wants to be told when it happens (Event Notification).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/cigi/packets.h"

namespace skyig::server::world {

/// The ids on the wire; docs/protocols.md tells what their data words hold.
enum class Event : std::uint16_t { kSourceHeard = 1, kSourceLost = 2, kClockSet = 3, kFrameFinished = 4 };

/// Off until the host enables them, one by one. Allocates nothing.
class Events {
  public:
    static constexpr std::size_t kMostWaiting = 64;

    /// \return false when there is no such event
    bool enable(std::uint16_t event_id, bool enable) noexcept;

    /// To be told if enabled. \return false when it was lost: too many wait
    bool raise(Event event, std::uint32_t data_1, std::uint32_t data_2, std::uint32_t data_3 = 0) noexcept;

    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    /// The first; only while not empty.
    [[nodiscard]] const protocol::cigi::EventNotification& front() const noexcept { return waiting_[first_]; }
    void pop() noexcept;
    /// Nothing waits, all off.
    void clear() noexcept;

  private:
    /// By id.
    std::array<bool, 5> enabled_{};
    std::array<protocol::cigi::EventNotification, kMostWaiting> waiting_{};
    std::size_t first_ = 0;
    std::size_t count_ = 0;
};

}  // namespace skyig::server::world
