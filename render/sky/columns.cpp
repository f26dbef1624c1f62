// Optical columns from every height in every direction, along rays as the air bends them. A ray in air of
// refractive index n keeps n r cos(elevation), so it is straight once every point is moved to the radius n r:
// columns are sums along straight lines through air that is relabelled, and the bending is one more of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "render/sky/air_data.h"
#include "render/sky/monotone_cubic.h"
#include "render/sky/quadrature.h"
#include "render/sky/standard_air.h"

namespace skyig::render::sky {
namespace {

/// Metres of molecules, aerosol and ozone at their reference densities; and the bending over n r
/// cos(elevation).
constexpr std::size_t kAmounts = 4;
using Amounts = std::array<double, kAmounts>;
constexpr std::size_t kOzone = 2;
constexpr std::size_t kBending = 3;

/// The air by level: n r, less that of the ground.
class LevelAir {
  public:
    explicit LevelAir(const AirData& data);

    [[nodiscard]] const Shell& shell() const noexcept { return shell_; }
    [[nodiscard]] double level_m(double height_m) const noexcept {
        return height_m + refractivity_at(height_m) * (ground_radius_m_ + height_m) - lowest_m_;
    }
    /// Along a ray that leaves `level_m` at `sine`, up to the lid.
    [[nodiscard]] Amounts columns_to_top(double level_m, double sine) const noexcept;

  private:
    [[nodiscard]] double refractivity_at(double height_m) const noexcept {
        return strength_ > 0.0 ? strength_ * air_.at(height_m).refractivity : 0.0;
    }
    [[nodiscard]] double height_m(double level_m, double guess_m) const noexcept;
    /// Of a ray that leaves `level_m` upwards, up to `end_m`.
    void add_columns(double level_m, double sine, double end_m, Amounts& sum) const noexcept;
    [[nodiscard]] Amounts held(double level_m) const noexcept;

