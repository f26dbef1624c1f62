#include "clients/skyig/sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>

#include "clients/skyig/sky/model_solver.h"
#include "clients/skyig/sky/truth_solver.h"
#include "clients/table_streams.h"

namespace skyig::clients {

namespace {

int solve(const SkyOptions& options) {
    sky::Atmosphere atmosphere = sky::load_atmosphere(options.atmosphere);
    if (!options.model.empty()) {
        const auto* const at =
            std::find(render::kSkyModelNames.begin(), render::kSkyModelNames.end(), options.model);
        atmosphere.sky.model = static_cast<render::SkyModel>(at - render::kSkyModelNames.begin());
    }
    TableStreams streams(options.cases_path, options.out_path, "--out");
    const auto solver = options.truth ? std::unique_ptr<sky::Solver>(new sky::TruthSolver(atmosphere.law))
                                      : std::make_unique<sky::ModelSolver>(atmosphere);
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
