// The eye and what stands before it: [eye], [display] and [channel.display].
#include <fmt/format.h>

#include <array>

#include "config/schema.h"

namespace skyig::config {
namespace {

constexpr std::array<std::string_view, 6> kToneNames{"hybrid",   "tumblin", "tumblin-safe",
                                                     "reinhard", "ward",    "linear"};
constexpr std::array<std::string_view, 3> kSourceNames{"sky", "view", "view-mean"};
constexpr std::array<std::string_view, 2> kPaceNames{"cockpit", "physiological"};

void read_gamma(TableReader& table, std::optional<double>& gamma) {
    const Value* value = table.any("gamma");
    if (value == nullptr) return;
    const auto* text = std::get_if<std::string>(&value->data);
    double number = 0.0;
    if (text != nullptr && *text == "srgb") {
        gamma.reset();
    } else if (as_number(*value, number) && number >= 1.0 && number <= 3.0) {
        gamma = number;
    } else {
        const std::string read = text != nullptr             ? fmt::format("\"{}\"", *text)
                                 : as_number(*value, number) ? fmt::format("{}", number)
                                                             : std::string(type_name(*value));
        table.error(*value, "gamma", fmt::format("is {}; it must be \"srgb\" or a number 1..3", read));
    }
}

}  // namespace

void read_screen(TableReader& table, Screen& screen) {
    const Value* most =
        table.number("max_luminance_cd_m2", screen.max_luminance_cd_m2, {1.0, 10'000.0, "cd/m2"});
    if (most != nullptr) screen.adaptation_cd_m2 = 0.5 * screen.max_luminance_cd_m2;
    table.number("adaptation_cd_m2", screen.adaptation_cd_m2, {0.1, 10'000.0, "cd/m2"});
    read_gamma(table, screen.gamma);
    table.describe("gamma", "\"srgb\", 1..3", screen.gamma ? to_toml(*screen.gamma) : to_toml("srgb"));
    const Value* black = table.number("black_cd_m2", screen.black_cd_m2, {0.0, 1000.0, "cd/m2"});
    const Value* reflected = table.number("reflected_cd_m2", screen.reflected_cd_m2, {0.0, 1000.0, "cd/m2"});
    const double least_cd_m2 = screen.black_cd_m2 + screen.reflected_cd_m2;
    if (least_cd_m2 < screen.max_luminance_cd_m2) return;
    const std::string_view key = reflected != nullptr ? "reflected_cd_m2"
                                 : black != nullptr   ? "black_cd_m2"
                                                      : "max_luminance_cd_m2";
    const Value* at = reflected != nullptr ? reflected : black != nullptr ? black : most;
    if (at == nullptr) return;
    table.error(
        *at, key,
        fmt::format("black and reflected light together are {} cd/m2; full white, {} cd/m2, must be more",
                    least_cd_m2, screen.max_luminance_cd_m2));
}

void read_display(TableReader table, Display& display) {
    read_screen(table, display);
    table.boolean("dither", display.dither);
    table.finish();
}

void read_eye(TableReader table, Eye& eye) {
    table.choice("operator", eye.tone, kToneNames);
    table.number("highlight_room", eye.highlight_room, {0.0, 2.0, "decades"});
    table.number("shoulder", eye.shoulder, {0.1, 1.0, "of full white"});
    table.boolean("night_colours", eye.night_colours);
    table.choice("adapt_to", eye.adapt_to, kSourceNames);
    table.number("adaptation_cd_m2", eye.adaptation_cd_m2, {1e-6, 1e6, "cd/m2"});
    table.choice("adapt_pace", eye.pace, kPaceNames);
    table.number("adapt_up_s", eye.adapt_up_s, {0.0, 600.0, "s"});
    table.number("adapt_down_s", eye.adapt_down_s, {0.0, 600.0, "s"});
    table.boolean("glare", eye.glare);
    table.finish();
}

}  // namespace skyig::config
