#include "clients/bench/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace skyig::clients::bench {

const ErrorEntry* find_error(const ModelEntry& model, std::string_view quantity,
                             std::string_view cases) noexcept {
    const auto found = std::find_if(model.errors.begin(), model.errors.end(), [&](const ErrorEntry& entry) {
        return entry.quantity == quantity && entry.cases == cases;
    });
    return found == model.errors.end() ? nullptr : &*found;
}

const CostEntry* find_cost(const ModelEntry& model, std::string_view name) noexcept {
    const auto found = std::find_if(model.costs.begin(), model.costs.end(),
                                    [&](const CostEntry& entry) { return entry.name == name; });
    return found == model.costs.end() ? nullptr : &*found;
}

std::string short_number(double value) {
    const std::string shortest = fmt::format("{:.4g}", value);
    if (std::abs(value) < 1e4 || std::abs(value) >= 1e9) return shortest;
    return fmt::format("{:.0f}", std::stod(shortest));
}

std::string to_text(const Report& report) {
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "{}: {}\ncases  {}\ntruth  {}\nfloor  {}: {} ns\n", report.family, report.title,
                   report.cases, report.truth, report.floor, short_number(report.floor_ns.median));
    fmt::format_to(out, "on     {}, {} rounds\n", report.machine, report.rounds);
    fmt::format_to(out, "\n{:<15} {:<15} {:<26} {:>10} {:>10} {:>10} {:>6}  unit\n", "model", "quantity",
                   "cases", "max", "rms", "p95", "count");
    for (const ModelEntry& model : report.models) {
        for (const ErrorEntry& error : model.errors) {
            fmt::format_to(out, "{:<15} {:<15} {:<26} {:>10} {:>10} {:>10} {:>6}  {}\n", model.name,
                           error.quantity, error.cases, short_number(error.figures.max),
                           short_number(error.figures.rms), short_number(error.figures.p95),
                           error.figures.count, error.unit);
        }
    }
    fmt::format_to(out, "\n{:<15} {:<15} {:>10} {:>10} {:>10} {:>10} {:>12}\n", "model", "cost", "ns", "p25",
                   "p75", "floors", "instructions");
    for (const ModelEntry& model : report.models) {
        for (const CostEntry& cost : model.costs) {
            fmt::format_to(out, "{:<15} {:<15} {:>10} {:>10} {:>10} {:>10} {:>12}\n", model.name, cost.name,
                           short_number(cost.ns.median), short_number(cost.ns.p25), short_number(cost.ns.p75),
                           short_number(cost.floors.median),
                           cost.instructions ? fmt::format("{:.0f}", *cost.instructions) : "-");
        }
    }
    for (const ModelEntry& model : report.models) {
        for (const SizeEntry& size : model.sizes)
            fmt::format_to(out, "{:<15} memory, {}: {} bytes\n", model.name, size.name, size.bytes);
    }
    return text;
}

}  // namespace skyig::clients::bench
