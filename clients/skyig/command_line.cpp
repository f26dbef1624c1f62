#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <CLI/CLI.hpp>
#include <cmath>
#include <string_view>
#include <vector>

#include "clients/body_name.h"
#include "clients/skyig/cloud_command.h"
#include "clients/skyig/decode_command.h"
#include "clients/skyig/ephem/almanac.h"
#include "clients/skyig/ephem/star_name.h"
#include "clients/skyig/instructor_command.h"
#include "clients/skyig/latency/latency_command.h"
#include "clients/skyig/metar_command.h"
#include "clients/skyig/options.h"
#include "clients/skyig/rvr_command.h"
#include "clients/skyig/sky_command.h"
#include "clients/skyig/still/still_command.h"
#include "clients/skyig/tone_command.h"
#include "clients/skyig/validators.h"
#include "protocol/transport/endpoint.h"
#include "render/output/light_file.h"
#include "render/sky_settings.h"
#include "server/ephemeris/time.h"

namespace skyig::clients {

namespace {

constexpr std::array<std::string_view, 18> kVerbs{
    "host",  "latency", "shot",   "plan", "channels", "bench", "ephem", "cloud", "decode",
    "metar", "replay",  "record", "sky",  "status",   "top",   "tone",  "rvr",   "instructor"};

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
    add_still(app, options.still);
    app.add_option("-o,--out", options.out_path,
                   "the PNG to write; with --config and several channels NAME_channel.png")
        ->required()
        ->type_name("FILE");
    app.add_option("--luminance", options.luminance_path,
                   "an EXR or PFM to write beside it: each pixel's light, linear Rec.709 in cd/m2, all stars "
                   "and the discs included, without an eye and its limits")
        ->check([](const std::string& path) {
            return render::output::names_light_file(path)
                       ? std::string()
                       : fmt::format("'{}': light is written as .exr or .pfm", path);
        })
        ->type_name("FILE");
    app.add_flag("--json", options.json, "tell the results as JSON");
}

void add_plan(CLI::App& app, PlanOptions& options) {
    add_still(app, options.still);
    app.add_flag("--json", options.json, "tell the plan as JSON");
}

void add_channels(CLI::App& app, ChannelsOptions& options) {
    app.add_option("--config", options.config_path, "settings of the site")->required()->type_name("FILE");
    app.add_flag("--json", options.json, "tell it as JSON");
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

CLI::Validator known_utc() {
    const auto check = [](std::string& text) -> std::string {
        const auto utc = server::ephemeris::parse_utc(text);
        if (utc && server::ephemeris::make_instant(*utc).clamped)
            return fmt::format("'{}' is outside the years 1900..2100 that are known", text);
        return check_utc(text);
    };
    return {check, "UTC"};
}

CLI::Validator not_empty() {
    return {[](std::string& text) { return text.empty() ? std::string("a name is missing") : std::string(); },
            "NAME"};
}

CLI::Validator known_body() {
    const auto check = [](std::string& text) -> std::string {
        if (parse_body(text)) return {};
        return fmt::format("'{}' is none of {}", text, body_list());
    };
    return {check, "BODY"};
}

CLI::Validator known_star() {
    const auto check = [](std::string& text) -> std::string {
        if (ephem::parse_star(text)) return {};
        return fmt::format("'{}' is no star here; write a name as Sirius or a number of the Yale catalogue",
                           text);
    };
    return {check, "STAR"};
}

CLI::Validator known_span() {
    const auto check = [](std::string& text) -> std::string {
        if (ephem::parse_span(text)) return {};
        return fmt::format("'{}' is no span within 1900..2100; write it as 2026-06-01..2026-06-30", text);
    };
    return {check, "DATE..DATE"};
}

constexpr const char* kEphemFooter =
    R"(Tables (--batch) need a column of time: utc or date_ut (UTC, before 1971 UT1), jd_tt (Julian date in TT;
seen from the Earth's centre) or td_iso (TT). Of several the first in this order is read and the others are
not, also in rows that leave it empty (those are bad); --time-column names another. Columns body, lat_deg,
lon_deg and h_m say what is seen from where, and where they are --body, --lat, --lon and --alt are not used:
without body it is --body (one) or the Moon, without a place --lat --lon --alt or the Earth's centre, without
h_m height 0. An empty field in one of them makes a bad row. tt_minus_utc_s (tt_minus_ut_s), ut1_minus_utc_s
(ut1_minus_ut_s) and, with td_iso, delta_t_s (catalog_delta_t_s) come before the built-in tables, which hold
where they are empty. Headings may be in capitals, lines with # are left out. Every row keeps
its columns and gets skyig_*: right ascension and declination are apparent, of the true equator and equinox of
date; elevations airless and refracted; the bright limb counts from the north of date through east; the
Moon's sub-Earth and sub-solar points are for the eye (or the Earth's centre); its axis angle counts from the
north of J2000. A bad row is told on stderr, its new columns stay empty, and the exit status is 1.
Events: rise and set are of the upper limb with 34' of refraction, from height 0 (--horizon eye: behind the
horizon that the eye sees from its height, through the air); twilights of the Sun's centre at -6, -12, -18
degrees; contacts of eclipses to a second, for mean limbs.)";

