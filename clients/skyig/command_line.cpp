#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <CLI/CLI.hpp>
#include <cmath>
#include <string_view>
#include <vector>

#include "clients/skyig/options.h"
#include "server/ephemeris/time.h"

namespace skyig::clients {

namespace {

constexpr std::array<std::string_view, 3> kVerbs{"host", "shot", "bench"};

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row[b.size()];
}

std::string_view nearest_verb(std::string_view word) {
    return *std::min_element(kVerbs.begin(), kVerbs.end(), [word](std::string_view a, std::string_view b) {
        return edit_distance(word, a) < edit_distance(word, b);
    });
}

std::string check_utc(const std::string& text) {
    if (server::ephemeris::parse_utc(text)) return {};
    return fmt::format("'{}' is no UTC time; write it as 2026-06-21T19:30:00Z", text);
}

CLI::Validator utc_time() {
    return {[](std::string& text) { return check_utc(text); }, "UTC"};
}

/// CLI::Range lets NaN through: no comparison with it is true.
CLI::Validator finite_in(double lo, double hi) {
    const auto check = [lo, hi](std::string& text) -> std::string {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= lo && value <= hi)
            return {};
        return fmt::format("'{}' is not a number in [{:.9g}, {:.9g}]", text, lo, hi);
    };
    return {check, fmt::format("NUMBER in [{:.9g}, {:.9g}]", lo, hi)};
}

void add_host(CLI::App& app, HostOptions& options, std::string& order) {
    app.add_option("--flight", options.flight_path, "the flight to fly (CSV)")->required()->type_name("FILE");
    app.add_option("--utc", options.utc, "UTC at the start, as 2026-06-21T19:30:00Z")
        ->required()
        ->check(utc_time())
        ->type_name("TIME");
    app.add_option("--rate", options.rate_hz, "messages a second (60)")->check(finite_in(1.0, 1000.0));
    app.add_option("--cigi", options.cigi, "protocol version, 3.3 or 4.0 (3.3)")
        ->check(CLI::IsMember({"3.3", "4.0"}))
        ->type_name("VERSION");
    app.add_option("--order", order, "byte order, little or big (little)")
        ->check(CLI::IsMember({"little", "big"}))
        ->type_name("ORDER");
    app.add_option("--to", options.to, "where the daemon listens (127.0.0.1:8004)")
        ->type_name("ADDRESS:PORT");
    app.add_option("--listen", options.listen, "where its answers come (127.0.0.1:8005)")
        ->type_name("ADDRESS:PORT");
    app.add_option("--start-s", options.start_s, "begin at this second of the flight (its first)")
        ->check(finite_in(-1e9, 1e9));
    app.add_option("--duration", options.duration_s, "fly for so many seconds (to the end)")
        ->check(finite_in(0.0, 1e6));
    CLI::Option* yaw = app.add_option("--view-yaw", options.view_yaw_deg, "turn a view to the right, degrees")
                           ->check(finite_in(-180.0, 180.0));
    app.add_option("--view-id", options.view_id, "which view --view-yaw turns (1)")
        ->check(CLI::Range(0, 65535))
        ->needs(yaw);
    app.add_option("--visibility-m", options.visibility_m, "visibility at the ground, metres")
        ->check(finite_in(0.0, 1e6));
    app.add_option("--wait", options.wait_s, "seconds to wait for the first answer (10)")
        ->check(finite_in(0.1, 3600.0));
    app.add_flag("--json", options.json, "tell the results as JSON");
}

