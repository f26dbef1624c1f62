// Light under clouds, as a mean over the area: what is left of a source and of the sky below, between and
// above the layers of a scene. Shadows of single clouds are not in it.
#pragma once

#include <array>
#include <cstddef>

#include "render/weather.h"

namespace skyig::render {

/// Parts of what a clear sky would bring, on level ground.
struct CloudShare {
    /// Of a source's own beam and of it scattered by clouds, together.
    float beam = 1.0F;
    /// The beam alone.
    float direct = 1.0F;
    /// Of even light from the sky.
    float sky = 1.0F;
};

/// Layers as slabs (cloud::slab_fluxes) with gaps, one over another at random, the ground below. Light goes
/// back and forth between all of them: adding layers as in Lacis & Hansen, J. Atmos. Sci. 31 (1974) 118. Of
/// a layer that the asked height lies in, the part above counts, so that all is continuous in heights,
/// coverage and depth. A low beam meets the clouds' sides too: of the gaps, a part n of the layer from above,
/// the power 1 + (cot - 0.5) * thickness / apart of n is left at an elevation of that cotangent (as Kauth &
/// Penquite, J. Appl. Meteorol. 6 (1967) 1005, have clear lines of sight; lengths measured on the field).
class CloudShade {
  public:
    /// \param ground_albedo  0..1
    CloudShade(const Weather& weather, double ground_albedo) noexcept;

    /// False: every share is exactly 1.
    [[nodiscard]] bool any() const noexcept { return count_ > 0; }

    /// \param mu0  of the source; at 0 and below `beam` is that of light along the horizon
    [[nodiscard]] CloudShare at(double height_m, double mu0) const noexcept;

  private:
    struct Layer {
        double base_m = 0.0;
        double top_m = 0.0;
        double coverage = 0.0;
        double sides = 0.0;  // thickness over how far the clouds stand apart
        float depth = 0.0F;
        float g = 0.85F;
    };
    [[nodiscard]] static double covered(const Layer& layer, double above, double height_m,
                                        double mu0) noexcept;

    std::array<Layer, Weather::kMaxClouds> layers_{};  // the highest base first
    std::size_t count_ = 0;
    double ground_albedo_ = 0.0;
};

}  // namespace skyig::render
