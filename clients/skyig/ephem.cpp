#include "clients/skyig/ephem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "clients/body_name.h"
#include "clients/skyig/ephem/almanac.h"
#include "clients/skyig/ephem/batch.h"
#include "clients/skyig/ephem/report.h"
#include "clients/table_streams.h"
#include "render/sky/refraction.h"
#include "server/clock.h"

namespace skyig::clients {

using namespace server::ephemeris;

namespace {

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
    for (const std::string& name : options.bodies) {
        const Body body = *parse_body(name);
        if (std::find(bodies.begin(), bodies.end(), body) == bodies.end()) bodies.push_back(body);
    }
    if (bodies.empty()) bodies.assign(otherwise.begin(), otherwise.end());
    return bodies;
}

std::vector<ephem::NamedStar> stars_of(const EphemOptions& options) {
    std::vector<ephem::NamedStar> stars;
    for (const std::string& text : options.stars) {
        const ephem::NamedStar star = *ephem::parse_star(text);
        const auto same = [&star](const ephem::NamedStar& other) { return other.hr == star.hr; };
        if (std::none_of(stars.begin(), stars.end(), same)) stars.push_back(star);
    }
    return stars;
}

int report(const EphemOptions& options) {
    const ephem::ReportRequest request{.utc = utc_of(options),
                                       .site = site_of(options),
                                       .bodies = bodies_of(options, kBodies),
                                       .stars = stars_of(options),
                                       .model = model_of(options),
                                       .air = air_of(options)};
    if (make_instant(request.utc).clamped)
        throw std::runtime_error(fmt::format("the clock's {} is outside the years 1900..2100 that are known",
                                             to_iso(request.utc)));
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

ephem::BatchSettings batch_settings(const EphemOptions& options, const std::string& input_name) {
    ephem::BatchSettings settings;
    settings.input_name = input_name;
    settings.time_column = options.time_column;
    if (!options.bodies.empty()) settings.body = parse_body(options.bodies.front());
    settings.site = site_of(options);
    settings.model = model_of(options);
    settings.air = air_of(options);
    return settings;
}

int batch(const EphemOptions& options) {
    TableStreams streams(options.batch_path, options.out_path, "--out");
    const ephem::BatchCount count = ephem::run_batch(
        streams.input(), [&]() -> std::ostream& { return streams.open_output(); }, std::cerr,
        batch_settings(options, streams.input_name()));
    streams.finish();
    if (streams.to_file()) fmt::print("{}  {} rows, {} bad\n", options.out_path, count.rows, count.bad_rows);
    return count.bad_rows == 0 ? 0 : 1;
}

}  // namespace

int run_ephem(const EphemOptions& options) {
    try {
        if (!options.batch_path.empty()) return batch(options);
        return options.events.empty() ? report(options) : almanac(options);
    } catch (const WrongUsage& error) {
        fmt::print(stderr, "skyig ephem: {}\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig ephem: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
