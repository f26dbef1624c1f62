#include "clients/skyig/latency/latency_command.h"

#include "clients/skyig/validators.h"

namespace skyig::clients {

void add_latency(CLI::App& app, LatencyOptions& options) {
    CLI::App& verb = *app.add_subcommand(
        "latency",
        "flip an aircraft's attitude and tell how soon a daemon's pictures show it: day, night, cloud");
    verb.add_option("--to", options.to, "where the daemon listens (127.0.0.1:8004)")
        ->type_name("ADDRESS:PORT");
    verb.add_option("--listen", options.listen, "where its answers come (127.0.0.1:8005)")
        ->type_name("ADDRESS:PORT");
    verb.add_option("--rate", options.rate_hz,
                    "messages a second (58.3: their phase wanders over the frames of a daemon at 60 Hz)")
        ->check(finite_in(1.0, 1000.0));
    verb.add_option("--flips", options.flips, "in each scene (200)")->check(CLI::Range(1, 100'000));
    verb.add_option("--settle", options.settle_s, "seconds before the first flip of a scene (3)")
        ->check(finite_in(0.0, 600.0));
    verb.add_option("--wait", options.wait_s, "seconds to wait for the daemon (10)")
        ->check(finite_in(0.1, 3600.0));
    verb.add_option("--at-most", options.at_most_frames, "fail where a p99 is more than so many frame times")
        ->check(finite_in(0.1, 1000.0));
    verb.add_flag("--json", options.json, "tell the results as JSON");
}

}  // namespace skyig::clients
