// What rain and snow leave on the land below the eye: a film of water and a layer of snow.
#pragma once

namespace skyig::server::weather {

/// What reaches the ground.
struct Reaching {
    /// Of liquid water, mm/h, >= 0.
    double rain_mm_h = 0.0;
    double snow_mm_h = 0.0;
    double air_c = 15.0;
};

/// A function of what has fallen and when: steps over which nothing changes may be of any length.
///
/// Water: dw/dt = rain + melt - w / kDrains_s, up to what the texture of a road holds (a mean depth of 0.5
/// to 1 mm by the sand patch, ASTM E965); the rest runs off. Snow: lies as deep as its density has it when it
/// falls, 67.92 + 51.25 exp(T / 2.59 C) kg/m3 (Hedstrom and Pomeroy 1998); melts by 3 mm of water a day and
/// degree above 0 C (Hock 2003: 2.5 to 5.5) and by the heat of rain, 4.186 kJ/(kg K) over 334 kJ/kg. Part of
/// the land that it covers: tanh(depth / 2.5 z0), z0 = 1 cm (Niu and Yang 2007, fresh snow).
class GroundCover {
  public:
    static constexpr double kHolds_mm = 0.5;
    static constexpr double kDrains_s = 1800.0;

    /// Neither water nor snow.
    void clear() noexcept { *this = {}; }
    /// As if it had rained like that for long; snow stays as it is.
    void settle(const Reaching& reaching) noexcept;
    /// \param step_s  >= 0
    void advance(const Reaching& reaching, double step_s) noexcept;

    [[nodiscard]] double water_mm() const noexcept { return water_mm_; }
    /// Of water.
    [[nodiscard]] double snow_mm() const noexcept { return snow_mm_; }
    [[nodiscard]] double snow_depth_m() const noexcept { return snow_depth_m_; }
    /// How wet the land is, 0..1.
    [[nodiscard]] double wet() const noexcept { return water_mm_ / kHolds_mm; }
    /// Part of the land under snow, 0..1.
    [[nodiscard]] double snow() const noexcept;

  private:
    double water_mm_ = 0.0;
    double snow_mm_ = 0.0;
    double snow_depth_m_ = 0.0;
};

}  // namespace skyig::server::weather
