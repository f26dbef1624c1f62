#include "render/night/star_scintillation.h"

#include <algorithm>
#include <cmath>

#include "render/mixed_bits.h"

namespace skyig::render::night {

namespace {

constexpr double kFrame_s = 1.0 / 30.0;
constexpr double kCorrelation_s = 0.025;
constexpr double kScaleHeight_m = 8e3;

double part_left_by_a_frame() {
    constexpr double kRatio = kFrame_s / kCorrelation_s;
    return std::sqrt(2.0 * (kRatio - 1.0 + std::exp(-kRatio))) / kRatio;
}

// Sum of four uniform numbers, mean 0 and variance 1: near enough to a Gaussian, and never beyond 3.5.
float noise(std::uint32_t source, std::int64_t frame) {
    const std::uint64_t bits = mixed(static_cast<std::uint64_t>(frame) ^ mixed(source));
    const std::uint64_t sum =
        (bits & 0xffffU) + ((bits >> 16U) & 0xffffU) + ((bits >> 32U) & 0xffffU) + (bits >> 48U);
    constexpr float kRoot3 = 1.7320508F;
    return (static_cast<float>(sum) * (1.0F / 65535.0F) - 2.0F) * kRoot3;
}

}  // namespace

double scintillation_rms(double air_mass, double eye_height_m) noexcept {
    static const double kFramePart = part_left_by_a_frame();
    const double whole = std::min(0.08 * std::pow(air_mass, 1.75), 0.5);
    return whole * kFramePart * std::exp(-std::max(eye_height_m, 0.0) / kScaleHeight_m);
}

double strongest_flicker(double eye_height_m) noexcept {
    const double rms = scintillation_rms(air_mass(0.0), eye_height_m);
    return std::exp(3.0 * rms - 0.5 * rms * rms) - 1.0;
}

double air_mass(double apparent_elevation_rad) noexcept {
    constexpr double kDegree = 0.017453292519943295;
    const double elevation_rad = std::max(apparent_elevation_rad, 0.0);
    const double elevation_deg = elevation_rad / kDegree;
    return 1.0 / (std::sin(elevation_rad) + 0.50572 * std::pow(elevation_deg + 6.07995, -1.6364));
}

float scintillation(std::uint32_t source, double time_s, float rms) noexcept {
    if (!(rms > 0.0F) || !std::isfinite(time_s)) return 1.0F;
    const double frames = std::clamp(time_s / kFrame_s, -1e15, 1e15);
    const double whole = std::floor(frames);
    const auto share = static_cast<float>(frames - whole);
    const auto frame = static_cast<std::int64_t>(whole);
    const float left = 1.0F - share;
    const float between = (left * noise(source, frame) + share * noise(source, frame + 1)) /
                          std::sqrt(left * left + share * share);
    return std::exp(rms * between - 0.5F * rms * rms);
}

}  // namespace skyig::render::night
