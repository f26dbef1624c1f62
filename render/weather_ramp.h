// How weather is changed so that what is seen of it changes evenly: the values between two others are taken
// evenly on these scales.
#pragma once

#include <algorithm>
#include <cmath>

namespace skyig::render {

/// Of a layer's coverage. The first clouds and the last gaps are made by the rarest values of the noise: they
/// are given more time, as measured on the drawn picture (tests/server/weather/ramp_picture_test.cpp).
struct CoverScale {
    static constexpr double kFirst = 1.0 / 16.0;
    static constexpr double kLast = 31.0 / 32.0;
    static constexpr double kFirstPace = 4.0;
    static constexpr double kLastPace = 8.0;

    /// \param coverage  0..1
    [[nodiscard]] static double place_of(double coverage) noexcept {
        return coverage + (kFirstPace - 1.0) * std::min(coverage, kFirst) +
               (kLastPace - 1.0) * std::max(coverage - kLast, 0.0);
    }
    [[nodiscard]] static double value_at(double place) noexcept {
        constexpr double kFirstPlace = kFirstPace * kFirst;
        constexpr double kLastPlace = kFirstPlace + kLast - kFirst;
        const double later = std::clamp(place, kFirstPlace, kLastPlace) - kFirstPlace;
        return std::min(place, kFirstPlace) / kFirstPace + later +
               std::max(place - kLastPlace, 0.0) / kLastPace;
    }
};

/// Of extinction, 1/m: a logarithm, for a distance's transmittance changes fastest where its optical depth is
/// 1, by 1/e of the part by which the extinction changes.
struct ExtinctionScale {
    /// Of clear air besides, by which nothing is told from it.
    static constexpr double kClear_per_m = 2e-5;

    [[nodiscard]] static double place_of(double extinction_per_m) noexcept {
        return std::log1p(extinction_per_m / kClear_per_m);
    }
    [[nodiscard]] static double value_at(double place) noexcept { return kClear_per_m * std::expm1(place); }
};

/// Part `t` of the way, 0..1; at 0 and 1 the one and the other to the last bit.
template <class Scale>
[[nodiscard]] double between(double from, double to, double t) noexcept {
    if (t <= 0.0 || from == to) return from;
    if (t >= 1.0) return to;
    return Scale::value_at(std::lerp(Scale::place_of(from), Scale::place_of(to), t));
}

}  // namespace skyig::render
