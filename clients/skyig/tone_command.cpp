#include "clients/skyig/tone_command.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "clients/skyig/validators.h"
#include "render/display.h"

namespace skyig::clients {

namespace {

/// A number that one option knows by a word too, which leaves `out` empty.
void add_number_or(CLI::App& verb, const std::string& name, std::optional<double>& out,
                   const std::string& word, double least, double most, const std::string& what) {
    const auto take = [&out, word](const std::string& text) {
        out.reset();
        if (text != word) out = std::stod(text);
    };
    const auto check = [word, range = finite_in(least, most)](std::string& text) mutable -> std::string {
        if (text == word) return {};
        const std::string wrong = range(text);
        return wrong.empty() ? wrong : fmt::format("{}, or '{}'", wrong, word);
    };
    verb.add_option_function<std::string>(name, take, what)->check(CLI::Validator(check, "NUMBER|" + word));
}

/// No negative one and no NaN; infinity is as bright as can be.
CLI::Validator luminance() {
    const auto check = [](std::string& text) -> std::string {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && value >= 0.0) return {};
        return fmt::format("'{}' is no luminance: 0 cd/m2 or more, or inf", text);
    };
    return {check, "CD"};
}

}  // namespace

void add_tone(CLI::App& app, ToneOptions& options) {
    CLI::App& verb = *app.add_subcommand("tone", "what luminances are shown as, by the shader that draws");
    const std::vector<std::string> names(render::kToneOperatorNames.begin(),
                                         render::kToneOperatorNames.end());
    verb.add_option("--operator", options.tone_operator,
                    "hybrid, tumblin, tumblin-safe, reinhard, ward, linear (hybrid)")
        ->check(CLI::IsMember(names))
        ->type_name("NAME");
    add_number_or(verb, "--adaptation", options.adaptation_cd_m2, "self", 1e-9, 1e9,
                  "what the eye is adapted to, cd/m2; self: to each luminance (so it is)");
    verb.add_option("--display-max", options.display_max_cd_m2, "full white, cd/m2 (350)")
        ->check(finite_in(1.0, 1e5));
    verb.add_option("--display-adaptation", options.display_adaptation_cd_m2,
                    "what the eye before the screen is adapted to, cd/m2 (half of full white)")
        ->check(finite_in(0.1, 1e5));
    verb.add_option("--ambient", options.ambient_cd_m2,
                    "what the screen shows at code 0, reflections included, cd/m2 (0)")
        ->check(finite_in(0.0, 1e5));
    add_number_or(verb, "--gamma", options.gamma, "srgb", 1.0, 3.0,
                  "the screen's exponent, or its curve (srgb)");
    verb.add_flag("--picture", options.picture,
                  "with what a picture has besides: room for highlights, a shoulder, night colours");
    verb.add_option("luminance", options.luminance_cd_m2, "in the world, cd/m2")
        ->required()
        ->check(luminance())
        ->type_name("LUMINANCE");
    verb.footer(
        "A line of JSON each: luminance, display_cd_m2 (what the operator asks of the screen), n (0..1, "
        "before "
        "dither) and code8, n in 255ths. An infinite luminance is told as null.");
}

}  // namespace skyig::clients
