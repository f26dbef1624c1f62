#include "render/eye/adaptation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skyig::render::eye {

namespace {

constexpr std::array<double, 7> kElevations_deg{-10.0, -3.0, 3.0, 10.0, 20.0, 35.0, 60.0};
constexpr std::size_t kAzimuths = kProbeCount / kElevations_deg.size();
constexpr double kFloor_cd_m2 = 1e-5;

std::array<ProbeDirection, kProbeCount> make_directions() {
    std::array<ProbeDirection, kProbeCount> out{};
    constexpr double kDegree = std::numbers::pi / 180.0;
    for (std::size_t i = 0; i < kProbeCount; ++i) {
        const std::size_t row = i / kAzimuths;
        // Rows are staggered so that no azimuth of the Sun falls on all of them.
        const double turn = static_cast<double>(i % kAzimuths) + (row % 2 == 0 ? 0.0 : 0.5);
        out[i] = {kElevations_deg[row] * kDegree, turn * 2.0 * std::numbers::pi / kAzimuths};
    }
    return out;
}

}  // namespace

const std::array<ProbeDirection, kProbeCount>& probe_directions() noexcept {
    static const auto kDirections = make_directions();
    return kDirections;
}

double adaptation_target_cd_m2(const std::array<double, kProbeCount>& luminance_cd_m2) noexcept {
    double sum_of_logs = 0.0;
    double sum = 0.0;
    for (const double value : luminance_cd_m2) {
        const double luminance = std::isfinite(value) ? std::max(value, 0.0) : 0.0;
        sum_of_logs += std::log10(luminance + kFloor_cd_m2);
        sum += luminance;
    }
    constexpr auto kCount = static_cast<double>(kProbeCount);
    return std::max(std::pow(10.0, sum_of_logs / kCount), sum / kCount / 3.0);
}

double Adaptation::update(double target_cd_m2, double time_s, bool jump,
                          const DisplaySettings& display) noexcept {
    if (!std::isfinite(target_cd_m2) || target_cd_m2 <= 0.0) return luminance_cd_m2_;
    const double step_s = time_s - time_s_;
    time_s_ = time_s;
    if (!started_ || jump || !(step_s >= 0.0) || step_s > kJump_s) {
        started_ = true;
        luminance_cd_m2_ = target_cd_m2;
        return luminance_cd_m2_;
    }
    const double log_now = std::log(luminance_cd_m2_);
    const double log_target = std::log(target_cd_m2);
    const double tau_s = log_target > log_now ? display.adapt_up_s : display.adapt_down_s;
    const double share = tau_s > 0.0 ? -std::expm1(-step_s / tau_s) : 1.0;
    luminance_cd_m2_ = std::exp(log_now + (log_target - log_now) * share);
    return luminance_cd_m2_;
}

}  // namespace skyig::render::eye
