// Drops on a pane before the eye: where they stand and run. Free of GL.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "render/channel.h"
#include "render/scene.h"

namespace skyig::render::precipitation {

/// Contact angle of water on the pane. A drop is the cap of a sphere that meets it so; straight through it
/// light turns by no more than kMostTurn_rad (Snell at its rim).
inline constexpr double kContact_rad = glm::radians(40.0);
inline constexpr double kMostTurn_rad = glm::radians(18.72);

/// A pane across the view axis that leans back by half a right angle in its forces. Rain of Marshall and
/// Palmer hits it with the relative wind; drops of less than kLeast_mm wet it without showing. A drop stands
/// until gravity and the air that flows along the pane pull harder than its rim holds (Furmidge 1962), then
/// runs as fast as its wedge lets it (de Gennes 1985), takes up those that it meets, and leaves at the edge.
/// Without rain drops dry off.
class Windscreen {
  public:
    static constexpr std::size_t kMost = 1024;
    static constexpr double kStep_s = 1.0 / 60.0;
    static constexpr double kLeast_mm = 1.5;
    static constexpr double kFastest_m_s = 2.0;
    /// A drop comes and goes within this time.
    static constexpr double kFade_s = 0.12;

    struct Drop {
        /// On the pane: right and up of the view axis, metres.
        glm::dvec2 at_m{0.0};
        /// Of its base.
        double radius_m = 0.0;
        /// How much of it is there, 0..1; 0: the place is free.
        double there = 0.0;
        bool goes = false;
        double speed_m_s = 0.0;
    };

    /// \param seed  panes of unlike seeds have unlike drops
    explicit Windscreen(std::uint64_t seed = 0) noexcept : seed_(seed) {}

    /// To the scene's time: by whole steps, at most 16 at once; after a longer while, or back in time, the
    /// pane goes on as it is. \param view  its windscreen_m is above 0
    void advance(const Scene& scene, const ChannelView& view) noexcept;

    /// By their place, which a drop keeps while it lasts.
    [[nodiscard]] std::span<const Drop> drops() const noexcept { return drops_; }
    [[nodiscard]] bool dry() const noexcept { return shown_ == 0; }

    /// Drops of at least kLeast_mm that hit a square metre in a second. \param rate_mm_h  of rain
    /// \param towards_m_s  speed of the drops towards the pane
    [[nodiscard]] static double hits_per_m2_s(double rate_mm_h, double towards_m_s) noexcept;

  private:
    struct Conditions {
        double hits = 0.0;  ///< in a step
        double slope_per_mm = 1.0;
        glm::dvec2 gravity_m_s2{0.0};
        glm::dvec2 air_m_s{0.0};
        ImagePlane pane_m;
        bool rains = false;
    };
    [[nodiscard]] static Conditions conditions(const Scene& scene, const ChannelView& view) noexcept;
    void step(const Conditions& now) noexcept;
    void hit(const Conditions& now, std::uint64_t bits) noexcept;
    void run(Drop& drop, const Conditions& now) noexcept;
    void take_up(Drop& runner) noexcept;

    std::array<Drop, kMost> drops_{};
    std::size_t shown_ = 0;
    std::uint64_t seed_;
    std::uint64_t steps_ = 0;
    double time_s_ = 0.0;
    bool started_ = false;
};

}  // namespace skyig::render::precipitation
