#include "render/dome_bend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "render/eye/tone_curve.h"

namespace skyig::render {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kSkySamples = 192;
constexpr std::size_t kGroundSamples = 160;
constexpr std::size_t kColumnSamples = 321;

// The finest thing beside the horizon: some haze seen at a few tenths of its scale height.
constexpr double kFinest_rad = 0.001;
// The finest thing beside a source's azimuth: the path that low light lays on calm water.
constexpr double kFinestPath_rad = 0.005;

// Azimuths of the meridians, from each source; elevations of the circles above the horizon.
constexpr std::array<double, 10> kMeridians_rad{0.0, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.2, kPi};
constexpr std::array<double, 15> kCircles_rad{-0.5, -0.2, -0.06, -0.01, 0.0, 0.006, 0.02, 0.04,
                                              0.08, 0.16, 0.27,  0.4,   0.6, 0.85,  1.15};

// Of the largest error, what a profile may plan for: the profiles miss the worst places, which lie between
// them.
constexpr double kPlannedShare = 0.5;

constexpr double kWidestRow_rad = 0.14;
constexpr double kWidestColumn_rad = 0.18;

// Shares of the samples in each profile's range: a geometric progression from the horizon outwards.
double spread(double share, double range_rad) {
    return kFinest_rad * std::expm1(share * std::log1p(range_rad / kFinest_rad));
}

double largest_of(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

double second_derivative(const glm::dvec3& before, const glm::dvec3& here, const glm::dvec3& after,
                         double step_before, double step_after) {
    const glm::dvec3 bend =
        ((after - here) / step_after - (here - before) / step_before) * (2.0 / (step_before + step_after));
    return largest_of(bend);
}

// Round the circle from -pi to pi, symmetrical about 0, crowding there and about a second azimuth.
void spread_columns(std::span<double> azimuths_rad, std::optional<double> second_rad) {
    constexpr int kSteps = 4096;
    const auto density = [&](int step) {
        const double a = kPi * ((2.0 * step + 1.0) / kSteps - 1.0);
        const double other =
            second_rad ? 0.25 / (std::abs(std::remainder(a - *second_rad, 2.0 * kPi)) + kFinestPath_rad)
                       : 0.0;
        return 1.0 + 0.25 / (std::abs(a) + kFinestPath_rad) + other;
    };
    double whole = 0.0;
    for (int step = 0; step < kSteps; ++step)
        whole += density(step);
    const auto last = static_cast<double>(azimuths_rad.size() - 1);
    double sum = 0.0;
    std::size_t next = 1;
    for (int step = 0; step < kSteps; ++step) {
        const double here = density(step);
        while (next + 1 < azimuths_rad.size() && sum + here >= whole * static_cast<double>(next) / last) {
            const double share = (whole * static_cast<double>(next) / last - sum) / here;
            azimuths_rad[next++] = kPi * (2.0 * (step + share) / kSteps - 1.0);
        }
        sum += here;
    }
    azimuths_rad.front() = -kPi;
    azimuths_rad.back() = kPi;
}

// Lines of the profiles as seen from both sources if there are two.
template <std::size_t Count, class Use>
void each_meridian(const SkyLight& light, double azimuth_rad, const std::array<double, Count>& from_source,
                   Use use) {
    for (const double a : from_source)
        use(azimuth_rad + a);
    if (light.sun.view == nullptr || light.moon.view == nullptr) return;
    for (const double a : from_source)
        use(light.moon.source.azimuth_rad + a);
}

int quads(double intervals, int least, int most) {
    const int wanted = static_cast<int>(std::ceil(std::min(intervals, 1e4) / 8.0)) * 8;
    return std::clamp(wanted, least, most);
}

}  // namespace

BendProfile::BendProfile(std::size_t samples) : positions_rad_(samples), bend_(samples), sum_(samples) {}

void BendProfile::clear() noexcept {
    std::fill(bend_.begin(), bend_.end(), 0.0);
}

void BendProfile::add(std::size_t sample, double codes_per_rad2) noexcept {
    bend_[sample] = std::max(bend_[sample], codes_per_rad2);
}

void BendProfile::finish(double widest_rad) noexcept {
    bend_.front() = bend_[1];
    bend_.back() = bend_[bend_.size() - 2];
    // A kink between two samples belongs to both sides of it.
    const auto density = [&](std::size_t i) {
        const std::size_t last = bend_.size() - 1;
        const double bend = std::max({bend_[i > 0 ? i - 1 : 0], bend_[i], bend_[std::min(i + 1, last)]});
        return std::max(std::sqrt(bend / 8.0), 0.5 / widest_rad);
    };
    sum_[0] = 0.0;
    double before = density(0);
    for (std::size_t i = 1; i < sum_.size(); ++i) {
        const double here = density(i);
        sum_[i] = sum_[i - 1] + 0.5 * (before + here) * (positions_rad_[i] - positions_rad_[i - 1]);
        before = here;
    }
}

double BendProfile::intervals(double error_codes) const noexcept {
    return sum_.back() / std::sqrt(std::max(error_codes, 1e-6));
}

void BendProfile::place(std::span<double> nodes_rad) const noexcept {
    std::size_t at = 0;
    for (std::size_t n = 0; n < nodes_rad.size(); ++n) {
        const double wanted =
            sum_.back() * static_cast<double>(n) / static_cast<double>(nodes_rad.size() - 1);
        while (at + 2 < sum_.size() && sum_[at + 1] < wanted)
            ++at;
        const double share = (wanted - sum_[at]) / (sum_[at + 1] - sum_[at]);
        nodes_rad[n] = positions_rad_[at] + share * (positions_rad_[at + 1] - positions_rad_[at]);
    }
    nodes_rad.front() = positions_rad_.front();
    nodes_rad.back() = positions_rad_.back();
}

DomeBend::DomeBend()
    : sky_(kSkySamples), ground_(kGroundSamples), columns_(kColumnSamples), codes_(kColumnSamples) {}

void DomeBend::place_samples(const SkyLight& light, double edge_rad) {
    const double first_rad = 0.5 * edge_rad;
    const auto crowd_at_horizon = [&](BendProfile& profile, double last_rad, bool upwards) {
        profile.clear();
        const auto x = profile.positions_rad();
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double share = static_cast<double>(i) / static_cast<double>(x.size() - 1);
            x[i] = upwards ? first_rad + spread(share, last_rad - first_rad)
                           : -first_rad - spread(1.0 - share, last_rad - first_rad);
        }
    };
    crowd_at_horizon(sky_, 0.5 * kPi - light.horizon_elevation_rad, true);
    crowd_at_horizon(ground_, 0.5 * kPi + light.horizon_elevation_rad, false);
    columns_.clear();
    const bool mirrored = light.sun.view == nullptr || light.moon.view == nullptr;
    const double second = light.moon.source.azimuth_rad - light.sun.source.azimuth_rad;
    spread_columns(columns_.positions_rad(), mirrored ? std::nullopt : std::optional(second));
}

