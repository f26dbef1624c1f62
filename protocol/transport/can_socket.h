// A CAN bus in, by a raw socket of Linux. The receiver has a thread of its own that takes frames with the
// kernel's time stamps into a ring of fixed storage; one consumer drains it without waiting or allocating.
// Interfaces come and go (USB adapters, `ip link set down`): the receiver waits for them as long as it lives.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/can_frame.h"
#include "protocol/result.h"
#include "protocol/transport/can_ring.h"

namespace skyig::protocol::transport {

/// Lets through what has all the bits of `id` that `mask` names; of 11-bit or of 29-bit frames, never of
/// both.
struct CanFilter {
    std::uint32_t id = 0;
    std::uint32_t mask = kMaxExtendedId;
    bool extended = false;
};

/// The kernel takes no more of them for one socket.
inline constexpr std::size_t kMaxCanFilters = 512;

struct CanOptions {
    /// Such as "can0"; 1..15 characters.
    std::string interface {};
    /// CanFrame::bus of all that comes.
    std::uint8_t bus = 0;
    /// Data and remote frames that any of these lets through; empty: all. Error frames always come.
    std::vector<CanFilter> filters{};
    /// Frames that may wait for the consumer, brought to a power of two: two seconds of a full bus.
    std::size_t ring_frames = std::size_t{1} << 14U;
    /// How long to wait until a missing interface is looked for again.
    std::chrono::milliseconds retry{1000};
};

enum class CanState : std::uint8_t {
    kMissing,  // no CAN interface has this name; it is looked for
    kDown,     // it is there and switched off
    kUp
};
/// "missing", "down", "up"
[[nodiscard]] std::string_view to_text(CanState state) noexcept;

struct CanCounters {
    std::uint64_t received = 0;      // put into the ring, of all kinds
    std::uint64_t fd_frames = 0;     // of these: CAN FD
    std::uint64_t error_frames = 0;  // of these: bus errors that the controller told
    std::uint64_t dropped = 0;       // lost in the kernel: the socket's queue was full
    std::uint64_t ring_full = 0;     // lost here: the consumer was too slow
    std::uint64_t went_down = 0;     // times that the interface was switched off
    std::uint64_t went_away = 0;     // times that it was deleted or unplugged
    std::uint64_t opened = 0;        // times that it was found, the first included
    std::uint64_t errors = 0;        // calls that failed for any other reason
};

class CanReceiver {
  public:
    /// Starts the thread; the interface need not be there. The error is one line: this kernel has no CAN
    /// ("can can0: this kernel has no CAN; ..."), no raw CAN sockets, or the options make no sense.
    [[nodiscard]] static Result<CanReceiver, std::string> open(const CanOptions& options);
    CanReceiver(CanReceiver&&) noexcept;
    CanReceiver& operator=(CanReceiver&&) noexcept;
    CanReceiver(const CanReceiver&) = delete;
    CanReceiver& operator=(const CanReceiver&) = delete;
    /// Stops the thread at once.
    ~CanReceiver();

    /// Calls `take(const CanFrame&)` for each frame that had come when the call began, oldest first. One
    /// consumer thread. Stops after `most_frames`; the rest waits. Returns how many.
    template <class Take>
    std::size_t drain(Take&& take, std::size_t most_frames = std::numeric_limits<std::size_t>::max()) {
        return ring().drain(take, most_frames);
    }

    /// Waits until a frame is in the ring or the time is over; true if one is. For consumers without a frame
    /// clock.
    [[nodiscard]] bool wait(std::chrono::milliseconds timeout) noexcept;

    [[nodiscard]] const std::string& interface() const noexcept;
    /// Follows the interface within `retry`; down and away at once.
    [[nodiscard]] CanState state() const noexcept;
    /// A frame that the kernel dropped shows with the next one that it could queue. A state() asked for after
    /// the counters is no older than they are.
    [[nodiscard]] CanCounters counters() const noexcept;

  private:
    struct State;
    explicit CanReceiver(std::unique_ptr<State> state) noexcept;
    [[nodiscard]] CanRing& ring() noexcept;

    std::unique_ptr<State> state_;
};

}  // namespace skyig::protocol::transport
