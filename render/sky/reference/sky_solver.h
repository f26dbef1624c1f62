// The truth that every day-sky model is held against: radiance of a clear sky in a spherical shell, all
// orders of scattering, forty wavelengths, double precision, by backward Monte Carlo. It shares the statement
// of the medium (AirLaw), the geometry of the shell and the phase functions with the models, and none of
// their tables or closures. No polarisation, no refraction, no clouds; a Sun without a disc over Lambertian
// ground.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/sky/reference/medium.h"

namespace skyig::render::sky::reference {

/// Geometric (airless) angles at the eye; heights above the medium's ground, below 0.01 m counts as 0.01 m.
struct View {
    double eye_height_m = 0.0;
    double sun_zenith_rad = 0.0;   ///< 0..pi
    double view_zenith_rad = 0.0;  ///< 0..pi
    double relative_azimuth_rad = 0.0;

    friend bool operator==(const View&, const View&) = default;
};

/// Paths are followed until the standard error of the luminance is below the wanted one, in rounds of
/// kPathsARound, two at least.
struct Effort {
    double relative_error = 0.003;
    int most_paths = 200'000;
    std::uint64_t seed = 1;
};
inline constexpr int kReplicates = 32;
inline constexpr int kPathsARound = 1024;

/// At 360 + 11.75 i nm, and summed with the CIE 1931 observer to XYZ (Y in cd/m2). A standard error is one
/// sigma, from 32 independent replicates (and so known to 13 % itself).
struct Radiance {
    Samples spectral_w_m2_sr_nm{};
    Samples spectral_error{};
    glm::dvec3 xyz{0.0};
    double luminance_error = 0.0;
    /// Luminance of what is scattered once, directly lit ground included.
    double single_luminance = 0.0;
    int paths = 0;
};

/// On the ground; XYZ with Y in lux.
struct GroundLight {
    Samples transmittance{};  // of the path to the Sun
    glm::dvec3 direct_normal_xyz{0.0};
    glm::dvec3 diffuse_xyz{0.0};
    double diffuse_error = 0.0;
    int paths = 0;
};

class SkySolver {
  public:
    explicit SkySolver(const AirLaw& law) : medium_(law) {}

    /// The same values for the same view and effort, on every machine whose libm is the same.
    [[nodiscard]] Radiance radiance(const View& view, const Effort& effort) const;
    [[nodiscard]] GroundLight ground_light(double sun_zenith_rad, const Effort& effort) const;
    /// One after the other on `threads` threads; view i is seeded with effort.seed + i, whatever the threads.
    [[nodiscard]] std::vector<Radiance> radiances(std::span<const View> views, const Effort& effort,
                                                  unsigned threads) const;

  private:
    Medium medium_;
};

/// XYZ of a spectrum in W m-2 (sr-1) nm-1: 683 lm/W times the sum over the samples.
[[nodiscard]] glm::dvec3 xyz_of(const Samples& spectrum) noexcept;

}  // namespace skyig::render::sky::reference
