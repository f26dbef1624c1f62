// How the air bends the light of the sky's bodies on its way to the eye: where a body is seen that stands
// elsewhere, and where the horizon is seen.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "render/sky/standard_air.h"

namespace skyig::render::sky {

/// Refraction for one eye height and air. Elevations are radians above the level of the eye; "true" is where
/// a body at infinity would be seen without air, "apparent" where it is seen. A plain value; default: no air,
/// eye on the ground.
///
/// Both directions are continuous, strictly increasing and each other's inverse (round trip within 1e-11 rad)
/// over -pi/2..pi/2; the zenith and the nadir stay where they are. Down to the apparent horizon the bending
/// is that of the traced ray; below it, where the ground is in the way, it fades out smoothly over 20 degrees
/// at most, for bodies half set. An elevation beyond the zenith counts along the same great circle.
class RefractionRow {
  public:
    [[nodiscard]] double true_from_apparent(double apparent_rad) const noexcept;
    [[nodiscard]] double apparent_from_true(double true_rad) const noexcept;

    /// Where the ground ends: minus the apparent dip, <= 0.
    [[nodiscard]] double horizon_elevation_rad() const noexcept { return horizon_rad_; }
    /// True elevation of what is seen on the apparent horizon: lower than that by up to 1.1 deg in standard
    /// air.
    [[nodiscard]] double setting_elevation_rad() const noexcept {
        return horizon_rad_ - horizon_bending_rad_;
    }

    /// How much a small body is flattened: d(apparent) / d(true), in (0, 1] above the horizon.
    [[nodiscard]] double vertical_scale(double apparent_rad) const noexcept;

  private:
    friend class Refraction;
    static constexpr std::size_t kColumns = 48;
    static constexpr std::size_t kHeights = 111;

    [[nodiscard]] double bending_rad(double apparent_rad) const noexcept;
    [[nodiscard]] double bending_upwards_rad(double apparent_rad) const noexcept;
    [[nodiscard]] double bending_in_air_rad(double apparent_rad) const noexcept;
    [[nodiscard]] double bending_past_rad(double level_m) const noexcept;
    [[nodiscard]] double level_m(double apparent_rad) const noexcept;

    void set_horizon(double ground_level_m) noexcept;

    // A level is n r - R, metres: rays keep n r cos(elevation), so its value at a ray's lowest point follows
    // from the angle at the eye.
    std::array<double, kColumns + 2> column_{};  // of rays that leave upwards; one more at each end
    std::array<double, kHeights> level_m_{};     // of the lowest point of rays that pass through,
    std::array<double, kHeights> past_rad_{};    // how much they are bent from end to end,
    std::array<double, kHeights> past_slope_{};  // and its slope over the level
    double eye_level_m_ = 0.0;
    double past_at_eye_rad_ = 0.0;
    double level_bending_rad_ = 0.0;  // of the level ray
    double horizon_rad_ = 0.0;
    double horizon_bending_rad_ = 0.0;
    double below_rise_rad_ = 0.0;  // how the bending goes on below the horizon
    double below_scale_rad_ = 1.0;
    double below_fade_rad_ = 1.0;
};

/// The bending of rays in a spherical standard atmosphere, traced once, for every eye height, angle and
/// strength of the air. The ground is a sphere at height 0, or at the eye's height if that is lower.
///
/// Source: the refraction integral of Auer and Standish (2000) along n r cos(elevation) = constant, in a
/// variable that leaves it without a singularity. Error of the table against rays traced step by step: 0.6
/// arcsec above the apparent horizon, from -430 m to geostationary orbit and for all weather; of the standard
/// atmosphere against the real one: arcminutes below 2 deg. Cost: 35 ms to build, 1.5 us a row, 0.05 us an
/// apparent elevation, 0.3 us a true one. Bodies are taken to be at infinity (the Moon on the horizon:
/// 1 arcsec off from the ground, 4 from FL360).
class Refraction {
  public:
    /// Traces the rays; the only member that allocates.
    Refraction();

    /// \param height_m  of the eye above the ellipsoid; below -500 m and above 50,000 km it counts as those
    /// \param pressure_hpa, temperature_c  at height 0. The refractivity is that of the standard atmosphere
    /// at every height, times pressure / 1013.25 and 288.15 / absolute temperature; the product is held
    /// within 0..1.6. No pressure: no refraction. What is not finite counts as standard.
    [[nodiscard]] RefractionRow at(double height_m, double pressure_hpa, double temperature_c) const noexcept;

  private:
    static constexpr std::size_t kStrengths = 3;
    /// Bending per strength, freed of most of its dependence on angle, and its slope over height.
    struct Node {
        std::array<double, kStrengths> value{};
        std::array<double, kStrengths> slope_per_m{};
    };
    static constexpr std::size_t index(std::size_t height, std::size_t column) noexcept {
        return height * RefractionRow::kColumns + column;
    }
    void trace();
    void slope();

    StandardAir air_;
    std::array<double, RefractionRow::kHeights> height_m_{};
    std::array<double, RefractionRow::kHeights> refractivity_{};
    std::vector<Node> nodes_;
};

}  // namespace skyig::render::sky
