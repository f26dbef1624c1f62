#include "clients/skyig/tone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <vector>

#include "render/display.h"
#include "render/eye/tone_curve.h"
#include "render/gl/headless_context.h"
#include "render/tone_probe.h"

namespace skyig::clients {

namespace {

render::DisplaySettings display_of(const ToneOptions& options) {
    render::DisplaySettings display;
    display.max_luminance_cd_m2 = options.display_max_cd_m2;
    display.adaptation_luminance_cd_m2 =
        options.display_adaptation_cd_m2.value_or(0.5 * options.display_max_cd_m2);
    display.black_cd_m2 = options.ambient_cd_m2;
    display.srgb = !options.gamma.has_value();
    display.gamma = options.gamma.value_or(display.gamma);
    const auto* const at = std::find(render::kToneOperatorNames.begin(), render::kToneOperatorNames.end(),
                                     options.tone_operator);
    display.tone = static_cast<render::ToneOperator>(at - render::kToneOperatorNames.begin());
    return options.picture ? display : render::eye::operator_alone(display);
}

std::vector<render::ShownGrey> show(const ToneOptions& options) {
    const auto context = render::gl::HeadlessContext::create(true);
    render::ToneProbe probe;
    const render::DisplaySettings display = display_of(options);
    const std::vector<float> luminance(options.luminance_cd_m2.begin(), options.luminance_cd_m2.end());
    std::vector<render::ShownGrey> shown(luminance.size());
    const auto tone_for = [&display](double adaptation_cd_m2) {
        return render::eye::single_precision(render::eye::tone_parameters(display, adaptation_cd_m2));
    };
    if (options.adaptation_cd_m2) {
        probe.measure(luminance, tone_for(*options.adaptation_cd_m2), shown);
        return shown;
    }
    // What cannot be adapted to is met with the nearest that can.
    constexpr double kBrightest_cd_m2 = 1e9;
    for (std::size_t i = 0; i < luminance.size(); ++i) {
        const double field_cd_m2 = std::min(options.luminance_cd_m2[i], kBrightest_cd_m2);
        probe.measure(std::span{luminance}.subspan(i, 1), tone_for(field_cd_m2),
                      std::span{shown}.subspan(i, 1));
    }
    return shown;
}

}  // namespace

int run_tone(const ToneOptions& options) {
    try {
        const std::vector<render::ShownGrey> shown = show(options);
        for (std::size_t i = 0; i < shown.size(); ++i) {
            const nlohmann::ordered_json line{{"luminance", options.luminance_cd_m2[i]},
                                              {"display_cd_m2", shown[i].display_cd_m2},
                                              {"n", shown[i].n},
                                              {"code8", static_cast<int>(std::lround(255.0 * shown[i].n))}};
            fmt::print("{}\n", line.dump());
        }
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig tone: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
