// What an image generator's answers tell its host: rate, losses, round trips.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocol/cigi/packets.h"
#include "protocol/cigi/wire.h"
#include "server/report.h"
#include "server/time_histogram.h"

namespace skyig::clients {

class AnswerStatistics {
  public:
    /// A message with this host frame number has gone out. Times are nanoseconds of one clock for all calls.
    void sent(std::uint32_t host_frame_number, std::int64_t at_ns) noexcept;

    /// A Start of Frame has come.
    void received(const protocol::cigi::StartOfFrame& start_of_frame, protocol::cigi::Version version,
                  std::int64_t at_ns) noexcept;

    [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
    /// Numbers left out between the answers that came; a restart of the image generator loses none.
    [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }
    [[nodiscard]] std::uint64_t restarts() const noexcept { return restarts_; }
    /// Answers a second, between the first and the last.
    [[nodiscard]] double rate_hz() const noexcept;
    /// From a message to the first answer that echoes it. Messages that newer ones overtook have none.
    [[nodiscard]] const server::TimeHistogram& round_trip() const noexcept { return round_trip_; }
    /// The same in host frames: how many messages had gone out since.
    [[nodiscard]] const server::FramesBehind& frames_behind() const noexcept { return frames_behind_; }

    [[nodiscard]] const protocol::cigi::StartOfFrame& last() const noexcept { return last_; }
    [[nodiscard]] protocol::cigi::Version version() const noexcept { return version_; }
    /// When the latest answer came, overtaken ones too.
    [[nodiscard]] std::int64_t last_at_ns() const noexcept { return last_at_ns_; }

  private:
    void note_echo(std::uint32_t host_frame_number, std::int64_t at_ns) noexcept;

    /// Messages further back than this have no round trip: minutes at any rate.
    static constexpr std::size_t kRemembered = 4096;

    std::array<std::int64_t, kRemembered> sent_at_ns_{};
    std::uint32_t last_sent_ = 0;
    std::uint64_t sent_count_ = 0;
    std::uint32_t last_echo_ = 0;

    std::uint64_t count_ = 0;
    std::uint64_t lost_ = 0;
    std::uint64_t restarts_ = 0;
    std::int64_t first_at_ns_ = 0;
    std::int64_t last_at_ns_ = 0;
    protocol::cigi::StartOfFrame last_;
    protocol::cigi::Version version_ = protocol::cigi::Version::k33;
    server::TimeHistogram round_trip_;
    server::FramesBehind frames_behind_;
};

}  // namespace skyig::clients
