#include "render/sky/refraction.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "render/geometry.h"
#include "render/sky/monotone_cubic.h"
#include "render/sky/quadrature.h"

namespace skyig::render::sky {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLowestEye_m = -500.0;
constexpr double kHighestEye_m = 5e7;
constexpr double kStrongest = 1.6;

// Strengths of the air that are traced: bending per strength is nearly a parabola between them.
constexpr std::array<double, 3> kStrength{0.7, 1.05, 1.4};

// Columns lie even in asinh(elevation / knee): dense where rays are level, then even in the logarithm.
constexpr double kKnee_rad = 0.01;
constexpr double kLastColumn = 5.75;  // a hair beyond the zenith

// Bending is tabulated times (sin + this) / cos of the elevation, which leaves little to interpolate.
constexpr double kLevelSine = 0.03;

double level_of(double height_m, double refractivity) {
    return height_m + refractivity * (kEarthRadius_m + height_m);
}

// 1 - cos, without cancellation.
double versine(double angle) {
    const double half_sine = std::sin(0.5 * angle);
    return 2.0 * half_sine * half_sine;
}

using Rule = GaussLegendre<12>;

/// Bending of a ray that leaves `height_m` upwards, divided by strength and by the cosine of its elevation.
/// The height above the eye is w^2 - t^2, with t^2 what the ray's angle is worth in height: the root in the
/// integrand then cancels against the variable at every angle.
double traced_bending(const StandardAir& air, const Rule& rule, double height_m, double elevation_rad,
                      double strength) {
    constexpr std::array<double, 5> kParts_m{kTropopause_m - kTropopauseRounding_m,
                                             kTropopause_m + kTropopauseRounding_m, 20063.0, 47350.0,
                                             kRefractionTop_m};

    const double eye_refractivity = strength * air.at(height_m).refractivity;
    const double eye_m = (1.0 + eye_refractivity) * (kEarthRadius_m + height_m);
    const double invariant_m = eye_m * std::cos(elevation_rad);
    const double lift_m = eye_m * versine(elevation_rad);
    double sum = 0.0;
    double from = std::sqrt(lift_m);
    for (const double part_m : kParts_m) {
        if (part_m <= height_m) continue;
        const double to = std::sqrt(part_m - height_m + lift_m);
        for (std::size_t i = 0; i < rule.node.size(); ++i) {
            const double w = 0.5 * (from + to + rule.node[i] * (to - from));
            const double rise_m = w * w - lift_m;
            const StandardAir::At here = air.at(height_m + rise_m);
            const double index = 1.0 + strength * here.refractivity;
            const double above_m =
                (strength * here.refractivity - eye_refractivity) * (kEarthRadius_m + height_m) +
                index * rise_m + lift_m;
            sum += rule.weight[i] * 0.5 * (to - from) * -here.slope_per_m / index * 2.0 * w /
                   std::sqrt(above_m * (above_m + 2.0 * invariant_m));
        }
        from = to;
    }
    return sum * eye_m;
}

double finite_or(double value, double otherwise) {
    return std::isfinite(value) ? value : otherwise;
}

}  // namespace

Refraction::Refraction() : nodes_(RefractionRow::kHeights * RefractionRow::kColumns) {
    std::size_t n = 0;
    const auto add = [&](double from_m, double to_m, double step_m) {
        for (double h = from_m; h < to_m + 0.5 * step_m; h += step_m)
            height_m_[n++] = h;
    };
    add(kLowestEye_m, 12000.0, 250.0);
    add(12500.0, 20000.0, 500.0);
    add(21000.0, 40000.0, 1000.0);
    add(42500.0, kRefractionTop_m, 2500.0);
    for (std::size_t i = 0; i < n; ++i)
        refractivity_[i] = air_.at(height_m_[i]).refractivity;
    trace();
    slope();
}

void Refraction::trace() {
    const Rule rule = gauss_legendre<12>();
    for (std::size_t column = 0; column < RefractionRow::kColumns; ++column) {
        const double share = static_cast<double>(column) / (RefractionRow::kColumns - 1);
        const double elevation_rad = kKnee_rad * std::sinh(share * kLastColumn);
        const double freed = std::sin(elevation_rad) + kLevelSine;
        for (std::size_t height = 0; height < RefractionRow::kHeights; ++height) {
            Node& node = nodes_[index(height, column)];
            for (std::size_t k = 0; k < kStrengths; ++k)
                node.value[k] =
                    freed * traced_bending(air_, rule, height_m_[height], elevation_rad, kStrength[k]);
        }
    }
}

