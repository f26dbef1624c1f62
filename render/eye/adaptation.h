// The one state of adaptation that all channels of a rig share.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "render/channel.h"
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

/// What a tenth of these luminances exceed, cd/m2: more than the Sun's aureole alone.
[[nodiscard]] double bright_part_cd_m2(std::array<double, kProbeCount> luminances_cd_m2) noexcept;

/// A direction that a channel sees, and how much of the view it stands for.
struct ViewProbe {
    glm::dvec3 direction_enu;
    double solid_angle_sr = 0.0;
};

inline constexpr std::size_t kViewProbeColumns = 8;
inline constexpr std::size_t kViewProbeRows = 6;

/// A channel's probes: places in its image plane, the same in every frame, whatever its resolution.
/// Precondition: has_area(view.frustum).
[[nodiscard]] std::array<ViewProbe, kViewProbeColumns * kViewProbeRows> view_probes(
    const ChannelView& view) noexcept;

/// Means of luminances, cd/m2. What is not finite or negative counts as dark.
class LuminanceMean {
  public:
    void add(double luminance_cd_m2, double weight = 1.0) noexcept;

    [[nodiscard]] bool empty() const noexcept { return !(weight_ > 0.0); }
    /// Log-average, but at least a third of the mean: where most of the view is black (orbit, late twilight)
    /// the eye follows the part that is not. Never below 1e-5.
    [[nodiscard]] double log_average_cd_m2() const noexcept;
    /// Arithmetic; never below 1e-5.
    [[nodiscard]] double mean_cd_m2() const noexcept;

  private:
    double weight_ = 0.0;
    double sum_ = 0.0;
    double sum_of_logs_ = 0.0;
};

/// Both states as one: the luminance that a settled eye has the same threshold at, as log10. The more
/// sensitive of cones and rods decides, so that by day the cones' state counts and in the dark, after some
/// minutes, that of the rods.
[[nodiscard]] double equivalent_log_adaptation(double log_cones, double log_rods) noexcept;

/// First-order approach of the logarithm, by scene time. kPhysiological: cones and rods each have a state,
/// with 0.1 and 0.4 s towards light and the recovery of their pigments, 110 and 400 s, towards the dark.
class Adaptation {
  public:
    /// \param target_cd_m2  > 0; \param time_s  scene time. The first call, a step backwards, and a step of
    /// more than kJump_s set the state to the target at once. \return the luminance that this frame is
    /// adapted to
    double update(double target_cd_m2, double time_s, bool jump, const DisplaySettings& display) noexcept;

    /// The next step is taken as it is, however long and whatever has jumped: the eyes were there all along.
    void resume() noexcept { resumed_ = true; }

    [[nodiscard]] double luminance_cd_m2() const noexcept { return luminance_cd_m2_; }

    /// All that it knows, one value after the other: for who takes it elsewhere.
    template <class Visit>
    void visit(Visit&& visit) {
        visit(started_), visit(resumed_), visit(luminance_cd_m2_), visit(log_cones_), visit(log_rods_),
            visit(time_s_);
    }

    static constexpr double kJump_s = 2.0;

  private:
    bool started_ = false;
    bool resumed_ = false;
    double luminance_cd_m2_ = 1.0;
    double log_cones_ = 0.0;
    double log_rods_ = 0.0;
    double time_s_ = 0.0;
};

}  // namespace skyig::render::eye
