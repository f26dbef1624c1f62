#include "clients/skyig/sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>

#include "clients/skyig/sky/model_solver.h"
#include "clients/skyig/sky/night_solver.h"
#include "clients/skyig/sky/truth_solver.h"
#include "clients/table_streams.h"
#include "server/ephemeris/sky_state.h"
#include "server/ephemeris/time.h"

namespace skyig::clients {

namespace {

std::unique_ptr<sky::Solver> night_solver(const SkyOptions& options, const sky::Atmosphere& atmosphere) {
    std::optional<sky::MoonPlace> moon;
    if (options.moon_phase_angle_deg)
        moon = {*options.moon_phase_angle_deg, *options.moon_elevation_deg,
                options.moon_rel_azimuth_deg.value_or(180.0)};
    std::optional<sky::RealSky> real;
    if (!options.utc.empty()) {
        namespace ephemeris = server::ephemeris;
        const ephemeris::SkyState state =
            ephemeris::compute_sky_state(ephemeris::make_instant(ephemeris::parse_utc(options.utc).value()),
                                         {options.latitude_deg, options.longitude_deg, 0.0});
        real = {state.enu_from_gcrs, state.sun.direction_enu, options.latitude_deg, options.longitude_deg};
    }
    return std::make_unique<sky::NightSolver>(atmosphere, moon, real);
}

std::unique_ptr<sky::Solver> solver_of(const SkyOptions& options, const sky::Atmosphere& atmosphere) {
    if (options.truth) return std::make_unique<sky::TruthSolver>(atmosphere.law);
    if (options.night) return night_solver(options, atmosphere);
    return std::make_unique<sky::ModelSolver>(atmosphere);
}

int solve(const SkyOptions& options) {
    sky::Atmosphere atmosphere = sky::load_atmosphere(options.atmosphere);
    if (!options.model.empty()) {
        const auto* const at =
            std::find(render::kSkyModelNames.begin(), render::kSkyModelNames.end(), options.model);
        atmosphere.sky.model = static_cast<render::SkyModel>(at - render::kSkyModelNames.begin());
    }
    TableStreams streams(options.cases_path, options.out_path, "--out");
    const std::unique_ptr<sky::Solver> solver = solver_of(options, atmosphere);
    const sky::CaseCount count = sky::run_cases(
        streams.input(), streams.input_name(), [&]() -> std::ostream& { return streams.open_output(); },
        std::cerr, *solver);
    streams.finish();
    if (streams.to_file()) {
        fmt::print("{}  {} rows, {} bad, {} tables of {}\n", options.out_path, count.rows, count.bad_rows,
                   count.tables, options.truth ? "the truth" : render::name_of(atmosphere.sky.model));
    }
    return count.bad_rows == 0 ? 0 : 1;
}

}  // namespace

int run_sky(const SkyOptions& options) {
    try {
        return solve(options);
    } catch (const sky::AtmosphereErrors& errors) {
        for (const std::string& line : errors.lines)
            fmt::print(stderr, "{}\n", line);
        return 2;
    } catch (const WrongUsage& error) {
        fmt::print(stderr, "skyig sky: {}\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig sky: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
