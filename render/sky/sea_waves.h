// The told waves as a frame sees them: trains of crests that run over the Earth. Which of them a pixel
// resolves, and where. Pure mathematics.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "render/scene.h"
#include "render/shaders/shared.h"
#include "render/sky/sea_surface.h"

namespace skyig::render::sky {

/// Metres over the ellipsoid from where the equator meets the nearest meridian of whole five degrees: along
/// the eye's own parallel, and along the meridian (WGS84; Snyder 1987, Map Projections, eq. 3-21 and 4-21).
struct SeaAnchor {
    glm::dvec2 eye_m{0.0};
    /// What `eye_m.x` gains a metre to the north: parallels grow shorter. Within 0.044 of 0.
    double closing = 0.0;
};
[[nodiscard]] SeaAnchor sea_anchor(const Eye& eye) noexcept;

struct SeaWaves {
    /// As many as sky/sea.frag takes.
    static constexpr std::size_t kMost = 4;

    std::array<shaders64::WaveTrain, kMost> trains{};
    std::size_t count = 0;
    /// Of wind and all told waves, along the ways that trains are drawn, roughened(): less what is resolved
    /// of the trains, it is the roughness that is left.
    SlopeVariance variance;

    [[nodiscard]] std::span<const shaders64::WaveTrain> all() const noexcept {
        return {trains.data(), count};
    }
};

/// Of the four steepest told waves those that pixels of this angle resolve straight below the eye, the
/// longest first; all others only roughen the sea, from whatever height. A crest stands at the anchor at
/// scene time 0 (Wave::phase_rad 0) and runs a wave's length in its period. Trains follow the anchor's own
/// axes, so that they lie still on the Earth under a moving eye: their way is off the told one by at most 2.5
/// deg. Wave::leading_rad counts up to 1 either way.
[[nodiscard]] SeaWaves sea_waves(const Scene& scene, double pixel_rad) noexcept;

/// Of the eye above the sea, at least half a metre.
[[nodiscard]] double height_above_sea_m(const Scene& scene) noexcept;

/// Sine of the depression below which no train of this length is resolved: 1 from 2 * pixels a wave on.
[[nodiscard]] double least_depression_sine(double height_m, double number_rad_m, double pixel_rad) noexcept;

}  // namespace skyig::render::sky
