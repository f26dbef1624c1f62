#include "clients/skyig/ephem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "clients/skyig/ephem/almanac.h"
#include "clients/skyig/ephem/batch.h"
#include "clients/skyig/ephem/body_name.h"
#include "clients/skyig/ephem/report.h"
#include "render/sky/refraction.h"
#include "server/clock.h"

namespace skyig::clients {

using namespace server::ephemeris;

namespace {

constexpr std::string_view kStandardStream = "-";

std::optional<Geodetic> site_of(const EphemOptions& options) {
    if (!options.latitude_deg || !options.longitude_deg) return std::nullopt;
    return Geodetic{*options.latitude_deg, *options.longitude_deg, options.height_m};
}

Model model_of(const EphemOptions& options) {
    const auto* const name = std::find(kModelNames.begin(), kModelNames.end(), options.model);
    return static_cast<Model>(name - kModelNames.begin());
}

ephem::AirSettings air_of(const EphemOptions& options) {
    return {options.pressure_hpa, options.temperature_c};
}

UtcClockTime utc_of(const EphemOptions& options) {
    if (const auto asked = parse_utc(options.utc)) return *asked;
    constexpr std::int64_t kNanoseconds = 1'000'000'000;
    const std::int64_t now_ns = server::SystemClock().utc_ns();
    return UtcClockTime::from_unix(now_ns / kNanoseconds, static_cast<std::int32_t>(now_ns % kNanoseconds));
}

template <std::size_t count>
std::vector<Body> bodies_of(const EphemOptions& options, const std::array<Body, count>& otherwise) {
    std::vector<Body> bodies;
    for (const std::string& name : options.bodies)
        bodies.push_back(*ephem::parse_body(name));
    if (bodies.empty()) bodies.assign(otherwise.begin(), otherwise.end());
    return bodies;
}

int report(const EphemOptions& options) {
    ephem::ReportRequest request{.utc = utc_of(options),
                                 .site = site_of(options),
                                 .bodies = bodies_of(options, kBodies),
                                 .stars = {},
                                 .model = model_of(options),
                                 .air = air_of(options)};
    for (const std::string& star : options.stars)
        request.stars.push_back(*ephem::parse_star(star));
    if (make_instant(request.utc).clamped)
        throw std::runtime_error(
            fmt::format("--utc: {} is outside the years 1900..2100 that are known", to_iso(request.utc)));
    const ephem::Report made = ephem::make_report(request);
    fmt::print("{}", options.json ? to_json(made) : to_text(made));
    return 0;
}

int almanac(const EphemOptions& options) {
    ephem::AlmanacRequest request{.span = *ephem::parse_span(options.events),
                                  .site = site_of(options),
                                  .bodies = bodies_of(options, std::array{Body::kSun, Body::kMoon}),
                                  .model = model_of(options)};
    if (options.eye_horizon) {
        request.horizon_rad = render::sky::Refraction()
                                  .at(options.height_m, options.pressure_hpa, options.temperature_c)
                                  .setting_elevation_rad();
    }
    const ephem::Almanac made = ephem::make_almanac(request);
    fmt::print("{}", options.json ? to_json(made) : to_text(made));
    return 0;
}

ephem::BatchSettings batch_settings(const EphemOptions& options) {
    if (options.bodies.size() > 1)
        throw std::runtime_error("--body: a table takes one body (or none, and a column 'body')");
    ephem::BatchSettings settings;
    settings.input_name = options.batch_path == kStandardStream ? "standard input" : options.batch_path;
    settings.time_column = options.time_column;
    if (!options.bodies.empty()) settings.body = ephem::parse_body(options.bodies.front());
    settings.site = site_of(options);
    settings.model = model_of(options);
    settings.air = air_of(options);
    return settings;
}

void require_two_files(const EphemOptions& options) {
    std::error_code none;
    if (std::filesystem::equivalent(options.batch_path, options.out_path, none))
        throw std::runtime_error("--out is the table that is read; name another file");
}

int batch(const EphemOptions& options) {
    const ephem::BatchSettings settings = batch_settings(options);
    std::ifstream input_file;
    if (options.batch_path != kStandardStream) {
        input_file.open(options.batch_path);
        if (!input_file || std::filesystem::is_directory(options.batch_path))
            throw std::runtime_error(fmt::format("{}: cannot be read", options.batch_path));
    }
    std::ofstream output_file;
    const bool to_file = !options.out_path.empty() && options.out_path != kStandardStream;
    if (to_file) {
        require_two_files(options);
        output_file.open(options.out_path, std::ios::binary);
        if (!output_file) throw std::runtime_error(fmt::format("{}: cannot be written", options.out_path));
    }
    std::istream& input = input_file.is_open() ? static_cast<std::istream&>(input_file) : std::cin;
    std::ostream& output = to_file ? static_cast<std::ostream&>(output_file) : std::cout;
    const ephem::BatchCount count = ephem::run_batch(input, output, std::cerr, settings);
    output.flush();
    if (!output)
        throw std::runtime_error(
            fmt::format("{}: cannot be written", to_file ? options.out_path : "standard output"));
    if (to_file) fmt::print("{}  {} rows, {} bad\n", options.out_path, count.rows, count.bad_rows);
    return count.bad_rows == 0 ? 0 : 1;
}

}  // namespace

int run_ephem(const EphemOptions& options) {
    try {
        if (!options.batch_path.empty()) return batch(options);
        return options.events.empty() ? report(options) : almanac(options);
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig ephem: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
