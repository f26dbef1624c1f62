#include "clients/skyig/instructor_command.h"

#include <algorithm>

#include "clients/skyig/validators.h"
#include "protocol/transport/endpoint.h"

namespace skyig::clients {

void add_instructor(CLI::App& app, InstructorOptions& options) {
    CLI::App& verb = *app.add_subcommand(
        "instructor", "a web page that sets a daemon's weather and time and shows what the crew sees");
    verb.add_option("--daemon-status", options.daemon_status,
                    "where the daemon tells of itself (http://127.0.0.1:8006)")
        ->check(daemon_url());
    verb.add_option("--cigi-to", options.cigi_to,
                    "where the daemon hears its [[source]] for it (127.0.0.1:8010)")
        ->check(endpoint(false));
    verb.add_option("--listen", options.listen, "where the page is served (127.0.0.1:8080)")
        ->check(endpoint(false));
    verb.add_option(
            "--token", options.token,
            "what a page has to say to be heard, 8 letters and digits at least: they open /#token=TOKEN")
        ->envname("SKYIG_INSTRUCTOR_TOKEN");
    verb.add_option("--name", options.names, "a name, without port, that a reverse proxy gives this page")
        ->type_name("NAME");
    verb.add_option("--saved", options.saved_path,
                    "file of own presets, \"\" for none (~/.local/state/skyig/instructor.json)")
        ->type_name("FILE");
    verb.footer("Open http://127.0.0.1:8080/ (with a token: http://HOST:8080/#token=TOKEN).");
}

void check_instructor(const InstructorOptions& options) {
    constexpr std::size_t kShortestToken = 8;
    constexpr protocol::transport::Ipv4 kLoopbackNet = 127;
    const auto wordlike = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ||
               c == '_';
    };
    const bool good_token = options.token.size() >= kShortestToken &&
                            std::all_of(options.token.begin(), options.token.end(), wordlike);
    if (!options.token.empty() && !good_token)
        throw CLI::ValidationError("--token", "must have 8 or more letters, digits, '-' and '_'");
    const auto listen = protocol::transport::parse_endpoint(options.listen);
    if (listen && listen->address >> 24U != kLoopbackNet && options.token.empty()) {
        throw CLI::ValidationError(
            "--listen",
            "others reach this address: give a --token that pages must know, or listen on 127.0.0.1");
    }
}

}  // namespace skyig::clients