void Refraction::slope() {
    std::array<double, RefractionRow::kHeights> value{};
    std::array<double, RefractionRow::kHeights> slope{};
    for (std::size_t column = 0; column < RefractionRow::kColumns; ++column) {
        for (std::size_t k = 0; k < kStrengths; ++k) {
            for (std::size_t i = 0; i < value.size(); ++i)
                value[i] = nodes_[index(i, column)].value[k];
            monotone_slopes(height_m_, value, slope);
            for (std::size_t i = 0; i < value.size(); ++i)
                nodes_[index(i, column)].slope_per_m[k] = slope[i];
        }
    }
}

RefractionRow Refraction::at(double height_m, double pressure_hpa, double temperature_c) const noexcept {
    const double eye_m = std::clamp(finite_or(height_m, 0.0), kLowestEye_m, kHighestEye_m);
    const double kelvin = std::max(finite_or(temperature_c, 15.0) + 273.15, 1.0);
    const double strength =
        std::clamp(finite_or(pressure_hpa, 1013.25) / 1013.25 * 288.15 / kelvin, 0.0, kStrongest);

    std::array<double, kStrengths> part{};
    for (std::size_t k = 0; k < kStrengths; ++k) {
        const double a = kStrength[(k + 1) % 3];
        const double b = kStrength[(k + 2) % 3];
        part[k] = strength * (strength - a) * (strength - b) / ((kStrength[k] - a) * (kStrength[k] - b));
    }
    const auto mix = [&part](const std::array<double, kStrengths>& v) {
        return part[0] * v[0] + part[1] * v[1] + part[2] * v[2];
    };

    RefractionRow row;
    for (std::size_t i = 0; i < height_m_.size(); ++i) {
        row.level_m_[i] = level_of(height_m_[i], strength * refractivity_[i]);
        row.past_rad_[i] = 2.0 * mix(nodes_[index(i, 0)].value) / kLevelSine;
    }
    monotone_slopes(row.level_m_, row.past_rad_, row.past_slope_);

    const std::size_t low = piece_of(height_m_, eye_m);
    const double step_m = height_m_[low + 1] - height_m_[low];
    const Cubic c = cubic(std::min((eye_m - height_m_[low]) / step_m, 1.0));
    for (std::size_t column = 0; column < RefractionRow::kColumns; ++column) {
        const Node& a = nodes_[index(low, column)];
        const Node& b = nodes_[index(low + 1, column)];
        row.column_[column + 1] = c.value0 * mix(a.value) + c.value1 * mix(b.value) +
                                  step_m * (c.slope0 * mix(a.slope_per_m) + c.slope1 * mix(b.slope_per_m));
    }
    auto& f = row.column_;
    f.front() = 3.0 * (f[1] - f[2]) + f[3];
    f.back() = 3.0 * (f[f.size() - 2] - f[f.size() - 3]) + f[f.size() - 4];

    row.eye_level_m_ = level_of(eye_m, strength * air_.at(eye_m).refractivity);
    const double ground_level_m =
        eye_m > 0.0 ? level_of(0.0, strength * kSeaLevelRefractivity) : row.eye_level_m_;
    row.set_horizon(ground_level_m);
    return row;
}

void RefractionRow::set_horizon(double ground_level_m) noexcept {
    past_at_eye_rad_ = bending_past_rad(eye_level_m_);
    level_bending_rad_ = bending_upwards_rad(0.0);
    const double drop = std::max(eye_level_m_ - ground_level_m, 0.0) / (kEarthRadius_m + eye_level_m_);
    horizon_rad_ = -2.0 * std::asin(std::sqrt(0.5 * drop));
    horizon_bending_rad_ = bending_in_air_rad(horizon_rad_);

    // Below, the bending rises on at first, with the slope that it has at the horizon, then fades to nothing
    // before the nadir, slowly enough for true elevations to keep falling.
    constexpr double kStep_rad = 1e-6;
    constexpr double kRise = 0.05;
    const double slope = (horizon_bending_rad_ - bending_in_air_rad(horizon_rad_ + kStep_rad)) / kStep_rad;
    below_rise_rad_ = kRise * horizon_bending_rad_;
    below_scale_rad_ = slope > 0.0 ? below_rise_rad_ / slope : 1.0;
    below_fade_rad_ = std::min(20.0 * kPi / 180.0, 0.9 * (0.5 * kPi + horizon_rad_));
}

