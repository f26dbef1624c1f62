#include "clients/skyig/metar_command.h"

namespace skyig::clients {

CLI::App* add_metar(CLI::App& app, MetarOptions& options) {
    CLI::App* verb = app.add_subcommand("metar", "what weather reports (METAR, SPECI) say");
    verb->add_option("text", options.reports,
                     "reports, each in quotes; -, or without any, from the lines of standard input")
        ->type_name("TEXT");
    verb->add_flag("--json", options.json, "one JSON object a line for each report");
    CLI::Option* state = verb->add_flag("--state", options.state,
                                        "the weather that is drawn of it, as JSON, a line for each report");
    verb->add_option("--elevation", options.elevation_m, "of the aerodrome, metres above the ellipsoid (0)")
        ->check(CLI::Range(-500.0, 9000.0))
        ->needs(state);
    verb->footer(
        "A group that is wrong is told on stderr and in the key error, and the exit status is 1; the rest "
        "is told all the same. Groups of no known kind stand under unparsed and are no error.");
    return verb;
}

}  // namespace skyig::clients
