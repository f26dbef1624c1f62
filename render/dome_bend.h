// How much the toned light bends with direction, and from that where the dome's rows and columns lie. Linear
// interpolation is off by an eighth of the second derivative times the square of the spacing: where every
// interval shall err alike, nodes stand as close as the root of the second derivative asks. Free of GL.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/shaders/shared.h"
#include "render/sky_light.h"

namespace skyig::render {

/// Quads of the dome: round the horizon, from it to the zenith, from it to the nadir. The two rows of
/// vertices at the horizon itself are counted by neither.
struct DomeSize {
    int columns = 112;
    int sky_rows = 64;
    int ground_rows = 40;

    [[nodiscard]] int rows() const noexcept { return sky_rows + ground_rows + 1; }
    friend bool operator==(const DomeSize&, const DomeSize&) = default;
};

/// The second derivative of a colour along one coordinate.
class BendProfile {
  public:
    /// \param samples  >= 3
    explicit BendProfile(std::size_t samples);

    /// Where it is sampled: rising; to be written before the rest.
    [[nodiscard]] std::span<double> positions_rad() noexcept { return positions_rad_; }
    void clear() noexcept;
    /// Keeps the larger of what is held and of |second derivative|, display codes per square radian.
    void add(std::size_t sample, double codes_per_rad2) noexcept;
    /// \param widest_rad  spacing that no node may exceed where the largest error is a quarter code
    void finish(double widest_rad) noexcept;

    /// Intervals for this largest error at their middle.
    [[nodiscard]] double intervals(double error_codes) const noexcept;
    /// Both ends are nodes.
    void place(std::span<double> nodes_rad) const noexcept;

  private:
    std::vector<double> positions_rad_;
    std::vector<double> bend_;
    std::vector<double> sum_;  // of intervals at an error of one code
};

/// The bends of a frame's light: along some meridians above and below the horizon, and along some circles of
/// equal elevation. 6,500 look-ups by one light source, twice as many by two.
class DomeBend {
  public:
    DomeBend();

    /// The largest over all screens. \param tones  one for each; \param edge_rad  angle over which the
    /// horizon is softened
    void measure(const SkyLight& light, std::span<const shaders64::ToneParameters> tones, double azimuth_rad,
                 double edge_rad);
    void measure(const SkyLight& light, const shaders64::ToneParameters& tone, double azimuth_rad,
                 double edge_rad) {
        measure(light, std::span{&tone, 1}, azimuth_rad, edge_rad);
    }

    /// Quads for a dome whose largest error is this. Multiples of 8, within kLeast and kMost.
    [[nodiscard]] DomeSize size_for(double error_codes) const noexcept;

    /// Elevations above the horizon, rising from the end of its softness to the zenith; below it, from the
    /// nadir to the softness; azimuths from the mesh's own, -pi to pi.
    void place_sky(std::span<double> above_rad) const noexcept { sky_.place(above_rad); }
    void place_ground(std::span<double> above_rad) const noexcept { ground_.place(above_rad); }
    void place_columns(std::span<double> azimuth_rad) const noexcept { columns_.place(azimuth_rad); }

    static constexpr DomeSize kLeast{48, 32, 16};
    static constexpr DomeSize kMost{192, 112, 64};

  private:
    void place_samples(const SkyLight& light, double edge_rad);
    void measure_rows(const SkyLight& light, const shaders32::ToneParameters& tone, double azimuth_rad);
    void measure_columns(const SkyLight& light, const shaders32::ToneParameters& tone, double azimuth_rad);

    BendProfile sky_;
    BendProfile ground_;
    BendProfile columns_;
    std::vector<glm::dvec3> codes_;
};

}  // namespace skyig::render
