// What fog, dust, rain and their like are made of, and where they lie, as optics.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "render/weather.h"

namespace skyig::render::fog {

/// Scattering of visible light by one sort of particle.
struct Optics {
    /// Of one scattering, linear red, green, blue (612, 549, 465 nm).
    glm::dvec3 albedo{1.0};
    /// Mean cosine; the phase function is Henyey and Greenstein's.
    double g = 0.85;
};

/// Fog: droplets, 1 - albedo below 1e-5 in visible light. Haze: the continental average of OPAC (Hess, Koepke
/// & Schult, Bull. Am. Met. Soc. 79 (1998) 831). Dust: desert sites of AERONET (Dubovik et al., J. Atmos.
/// Sci. 59 (2002) 590), albedo between 440 and 670 nm. Sand: OPAC's transported mineral mode, grains that
/// absorb more, the blue most. Smoke: Dubovik's savanna fires. Rain: drops larger than the light by far, so
/// that half of their extinction is diffraction straight ahead. Snow: crystals.
[[nodiscard]] const Optics& optics_of(Obscurant::Kind kind) noexcept;

/// Extinction of an obscurant that lies in patches: the one whose transmittance is the mean of cells with and
/// without it, as wide as it is thick (300 m at most) and independent of one another. Straight through the
/// layer that is the mean over the ground; along it, over many patches. Whole coverage: its own, exactly.
[[nodiscard]] double mean_extinction_per_m(const Obscurant& obscurant) noexcept;

/// All obscurants in one profile: shells in which extinction is linear with height, from the ground up,
/// without gaps. Each counts by what its area has of it at the eye: a bank that the eye is not in is not
/// seen. Bands below 0 count as 0, a top below its base as the base.
class Profile {
  public:
    struct Shell {
        double low_m = 0.0;  ///< above the ellipsoid
        double high_m = 0.0;
        double low_per_m = 0.0;  ///< just inside
        double high_per_m = 0.0;
        Optics optics;      ///< means by extinction
        double kept = 1.0;  ///< cut depth over true depth: 1 - mean albedo * g^2
    };
    static constexpr std::size_t kMostShells = 4 * Weather::kMaxObscurants;

    /// \param ground_m  what lies lower is left out
    void lay(std::span<const Obscurant> obscurants, double ground_m) noexcept;

    [[nodiscard]] std::span<const Shell> shells() const noexcept { return {shells_.data(), count_}; }
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }

  private:
    std::array<Shell, kMostShells> shells_{};
    std::size_t count_ = 0;
};

}  // namespace skyig::render::fog
