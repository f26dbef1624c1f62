// Snapshots from the frame loop's thread to one other: three places in fixed memory, one atomic exchange a
// side. Neither ever waits for the other.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "server/status/snapshot.h"

namespace skyig::server::status {

class SnapshotExchange {
  public:
    /// The writer's own place: fill it, then publish(). Holds what an older frame left there.
    [[nodiscard]] Snapshot& draft() noexcept { return places_[writing_]; }
    void publish() noexcept {
        writing_ = middle_.exchange(static_cast<std::uint8_t>(writing_ | kFresh), std::memory_order_acq_rel) &
                   kPlace;
    }

    /// The reader's: the newest that was published, valid until the next call; `frames` is 0 before the
    /// first.
    [[nodiscard]] const Snapshot& newest() noexcept {
        if ((middle_.load(std::memory_order_relaxed) & kFresh) != 0)
            reading_ = middle_.exchange(reading_, std::memory_order_acq_rel) & kPlace;
        return places_[reading_];
    }

  private:
    static constexpr std::uint8_t kPlace = 3;
    static constexpr std::uint8_t kFresh = 4;

    std::array<Snapshot, 3> places_{};
    std::atomic<std::uint8_t> middle_{0};
    std::uint8_t writing_ = 1;
    std::uint8_t reading_ = 2;
};

}  // namespace skyig::server::status
