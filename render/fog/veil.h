// The veil that obscurants lay before what the eye sees: how much light they keep away along a ray, and what
// they send instead. A plane stack of layers lights it (fluxes by Eddington's approximation over all layers
// together, Shettle & Weinman, J. Atmos. Sci. 27 (1970) 1048, with the forward peak cut), a round Earth bends
// it; what a ray collects is the integral of that source function (Toon et al., J. Geophys. Res. 94 (1989)
// 16287) in closed form.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "render/fog/obscurants.h"
#include "render/shaders/shared.h"

namespace skyig::render::fog {

/// What shines on the stack, linear Rec.709.
struct VeilSources {
    struct Beam {
        glm::dvec3 direction_enu{0.0, 0.0, 1.0};
        /// Above all layers, on a plane that faces it.
        glm::dvec3 lux{0.0};
    };
    std::array<Beam, 2> beams{};
    /// Mean of the sky over the layers (illuminance / pi).
    glm::dvec3 above_cd_m2{0.0};
    /// Of the ground below them, 0..1.
    double ground_albedo = 0.1;
};

class Veil {
  public:
    using Segment = shaders64::VeilSegment;
    /// Shells are cut where the light in them bends.
    static constexpr std::size_t kCuts = 5;
    static constexpr std::size_t kMostSegments = Profile::kMostShells + kCuts;
    static constexpr double kEndless_m = 1e7;

    /// \param obscurants  of the frame; without any that counts the veil is empty. Allocates nothing.
    void lay(std::span<const Obscurant> obscurants, double eye_height_m) noexcept;
    /// Lights what was laid.
    void light(const VeilSources& sources) noexcept;

    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }

    struct Seen {
        /// Part of what lies behind that is seen: of sharp things, and of smooth light, which loses nothing
        /// by being scattered by a few degrees.
        double passed = 1.0;
        double smooth_passed = 1.0;
        glm::dvec3 added_cd_m2{0.0};
        /// Of what the veil keeps away, its mean.
        double distance_m = 0.0;
    };
    /// \param direction_enu  unit vector of the straight ray
    [[nodiscard]] shaders64::VeilSum sum(const glm::dvec3& direction_enu, double end_m) const noexcept;
    [[nodiscard]] Seen seen(const glm::dvec3& direction_enu, double end_m) const noexcept;
    /// The ray up to a thing, and all of it as if the thing were not there.
    struct Both {
        shaders64::VeilSum near;
        shaders64::VeilSum whole;
    };
    /// \param end_m  of the whole; a thing behind it stands at it
    [[nodiscard]] Both along(const glm::dvec3& direction_enu, double distance_m, double end_m) const noexcept;
    /// Sharp things alone.
    [[nodiscard]] double passed(double sine, double end_m = kEndless_m) const noexcept;
    [[nodiscard]] double optical_depth(double sine, double end_m) const noexcept;
    /// As the GPU computes it.
    [[nodiscard]] float optical_depth(float sine, float end_m) const noexcept;

    /// What of the light on the ground the stack leaves, 0..1 and somewhat above under a bright ground.
    [[nodiscard]] const glm::dvec3& ground_share() const noexcept { return ground_share_; }
    /// Over all layers.
    [[nodiscard]] double top_m() const noexcept { return top_m_; }

    // For the GPU.
    [[nodiscard]] std::span<const Segment> segments() const noexcept { return {segments_.data(), count_}; }
    [[nodiscard]] double eye_radius_m() const noexcept { return eye_radius_m_; }
    /// Of a ray in that direction.
    [[nodiscard]] shaders64::VeilBeams beams(const glm::dvec3& direction_enu) const noexcept;
    [[nodiscard]] const VeilSources& sources() const noexcept { return sources_; }

  private:
    void add_segments(const Profile::Shell& shell, double depth_above, std::span<const double> cuts,
                      double eye_height_m) noexcept;
    void stack_depths() noexcept;
    [[nodiscard]] double slant(double sine) const noexcept;
    void light_channel(int channel) noexcept;

    std::array<Segment, kMostSegments> segments_{};
    std::size_t count_ = 0;
    double eye_radius_m_ = 6371.0e3;
    double ground_over_m_ = 0.0;  // of the lowest segment, over the eye
    double top_m_ = 0.0;
    VeilSources sources_;
    std::array<double, 2> slants_{1.0, 1.0};
    glm::dvec3 ground_share_{1.0};
};

/// The same segment in single precision.
[[nodiscard]] shaders32::VeilSegment single_precision(const Veil::Segment& segment) noexcept;

/// Whether what one of them shows differs from what the other shows by more than this part of 1 (of what
/// passes) or of their light, over directions that crowd about the level.
class VeilMark {
  public:
    VeilMark() = default;
    explicit VeilMark(const Veil& veil) noexcept;
    [[nodiscard]] bool differs(const VeilMark& other, double part) const noexcept;

  private:
    static constexpr std::size_t kDirections = 20;
    struct Probe {
        double passed = 1.0;
        glm::dvec3 added_cd_m2{0.0};
    };
    std::array<Probe, kDirections> probes_{};
    glm::dvec3 ground_share_{1.0};
};

}  // namespace skyig::render::fog
