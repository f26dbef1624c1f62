// Rings that drops make in shallow water: a small tile of the wave equation. Free of GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace skyig::render::precipitation {

/// z_tt = c^2 laplacian(z) on a grid whose edges meet, by central differences in steps of kStep_s:
/// z+ = damping (2 z - z- + r^2 (sum of the four neighbours - 4 z)), r = c dt / dx, stable for r <= 1 /
/// sqrt 2.
class Ripples {
  public:
    static constexpr int kCells = 128;
    static constexpr double kSide_m = 4.0;
    static constexpr double kStep_s = 1.0 / 60.0;
    static constexpr float kRatio = 0.5F;
    static constexpr float kDamping = 0.98F;

    /// Still water. Allocates all it needs.
    Ripples();

    /// To a scene time: by whole steps, at most 16 at once; after a longer while, or back in time, the water
    /// goes on as it is. Drops fall by a counter of steps since the first call. \param rate_mm_h  of rain,
    /// >= 0 \return whether anything has moved
    bool advance(double time_s, double rate_mm_h) noexcept;

    /// Slopes to the east and to the north in the first two of four floats, rows from the south, with the
    /// first row and column once more at the end: (kCells + 1)^2 texels.
    [[nodiscard]] std::span<const float> slopes() const noexcept { return slopes_; }
    [[nodiscard]] float height(int column, int row) const noexcept { return now_[index(column, row)]; }
    /// What a drop does; for advance() and its tests. \param column, row  any
    void push(int column, int row, float height) noexcept;
    void step() noexcept;

  private:
    [[nodiscard]] static std::size_t index(int column, int row) noexcept {
        constexpr auto kMask = static_cast<unsigned>(kCells - 1);
        return (static_cast<unsigned>(row) & kMask) * kCells + (static_cast<unsigned>(column) & kMask);
    }
    void drop(double rate_mm_h) noexcept;
    void take_slopes() noexcept;

    std::vector<float> now_;
    std::vector<float> before_;
    std::vector<float> slopes_;
    double time_s_ = 0.0;
    std::uint64_t steps_ = 0;
    bool started_ = false;
};

}  // namespace skyig::render::precipitation
