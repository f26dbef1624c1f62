#include "render/cloud/field/coverage.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace skyig::render::cloud::field {
namespace {

constexpr int kHeights = 32;
constexpr int kColumns = 3072;
static_assert(kRays % kHeights == 0);

using Column = std::array<float, kHeights>;

// The n-th place of the R2 sequence (Roberts 2018).
void put_place(Points& points, int at, int n) {
    constexpr double kEast = 0.7548776662466927;
    constexpr double kNorth = 0.5698402909980532;
    points.east_m[at] = static_cast<float>((kEast * n - std::floor(kEast * n)) * kWorld_m);
    points.north_m[at] = static_cast<float>((kNorth * n - std::floor(kNorth * n)) * kWorld_m);
}

// Values at heights in the middle of equal parts.
std::vector<Column> columns_of(const Shape& shape, float thickness_m) {
    std::vector<Column> columns(kColumns);
    Points points{};
    constexpr int kAtOnce = kRays / kHeights;
    for (int first = 0; first < kColumns; first += kAtOnce) {
        for (int i = 0; i < kRays; ++i) {
            put_place(points, i, first + i / kHeights);
            points.height_m[i] = (static_cast<float>(i % kHeights) + 0.5F) / kHeights * thickness_m;
        }
        kernels().values(shape, thickness_m, points);
        for (int i = 0; i < kRays; ++i)
            columns[static_cast<std::size_t>(first + i / kHeights)][static_cast<std::size_t>(i % kHeights)] =
                points.value[i];
    }
    return columns;
}

// Of the flats alone.
std::vector<float> flat_values_of(Shape shape) {
    for (Fine& fine : shape.fines)
        fine.weight = 0.0F;
    shape.fibres.weight = 0.0F;
    std::fill(std::begin(shape.lift), std::end(shape.lift), 0.0F);
    std::vector<float> values(kColumns);
    Points points{};
    for (int first = 0; first < kColumns; first += kRays) {
        for (int i = 0; i < kRays; ++i)
            put_place(points, i, first + i);
        kernels().values(shape, 1.0F, points);
        std::copy(std::begin(points.value), std::end(points.value), values.begin() + first);
    }
    return values;
}

float mean_density(const Column& column, float threshold, float edge) {
    float sum = 0.0F;
    for (const float value : column) {
        const float x = std::clamp((value - threshold) / edge, 0.0F, 1.0F);
        sum += x * x * (3.0F - 2.0F * x);
    }
    return sum / kHeights;
}

// The threshold at which the column's mean density is `part`: it falls with the threshold.
float threshold_of(const Column& column, float edge, float part) {
    float high = *std::max_element(column.begin(), column.end());
    float low = high - edge - 2.0F;
    for (int step = 0; step < 12; ++step) {
        const float middle = 0.5F * (low + high);
        (mean_density(column, middle, edge) > part ? low : high) = middle;
    }
    return 0.5F * (low + high);
}

float lowest_value(const Shape& shape) {
    float sum = 0.0F;
    for (const Flat& flat : shape.flats)
        sum += flat.weight;
    for (const Fine& fine : shape.fines)
        sum += fine.weight;
    sum += shape.fibres.weight;
    return -0.5F * sum;
}

// The mean density of which a column hides what is behind it.
float hiding_part(double optical_depth) {
    return static_cast<float>(std::min(std::log(2.0), 0.25 * optical_depth) / optical_depth);
}

// From the thresholds of all columns.
template <class Curve>
void put_curve(std::vector<float>& thresholds, float full, Curve& curve) {
    std::sort(thresholds.begin(), thresholds.end(), std::greater<>());
    const std::size_t parts = curve.size() - 1;
    for (std::size_t i = 1; i < parts; ++i)
        curve[i] = thresholds[i * kColumns / parts];
    curve[0] = thresholds.front() + 0.05F;
    curve[parts] = full;
}

}  // namespace

Coverage::Coverage(const Noise& noise) {
    std::vector<float> thresholds(kColumns);
    for (std::size_t g = 0; g < kGenera; ++g) {
        const auto genus = static_cast<CloudGenus>(g);
        const Shape shape = shape_of(noise, genus, {});
        const std::vector<Column> columns = columns_of(shape, genus_of(genus).usual_thickness_m);
        const std::vector<float> flats = flat_values_of(shape);
        const float full = lowest_value(shape) - shape.edge;
        for (std::size_t d = 0; d < kDepths.size(); ++d) {
            const float own = genus_of(genus).covered_part;
            const float part = own > 0.0F ? own : hiding_part(kDepths[d]);
            for (std::size_t i = 0; i < columns.size(); ++i)
                thresholds[i] = threshold_of(columns[i], shape.edge, part);
            put_curve(thresholds, full, curves_[static_cast<std::size_t>(Drawn::kVolume)][g][d]);
            // A sheet's density goes straight with the value.
            for (std::size_t i = 0; i < flats.size(); ++i)
                thresholds[i] = flats[i] - part * shape.edge;
            put_curve(thresholds, full, curves_[static_cast<std::size_t>(Drawn::kSheet)][g][d]);
        }
    }
}

float Coverage::threshold(CloudGenus genus, double coverage, double optical_depth,
                          Drawn drawn) const noexcept {
    const std::size_t known_genus =
        static_cast<std::size_t>(genus) < kGenera ? static_cast<std::size_t>(genus) : 0;
    const Curves& curves = curves_[static_cast<std::size_t>(drawn)][known_genus];
    const double place = std::clamp(coverage, 0.0, 1.0) * static_cast<double>(kParts);
    const std::size_t low = std::min(static_cast<std::size_t>(place), kParts - 1);
    const auto part = static_cast<float>(place - static_cast<double>(low));
    const double known = std::clamp(optical_depth, kDepths.front(), kDepths.back());
    const double depth_place = std::log(known / kDepths.front()) / std::log(8.0);
    const std::size_t thin = std::min(static_cast<std::size_t>(depth_place), kDepths.size() - 2);
    const auto depth_part = static_cast<float>(depth_place - static_cast<double>(thin));
    const auto along = [&](const Curve& curve) { return curve[low] + part * (curve[low + 1] - curve[low]); };
    const float at_thin = along(curves[thin]);
    return at_thin + depth_part * (along(curves[thin + 1]) - at_thin);
}

}  // namespace skyig::render::cloud::field
