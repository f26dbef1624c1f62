#include "render/fog/obscurants.h"

#include <algorithm>
#include <cmath>

#include "render/weather_area.h"

namespace skyig::render::fog {

namespace {

constexpr double kPatch_m = 300.0;

// By Obscurant::Kind.
constexpr std::array<Optics, 7> kOptics{{{glm::dvec3{1.0}, 0.85},
                                         {{0.915, 0.925, 0.93}, 0.70},
                                         {{0.955, 0.94, 0.92}, 0.72},
                                         {{0.90, 0.84, 0.75}, 0.75},
                                         {{0.84, 0.85, 0.87}, 0.60},
                                         {glm::dvec3{0.9999}, 0.90},
                                         {glm::dvec3{0.9999}, 0.80}}};

// Of green mostly, as luminance is.
double luminous(const glm::dvec3& rgb) {
    return glm::dot(rgb, glm::dvec3{0.2126, 0.7152, 0.0722});
}

// Heights at which the density bends, and the extinction between.
struct Ramp {
    double begin_m, base_m, top_m, end_m;
    double per_m;

    // On the inner side of a shell's end.
    [[nodiscard]] double at(double height_m, double inside_m) const noexcept {
        if (inside_m < begin_m || inside_m > end_m) return 0.0;
        if (inside_m < base_m) return per_m * (height_m - begin_m) / (base_m - begin_m);
        if (inside_m > top_m) return per_m * (end_m - height_m) / (end_m - top_m);
        return per_m;
    }
};

Ramp ramp_of(const Obscurant& o) noexcept {
    const double top_m = std::max(o.top_m, o.base_m);
    const double share = o.area ? area_weight(*o.area, glm::dvec2{0.0}) : 1.0;
    return {o.base_m - std::max(o.bottom_band_m, 0.0), o.base_m, top_m, top_m + std::max(o.top_band_m, 0.0),
            share * mean_extinction_per_m(o)};
}

}  // namespace

const Optics& optics_of(Obscurant::Kind kind) noexcept {
    return kOptics[static_cast<std::size_t>(kind)];
}

double mean_extinction_per_m(const Obscurant& o) noexcept {
    const double coverage = std::clamp(o.coverage, 0.0, 1.0);
    if (coverage >= 1.0) return std::max(o.extinction_per_m, 0.0);
    const double bands_m = std::max(o.bottom_band_m, 0.0) + std::max(o.top_band_m, 0.0);
    const double cell_m = std::clamp(std::max(o.top_m - o.base_m, 0.0) + 0.5 * bands_m, 1.0, kPatch_m);
    const double lost = -std::expm1(-std::max(o.extinction_per_m, 0.0) * cell_m);
    return -std::log1p(-coverage * lost) / cell_m;
}

void Profile::lay(std::span<const Obscurant> obscurants, double ground_m) noexcept {
    count_ = 0;
    std::array<Ramp, Weather::kMaxObscurants> ramps{};
    std::array<const Optics*, Weather::kMaxObscurants> optics{};
    std::array<double, kMostShells + 1> heights{};
    std::size_t ramp_count = 0;
    std::size_t height_count = 0;
    heights[height_count++] = ground_m;
    for (const Obscurant& o : obscurants.first(std::min(obscurants.size(), Weather::kMaxObscurants))) {
        const Ramp ramp = ramp_of(o);
        if (!(ramp.per_m > 0.0) || !(ramp.end_m > ground_m) || !(ramp.end_m > ramp.begin_m)) continue;
        optics[ramp_count] = &optics_of(o.kind);
        ramps[ramp_count++] = ramp;
        for (const double height_m : {ramp.begin_m, ramp.base_m, ramp.top_m, ramp.end_m}) {
            if (height_m > ground_m) heights[height_count++] = height_m;
        }
    }
    std::sort(heights.begin(), heights.begin() + height_count);
    for (std::size_t i = 0; i + 1 < height_count; ++i) {
        if (!(heights[i + 1] > heights[i])) continue;
        Shell shell{heights[i], heights[i + 1], 0.0, 0.0, {glm::dvec3{0.0}, 0.0}, 1.0};
        const double inside_m = 0.5 * (shell.low_m + shell.high_m);
        double sum = 0.0;
        for (std::size_t k = 0; k < ramp_count; ++k) {
            shell.low_per_m += ramps[k].at(shell.low_m, inside_m);
            shell.high_per_m += ramps[k].at(shell.high_m, inside_m);
            const double part = ramps[k].at(inside_m, inside_m);
            shell.optics.albedo += part * optics[k]->albedo;
            shell.optics.g += part * optics[k]->g;
            sum += part;
        }
        shell.optics = sum > 0.0 ? Optics{shell.optics.albedo / sum, shell.optics.g / sum} : Optics{};
        shell.kept = 1.0 - luminous(shell.optics.albedo) * shell.optics.g * shell.optics.g;
        shells_[count_++] = shell;
    }
}

}  // namespace skyig::render::fog
