#include "clients/skyig/rvr_command.h"

#include "clients/skyig/validators.h"

namespace skyig::clients {

void add_rvr(CLI::App& app, RvrOptions& options) {
    CLI::App& verb = *app.add_subcommand(
        "rvr", "how far runway lights and marks are seen in fog, or the fog for a wanted range");
    CLI::Option_group* what = verb.add_option_group("what is known", "one of these");
    what->add_option("--visibility", options.visibility_m, "meteorological visibility, metres")
        ->check(finite_in(0.1, 1e9));
    what->add_option("--extinction", options.extinction_per_m, "of visible light, per metre")
        ->check(finite_in(0.0, 1e4));
    what->add_option("--rvr", options.rvr_m,
                     "wanted runway visual range, metres: tells the extinction for it")
        ->check(finite_in(0.1, 1e6));
    what->require_option(1);
    verb.add_option("--intensity", options.intensity_cd, "of the lights, candela (10000)")
        ->check(finite_in(0.0, 1e9));
    verb.add_option("--background", options.background_cd_m2,
                    "luminance that lights stand before, cd/m2 (10000: day; 10: night)")
        ->check(finite_in(0.0, 1e6));
    verb.add_option("--contrast", options.contrast, "at which marks are just seen (0.05)")
        ->check(finite_in(0.001, 0.9));
    verb.add_flag("--json", options.json, "tell it as JSON");
}

}  // namespace skyig::clients
