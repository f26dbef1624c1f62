// Layers as they are shown: every change of what is told takes its time.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "server/weather/layer_state.h"

namespace skyig::server::weather {

/// A value on its way: linear in scene time, from where it was when it was told otherwise.
class Glide {
  public:
    explicit Glide(double value) noexcept : from_(value), to_(value) {}
    /// \param since_s  the last frame's time: what changes in every frame gets on too
    void aim(double to, double since_s, double transition_s) noexcept;
    void set(double value) noexcept { from_ = to_ = value; }
    [[nodiscard]] double at(double time_s, double transition_s) const noexcept;
    [[nodiscard]] bool settled(double time_s, double transition_s) const noexcept {
        return from_ == to_ || time_s >= since_s_ + transition_s;
    }

  private:
    double from_;
    double to_;
    double since_s_ = 0.0;
};

struct ShownLayer {
    ToldLayer told;
    /// At the frame at hand.
    LayerState state;
    double uncovered = 1.0;
    /// Everywhere, if none.
    std::optional<GroundArea> area;

    /// Where the change began.
    LayerState from;
    double since_s = 0.0;
    std::optional<GroundArea> from_area;
    double area_since_s = 0.0;
    /// It is not told any more, and on its way to nothing.
    bool ends = false;
};

/// Even in scene time over `transition_s` (weather_ramp.h); a new layer grows from nothing, one that is told
/// no more goes to nothing and is forgotten. Areas move and grow alike, but for those that an entity carries:
/// they are where it is. What layers cover of each other at the eye is limited to the same pace. Depends on
/// what is told and on scene time alone. Allocates at construction only.
class Ramps {
  public:
    /// Told layers and those that end.
    static constexpr std::size_t kMost = 128;

    explicit Ramps(double transition_s);

    /// \param told  at most kMost / 2  \param at_once  as told, without any way
    void advance(std::span<const ToldLayer> told, double time_s, bool at_once) noexcept;

    [[nodiscard]] std::span<ShownLayer> shown() noexcept { return shown_; }

  private:
    void tell(const ToldLayer& told) noexcept;
    void tell_area(ShownLayer& layer, const ToldLayer& told) const noexcept;
    void move(ShownLayer& layer, double time_s, double step_s, bool at_once) const noexcept;
    void forget_ended(double time_s, bool at_once) noexcept;

    double transition_s_;
    /// Of the last frame: a change begins there, so that what changes in every frame gets on too.
    double time_s_ = 0.0;
    std::vector<ShownLayer> shown_;
};

}  // namespace skyig::server::weather
