#include "clients/bench/fog_family.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <string>

#include "render/fog/rvr.h"
#include "render/fog/veil.h"
#include "render/geometry.h"

namespace skyig::clients::bench {

namespace {

using render::Obscurant;
namespace fog = render::fog;

Obscurant layer(Obscurant::Kind kind, double base_m, double top_m, double band_m, double extinction_per_m) {
    Obscurant o;
    o.kind = kind;
    o.base_m = base_m;
    o.top_m = top_m;
    o.bottom_band_m = base_m > 0.0 ? band_m : 0.0;
    o.top_band_m = band_m;
    o.extinction_per_m = extinction_per_m;
    return o;
}

std::vector<Obscurant> one_layer() {
    return {layer(Obscurant::Kind::kFog, -1000.0, 100.0, 20.0, 0.01)};
}

std::vector<Obscurant> four_layers() {
    return {layer(Obscurant::Kind::kFog, -1000.0, 60.0, 20.0, 8e-3),
            layer(Obscurant::Kind::kHaze, -1000.0, 1500.0, 300.0, 3e-4),
            layer(Obscurant::Kind::kSmoke, 800.0, 1200.0, 100.0, 4e-4),
            layer(Obscurant::Kind::kDust, 3000.0, 3030.0, 0.0, 2e-3)};
}

double density(const Obscurant& o, double height_m) {
    const double over = height_m > o.top_m ? (height_m - o.top_m) / std::max(o.top_band_m, 1e-300) : 0.0;
    const double under =
        height_m < o.base_m ? (o.base_m - height_m) / std::max(o.bottom_band_m, 1e-300) : 0.0;
    return std::clamp(1.0 - over - under, 0.0, 1.0);
}

// By many midpoints between all places where the ray crosses an end of a layer.
double summed_depth(std::span<const Obscurant> layers, double eye_m, double sine, double end_m) {
    constexpr int kSteps = 2000;
    const double radius_m = render::kEarthRadius_m + eye_m;
    std::vector<double> bends{0.0, end_m};
    const double fall_m = -sine * radius_m;
    for (const Obscurant& o : layers) {
        for (const double at_m : {o.base_m - o.bottom_band_m, o.base_m, o.top_m, o.top_m + o.top_band_m}) {
            const double square = fall_m * fall_m + (at_m - eye_m) * (2.0 * radius_m + at_m - eye_m);
            if (square <= 0.0) continue;
            bends.push_back(std::clamp(fall_m - std::sqrt(square), 0.0, end_m));
            bends.push_back(std::clamp(fall_m + std::sqrt(square), 0.0, end_m));
        }
    }
    std::sort(bends.begin(), bends.end());
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < bends.size(); ++k) {
        const double step_m = (bends[k + 1] - bends[k]) / kSteps;
        for (int i = 0; i < kSteps && step_m > 0.0; ++i) {
            const double along_m = bends[k] + (i + 0.5) * step_m;
            const double gain = along_m * (2.0 * radius_m * sine + along_m);
            const double height_m = eye_m + gain / (std::sqrt(radius_m * radius_m + gain) + radius_m);
            for (const Obscurant& o : layers)
                sum += o.extinction_per_m * density(o, height_m) * step_m;
        }
    }
    return sum;
}

void add_depths(ModelEntry& in_double, ModelEntry& in_float, const std::string& cases,
                const std::vector<Obscurant>& layers) {
    ErrorSamples exact;
    ErrorSamples quick;
    for (const double eye_m : {2.0, 60.0, 300.0, 914.0, 3030.0, 10e3}) {
        fog::Veil veil;
        veil.lay(layers, eye_m);
        for (const double sine : {-0.5, -0.05, -0.01, -1e-3, 0.0, 1e-3, 0.02, 0.3, 1.0}) {
            for (const double end_m : {500.0, 5e3, 50e3}) {
                // No ray goes through the ground.
                const double fall_m = -sine * (render::kEarthRadius_m + eye_m);
                const double square = fall_m * fall_m - eye_m * (2.0 * render::kEarthRadius_m + eye_m);
                const double until_m =
                    sine < 0.0 && square > 0.0 ? std::min(end_m, fall_m - std::sqrt(square)) : end_m;
                const double wanted = summed_depth(layers, eye_m, sine, until_m);
                if (wanted < 1e-6) continue;
                exact.add(100.0 * (veil.optical_depth(sine, until_m) / wanted - 1.0));
                const float got = veil.optical_depth(static_cast<float>(sine), static_cast<float>(until_m));
                quick.add(100.0 * (static_cast<double>(got) / wanted - 1.0));
            }
        }
    }
    in_double.errors.push_back({"optical depth", cases, "%", exact.figures()});
    in_float.errors.push_back({"optical depth", cases, "%", quick.figures()});
}

// A black thing at the set visibility against what is there without it, in a deep layer.
ErrorFigures contrast_errors() {
    ErrorSamples samples;
    for (const double eye_m : {2.0, 304.8, 457.2, 609.6}) {
        for (const double visibility_m : {300.0, 800.0, 5000.0}) {
            for (const double contrast : {0.05, 0.02}) {
                const std::vector<Obscurant> layers{
                    layer(Obscurant::Kind::kFog, -1000.0, 900.0, 50.0, -std::log(contrast) / visibility_m)};
                fog::Veil veil;
                veil.lay(layers, eye_m);
                fog::VeilSources sources;
                sources.beams[0] = {render::direction_of({0.6, 2.0}), glm::dvec3{9e4}};
                sources.above_cd_m2 = glm::dvec3{4000.0};
                veil.light(sources);
                const auto both = veil.along(glm::dvec3{1.0, 0.0, 0.0}, visibility_m, fog::Veil::kEndless_m);
                const double whole = both.whole.added_cd_m2.y;
                const double seen =
                    render::shaders64::veil_before(both.near.added_cd_m2, both.whole.added_cd_m2, both.near)
                        .y;
                samples.add(100.0 * ((whole - seen) / whole / contrast - 1.0));
            }
        }
    }
    return samples.figures();
}

ErrorFigures rvr_errors() {
    ErrorSamples samples;
    for (const double extinction : {0.0, 1e-6, 1e-3, 0.02, 0.1, 1.0}) {
        for (const double intensity : {30.0, 1000.0, 10e3, 200e3}) {
            for (const double background : {1.0, 15.0, 1000.0, 30e3}) {
                const double threshold = fog::light_threshold_lux(background);
                double low = -20.0;
                double high = 30.0;
                for (int i = 0; i < 100; ++i) {
                    const double middle = 0.5 * (low + high);
                    const double log_lux =
                        std::log(intensity / threshold) - extinction * std::exp(middle) - 2.0 * middle;
                    (log_lux > 0.0 ? low : high) = middle;
                }
                samples.add(100.0 *
                            (fog::allard_range_m(intensity, extinction, threshold) / std::exp(low) - 1.0));
            }
        }
    }
    return samples.figures();
}

Work veil_work(const std::vector<Obscurant>& layers, double eye_m) {
    const auto veil = std::make_shared<fog::Veil>();
    veil->lay(layers, eye_m);
    fog::VeilSources sources;
    sources.beams[0] = {render::direction_of({0.6, 2.0}), glm::dvec3{9e4}};
    sources.above_cd_m2 = glm::dvec3{4000.0};
    veil->light(sources);
    return repeat([veil](std::uint64_t call) {
        const double up = 0.01 + 0.9 * static_cast<double>(call % 64) / 64.0;
        return veil->sum({std::sqrt(1.0 - up * up), 0.0, up}, fog::Veil::kEndless_m).added_cd_m2.y;
    });
}

Work frame_work(const std::vector<Obscurant>& layers) {
    return repeat([layers](std::uint64_t call) {
        fog::Veil veil;
        veil.lay(layers, 2.0 + static_cast<double>(call % 64));
        fog::VeilSources sources;
        sources.beams[0] = {render::direction_of({0.6, 2.0}), glm::dvec3{9e4}};
        veil.light(sources);
        return veil.ground_share().y;
    });
}

}  // namespace

