#include "clients/skyig/rvr.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "render/fog/rvr.h"

namespace skyig::clients {

namespace {

double extinction_per_m(const RvrOptions& options) {
    if (options.extinction_per_m) return *options.extinction_per_m;
    if (options.visibility_m) return -std::log(options.contrast) / *options.visibility_m;
    return render::fog::extinction_for_range(*options.rvr_m, options.intensity_cd, options.background_cd_m2,
                                             options.contrast);
}

std::string metres(double value_m) {
    return std::isfinite(value_m) ? fmt::format("{:.1f} m", value_m) : "without end";
}

}  // namespace

int run_rvr(const RvrOptions& options) {
    const double extinction = extinction_per_m(options);
    const double visibility_m = render::fog::koschmieder_range_m(extinction, options.contrast);
    const auto range = render::fog::runway_visual_range(extinction, options.intensity_cd,
                                                        options.background_cd_m2, options.contrast);
    if (options.json) {
        // JSON has no infinity: null.
        const nlohmann::ordered_json json{{"extinction_per_m", extinction},
                                          {"visibility_m", visibility_m},
                                          {"contrast", options.contrast},
                                          {"intensity_cd", options.intensity_cd},
                                          {"background_cd_m2", options.background_cd_m2},
                                          {"threshold_lux", range.threshold_lux},
                                          {"allard_m", range.allard_m},
                                          {"koschmieder_m", range.koschmieder_m},
                                          {"rvr_m", range.range_m}};
        fmt::print("{}\n", json.dump(2));
        return 0;
    }
    fmt::print("extinction  {:.4g} per metre\n", extinction);
    fmt::print("visibility  {} at a contrast of {:g} %\n", metres(visibility_m), 100.0 * options.contrast);
    fmt::print("threshold   {:.3g} lx before {:g} cd/m2\n", range.threshold_lux, options.background_cd_m2);
    fmt::print("lights      {} (Allard, {:g} cd)\n", metres(range.allard_m), options.intensity_cd);
    fmt::print("marks       {} (Koschmieder)\n", metres(range.koschmieder_m));
    fmt::print("RVR         {}\n", metres(range.range_m));
    return 0;
}

}  // namespace skyig::clients
