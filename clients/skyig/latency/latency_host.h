// The host of skyig latency, without socket or clock: an aircraft that stands still and flips its attitude
// now and then, in one scene after the other, and asks to be told when each flip was seen.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string_view>
#include <vector>

#include "protocol/cigi/message.h"
#include "protocol/cigi/packets.h"
#include "server/time_histogram.h"

namespace skyig::clients {

/// At 40 N, 0 E on 21 June 2026.
struct LatencyScene {
    std::string_view name;
    int hour_utc = 12;
    /// Six oktas of cumulus, from 1000 m to 2000 m.
    bool clouds = false;
};
/// Day, night, cloud.
[[nodiscard]] std::span<const LatencyScene> latency_scenes() noexcept;

/// By message, until the first and until the last channel of the frame that shows it is finished.
struct LatencyFigures {
    std::uint64_t flips = 0;
    /// Of those the image generator told nothing.
    std::uint64_t untold = 0;
    server::TimeHistogram first_channel;
    server::TimeHistogram last_channel;
};

/// A flip is one of 5 degrees of roll, 2 of pitch and 1 of yaw. Goes to Operate as every host does, lets each
/// scene settle for `settle_frames` messages, flips `flips` times in it, every 7 to 12 messages, and goes on
/// to the next.
class LatencyHost {
  public:
    LatencyHost(int settle_frames, int flips);

    /// The next message; its bytes stay until the next call.
    [[nodiscard]] std::span<const std::byte> next() noexcept;
    void answered(const protocol::cigi::StartOfFrame& start_of_frame) noexcept;
    void told(const protocol::cigi::EventNotification& event) noexcept;

    [[nodiscard]] bool done() const noexcept { return scene_ == figures_.size(); }
    [[nodiscard]] bool operating() const noexcept { return operating_; }
    /// One a scene.
    [[nodiscard]] std::span<const LatencyFigures> figures() const noexcept { return figures_; }

  private:
    void add_scene(protocol::cigi::MessageWriter& writer) const noexcept;
    void add_ownship(protocol::cigi::MessageWriter& writer) const noexcept;
    /// Whether this message flips.
    [[nodiscard]] bool step() noexcept;

    int settle_frames_;
    int flips_;
    std::mt19937 random_{20260621};
    std::vector<LatencyFigures> figures_;
    std::array<std::byte, 512> buffer_{};
    std::uint32_t frame_number_ = 0;
    std::uint32_t last_ig_frame_number_ = 0;
    bool heard_in_standby_ = false;
    bool operating_ = false;
    std::size_t scene_ = 0;
    int frames_in_scene_ = 0;
    int until_flip_ = 0;
    bool turned_ = false;
    /// The message of the last flip, while nothing has been told of it.
    std::optional<std::uint32_t> flipped_;
};

}  // namespace skyig::clients
