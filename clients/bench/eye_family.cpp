#include "clients/bench/eye_family.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "clients/bench/truth_table.h"
#include "render/display.h"
#include "render/eye/tone_curve.h"

namespace skyig::clients::bench {

namespace {

using render::DisplaySettings;
using render::ToneOperator;
namespace eye = render::eye;
namespace shaders32 = render::shaders32;
namespace shaders64 = render::shaders64;

constexpr std::array<std::string_view, render::kToneOperatorNames.size()> kWhat{
    "Tumblin and Rushmeier by day, threshold matching (Ferwerda et al.) by night; the default",
    "Tumblin and Rushmeier 1993 as published, held at its sign change, 1.594e-4 cd/m2, below it",
    "the same with the world's adaptation raised by 1e-3 cd/m2",
    "Reinhard et al. 2002: linear, then compressed",
    "Ward 1994: linear, a threshold difference is one on the screen",
    "the adaptation luminance at 18 % of white"};

// Of the tables: A and B.
struct TableScreen {
    char column;
    double max_cd_m2;
    double black_cd_m2;
};
constexpr std::array<TableScreen, 2> kScreens{{{'A', 100.0, 1.0}, {'B', 350.0, 0.35}}};
constexpr TableScreen kPlotScreen{'B', 350.0, 0.0};

DisplaySettings display_of(ToneOperator tone, const TableScreen& screen, bool alone = true) {
    DisplaySettings display;
    display.max_luminance_cd_m2 = screen.max_cd_m2;
    display.adaptation_luminance_cd_m2 = 0.5 * screen.max_cd_m2;
    display.black_cd_m2 = screen.black_cd_m2;
    display.srgb = false;
    display.tone = tone;
    return alone ? eye::operator_alone(display) : display;
}

double shown32(double luminance, const DisplaySettings& display, double adaptation_cd_m2) {
    const auto tone = eye::single_precision(eye::tone_parameters(display, adaptation_cd_m2));
    return static_cast<double>(shaders32::shown(glm::vec3{static_cast<float>(luminance)}, tone).y);
}

void add_tumblin(ModelEntry& model, ToneOperator tone, const TruthTable& table) {
    const bool raw = tone == ToneOperator::kTumblin;
    ErrorSamples samples;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double light = table.number(row, "Lw_cd_m2");
        const double adaptation =
            table.text(row, "Lwa_cd_m2") == "self" ? light : table.number(row, "Lwa_cd_m2");
        if (raw && adaptation <= eye::kTumblinZero_cd_m2) continue;
        for (const TableScreen& screen : kScreens) {
            const double wanted =
                table.number(row, fmt::format("n{}_{}", screen.column, raw ? "raw" : "safe"));
            samples.add(255.0 * (shown32(light, display_of(tone, screen), adaptation) - wanted));
        }
    }
    model.errors.push_back(
        {"the table's display value", "Tumblin and Rushmeier", "codes", samples.figures()});
}

void add_hybrid(ModelEntry& model, const TruthTable& table) {
    ErrorSamples samples;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double adaptation = table.number(row, "La_cd_m2");
        for (TableScreen screen : kScreens) {
            screen.black_cd_m2 = 0.0;
            const double asked_cd_m2 = std::pow(
                10.0, table.number(row, fmt::format("p{}", screen.column)) +
                          table.number(row, fmt::format("q{}", screen.column)) * std::log10(adaptation));
            const double wanted = std::pow(std::min(asked_cd_m2 / screen.max_cd_m2, 1.0), 1.0 / 2.2);
            const double n = shown32(adaptation, display_of(ToneOperator::kHybrid, screen), adaptation);
            samples.add(255.0 * (n - wanted));
        }
    }
    model.errors.push_back({"the table's display value", "default operator", "codes", samples.figures()});
}

ErrorFigures single_precision_errors(ToneOperator tone) {
    ErrorSamples samples;
    const DisplaySettings display = display_of(tone, kPlotScreen, false);
    for (double log_a = -6.0; log_a <= 5.0; log_a += 0.5) {
        const auto exact = eye::tone_parameters(display, std::pow(10.0, log_a));
        const auto quick = eye::single_precision(exact);
        for (double log_l = -7.0; log_l <= 9.0; log_l += 0.05) {
            const glm::vec3 rgb{glm::dvec3{0.7, 1.0, 1.6} * std::pow(10.0, log_l)};
            const glm::dvec3 off =
                shaders64::shown(glm::dvec3{rgb}, exact) - glm::dvec3{shaders32::shown(rgb, quick)};
            samples.add(255.0 * std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}));
        }
    }
    return samples.figures();
}

