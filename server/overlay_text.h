// What the lines over the pictures say: mode and time, frame rate, host. \see config::Overlay
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "config/config.h"
#include "render/scene.h"
#include "server/world/world.h"

namespace skyig::server {

/// The frame rate that is told is that of the grid's places over the last second or so: it is the recording's
/// in a replay. Allocates nothing.
class OverlayText {
  public:
    explicit OverlayText(const config::Config& config);

    /// Writes the lines and which of them each view shows. \param slots  periods since the frame before
    void write(const world::World& world, std::uint64_t slots, render::Scene& scene) noexcept;

  private:
    [[nodiscard]] double frames_a_second() const noexcept;

    std::array<std::uint8_t, config::kMaxChannels> shown_{};
    bool empty_ = true;
    double rate_hz_;

    static constexpr std::size_t kFrames = 64;
    std::array<std::uint64_t, kFrames> slots_{};
    std::uint64_t frames_ = 0;
    std::uint64_t left_out_ = 0;
};

}  // namespace skyig::server
