// The Milky Way's belt with clouds and dust lanes: what it adds to even starlight, by galactic coordinates.
// Free of GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace skyig::render::night {

/// A grid of |latitude| <= kBelt_rad, longitude from 0 to 360 deg, of luminance outside the air of the whole
/// starlight (both shares on). Its mean over some 10 deg is that of the fit (starlight.h); within, fractal
/// noise of a lognormal spread of 0.35 and what everyone knows by place: the Great Rift from Cygnus to
/// Centaurus, the Coalsack, the star clouds of Scutum, Sagittarius, Cygnus, Carina and Norma.
///
/// Texels hold the luminance warped to t = (1 + x / kWarp_cd_m2)^(1/2.2) - 1: before a night sky display
/// codes go nearly straight with it.
class MilkyWayMap {
  public:
    static constexpr int kWidth = 721;  ///< the last column is the first again
    static constexpr int kHeight = 121;
    static constexpr int kRowsAFrame = 2;
    static constexpr double kWarp_cd_m2 = 2e-4;

    [[nodiscard]] static double warped(double luminance_cd_m2) noexcept;
    [[nodiscard]] static double unwarped(double t) noexcept;

    /// Allocates all that it will need.
    MilkyWayMap();

    /// \param structure  0..1, how much of the detail there is; \param seed  of the noise
    void begin(double structure, std::uint32_t seed) noexcept;
    /// At most so many rows further; true when all are there. Precondition: begin() was called.
    bool build_rows(int most_rows) noexcept;
    [[nodiscard]] bool complete() const noexcept { return next_row_ == kHeight; }

    /// Rows from the lowest latitude. Precondition: complete().
    [[nodiscard]] std::span<const float> texels() const noexcept { return texels_; }

    /// Linear between texels as the GPU has it, cd/m2; 0 outside the belt. \param direction  unit vector,
    /// galactic axes
    [[nodiscard]] double luminance_cd_m2(const glm::dvec3& direction) const noexcept;

    /// Where on the map, 0..1 from edge to edge through texel centres.
    [[nodiscard]] static glm::dvec2 place(double longitude_rad, double latitude_rad) noexcept;

  private:
    // Half widths of the windows over which detail has mean 1.
    static constexpr int kMeanColumns = 12;
    static constexpr int kMeanRows = 8;
    static constexpr int kAround = kWidth - 1;

    /// What a texel is before the window over it is complete; sums are over the window's columns.
    struct Raw {
        float smooth_cd_m2 = 0.0F;
        float detail = 1.0F;
        double smooth_sum = 0.0;
        double detailed_sum = 0.0;
    };
    [[nodiscard]] std::span<Raw> raw_row(int row) noexcept;
    void detail_row(int row) noexcept;
    void sum_row(int row) noexcept;
    void finish_row(int row) noexcept;

    double structure_ = 1.0;
    std::uint32_t seed_ = 0;
    int next_row_ = 0;
    std::vector<float> texels_;
    std::vector<Raw> raw_;  // of as many rows as the window is high, one in place of the other
};

/// All starlight about a place, the map's with what is even: mean over a disc, outside the air, cd/m2. What
/// measurements of that resolution have. Precondition: map.complete(). \param longitude_rad, latitude_rad
/// galactic, away from the poles
[[nodiscard]] double mean_starlight_cd_m2(const MilkyWayMap& map, double longitude_rad, double latitude_rad,
                                          double disc_radius_rad) noexcept;

}  // namespace skyig::render::night
