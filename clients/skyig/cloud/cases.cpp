#include "clients/skyig/cloud/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "clients/csv.h"
#include "clients/letters.h"

namespace skyig::clients::cloud {
namespace {

namespace model = render::cloud;

using Columns = std::array<std::size_t, kCaseColumns.size()>;

enum Column : std::size_t { kDepth, kG, kAlbedo, kSun, kQuantity, kView, kAzimuth };

struct RowProblem {
    std::string_view column;
    std::string text;
};

Columns read_heading(const CsvRecord& heading) {
    if (heading.too_long || !heading.well_formed)
        throw std::runtime_error("the heading is too long, or a quote in it is not closed");
    const auto find = [&](std::string_view wanted) {
        return std::find_if(heading.fields.begin(), heading.fields.end(),
                            [&](const std::string& name) { return same_letters(name, wanted); });
    };
    if (find(kValueColumn) != heading.fields.end())
        throw std::runtime_error(fmt::format("column '{}' is there already", kValueColumn));
    Columns columns{};
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const auto at = find(kCaseColumns[i]);
        if (at == heading.fields.end()) {
            throw std::runtime_error(fmt::format("no column '{}': a table of cases has {}", kCaseColumns[i],
                                                 fmt::join(kCaseColumns, ", ")));
        }
        columns[i] = static_cast<std::size_t>(at - heading.fields.begin());
    }
    return columns;
}

/// Throws RowProblem.
double number(const CsvRecord& record, const Columns& columns, Column column, double least, double most) {
    const std::string& text = record.fields[columns[column]];
    const std::optional<double> value = parse_number(text);
    if (!value || *value < least || *value > most) {
        throw RowProblem{kCaseColumns[column],
                         fmt::format("'{}' is not a number in [{:.9g}, {:.9g}]", text, least, most)};
    }
    return *value;
}

/// Throws RowProblem.
double solve(const CsvRecord& record, const Columns& columns, model::SlabModel slab_model) {
    const std::string& name = record.fields[columns[kQuantity]];
    const auto* const found = std::find_if(kQuantityNames.begin(), kQuantityNames.end(),
                                           [&](std::string_view known) { return same_letters(known, name); });
    if (found == kQuantityNames.end()) {
        throw RowProblem{kCaseColumns[kQuantity],
                         fmt::format("'{}' is none of {}", name, fmt::join(kQuantityNames, ", "))};
    }
    const auto quantity = static_cast<Quantity>(found - kQuantityNames.begin());
    const bool directed = quantity == Quantity::kReflectedBrf || quantity == Quantity::kTransmittedBrf;
    Case slab_case;
    slab_case.slab = {number(record, columns, kDepth, 0.0, 1e6), number(record, columns, kG, 0.0, 0.95),
                      number(record, columns, kAlbedo, 0.0, 1.0)};
    if (!directed && same_letters(record.fields[columns[kSun]], "diffuse")) {
        slab_case.sun_zenith_deg.reset();
    } else {
        slab_case.sun_zenith_deg = number(record, columns, kSun, 0.0, 90.0);
    }
    if (directed) {
        slab_case.view_zenith_deg = number(record, columns, kView, 0.0, 90.0);
        slab_case.rel_azimuth_deg = number(record, columns, kAzimuth, -1e6, 1e6);
    }
    return value_of(slab_model, slab_case, quantity);
}

}  // namespace

double value_of(model::SlabModel slab_model, const Case& slab_case, Quantity quantity) {
    constexpr double kDegree = std::numbers::pi / 180.0;
    const double sun = slab_case.sun_zenith_deg.value_or(0.0) * kDegree;
    if (quantity == Quantity::kReflectedBrf || quantity == Quantity::kTransmittedBrf) {
        const bool above = quantity == Quantity::kReflectedBrf;
        const double view = slab_case.view_zenith_deg * kDegree;
        const double scatter =
            std::sin(sun) * std::sin(view) * std::cos(slab_case.rel_azimuth_deg * kDegree) +
            (above ? -1.0 : 1.0) * std::cos(sun) * std::cos(view);
        return model::slab_brf(slab_model, slab_case.slab, above, std::cos(sun), std::cos(view), scatter);
    }
    const model::SlabFluxes<double> fluxes = slab_case.sun_zenith_deg
                                                 ? model::slab_fluxes(slab_case.slab, std::cos(sun))
                                                 : model::slab_fluxes_diffuse(slab_case.slab);
    if (quantity == Quantity::kReflected) return fluxes.reflected;
    return quantity == Quantity::kDirect ? fluxes.direct : fluxes.transmitted - fluxes.direct;
}

CaseCount run_cases(std::istream& input, const std::string& input_name, const OpenOutput& open_output,
                    std::ostream& errors, model::SlabModel slab_model) {
    CsvReader reader(input);
    const auto require_readable = [&] {
        if (reader.failed())
            throw std::runtime_error(fmt::format("{}:{}: cannot be read", input_name, reader.line() + 1));
    };
    const std::optional<CsvRecord> heading = reader.next();
    require_readable();
    if (!heading) throw std::runtime_error(input_name + ": no heading line");
    Columns columns{};
    try {
        columns = read_heading(*heading);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}:{}: {}", input_name, heading->line, error.what()));
    }
    std::ostream& output = open_output();
    output << heading->text << ',' << kValueColumn << heading->line_end;
    CaseCount count;
    while (const std::optional<CsvRecord> record = reader.next()) {
        ++count.rows;
        std::string added = ",";
        bool whole = true;
        try {
            whole =
                !record->too_long && record->well_formed && record->fields.size() == heading->fields.size();
            if (!whole)
                throw RowProblem{
                    "", fmt::format("not a whole row: the heading has {} fields", heading->fields.size())};
            added = fmt::format(",{:.7g}", solve(*record, columns, slab_model));
        } catch (const RowProblem& problem) {
            ++count.bad_rows;
            const std::string column = problem.column.empty() ? "" : fmt::format("{}: ", problem.column);
            errors << fmt::format("{}:{}: {}{}\n", input_name, record->line, column, problem.text);
        }
        if (whole) output << record->text << added << record->line_end;
    }
    require_readable();
    return count;
}

}  // namespace skyig::clients::cloud
