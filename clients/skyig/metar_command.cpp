#include "clients/skyig/metar_command.h"

namespace skyig::clients {

CLI::App* add_metar(CLI::App& app, MetarOptions& options) {
    CLI::App* verb = app.add_subcommand("metar", "what weather reports (METAR, SPECI) say");
    verb->add_option("text", options.reports,
                     "reports, each in quotes; -, or without any, from the lines of standard input")
        ->type_name("TEXT");
    verb->add_flag("--json", options.json, "one JSON object a line for each report");
    verb->footer(
        "A group that is wrong is told on stderr and in the key error, and the exit status is 1; the rest "
        "is told all the same. Groups of no known kind stand under unparsed and are no error.");
    return verb;
}

}  // namespace skyig::clients
