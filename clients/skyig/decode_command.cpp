#include "clients/skyig/decode_command.h"

namespace skyig::clients {

CLI::App* add_decode(CLI::App& app, DecodeOptions& options) {
    CLI::App* verb =
        app.add_subcommand("decode", "what messages and recorded frames say, and what is wrong with them");
    CLI::Option* cigi =
        verb->add_option(
                "--cigi", options.cigi,
                "CIGI datagrams in hexadecimal, one an argument; -, or without any, one a line of stdin")
            ->expected(0, -1)
            ->default_str("-")
            ->type_name("HEX");
    CLI::Option* live =
        verb->add_option("--live", options.live_port, "watch what comes to this UDP port of 127.0.0.1")
            ->check(CLI::Range(0, 65535))
            ->type_name("PORT")
            ->excludes(cigi);
    CLI::Option* can = verb->add_option("--can", options.can_path,
                                        "a log of candump -L, read as CANaerospace; - is standard input")
                           ->type_name("FILE")
                           ->excludes(cigi)
                           ->excludes(live);
    verb->add_option("--count", options.count, "stop after so many datagrams")
        ->check(CLI::PositiveNumber)
        ->needs(live);
    verb->add_flag("--from-ig", options.from_ig, "messages of the image generator to the host")
        ->excludes(can);
    verb->add_flag("--json", options.json, "one JSON object a line for each datagram or frame");
    verb->callback([cigi, live, can] {
        if (cigi->empty() && live->empty() && can->empty())
            throw CLI::RequiredError("decode: one of --cigi, --can and --live");
    });
    verb->footer(
        "A line that is none is told on stderr; the others are decoded, and the exit status is 1.\n"
        "JSON of CIGI: outcome is accept, partial (framing lost part-way) or drop; reason names the "
        "counter.");
    return verb;
}

}  // namespace skyig::clients