double RefractionRow::level_m(double apparent_rad) const noexcept {
    return eye_level_m_ - (kEarthRadius_m + eye_level_m_) * versine(apparent_rad);
}

double RefractionRow::bending_past_rad(double level_m) const noexcept {
    if (level_m >= level_m_.back()) return 0.0;
    const std::size_t i = piece_of(level_m_, level_m);
    const double step_m = level_m_[i + 1] - level_m_[i];
    if (!(step_m > 0.0)) return 0.0;
    const Cubic c = cubic(std::max((level_m - level_m_[i]) / step_m, 0.0));
    return c.value0 * past_rad_[i] + c.value1 * past_rad_[i + 1] +
           step_m * (c.slope0 * past_slope_[i] + c.slope1 * past_slope_[i + 1]);
}

double RefractionRow::bending_upwards_rad(double apparent_rad) const noexcept {
    constexpr double kScale = (kColumns - 1) / kLastColumn;
    const double x = std::min(std::asinh(apparent_rad / kKnee_rad) * kScale, double{kColumns - 1});
    const std::size_t i = std::min(static_cast<std::size_t>(x), kColumns - 2);
    const double* const f = &column_[i];
    const Cubic c = cubic(x - static_cast<double>(i));
    const double freed =
        c.value0 * f[1] + c.value1 * f[2] + 0.5 * (c.slope0 * (f[2] - f[0]) + c.slope1 * (f[3] - f[1]));
    return freed * std::cos(apparent_rad) / (std::sin(apparent_rad) + kLevelSine);
}

// A ray that leaves downwards comes back to the eye's height as steeply as it left, and then goes the way of
// the one that left upwards: from end to end it is bent as any that passes the same lowest point.
double RefractionRow::bending_in_air_rad(double apparent_rad) const noexcept {
    if (apparent_rad >= 0.0) return bending_upwards_rad(apparent_rad);
    return bending_past_rad(level_m(apparent_rad)) - past_at_eye_rad_ + 2.0 * level_bending_rad_ -
           bending_upwards_rad(-apparent_rad);
}

double RefractionRow::bending_rad(double apparent_rad) const noexcept {
    if (apparent_rad >= horizon_rad_) return bending_in_air_rad(apparent_rad);
    const double below_rad = horizon_rad_ - apparent_rad;
    const double rise_rad = below_rise_rad_ * -std::expm1(-below_rad / below_scale_rad_);
    return (horizon_bending_rad_ + rise_rad) * smooth_step(below_fade_rad_, 0.0, below_rad);
}

double RefractionRow::true_from_apparent(double apparent_rad) const noexcept {
    if (apparent_rad > 0.5 * kPi) return kPi - true_from_apparent(kPi - apparent_rad);
    return apparent_rad - bending_rad(apparent_rad);
}

double RefractionRow::apparent_from_true(double true_rad) const noexcept {
    if (true_rad > 0.5 * kPi) return kPi - apparent_from_true(kPi - true_rad);
    if (horizon_bending_rad_ <= 0.0) return true_rad;
    // False position (Illinois) between no bending and the most there is.
    const auto error_at = [&](double apparent_rad) {
        return apparent_rad - bending_rad(apparent_rad) - true_rad;
    };
    double low = true_rad;
    double high = std::min(true_rad + horizon_bending_rad_ + below_rise_rad_, 0.5 * kPi);
    double low_error = error_at(low);
    double high_error = error_at(high);
    if (low_error >= 0.0) return low;
    if (high_error <= 0.0) return high;
    enum class End { kNone, kLow, kHigh } last = End::kNone;
    for (int pass = 0; pass < 80 && high - low > 1e-14; ++pass) {
        const double middle = (low * high_error - high * low_error) / (high_error - low_error);
        const double error = error_at(middle);
        if (std::abs(error) < 1e-14) return middle;
        // An end that stays twice in a row counts half.
        if (error < 0.0) {
            if (last == End::kLow) high_error *= 0.5;
            low = middle;
            low_error = error;
            last = End::kLow;
        } else {
            if (last == End::kHigh) low_error *= 0.5;
            high = middle;
            high_error = error;
            last = End::kHigh;
        }
    }
    return 0.5 * (low + high);
}

double RefractionRow::vertical_scale(double apparent_rad) const noexcept {
    constexpr double kStep_rad = 1e-5;
    return 2.0 * kStep_rad /
           (true_from_apparent(apparent_rad + kStep_rad) - true_from_apparent(apparent_rad - kStep_rad));
}

}  // namespace skyig::render::sky