void add_shot(CLI::App& app, ShotOptions& options) {
    CLI::Option* config = app.add_option("--config", options.config_path,
                                         "settings to start from (TOML); all their channels are drawn")
                              ->type_name("FILE");
    app.add_option("--lat", options.latitude_deg, "latitude, degrees north")->check(finite_in(-90.0, 90.0));
    app.add_option("--lon", options.longitude_deg, "longitude, degrees east")
        ->check(finite_in(-360.0, 360.0));
    app.add_option("--alt", options.height_m, "height above the WGS84 ellipsoid, metres")
        ->check(finite_in(-430.0, 1e8));
    app.add_option("--utc", options.utc, "UTC, as 2026-06-21T19:30:00Z")
        ->check(utc_time())
        ->type_name("TIME");
    app.add_option("--heading", options.heading_deg, "degrees from true north")
        ->check(finite_in(-360.0, 360.0));
    app.add_option("--pitch", options.pitch_deg, "degrees nose up")->check(finite_in(-90.0, 90.0));
    app.add_option("--roll", options.roll_deg, "degrees right wing down")->check(finite_in(-180.0, 180.0));
    app.add_option("--visibility-m", options.visibility_m, "visibility at the ground, metres")
        ->check(finite_in(10.0, 400'000.0));
    app.add_option("--width", options.width_px, "pixels across (1280)")
        ->check(CLI::Range(1, 16384))
        ->excludes(config);
    app.add_option("--height", options.height_px, "pixels down (1024)")
        ->check(CLI::Range(1, 16384))
        ->excludes(config);
    app.add_option("--fov", options.fov_deg, "degrees across (60)")
        ->check(finite_in(0.1, 170.0))
        ->excludes(config);
    app.add_option("-o,--out", options.out_path,
                   "the PNG to write; with --config and several channels NAME_channel.png")
        ->required()
        ->type_name("FILE");
    app.add_flag("--json", options.json, "tell the results as JSON");
}

void add_bench(CLI::App& app, BenchOptions& options) {
    CLI::Option_group* what = app.add_option_group("what to do", "one of these");
    CLI::Option* family =
        what->add_option("family", options.family, "measure every model of this family")->type_name("FAMILY");
    what->add_flag("--list", options.list, "tell the families");
    what->add_option("--render", options.render_folder,
                     "turn the folder's JSON files into pages and plots beside them")
        ->type_name("DIR");
    what->require_option(1);
    app.add_option("--truth", options.truth_folder,
                   "truth tables, one folder a topic (tests/data of the directory it is run in)")
        ->type_name("DIR");
    app.add_option("--rounds", options.rounds, "rounds of timing (101)")->check(CLI::Range(1, 100'000));
    app.add_option("--instructions", options.instructions_path,
                   "counted instructions to tell beside the times: family,model,cost,instructions a line")
        ->type_name("FILE");
    app.add_option("--counted-calls", options.counted_calls,
                   "measure nothing; call each work so often inside skyig_bench_counted_calls, which "
                   "callgrind can count, and tell them in order")
        ->check(CLI::Range(1, 1'000'000))
        ->needs(family);
    app.add_flag("--json", options.json, "tell the results as JSON");
}

/// The first word that is no option, when it is no verb either.
const char* unknown_verb(int argc, const char* const* argv) {
    if (argc < 2 || argv[1][0] == '-') return nullptr;
    const bool known = std::find(kVerbs.begin(), kVerbs.end(), std::string_view(argv[1])) != kVerbs.end();
    return known ? nullptr : argv[1];
}

}  // namespace

Invocation read_command_line(int argc, const char* const* argv) {
    Invocation invocation;
    if (const char* word = unknown_verb(argc, argv)) {
        invocation.exit_status = 2;
        invocation.error =
            fmt::format("skyig: there is no verb '{}'; did you mean '{}'? (skyig --help tells them)\n", word,
                        nearest_verb(word));
        return invocation;
    }
    CLI::App app("skyig: tools around the skyigd sky server.", "skyig");
    app.set_version_flag("--version", std::string("skyig " SKYIG_VERSION));
    app.require_subcommand(1);
    app.footer(
        "Exit status: 0 done, 1 the work failed, 2 wrong usage. skyig VERB --help tells a verb's options.");
    HostOptions host;
    ShotOptions shot;
    BenchOptions bench;
    std::string order = "little";
    CLI::App* host_verb =
        app.add_subcommand("host", "fly a recorded flight at a daemon and tell what it answers");
    CLI::App* shot_verb = app.add_subcommand("shot", "draw one still without a network");
    CLI::App* bench_verb = app.add_subcommand("bench", "measure error and cost of every model of a family");
    add_host(*host_verb, host, order);
    add_shot(*shot_verb, shot);
    add_bench(*bench_verb, bench);
    try {
        app.parse(argc, argv);
        host.big_endian = order == "big";
        if (host_verb->parsed()) invocation.options = host;
        if (shot_verb->parsed()) invocation.options = shot;
        if (bench_verb->parsed()) invocation.options = bench;
    } catch (const CLI::CallForHelp&) {
        const std::vector<CLI::App*> asked = app.get_subcommands();
        invocation.output = (asked.empty() ? &app : asked.front())->help();
    } catch (const CLI::CallForVersion& version) {
        invocation.output = fmt::format("{}\n", version.what());
    } catch (const CLI::ParseError& error) {
        invocation.exit_status = 2;
        invocation.error = fmt::format("skyig: {} (skyig --help tells the verbs)\n", error.what());
    }
    return invocation;
}

}  // namespace skyig::clients