CurvePlot curves(std::string name, std::string title, double adaptation_cd_m2) {
    CurvePlot plot{std::move(name), std::move(title), "luminance in the world, cd/m2", "display value n", {}};
    for (std::size_t i = 0; i < render::kToneOperatorNames.size(); ++i) {
        const DisplaySettings display = display_of(static_cast<ToneOperator>(i), kPlotScreen);
        Curve curve{std::string(render::kToneOperatorNames[i]), {}};
        for (double log_l = -6.0; log_l <= 5.01; log_l += 0.1) {
            const double light = std::pow(10.0, log_l);
            curve.points.push_back(
                {light, shown32(light, display, adaptation_cd_m2 > 0.0 ? adaptation_cd_m2 : light)});
        }
        plot.curves.push_back(std::move(curve));
    }
    return plot;
}

/// Colours of a day and a night, as many as fit the first cache.
std::array<glm::vec3, 64> colours() {
    std::array<glm::vec3, 64> out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = glm::vec3{0.7F, 1.0F, 1.6F} *
                 static_cast<float>(std::pow(10.0, -5.0 + 0.15 * static_cast<double>(i)));
    return out;
}

}  // namespace

Report measure_eye_errors(const std::filesystem::path& truth) {
    Report report;
    report.family = "eye";
    report.title = "From luminance to display codes";
    report.cases =
        "luminances 1e-7..1e9 cd/m2 under adaptations 1e-6..1e5 cd/m2; the tables' own cases on displays of "
        "100 "
        "and 350 cd/m2, gamma 2.2. The curves are of the operators alone, on 350 cd/m2";
    report.truth =
        "tables computed in double from the published formulas; for single precision, the same text in "
        "double. "
        "The driver is held to the same by `tone_probe_test`";
    report.costs =
        "`colour` takes one colour through the whole text (operator, gamut, night colours, shoulder, "
        "encoding) in "
        "single precision, as at a vertex of the dome; `frame` derives all of a frame's parameters.";
    report.floor = "encoding one colour with a power";
    report.headline = {"single precision", "all adaptations", "colour"};
    const TruthTable tumblin(truth / "eye" / "tumblin_rushmeier.csv");
    const TruthTable hybrid(truth / "eye" / "default_operator.csv");
    for (std::size_t i = 0; i < render::kToneOperatorNames.size(); ++i) {
        const auto tone = static_cast<ToneOperator>(i);
        ModelEntry model{std::string(render::kToneOperatorNames[i]), std::string(kWhat[i]), {}, {}};
        model.errors.push_back(
            {"single precision", "all adaptations", "codes", single_precision_errors(tone)});
        if (tone == ToneOperator::kHybrid) add_hybrid(model, hybrid);
        if (tone == ToneOperator::kTumblin || tone == ToneOperator::kTumblinSafe)
            add_tumblin(model, tone, tumblin);
        report.models.push_back(std::move(model));
    }
    report.curves = {curves("fields", "A field that the eye is adapted to", 0.0),
                     curves("night", "Adapted to the natural night, 2e-4 cd/m2", 2e-4),
                     curves("day", "Adapted to a day, 3000 cd/m2", 3000.0)};
    return report;
}

std::vector<Contender> eye_contenders() {
    std::vector<Contender> contenders;
    for (std::size_t i = 0; i < render::kToneOperatorNames.size(); ++i) {
        const DisplaySettings display = display_of(static_cast<ToneOperator>(i), kPlotScreen, false);
        const auto tone = eye::single_precision(eye::tone_parameters(display, 100.0));
        const std::string name(render::kToneOperatorNames[i]);
        contenders.push_back({name, "colour", repeat([tone, all = colours()](std::uint64_t call) {
                                  return static_cast<double>(
                                      shaders32::shown(all[call % all.size()], tone).y);
                              })});
        contenders.push_back(
            {name, "frame", repeat([display](std::uint64_t call) {
                 return eye::tone_parameters(display, 1e-4 * static_cast<double>(call % 4096 + 1)).log2_gain;
             })});
    }
    return contenders;
}

Work eye_floor() {
    return repeat([all = colours()](std::uint64_t call) {
        const glm::vec3 n = glm::pow(all[call % all.size()], glm::vec3{1.0F / 2.2F});
        return static_cast<double>(n.x + n.y + n.z);
    });
}

}  // namespace skyig::clients::bench
