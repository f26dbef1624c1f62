// What falls near the eye, as streaks in space: the same for all channels. Free of GL.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/scene.h"

namespace skyig::render::precipitation {

/// The way of one drop, flake or stone during an exposure, or of a bundle of far ones: a straight rod from
/// head to tail, seen from the origin. Metres east, north, up of the eye.
struct Streak {
    glm::vec3 head_enu_m;
    glm::vec3 tail_enu_m;
    float half_width_m;
    float opacity;  ///< of the rod, 0..1
};

/// How much of what falls is drawn as streaks round the eye, and from where it comes. Shells of doubling
/// distance are filled from one tile of random places that repeats in space; a shell's rods cover as much of
/// the view, in the mean, as its drops dim it (extinction_per_m()), as far as that many rods can. What lies
/// beyond the last shell is an Obscurant's alone.
class StreakField {
  public:
    static constexpr std::size_t kShells = 4;
    /// Where the first shell begins; each ends at twice where it begins.
    static constexpr double kNearest_m = 2.0;
    static constexpr double kFarthest_m = 32.0;
    static_assert(kNearest_m * (1U << kShells) == kFarthest_m);

    /// Allocates for all kinds at their densest.
    StreakField();

    /// Follows the frame: everything moves by scene time and by the eye's own way over the Earth (in double,
    /// wrapped), and stands while both stand. After a jump of the clock it goes on from where it was.
    /// Depends on the scenes that it was shown alone. Allocates nothing, never throws. \param density  part
    /// of the streaks that are drawn, 0..1: fewer, and the more opaque
    void update(const Scene& scene, double density = 1.0) noexcept;

    struct Group {
        Precipitation::Kind kind = Precipitation::Kind::kRain;
        std::span<const Streak> streaks;
    };
    static constexpr std::size_t kKinds = 5;
    /// Of the frame, one a kind that falls; none where nothing does.
    [[nodiscard]] std::span<const Group> groups() const noexcept { return {groups_.data(), group_count_}; }

    /// How long the eye gathers light of one picture: streaks are as long as what falls moves meanwhile.
    [[nodiscard]] static double exposure_s(Precipitation::Kind kind) noexcept;

  private:
    struct Fall;
    struct Shell;
    void carry(const Scene& scene) noexcept;
    void fill(const Scene& scene, const Precipitation& falling) noexcept;
    void fill_shell(const Fall& fall, const Shell& shell) noexcept;

    std::vector<glm::vec3> tile_;  // 0..1
    std::vector<Streak> streaks_;
    std::array<Group, kKinds> groups_{};
    std::size_t group_count_ = 0;
    std::size_t count_ = 0;
    /// How far wind and fall have carried each kind, wrapped to the largest box.
    std::array<glm::dvec3, kKinds> carried_m_{};
    /// How far its flakes have whirled, in turns.
    double whirl_ = 0.0;
    double time_s_ = 0.0;
    double density_ = 1.0;
    bool started_ = false;
};

/// Whether any of it falls at the eye: it has a rate, and the eye is below its top.
[[nodiscard]] bool falls_on(const Precipitation& falling, const Eye& eye) noexcept;

}  // namespace skyig::render::precipitation
