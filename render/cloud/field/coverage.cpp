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

// Values at heights in the middle of equal parts, over places of the R2 sequence (Roberts 2018).
std::vector<Column> columns_of(const Shape& shape, float thickness_m) {
    constexpr double kEast = 0.7548776662466927;
    constexpr double kNorth = 0.5698402909980532;
    std::vector<Column> columns(kColumns);
    Points points{};
    constexpr int kAtOnce = kRays / kHeights;
    for (int first = 0; first < kColumns; first += kAtOnce) {
        for (int i = 0; i < kRays; ++i) {
            const double n = first + i / kHeights;
            points.east_m[i] = static_cast<float>((kEast * n - std::floor(kEast * n)) * kWorld_m);
            points.north_m[i] = static_cast<float>((kNorth * n - std::floor(kNorth * n)) * kWorld_m);
            points.height_m[i] = (static_cast<float>(i % kHeights) + 0.5F) / kHeights * thickness_m;
        }
        kernels().values(shape, thickness_m, points);
        for (int i = 0; i < kRays; ++i)
            columns[static_cast<std::size_t>(first + i / kHeights)][static_cast<std::size_t>(i % kHeights)] =
                points.value[i];
    }
    return columns;
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
    return -0.5F * sum;
}

}  // namespace

Coverage::Coverage(const Noise& noise) {
    std::vector<float> thresholds(kColumns);
    for (std::size_t g = 0; g < kGenera; ++g) {
        const auto genus = static_cast<CloudGenus>(g);
        const Shape shape = shape_of(noise, genus, {});
        const std::vector<Column> columns = columns_of(shape, genus_of(genus).usual_thickness_m);
        for (std::size_t d = 0; d < kDepths.size(); ++d) {
            const auto part = static_cast<float>(std::min(std::log(2.0), 0.25 * kDepths[d]) / kDepths[d]);
            for (std::size_t i = 0; i < columns.size(); ++i)
                thresholds[i] = threshold_of(columns[i], shape.edge, part);
            std::sort(thresholds.begin(), thresholds.end(), std::greater<>());
            Curve& curve = curves_[g][d];
            for (std::size_t i = 1; i < kParts; ++i)
                curve[i] = thresholds[i * kColumns / kParts];
            curve[0] = thresholds.front() + 0.05F;
            curve[kParts] = lowest_value(shape) - shape.edge;
        }
    }
}

float Coverage::threshold(CloudGenus genus, double coverage, double optical_depth) const noexcept {
    const auto& curves =
        curves_[static_cast<std::size_t>(genus) < kGenera ? static_cast<std::size_t>(genus) : 0];
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