Report measure_fog_errors(const std::filesystem::path&) {
    Report report;
    report.family = "fog";
    report.title = "Fog, haze and their like; runway visual range";
    report.cases =
        "a ground fog with a soft top, and four layers of four sorts, seen from 2 m to 10 km towards nine "
        "elevations up to 50 km; a black thing at the visibility set, 2 % and 5 %, on the ground and at "
        "1,000, "
        "1,500 and 2,000 ft; lights of 30 to 200,000 cd by night and day";
    report.truth =
        "optical depth: midpoints between all crossings, double. Contrast: Koschmieder's law. Runway visual "
        "range: bisection of Allard's law. What fog sends to the eye is held against a transport program's "
        "slab "
        "by `fog_test`, the picture itself by `pixel_test`";
    report.costs =
        "`look-up` is all that a vertex of the dome asks of the veil, from in it; `frame` lays and lights "
        "the "
        "stack, once a frame.";
    report.floor = "one exponential";
    report.headline = {"optical depth", "four layers", "look-up"};
    ModelEntry in_double{"one layer", "a ground fog; in double, as the dome is made", {}, {}};
    ModelEntry in_float{"one layer, float", "the same text as the shader before things computes it", {}, {}};
    add_depths(in_double, in_float, "one layer", one_layer());
    ModelEntry four_double{"four layers", "fog, haze, smoke and dust; in double", {}, {}};
    ModelEntry four_float{"four layers, float", "the same as the shader computes it", {}, {}};
    add_depths(four_double, four_float, "four layers", four_layers());
    in_double.errors.push_back({"contrast", "2 % and 5 %, ground to 2,000 ft", "%", contrast_errors()});
    ModelEntry rvr{"rvr", "Allard by Newton's method, and Koschmieder", {}, {}};
    rvr.errors.push_back({"range of lights", "night and day", "%", rvr_errors()});
    report.models = {in_double, in_float, four_double, four_float, rvr};
    return report;
}

std::vector<Contender> fog_contenders() {
    return {
        {"one layer", "look-up", veil_work(one_layer(), 2.0)},
        {"one layer", "frame", frame_work(one_layer())},
        {"four layers", "look-up", veil_work(four_layers(), 2.0)},
        {"four layers", "frame", frame_work(four_layers())},
        {"rvr", "range", repeat([](std::uint64_t call) {
             return fog::runway_visual_range(1e-3 * static_cast<double>(call % 64 + 1), 10e3, 100.0).range_m;
         })}};
}

Work fog_floor() {
    return repeat([](std::uint64_t call) { return std::exp(-0.01 * static_cast<double>(call % 64)); });
}

}  // namespace skyig::clients::bench
