// The glow of a town over the horizon: its light scattered once by the air between.
#pragma once

#include <array>
#include <cstddef>

#include "render/night_settings.h"

namespace skyig::render::night {

/// What the glow needs to know of the air, per metre at sea level.
struct TownAir {
    double molecules_per_m = 1.16e-5;
    double aerosol_per_m = 2.6e-5;

    friend bool operator==(const TownAir&, const TownAir&) = default;
};

/// Luminance of one town's glow for one eye, a small table of directions.
///
/// A disc of light sends up what Garstang (1986, PASP 98, 364) has a town send: 2 G (1 - F) cos z + 0.554 F
/// z^4 with G = F = 0.15, of 1000 lm a head. Rayleigh's and Henyey and Greenstein's (g = 0.7) phase
/// functions, scale heights of 8 and 1.2 km, dimming along both legs, the Earth's bulge between. Light that
/// is scattered again (a tenth to a third more) is not followed.
class LightDome {
  public:
    static constexpr int kRows = 20;

    /// Says whose glow is wanted. Rows that still serve are kept: of that city in that air, from the same
    /// distance within 1 %, from a height within height_step_m(). \param distance_m  to the town's centre
    /// along the ground; \param eye_height_m  above the ground
    void aim(const City& city, const TownAir& air, double distance_m, double eye_height_m) noexcept;
    /// At most so many rows further; true when all are there.
    bool build_rows(int most_rows) noexcept;
    [[nodiscard]] bool complete() const noexcept { return next_row_ == kRows; }

    /// How far the eye may be from the height that rows were made for, metres: 2.6 % of the
    /// glow above 1 km, half a degree and more above the horizon.
    [[nodiscard]] static double height_step_m(double height_m) noexcept;

    /// cd/m2. Precondition: complete(). \param elevation_rad  straight, 0..pi/2 (clamped); \param azimuth_rad
    /// from the town's
    [[nodiscard]] double luminance_cd_m2(double elevation_rad, double azimuth_rad) const noexcept;

  private:
    static constexpr int kColumns = 19;

    City city_;
    TownAir air_;
    double distance_m_ = -1.0;
    double eye_height_m_ = 0.0;
    double lumen_ = 0.0;
    int next_row_ = 0;
    std::array<double, std::size_t{kRows} * kColumns> log2_cd_m2_{};
};

/// The same without a table. \param lumen  that the town sends up or down
[[nodiscard]] double town_glow_cd_m2(double lumen, double radius_m, const TownAir& air, double distance_m,
                                     double eye_height_m, double elevation_rad, double azimuth_rad) noexcept;

/// All light of a town, lumen.
[[nodiscard]] double town_lumen(const City& city, const TownAir& air) noexcept;

}  // namespace skyig::render::night
