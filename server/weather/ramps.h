// Layers as they are shown: every change of what is told takes its time.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "server/weather/layer_state.h"

namespace skyig::server::weather {

/// How far the wind has carried something since scene time 0: exact while the wind holds, without a jump
/// when it changes.
class Drift {
  public:
    /// East and north, metres.
    [[nodiscard]] glm::dvec2 at(double time_s) const noexcept {
        return offset_m_ + wind_m_s_ * (time_s - since_s_);
    }
    /// The first wind has blown since scene time 0.
    void set_wind(const glm::dvec2& wind_m_s, double time_s) noexcept {
        if (blows_ && wind_m_s == wind_m_s_) return;
        if (blows_) {
            offset_m_ = at(time_s);
            since_s_ = time_s;
        }
        wind_m_s_ = wind_m_s;
        blows_ = true;
    }

  private:
    glm::dvec2 offset_m_{0.0};
    glm::dvec2 wind_m_s_{0.0};
    double since_s_ = 0.0;
    bool blows_ = false;
};

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
    Drift drift;

    /// Where the change began.
    LayerState from;
    double since_s = 0.0;
    /// It is not told any more, and on its way to nothing.
    bool ends = false;
};

/// Linear in scene time over `transition_s`; a new layer grows from nothing, one that is told no more goes to
/// nothing and is forgotten. What layers cover of each other at the eye is limited to the same pace. Depends
/// on what is told and on scene time alone. Allocates at construction only.
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
    void move(ShownLayer& layer, double time_s, double step_s, bool at_once) const noexcept;
    void forget_ended(double time_s, bool at_once) noexcept;

    double transition_s_;
    /// Of the last frame: a change begins there, so that what changes in every frame gets on too.
    double time_s_ = 0.0;
    std::vector<ShownLayer> shown_;
};

}  // namespace skyig::server::weather
