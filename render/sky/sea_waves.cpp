#include "render/sky/sea_waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "render/sky/sea_surface.h"

namespace skyig::render::sky {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

// WGS84.
constexpr double kEquator_m = 6378137.0;
constexpr double kEccentricity2 = 6.69437999014e-3;

double meridian_m(double latitude_rad) {
    constexpr double e2 = kEccentricity2;
    constexpr double e4 = e2 * e2;
    constexpr double e6 = e4 * e2;
    return kEquator_m *
           ((1.0 - e2 / 4.0 - 3.0 * e4 / 64.0 - 5.0 * e6 / 256.0) * latitude_rad -
            (3.0 * e2 / 8.0 + 3.0 * e4 / 32.0 + 45.0 * e6 / 1024.0) * std::sin(2.0 * latitude_rad) +
            (15.0 * e4 / 256.0 + 45.0 * e6 / 1024.0) * std::sin(4.0 * latitude_rad) -
            35.0 * e6 / 3072.0 * std::sin(6.0 * latitude_rad));
}

// The second harmonic that moves a crest this far ahead of the middle between its troughs.
double skew_of(double leading_rad) {
    const double leading = std::isfinite(leading_rad) ? std::clamp(leading_rad, -1.0, 1.0) : 0.0;
    return std::sin(0.5 * leading) / std::cos(leading);
}

bool is_sound(const Wave& wave) {
    return wave_slope(wave) > 0.0 && std::isfinite(wave.length_m) && std::isfinite(wave.direction_rad) &&
           std::isfinite(wave.phase_rad);
}

double turns_rad(const Wave& wave, double time_s) {
    if (!(wave.period_s > 0.0) || !std::isfinite(wave.period_s) || !std::isfinite(time_s)) return 0.0;
    return 2.0 * kPi * std::remainder(time_s / wave.period_s, 1.0);
}

glm::dvec2 told_way(const Wave& wave) {
    return {std::sin(wave.direction_rad), std::cos(wave.direction_rad)};
}

// What the phase gains along it at the eye, where the anchor's parallels close; not a unit vector.
glm::dvec2 drawn_way(const Wave& wave, const SeaAnchor& anchor) {
    const glm::dvec2 way = told_way(wave);
    return {way.x, way.y + way.x * anchor.closing};
}

shaders64::WaveTrain train_of(const Wave& wave, const SeaAnchor& anchor, double time_s) {
    const double number = 2.0 * kPi / wave.length_m;
    const glm::dvec2 way = drawn_way(wave, anchor);
    const double phase =
        number * glm::dot(told_way(wave), anchor.eye_m) - turns_rad(wave, time_s) + wave.phase_rad;
    const double skew = skew_of(wave.leading_rad);
    return {number * way, std::remainder(phase, 2.0 * kPi),
            glm::normalize(way) * (wave_slope(wave) / std::hypot(1.0, skew)), skew};
}

// Along the ways that trains are drawn: what a pixel resolves of them must not exceed it in any direction.
SlopeVariance drawn_variance(const Scene& scene, const SeaAnchor& anchor) {
    std::array<Wave, kMaxWaves> waves = scene.sea.waves;
    for (Wave& wave : waves) {
        const glm::dvec2 way = drawn_way(wave, anchor);
        wave.direction_rad = std::atan2(way.x, way.y);
    }
    return roughened(slope_variance(scene.ground, {waves.data(), scene.sea.wave_count}));
}

}  // namespace

SeaAnchor sea_anchor(const Eye& eye) noexcept {
    constexpr double kMeridians_deg = 5.0;
    const double latitude = eye.latitude_deg * kDegree;
    const double longitude = std::remainder(eye.longitude_deg, kMeridians_deg) * kDegree;
    const double sine = std::sin(latitude);
    const double parallel_m = kEquator_m / std::sqrt(1.0 - kEccentricity2 * sine * sine) * std::cos(latitude);
    return {{parallel_m * longitude, meridian_m(latitude)}, -sine * longitude};
}

double height_above_sea_m(const Scene& scene) noexcept {
    constexpr double kLeast_m = 0.5;
    return std::max(scene.eye.height_m - scene.sea.height_m, kLeast_m);
}

double least_depression_sine(double height_m, double number_rad_m, double pixel_rad) noexcept {
    // shaders' footprint_m() is a pixel's angle times the squared way to the water over the height.
    return std::min(1.0, std::sqrt(height_m * number_rad_m * pixel_rad / kPi));
}

SeaWaves sea_waves(const Scene& scene, double pixel_rad) noexcept {
    std::array<const Wave*, kMaxWaves> told{};
    std::size_t sound = 0;
    for (const Wave& wave : scene.sea.all_waves()) {
        if (is_sound(wave)) told[sound++] = &wave;
    }
    const auto begin = told.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(sound);
    std::sort(begin, end, [](const Wave* a, const Wave* b) { return wave_slope(*a) > wave_slope(*b); });
    // Chosen before the height has a say: a wave that took an unresolved one's place would pop up whole.
    auto kept = begin + static_cast<std::ptrdiff_t>(std::min(sound, SeaWaves::kMost));
    const double height_m = height_above_sea_m(scene);
    kept = std::remove_if(begin, kept, [&](const Wave* wave) {
        return least_depression_sine(height_m, 2.0 * kPi / wave->length_m, pixel_rad) >= 1.0;
    });
    std::sort(begin, kept, [](const Wave* a, const Wave* b) { return a->length_m > b->length_m; });
    const SeaAnchor anchor = sea_anchor(scene.eye);
    SeaWaves waves;
    waves.count = static_cast<std::size_t>(kept - begin);
    waves.variance = drawn_variance(scene, anchor);
    std::transform(begin, kept, waves.trains.begin(),
                   [&](const Wave* wave) { return train_of(*wave, anchor, scene.time_s); });
    return waves;
}

}  // namespace skyig::render::sky
