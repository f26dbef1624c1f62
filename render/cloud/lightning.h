// Lightning: when, where and how bright, from the scene alone, so that all who draw the scene see the same.
// Free of GL.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "render/scene.h"

namespace skyig::render::cloud {

/// One flash at one moment.
struct Flash {
    /// Of the eye, east, north, up, metres, over a flat ground: it lies within 45 km.
    glm::dvec3 place_m{0.0};
    /// The same way in all directions, as an eye sees it that gathers light for some 50 ms.
    double intensity_cd = 0.0;
    /// Index of the CloudLayer that it lights from inside.
    std::size_t layer = 0;

    friend bool operator==(const Flash&, const Flash&) = default;
};

struct Flashes {
    static constexpr std::size_t kMost = 24;
    std::array<Flash, kMost> flashes{};
    std::size_t count = 0;

    [[nodiscard]] std::span<const Flash> all() const noexcept { return {flashes.data(), count}; }
};

/// Longest that one flash is seen.
inline constexpr double kLongestFlash_s = 0.9;
/// Farther than this it lights no cloud.
inline constexpr double kFlashReach_m = 5e3;

/// What of the scene's lightning shines at its time. Flashes come as a Poisson process of the told rate, by
/// slots of time of which each is drawn by a counter from the seed: the answer depends on the scene's time,
/// not on what was asked before. A flash has 3 to 5 strokes within 0.2 to 0.5 s, each rising over 8 ms and
/// fading over 50 ms, so that no frame step is lost between two frames.
/// Places: inside the layer's area, else anywhere over the Earth with the told rate for what lies within 30
/// km east, west, north and south of the eye; fixed to the Earth (sky::sea_anchor), between base and top.
/// Nothing where the rate is 0, the time not finite, or the layer not one of the scene's.
[[nodiscard]] Flashes flashes_at(const Scene& scene) noexcept;

/// Luminance that a flash gives to cloud at a place, linear Rec.709 (it is blue-white), cd/m2: what an opaque
/// white diffuser there would have, I exp(-depth (1 - g)) / (pi d^2). It ends smoothly at kFlashReach_m and
/// grows no further within 150 m. \param place_m  of the eye, as Flash's \param optical_depth  of the cloud
/// between, >= 0 \param g  mean cosine of scattering
[[nodiscard]] glm::vec3 flash_on_cloud_cd_m2(const Flash& flash, const glm::dvec3& place_m,
                                             double optical_depth, double g) noexcept;

/// What all flashes do to everything at once.
struct FlashLight {
    /// On level ground below the eye.
    glm::vec3 ground_lux{0.0F};
    /// Of the air, in all directions of the sky.
    glm::vec3 sky_cd_m2{0.0F};

    friend bool operator==(const FlashLight&, const FlashLight&) = default;
};

/// \param extinction_per_m  of the air near the eye, >= 0
///
/// Cloud hardly absorbs: all light of a flash leaves it, to all sides alike, and falls on level ground as
/// I h / d^3 (h its height over it, at least 500 m). The air round the eye sends on sigma d / (4 pi) of
/// I / d^2, sigma d at most a tenth.
[[nodiscard]] FlashLight light_of(const Flashes& flashes, const Scene& scene,
                                  double extinction_per_m) noexcept;

}  // namespace skyig::render::cloud
