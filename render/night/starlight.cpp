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

// An exponential disc of stars and dust seen from within, a bulge, and dust before both.
double fit_s10(double l_deg, double b_deg) {
    const double l = std::remainder(l_deg, 360.0);
    const double sine = std::abs(std::sin((b_deg + 0.91) * kDegree));
    const double spread = b_deg / 25.0;
    const double disc = (-21.17 + 55.32 * (1.0 - std::exp(-0.157 / (sine + 0.02))) / 0.157) *
                        (1.0 - 0.386 * std::cos((l - 151.7) * kDegree) * std::exp(-spread * spread));
    const double bulge = 179.8 * bell(l, 7.48) * bell(b_deg, 5.63);
    const double dust = 1.0 - 0.533 * bell(b_deg - 1.5, 4.77) * bell(l, 70.0);
    return std::max(10.0, (disc + bulge) * dust);
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

double mean_starlight_s10() noexcept {
    constexpr int kLatitudes = 90;
    constexpr int kLongitudes = 36;
    double sum = 0.0;
    for (int i = 0; i < kLatitudes; ++i) {
        const double latitude_rad = std::asin(2.0 * (i + 0.5) / kLatitudes - 1.0);
        for (int j = 0; j < kLongitudes; ++j) {
            const Starlight light =
                starlight_s10(2.0 * std::numbers::pi * (j + 0.5) / kLongitudes, latitude_rad);
            sum += light.even + light.belt;
        }
    }
    return sum / (kLatitudes * kLongitudes);
}

}  // namespace skyig::render::night
