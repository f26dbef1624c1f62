// The one state of adaptation that all channels of a rig share.
#pragma once

#include <array>
#include <cstddef>

#include "render/display.h"

namespace skyig::render::eye {

/// A direction whose luminance takes part in adaptation: angle above the visible horizon, azimuth from north.
struct ProbeDirection {
    double above_horizon_rad = 0.0;
    double azimuth_rad = 0.0;
};

inline constexpr std::size_t kProbeCount = 84;

/// Directions that a crew looks at, evenly round the horizon, from 10 deg below it to 60 deg above: fixed to
/// the world, so that a turn of the aircraft changes nothing. Discs are too small to be hit on purpose and
/// are left out by the caller.
[[nodiscard]] const std::array<ProbeDirection, kProbeCount>& probe_directions() noexcept;

/// Log-average of luminances, cd/m2, but at least a third of their mean: where most of the view is black
/// (orbit, late twilight) the eye follows the part that is not. Never below 1e-5; what is not finite counts
/// as dark.
[[nodiscard]] double adaptation_target_cd_m2(const std::array<double, kProbeCount>& luminance_cd_m2) noexcept;

/// First-order approach of the logarithm, by scene time.
class Adaptation {
  public:
    /// \param target_cd_m2  > 0; \param time_s  scene time. The first call, a step backwards, and a step of
    /// more than kJump_s set the state to the target at once. \return the luminance that this frame is
    /// adapted to
    double update(double target_cd_m2, double time_s, bool jump, const DisplaySettings& display) noexcept;

    [[nodiscard]] double luminance_cd_m2() const noexcept { return luminance_cd_m2_; }

    static constexpr double kJump_s = 2.0;

  private:
    bool started_ = false;
    double luminance_cd_m2_ = 1.0;
    double time_s_ = 0.0;
};

}  // namespace skyig::render::eye