void DomeBend::measure(const SkyLight& light, std::span<const shaders64::ToneParameters> tones,
                       double azimuth_rad, double edge_rad) {
    place_samples(light, edge_rad);
    for (const shaders64::ToneParameters& tone : tones) {
        const auto tone32 = eye::single_precision(tone);
        measure_rows(light, tone32, azimuth_rad);
        measure_columns(light, tone32, azimuth_rad);
    }
    sky_.finish(kWidestRow_rad);
    ground_.finish(kWidestRow_rad);
    // The horizon's own edge shall not leave its place by more than a quarter of its softness.
    const double horizon = light.horizon_elevation_rad;
    const double dip = std::abs(std::sin(horizon) * std::cos(horizon));
    columns_.finish(std::min(kWidestColumn_rad, std::sqrt(2.0 * edge_rad / std::max(dip, 1e-9))));
}

void DomeBend::measure_rows(const SkyLight& light, const shaders32::ToneParameters& tone,
                            double azimuth_rad) {
    const auto along = [&](BendProfile& profile, Side side) {
        const auto x = profile.positions_rad();
        each_meridian(light, azimuth_rad, kMeridians_rad, [&](double azimuth) {
            for (std::size_t i = 0; i < x.size(); ++i) {
                const glm::vec3 rgb = light.rgb_cd_m2(light.horizon_elevation_rad + x[i], azimuth, side);
                codes_[i] = 255.0 * glm::dvec3{shaders32::shown(rgb, tone)};
            }
            for (std::size_t i = 1; i + 1 < x.size(); ++i)
                profile.add(i, second_derivative(codes_[i - 1], codes_[i], codes_[i + 1], x[i] - x[i - 1],
                                                 x[i + 1] - x[i]));
        });
    };
    along(sky_, Side::kSky);
    along(ground_, Side::kGround);
}

void DomeBend::measure_columns(const SkyLight& light, const shaders32::ToneParameters& tone,
                               double azimuth_rad) {
    const double horizon = light.horizon_elevation_rad;
    const bool mirrored = light.sun.view == nullptr || light.moon.view == nullptr;
    const auto x = columns_.positions_rad();
    const std::size_t first = mirrored ? x.size() / 2 - 1 : 0;
    const auto code = [&](double above_rad, std::size_t i, Side side) {
        const glm::vec3 rgb = light.rgb_cd_m2(horizon + above_rad, azimuth_rad + x[i], side);
        return 255.0 * glm::dvec3{shaders32::shown(rgb, tone)};
    };
    for (const double above : kCircles_rad) {
        const Side side = above < 0.0 ? Side::kGround : Side::kSky;
        const double elevation = horizon + above;
        if (std::abs(elevation) > 1.4) continue;
        // A straight edge between two columns is a great circle and leaves the circle of equal elevation.
        const double leaves = std::abs(std::sin(elevation) * std::cos(elevation));
        const double up = (0.05 * std::abs(above) + 1e-4) * (side == Side::kSky ? 1.0 : -1.0);
        for (std::size_t i = first; i < x.size(); ++i)
            codes_[i] = code(above, i, side);
        for (std::size_t i = first + 1; i + 1 < x.size(); ++i) {
            const double steep = largest_of(code(above + up, i, side) - codes_[i]) / std::abs(up);
            const double bend =
                second_derivative(codes_[i - 1], codes_[i], codes_[i + 1], x[i] - x[i - 1], x[i + 1] - x[i]) +
                leaves * steep;
            columns_.add(i, bend);
            if (mirrored) columns_.add(x.size() - 1 - i, bend);
        }
    }
}

DomeSize DomeBend::size_for(double error_codes) const noexcept {
    const double planned = kPlannedShare * error_codes;
    return {quads(columns_.intervals(planned), kLeast.columns, kMost.columns),
            quads(sky_.intervals(planned), kLeast.sky_rows, kMost.sky_rows),
            quads(ground_.intervals(planned), kLeast.ground_rows, kMost.ground_rows)};
}

}  // namespace skyig::render
