#include "render/night/starlight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skyig::render::night {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

double bell(double x, double width) {
    const double t = x / width;
    return std::exp(-0.5 * t * t);
}

// An exponential disc of stars and dust seen from within, the bulge, the clouds of Norma and of Aquila, and
// dust before all.
double fit_s10(double l_deg, double b_deg) {
    const double l = std::remainder(l_deg, 360.0);
    const double sine = std::abs(std::sin((b_deg + 0.91) * kDegree));
    const double spread = b_deg / 25.0;
    const double disc = (-22.80 + 58.17 * (1.0 - std::exp(-0.1922 / (sine + 0.02))) / 0.1922) *
                        (1.0 - 0.3637 * std::cos((l - 151.7) * kDegree) * std::exp(-spread * spread));
    const double bulge = 1583.0 * bell(l, 9.731) * bell(b_deg - 0.203, 5.765);
    const double norma = 314.0 * bell(std::remainder(l - 336.15, 360.0), 20.35) * bell(b_deg - 0.855, 8.455);
    const double aquila = 93.8 * bell(std::remainder(l - 64.88, 360.0), 14.0) * bell(b_deg - 8.993, 6.0);
    const double dust = 1.0 - 0.8941 * bell(b_deg - 3.224, 10.143) * bell(l, 34.13);
    return std::max(10.0, (disc + bulge + norma + aquila) * dust);
}

}  // namespace

const glm::dmat3& galactic_from_gcrs() noexcept {
    static const glm::dmat3 matrix{-0.0548755604, 0.4941094279,  -0.8676661490,  //
                                   -0.8734370902, -0.4448296300, -0.1980763734,  //
                                   -0.4838350155, 0.7469822445,  0.4559837762};
    return matrix;
}

Starlight starlight_s10(double longitude_rad, double latitude_rad) noexcept {
    const double l_deg = longitude_rad / kDegree;
    const double whole = fit_s10(l_deg, latitude_rad / kDegree);
    if (std::abs(latitude_rad) >= kBelt_rad) return {whole, 0.0};
    const double belt_deg = kBelt_rad / kDegree;
    const double even = std::lerp(fit_s10(l_deg, -belt_deg), fit_s10(l_deg, belt_deg),
                                  0.5 * (latitude_rad / kBelt_rad + 1.0));
    const double belt = std::max(0.0, whole - even);
    return {whole - belt, belt};
}

double typical_starlight_s10() noexcept {
    constexpr int kLatitudes = 90;
    constexpr int kLongitudes = 36;
    const double belt = std::sin(kBelt_rad);
    double sum = 0.0;
    for (int i = 0; i < kLatitudes; ++i) {
        const double share = 2.0 * (i + 0.5) / kLatitudes - 1.0;
        const double latitude_rad = std::copysign(std::asin(std::lerp(belt, 1.0, std::abs(share))), share);
        for (int j = 0; j < kLongitudes; ++j) {
            const Starlight light =
                starlight_s10(2.0 * std::numbers::pi * (j + 0.5) / kLongitudes, latitude_rad);
            sum += std::log(light.even + light.belt);
        }
    }
    return std::exp(sum / (kLatitudes * kLongitudes));
}

}  // namespace skyig::render::night
