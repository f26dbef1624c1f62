// How much the standard atmosphere slows light, against height: what bends rays.
#pragma once

#include <array>
#include <cstddef>

namespace skyig::render::sky {

inline constexpr double kSeaLevelRefractivity = 2.7745e-4;
inline constexpr double kRefractionTop_m = 100e3;

/// Geometric height of the tropopause, where the lapse rate jumps, and how far on each side of it the jump is
/// rounded off: a sharp one would show rays that graze it in the wrong order.
inline constexpr double kTropopause_m = 11019.1;
inline constexpr double kTropopauseRounding_m = 1000.0;

/// Refractivity n - 1 of the International Standard Atmosphere (15 C, 1013.25 hPa at height 0), proportional
/// to its density: seven layers of constant lapse rate over geopotential height (US Standard Atmosphere
/// 1976), dry, at 570 nm (Ciddor 1996). The lowest layer goes on below height 0, the highest to
/// kRefractionTop_m; nothing bends above.
class StandardAir {
  public:
    StandardAir() noexcept;

    struct At {
        double refractivity = 0.0;
        double slope_per_m = 0.0;  ///< of the refractivity, <= 0
    };
    [[nodiscard]] At at(double height_m) const noexcept;

  private:
    static constexpr std::size_t kLayers = 7;
    [[nodiscard]] At in_layer(std::size_t layer, double height_m) const noexcept;

    std::array<double, kLayers> base_refractivity_{};
};

}  // namespace skyig::render::sky