    StandardAir air_;
    double strength_ = 0.0;
    double ground_radius_m_ = 0.0;
    double lowest_m_ = 0.0;
    Shell shell_;
    /// A metre of level holds this, at even levels; logarithms but for the ozone.
    std::vector<std::array<float, kAmounts>> held_;
    /// Levels at which the air's laws change, or the aerosol has thinned out so far that the next stretch is
    /// longer; then the lid's.
    std::array<double, 7> part_m_{};
};

LevelAir::LevelAir(const AirData& data)
    : strength_(data.model.refractivity / kSeaLevelRefractivity),
      ground_radius_m_(data.shell.ground_radius_m),
      lowest_m_(refractivity_at(0.0) * ground_radius_m_),
      shell_{ground_radius_m_ + lowest_m_, level_m(data.shell.top_height_m)},
      held_(kProfileCells + 1) {
    constexpr double kLeast = 1e-30;
    double height = 0.0;
    for (std::size_t i = 0; i <= kProfileCells; ++i) {
        const double level = shell_.top_height_m * static_cast<double>(i) / kProfileCells;
        height = height_m(level, height);
        const StandardAir::At air = strength_ > 0.0 ? air_.at(height) : StandardAir::At{};
        const double index = 1.0 + strength_ * air.refractivity;
        const double slope_per_m = strength_ * air.slope_per_m;
        const double metres = 1.0 / (index + slope_per_m * (ground_radius_m_ + height));
        const double bending = -slope_per_m / index * metres / (index * (ground_radius_m_ + height));
        const Densities d = data.densities(height);
        const auto log_of = [kLeast](double x) { return static_cast<float>(std::log(std::max(x, kLeast))); };
        held_[i] = {log_of(metres * static_cast<double>(d.molecules)),
                    static_cast<float>(std::log(metres) - height / data.model.aerosol_scale_height_m),
                    static_cast<float>(metres * static_cast<double>(d.ozone)), log_of(bending)};
    }
    const AirShape& shape = data.model;
    part_m_ = {2.0 * shape.aerosol_scale_height_m,
               6.0 * shape.aerosol_scale_height_m,
               kTropopause_m - kTropopauseRounding_m,
               kTropopause_m + kTropopauseRounding_m,
               shape.ozone_peak_m,
               shape.ozone_top_m,
               shape.top_height_m};
    for (double& part_m : part_m_)
        part_m = level_m(std::min(part_m, shape.top_height_m));
    std::sort(part_m_.begin(), part_m_.end());
}

// Newton's iteration: the level rises with the height, and nearly evenly.
double LevelAir::height_m(double level_m, double guess_m) const noexcept {
    if (strength_ <= 0.0) return level_m;
    double height = guess_m;
    for (int pass = 0; pass < 6; ++pass) {
        const StandardAir::At air = air_.at(height);
        const double rise =
            1.0 + strength_ * (air.refractivity + air.slope_per_m * (ground_radius_m_ + height));
        height += (level_m - this->level_m(height)) / rise;
    }
    return std::max(height, 0.0);
}

Amounts LevelAir::held(double level_m) const noexcept {
    const double place = std::clamp(level_m / shell_.top_height_m, 0.0, 1.0) * kProfileCells;
    const auto cell = std::min(static_cast<std::size_t>(place), std::size_t{kProfileCells - 1});
    const auto part = static_cast<float>(place - static_cast<double>(cell));
    const auto& low = held_[cell];
    const auto& high = held_[cell + 1];
    const auto at = [&](std::size_t k) { return low[k] + part * (high[k] - low[k]); };
    const auto dense = [&](std::size_t k) { return static_cast<double>(std::exp(at(k))); };
    return {dense(0), dense(1), static_cast<double>(at(kOzone)), strength_ > 0.0 ? dense(kBending) : 0.0};
}

// The level above the start is w^2 - t^2, with t^2 what the ray's angle is worth in level: no ray makes the
// integrand singular.
void LevelAir::add_columns(double level_m, double sine, double end_m, Amounts& sum) const noexcept {
    static const auto rule = gauss_legendre<10>();
    const double radius_m = shell_.ground_radius_m + level_m;
    const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
    const double lift_m = radius_m * sine * sine / (1.0 + cosine);
    double from = std::sqrt(lift_m);
    for (const double part_m : part_m_) {
        const double to_m = std::min(part_m, end_m);
        if (to_m <= level_m) continue;
        const double to = std::sqrt(to_m - level_m + lift_m);
        for (std::size_t i = 0; i < rule.node.size(); ++i) {
            const double w = 0.5 * (from + to + rule.node[i] * (to - from));
            const double rise_m = w * w - lift_m;
            const double weight_m = rule.weight[i] * (to - from) * (radius_m + rise_m) /
                                    std::sqrt(radius_m * (1.0 + cosine) + rise_m);
            const Amounts here = held(level_m + rise_m);
            for (std::size_t k = 0; k < kAmounts; ++k)
                sum[k] += weight_m * here[k];
        }
        from = to;
    }
}

Amounts LevelAir::columns_to_top(double level_m, double sine) const noexcept {
    Amounts sum{};
    if (sine >= 0.0) {
        add_columns(level_m, sine, shell_.top_height_m, sum);
        return sum;
    }
    const double low_m = -(shell_.ground_radius_m + level_m) * sine;
    const double lowest_m = std::max(0.0, shell_.height_along_m(level_m, sine, low_m));
    add_columns(lowest_m, 0.0, level_m, sum);
    add_columns(lowest_m, 0.0, shell_.top_height_m, sum);
    return sum;
}

/// One row of the table of what is seen, and where it truly stands.
struct Row {
    double dip_sine = 0.0;                      ///< of the horizon that is seen
    std::array<double, kColumnAngles> sine{};   ///< of the elevation at which light arrives
    std::array<double, kColumnAngles> above{};  ///< of its elevation without air, plus that of the true dip
    double true_dip_sine = 0.0;
};

double place_of(double above_sine, double dip_sine) {
    return std::sqrt(std::max(0.0, above_sine) / (1.0 + dip_sine));
}

/// Writes the row of light as it arrives.
Row build_row(const LevelAir& air, double height_m, float* out) {
    constexpr double kLeastColumn_m = 1e-3;  // keeps the logarithm finite where a constituent has ended
    const double level_m = air.level_m(height_m);
    Row row;
    row.dip_sine = air.shell().dip_sine(level_m);
    for (std::size_t angle = 0; angle < kColumnAngles; ++angle, out += kColumnFloats) {
        const double place = static_cast<double>(angle) / (kColumnAngles - 1);
        const double sine = std::min(1.0, (1.0 + row.dip_sine) * place * place - row.dip_sine);
        const double level = std::sqrt((1.0 - sine) * (1.0 + sine));
        const Amounts sum = air.columns_to_top(level_m, sine);
        for (std::size_t k = 0; k < kBending; ++k)
            out[k] = static_cast<float>(std::log(std::max(sum[k], kLeastColumn_m)));
        out[kBending] = 0.0F;
        const double bending_rad = (air.shell().ground_radius_m + level_m) * level * sum[kBending];
        row.sine[angle] = sine;
        row.above[angle] = sine * std::cos(bending_rad) - level * std::sin(bending_rad);
    }
    row.true_dip_sine = -row.above.front();
    for (double& above : row.above)
        above += row.true_dip_sine;
    return row;
}

/// The same light by the elevation at which its source truly stands. The last float is the logarithm of how
/// much more solid angle a small source covers than without air, d(sin seen) / d(sin true): its light is as
/// much brighter.
/// \param level_ground  the last float is of what level ground gets instead: times the sine seen
void place_by_source(const Row& row, const float* seen, bool level_ground, float* out) {
    constexpr double kLeastGain = 1e-12;
    using Angles = std::array<double, kColumnAngles>;
    Angles x{};
    std::array<Angles, kAmounts> y{};
    std::array<Angles, kAmounts> slope{};
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = place_of(row.above[i], row.true_dip_sine);
        for (std::size_t k = 0; k < kAmounts; ++k)
            y[k][i] = static_cast<double>(seen[i * kColumnFloats + k]);
        y[kBending][i] = place_of(row.sine[i] + row.dip_sine, row.dip_sine);
    }
    for (std::size_t k = 0; k < kAmounts; ++k)
        monotone_slopes(x, y[k], slope[k]);
    const double scale = (1.0 + row.dip_sine) / (1.0 + row.true_dip_sine);
    for (std::size_t angle = 0, i = 0; angle < x.size(); ++angle, out += kColumnFloats) {
        const double place = static_cast<double>(angle) / (kColumnAngles - 1);
        while (i + 2 < x.size() && place > x[i + 1])
            ++i;
        const double step = x[i + 1] - x[i];
        const double t = std::clamp((place - x[i]) / step, 0.0, 1.0);
        const Cubic c = cubic(t);
        const auto at = [&](std::size_t k) {
            return c.value0 * y[k][i] + c.value1 * y[k][i + 1] +
                   step * (c.slope0 * slope[k][i] + c.slope1 * slope[k][i + 1]);
        };
        for (std::size_t k = 0; k < kBending; ++k)
            out[k] = static_cast<float>(at(k));
        const double seen_place = at(kBending);
        const double rate = 6.0 * t * (1.0 - t) * (y[kBending][i + 1] - y[kBending][i]) / step +
                            (1.0 - t) * (1.0 - 3.0 * t) * slope[kBending][i] +
                            t * (3.0 * t - 2.0) * slope[kBending][i + 1];
        double gain = scale * rate * (place > 0.0 ? seen_place / place : rate);
        if (level_ground) gain *= seen_place * seen_place;
        out[kBending] = static_cast<float>(std::log(std::max(gain, kLeastGain)));
    }
}

}  // namespace

void build_columns(AirData& data) {
    constexpr std::size_t kRowFloats = std::size_t{kColumnAngles} * kColumnFloats;
    const LevelAir air(data);
    data.seen_columns.assign(kColumnRows * kRowFloats, 0.0F);
    data.source_columns.assign((kColumnRows + 1) * kRowFloats, 0.0F);
    data.seen_dip_sine.assign(kColumnRows, 0.0);
    data.source_dip_sine.assign(kColumnRows, 0.0);
    for (std::size_t i = 0; i < kColumnRows; ++i) {
        const double part = static_cast<double>(i) / (kColumnRows - 1);
        float* const seen = data.seen_columns.data() + i * kRowFloats;
        const Row row = build_row(air, data.shell.top_height_m * part * part, seen);
        data.seen_dip_sine[i] = row.dip_sine;
        data.source_dip_sine[i] = row.true_dip_sine;
        if (i == 0) place_by_source(row, seen, true, data.source_columns.data());
        place_by_source(row, seen, false, data.source_columns.data() + (i + 1) * kRowFloats);
    }
}

}  // namespace skyig::render::sky
