#include "clients/skyig/cloud.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "clients/skyig/cloud/cases.h"
#include "clients/table_streams.h"

namespace skyig::clients {

namespace {

namespace model = render::cloud;

model::SlabModel model_of(const std::string& name) {
    const auto* const at = std::find(model::kSlabModelNames.begin(), model::kSlabModelNames.end(), name);
    return static_cast<model::SlabModel>(at - model::kSlabModelNames.begin());
}

int tell_one(const CloudOptions& options) {
    const cloud::Case slab_case{{options.optical_depth.value_or(0.0), options.g, options.albedo},
                                options.sun_zenith_deg,
                                options.view_zenith_deg,
                                options.rel_azimuth_deg};
    nlohmann::ordered_json facts{{"model", options.model}};
    for (std::size_t i = 0; i < cloud::kQuantityNames.size(); ++i) {
        const double value = cloud::value_of(model_of(options.model), slab_case, cloud::Quantity{i});
        facts[std::string(cloud::kQuantityNames[i])] = value;
        if (!options.json) fmt::print("{:<15} {:.5g}\n", cloud::kQuantityNames[i], value);
    }
    if (options.json) fmt::print("{}\n", facts.dump(2));
    return 0;
}

int fill(const CloudOptions& options) {
    TableStreams streams(options.cases_path, options.out_path, "--out");
    const cloud::CaseCount count = cloud::run_cases(
        streams.input(), streams.input_name(), [&]() -> std::ostream& { return streams.open_output(); },
        std::cerr, model_of(options.model));
    streams.finish();
    if (streams.to_file())
        fmt::print("{}  {} rows, {} bad, of {}\n", options.out_path, count.rows, count.bad_rows,
                   options.model);
    return count.bad_rows == 0 ? 0 : 1;
}

}  // namespace

int run_cloud(const CloudOptions& options) {
    try {
        return options.cases_path.empty() ? tell_one(options) : fill(options);
    } catch (const WrongUsage& error) {
        fmt::print(stderr, "skyig cloud: {}\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig cloud: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
