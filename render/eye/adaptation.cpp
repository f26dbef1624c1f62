#include "render/eye/adaptation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "render/eye/thresholds.h"

namespace skyig::render::eye {

namespace {

constexpr std::array<double, 7> kElevations_deg{-10.0, -3.0, 3.0, 10.0, 20.0, 35.0, 60.0};
constexpr std::size_t kAzimuths = kProbeCount / kElevations_deg.size();
constexpr double kFloor_cd_m2 = 1e-5;

// Towards light, and the recovery of bleached pigment.
constexpr double kConesUp_s = 0.1;
constexpr double kConesDown_s = 110.0;
constexpr double kRodsUp_s = 0.4;
constexpr double kRodsDown_s = 400.0;

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

double bright_part_cd_m2(std::array<double, kProbeCount> luminances_cd_m2) noexcept {
    auto* const place = luminances_cd_m2.begin() + 9 * kProbeCount / 10;
    for (double& luminance : luminances_cd_m2)
        luminance = std::isfinite(luminance) ? std::max(luminance, 0.0) : 0.0;
    std::nth_element(luminances_cd_m2.begin(), place, luminances_cd_m2.end());
    return *place;
}

std::array<ViewProbe, kViewProbeColumns * kViewProbeRows> view_probes(const ChannelView& view) noexcept {
    std::array<ViewProbe, kViewProbeColumns * kViewProbeRows> out{};
    const ImagePlane p = image_plane(view.frustum);
    const double step_x = (p.right - p.left) / static_cast<double>(kViewProbeColumns);
    const double step_y = (p.top - p.bottom) / static_cast<double>(kViewProbeRows);
    const glm::dmat3 enu_from_view = glm::transpose(view.view_from_enu);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double x = p.left + step_x * (static_cast<double>(i % kViewProbeColumns) + 0.5);
        const double y = p.bottom + step_y * (static_cast<double>(i / kViewProbeColumns) + 0.5);
        const double length = std::sqrt(1.0 + x * x + y * y);
        out[i] = {enu_from_view * (glm::dvec3{x, y, -1.0} / length),
                  step_x * step_y / (length * length * length)};
    }
    return out;
}

void LuminanceMean::add(double luminance_cd_m2, double weight) noexcept {
    const double luminance = std::isfinite(luminance_cd_m2) ? std::max(luminance_cd_m2, 0.0) : 0.0;
    sum_of_logs_ += weight * std::log10(luminance + kFloor_cd_m2);
    sum_ += weight * luminance;
    weight_ += weight;
}

double LuminanceMean::log_average_cd_m2() const noexcept {
    if (empty()) return kFloor_cd_m2;
    return std::max(std::pow(10.0, sum_of_logs_ / weight_), sum_ / weight_ / 3.0);
}

double LuminanceMean::mean_cd_m2() const noexcept {
    return empty() ? kFloor_cd_m2 : std::max(sum_ / weight_, kFloor_cd_m2);
}

double equivalent_log_adaptation(double log_cones, double log_rods) noexcept {
    const double by_cones = log_threshold_cones(log_cones);
    const double by_rods = log_threshold_rods(log_rods);
    if (by_rods <= by_cones && log_threshold_rods(log_rods) <= log_threshold_cones(log_rods)) return log_rods;
    if (by_cones < by_rods && log_threshold_cones(log_cones) <= log_threshold_rods(log_cones))
        return log_cones;
    // The one that decides now would not if it had settled: the threshold itself is looked up.
    const double wanted = std::min(by_cones, by_rods);
    double low = -6.0;
    double high = 10.0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (std::min(log_threshold_cones(middle), log_threshold_rods(middle)) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double Adaptation::update(double target_cd_m2, double time_s, bool jump,
                          const DisplaySettings& display) noexcept {
    if (!std::isfinite(target_cd_m2) || target_cd_m2 <= 0.0) return luminance_cd_m2_;
    const double step_s = time_s - time_s_;
    time_s_ = time_s;
    const double log_target = std::log10(target_cd_m2);
    const bool cut = !std::exchange(resumed_, false) && (jump || step_s > kJump_s);
    if (!started_ || cut || !(step_s >= 0.0)) {
        started_ = true;
        log_cones_ = log_rods_ = log_target;
        luminance_cd_m2_ = target_cd_m2;
        return luminance_cd_m2_;
    }
    const auto approach = [&](double& log_state, double up_s, double down_s) {
        const double tau_s = log_target > log_state ? up_s : down_s;
        log_state += (log_target - log_state) * (tau_s > 0.0 ? -std::expm1(-step_s / tau_s) : 1.0);
    };
    if (display.adapt_pace == AdaptationPace::kPhysiological) {
        approach(log_cones_, kConesUp_s, kConesDown_s);
        approach(log_rods_, kRodsUp_s, kRodsDown_s);
    } else {
        approach(log_cones_, display.adapt_up_s, display.adapt_down_s);
        log_rods_ = log_cones_;
    }
    luminance_cd_m2_ = std::pow(10.0, equivalent_log_adaptation(log_cones_, log_rods_));
    return luminance_cd_m2_;
}

}  // namespace skyig::render::eye