void add_ephem(CLI::App& app, EphemOptions& options, std::string& horizon) {
    CLI::Option* utc = app.add_option("--utc", options.utc, "UTC, as 2026-06-21T19:30:00Z (now)")
                           ->check(known_utc())
                           ->type_name("TIME");
    CLI::Option* latitude = app.add_option("--lat", options.latitude_deg, "latitude, degrees north")
                                ->check(finite_in(-90.0, 90.0));
    CLI::Option* longitude = app.add_option("--lon", options.longitude_deg, "longitude, degrees east")
                                 ->check(finite_in(-360.0, 360.0));
    latitude->needs(longitude);
    longitude->needs(latitude);
    app.add_option("--alt", options.height_m, "height above the WGS84 ellipsoid, metres (0)")
        ->check(finite_in(-12'000.0, 1e8))
        ->needs(latitude);
    app.add_option("--model", options.model, "series, erfa or almanac (series)")
        ->check(CLI::IsMember({"series", "erfa", "almanac"}))
        ->type_name("MODEL");
    app.add_option("--body", options.bodies, "which bodies, as sun,moon (all; events: sun,moon)")
        ->delimiter(',')
        ->check(known_body());
    CLI::Option* star =
        app.add_option("--star", options.stars, "stars too, by name or number in the Yale catalogue")
            ->delimiter(',')
            ->check(known_star());
    app.add_option("--pressure-hpa", options.pressure_hpa, "of the air at height 0 (1013.25)")
        ->check(finite_in(0.0, 1200.0));
    app.add_option("--temperature-c", options.temperature_c, "of the air at height 0 (15)")
        ->check(finite_in(-100.0, 70.0));
    CLI::Option* batch =
        app.add_option("--batch", options.batch_path, "add columns to this table (CSV; - is standard input)")
            ->check(not_empty())
            ->type_name("IN.csv")
            ->excludes(utc)
            ->excludes(star);
    app.add_option("-o,--out", options.out_path, "where the table goes (standard output)")
        ->check(not_empty())
        ->type_name("OUT.csv")
        ->needs(batch);
    app.add_option("--time-column", options.time_column,
                   "the table's column of times: one of the usual, or of UTC")
        ->check(not_empty())
        ->type_name("NAME")
        ->needs(batch);
    CLI::Option* events =
        app.add_option("--events", options.events, "what happens on these days: 2026-06-01..2026-06-30")
            ->check(known_span())
            ->excludes(batch)
            ->excludes(utc)
            ->excludes(star);
    app.add_option("--horizon", horizon, "of rise and set, almanac or eye (almanac)")
        ->check(CLI::IsMember({"almanac", "eye"}))
        ->type_name("HORIZON")
        ->needs(events)
        ->needs(latitude);
    CLI::Option* json = app.add_flag("--json", options.json, "tell the results as JSON")->excludes(batch);
    app.add_flag("--text")
        ->description("tell the results as text (so it is)")
        ->excludes(json)
        ->excludes(batch);
    app.footer(kEphemFooter);
}

CLI::Validator ipv4() {
    const auto check = [](std::string& text) -> std::string {
        const auto read = protocol::transport::parse_ipv4(text);
        return read ? std::string() : read.error();
    };
    return {check, "ADDRESS"};
}

void add_replay(CLI::App& app, ReplayOptions& options) {
    app.add_option("file", options.path, "a capture (pcapng, pcap); - is standard input")
        ->required()
        ->type_name("FILE");
    app.add_option("--to", options.to, "where its datagrams go (127.0.0.1:8004)")->check(endpoint(false));
    app.add_option("--port", options.ports, "only datagrams that went to these ports (all)")
        ->check(CLI::Range(1, 65535))
        ->type_name("PORT");
    CLI::Option* speed =
        app.add_option("--speed", options.speed, "times the recorded pace; 0 is as fast as it goes (1)")
            ->check(finite_in(0.0, 1000.0));
    app.add_flag(
           "--step", options.step,
           "each line of standard input sends the next: a frame of a daemon's recording, else a datagram")
        ->excludes(speed);
    app.add_flag("--json", options.json, "tell the results as JSON");
    app.footer(
        "CAN frames and a daemon's frame marks are left out. Each sender keeps a port of its own, not its "
        "number.");
}

void add_record(CLI::App& app, RecordOptions& options) {
    CLI::Option_group* what = app.add_option_group("what to record", "one at least");
    what->add_option("--listen", options.listen, "UDP ports to record, as 8004 or 0.0.0.0:8004")
        ->transform(endpoint(true));
    what->add_option("--can", options.can, "CAN interfaces to record, as can0")->type_name("INTERFACE");
    what->require_option(1, 2);
    app.add_option("--from", options.from, "who may send (127.0.0.1)")->check(ipv4());
    app.add_option("-o,--out", options.out_path, "the pcapng file to write")->required()->type_name("FILE");
    app.add_option("--duration", options.duration_s, "seconds to record (until Ctrl-C)")
        ->check(finite_in(0.0, 1e6));
    app.add_flag("--json", options.json, "tell the results as JSON");
}

void add_status(CLI::App& app, StatusOptions& options) {
    CLI::Option* url =
        app.add_option("--url", options.url, "where the daemon tells of itself (http://127.0.0.1:8006)")
            ->check(daemon_url());
    app.add_option_function<int>(
           "--port", [&options](int port) { options.url = fmt::format("http://127.0.0.1:{}", port); },
           "the same on this machine (8006)")
        ->check(CLI::Range(1, 65535))
        ->type_name("PORT")
        ->excludes(url);
    app.add_flag("--json", options.json, "tell it as JSON, in a watch one line each time");
    app.add_flag("--rig", options.rig,
                 "only its rig of several machines: every node, its channels and frame");
}

/// The first word that is no option, when it is no verb either.
const char* unknown_verb(int argc, const char* const* argv) {
    if (argc < 2 || argv[1][0] == '-') return nullptr;
    const bool known = std::find(kVerbs.begin(), kVerbs.end(), std::string_view(argv[1])) != kVerbs.end();
    return known ? nullptr : argv[1];
}

/// The options of every verb; one verb's are given.
struct Verbs {
    HostOptions host;
    ShotOptions shot;
    PlanOptions plan;
    ChannelsOptions channels;
    BenchOptions bench;
    EphemOptions ephem;
    CloudOptions cloud;
    DecodeOptions decode;
    MetarOptions metar;
    ReplayOptions replay;
    RecordOptions record;
    StatusOptions status;
    StatusOptions top;
    SkyOptions sky;
    ToneOptions tone;
    RvrOptions rvr;
    LatencyOptions latency;
    InstructorOptions instructor;
    std::string order = "little";
    std::string horizon = "almanac";
};

void add_verbs(CLI::App& app, Verbs& verbs) {
    add_host(*app.add_subcommand("host", "fly a recorded flight at a daemon and tell what it answers"),
             verbs.host, verbs.order);
    add_shot(*app.add_subcommand("shot", "draw one still without a network"), verbs.shot);
    add_plan(*app.add_subcommand("plan", "which passes a scene needs, how fine, and why"), verbs.plan);
    add_channels(*app.add_subcommand("channels", "what a site's channels cover, overlap and leave out"),
                 verbs.channels);
    add_bench(*app.add_subcommand("bench", "measure error and cost of every model of a family"), verbs.bench);
    add_ephem(
        *app.add_subcommand("ephem", "where Sun, Moon, planets and stars stand, and when things happen"),
        verbs.ephem, verbs.horizon);
    add_cloud(app, verbs.cloud);
    add_decode(app, verbs.decode);
    add_metar(app, verbs.metar);
    add_replay(*app.add_subcommand("replay", "send the datagrams of a capture onto the network again"),
               verbs.replay);
    add_record(*app.add_subcommand("record", "write down what comes to UDP ports and over CAN buses"),
               verbs.record);
    CLI::App& status = *app.add_subcommand("status", "how a running daemon goes: frames, sources, counters");
    add_status(status, verbs.status);
    status.add_option("--watch", verbs.status.watch_s, "again every so many seconds (until Ctrl-C)")
        ->check(finite_in(0.1, 3600.0));
    CLI::App& top = *app.add_subcommand("top", "the same on the whole screen, again every second");
    add_status(top, verbs.top);
    verbs.top.watch_s = 1.0;
    verbs.top.clear_screen = true;
    top.add_option("--every", verbs.top.watch_s, "seconds from one page to the next (1)")
        ->check(finite_in(0.1, 3600.0));
    add_sky(*app.add_subcommand("sky", "luminance and colour of the sky for a table of directions"),
            verbs.sky);
    add_tone(app, verbs.tone);
    add_rvr(app, verbs.rvr);
    add_latency(app, verbs.latency);
    add_instructor(app, verbs.instructor);
}

void require_one_body(const EphemOptions& options) {
    if (!options.batch_path.empty() && options.bodies.size() > 1)
        throw CLI::ValidationError("--body", "a table takes one body (or none, and a column 'body')");
}

void take_verb(const CLI::App& app, Verbs& verbs, Invocation& invocation) {
    verbs.host.big_endian = verbs.order == "big";
    require_one_body(verbs.ephem);
    verbs.ephem.eye_horizon = verbs.horizon == "eye";
    if (app.got_subcommand("host")) invocation.options = verbs.host;
    if (app.got_subcommand("shot")) invocation.options = verbs.shot;
    if (app.got_subcommand("plan")) invocation.options = verbs.plan;
    if (app.got_subcommand("channels")) invocation.options = verbs.channels;
    if (app.got_subcommand("bench")) invocation.options = verbs.bench;
    if (app.got_subcommand("ephem")) invocation.options = verbs.ephem;
    if (app.got_subcommand("cloud")) invocation.options = verbs.cloud;
    if (app.got_subcommand("decode")) invocation.options = verbs.decode;
    if (app.got_subcommand("metar")) invocation.options = verbs.metar;
    if (app.got_subcommand("replay")) invocation.options = verbs.replay;
    if (app.got_subcommand("record")) invocation.options = verbs.record;
    if (app.got_subcommand("status")) invocation.options = verbs.status;
    if (app.got_subcommand("top")) invocation.options = verbs.top;
    if (app.got_subcommand("sky")) invocation.options = verbs.sky;
    if (app.got_subcommand("tone")) invocation.options = verbs.tone;
    if (app.got_subcommand("rvr")) invocation.options = verbs.rvr;
    if (app.got_subcommand("latency")) invocation.options = verbs.latency;
    if (app.got_subcommand("instructor")) {
        check_instructor(verbs.instructor);
        invocation.options = verbs.instructor;
    }
}

std::string usage_error(const char* what, const char* verb) {
    const std::string_view known =
        std::find(kVerbs.begin(), kVerbs.end(), std::string_view(verb)) != kVerbs.end() ? verb : "";
    return known.empty() ? fmt::format("skyig: {} (skyig --help tells the verbs)\n", what)
                         : fmt::format("skyig {0}: {1} (skyig {0} --help tells the options)\n", known, what);
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
    Verbs verbs;
    add_verbs(app, verbs);
    try {
        app.parse(argc, argv);
        take_verb(app, verbs, invocation);
    } catch (const CLI::CallForHelp&) {
        const std::vector<CLI::App*> asked = app.get_subcommands();
        invocation.output = (asked.empty() ? &app : asked.front())->help();
    } catch (const CLI::CallForVersion& version) {
        invocation.output = fmt::format("{}\n", version.what());
    } catch (const CLI::ParseError& error) {
        invocation.exit_status = 2;
        invocation.error = usage_error(error.what(), argc > 1 ? argv[1] : "");
    }
    return invocation;
}

}  // namespace skyig::clients
