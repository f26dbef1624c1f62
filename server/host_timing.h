// How evenly a host's messages come, by the kernel's stamps and by its own.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/cigi/packets.h"
#include "server/time_histogram.h"
#include "server/world/ownship_track.h"

namespace skyig::server {

/// Interval: from one message to the next. Jitter, of a host that stamps its messages: by how much one came
/// later than the quickest, both clocks' difference in rate being followed (world::SenderOffset); what the
/// ownship's motion is freed from. A silence of more than a second begins anew. Allocates nothing.
class HostTiming {
  public:
    /// \param arrival_ns  the kernel's stamp, any steady origin
    void heard(const protocol::cigi::IgControl& control, std::int64_t arrival_ns) noexcept;

    [[nodiscard]] const TimeHistogram& interval() const noexcept { return interval_; }
    [[nodiscard]] const TimeHistogram& jitter() const noexcept { return jitter_; }

  private:
    TimeHistogram interval_;
    TimeHistogram jitter_;
    world::StampClock stamps_;
    world::SenderOffset offset_;
    std::optional<std::int64_t> last_ns_;
    std::int64_t origin_ns_ = 0;
};

}  // namespace skyig::server
