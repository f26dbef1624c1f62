#include "clients/skyig/sky/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "clients/csv.h"
#include "clients/letters.h"

namespace skyig::clients::sky {
namespace {

using Columns = std::array<std::size_t, kCaseColumns.size()>;
using Numbers = std::array<double, kCaseColumns.size()>;

struct Limits {
    double least;
    double most;
};
constexpr std::array<Limits, kCaseColumns.size()> kLimits{
    {{0.0, 1e9}, {0.0, 180.0}, {0.0, 180.0}, {-1e6, 1e6}}};

struct Row {
    std::string text;
    std::string_view line_end;
    std::string added;
};

/// Why a row is bad; `column` is empty when it is the row as a whole.
struct RowProblem {
    std::string_view column;
    std::string text;
};

std::optional<std::size_t> find(const std::vector<std::string>& names, std::string_view wanted) {
    const auto at = std::find_if(names.begin(), names.end(),
                                 [&](const std::string& name) { return same_letters(name, wanted); });
    if (at == names.end()) return std::nullopt;
    return static_cast<std::size_t>(at - names.begin());
}

Columns read_heading(const CsvRecord& heading) {
    if (heading.too_long || !heading.well_formed)
        throw std::runtime_error("the heading is too long, or a quote in it is not closed");
    for (const std::string_view name : kSkyColumns) {
        if (find(heading.fields, name))
            throw std::runtime_error(fmt::format("column '{}' is there already", name));
    }
    Columns columns{};
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::optional<std::size_t> at = find(heading.fields, kCaseColumns[i]);
        if (!at) {
            throw std::runtime_error(fmt::format("no column '{}': a table of cases has {}", kCaseColumns[i],
                                                 fmt::join(kCaseColumns, ", ")));
        }
        columns[i] = *at;
    }
    return columns;
}

/// Throws RowProblem.
Numbers read_row(const CsvRecord& record, const Columns& columns) {
    Numbers numbers{};
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::string& text = record.fields[columns[i]];
        const std::optional<double> value = parse_number(text);
        if (!value || *value < kLimits[i].least || *value > kLimits[i].most) {
            throw RowProblem{kCaseColumns[i], fmt::format("'{}' is not a number in [{:.9g}, {:.9g}]", text,
                                                          kLimits[i].least, kLimits[i].most)};
        }
        numbers[i] = *value;
    }
    return numbers;
}

std::string columns_of(const glm::dvec3& xyz) {
    const double sum = xyz.x + xyz.y + xyz.z;
    if (!(sum > 0.0)) return ",0,0,0";
    return fmt::format(",{:.7g},{:.6f},{:.6f}", xyz.y, xyz.x / sum, xyz.y / sum);
}

class Table {
  public:
    Table(std::string name, const CsvRecord& heading)
        : name_(std::move(name)), columns_(read_heading(heading)), width_(heading.fields.size()) {}

    void add(const CsvRecord& record, std::ostream& errors) {
        ++count_.rows;
        try {
            if (record.too_long || !record.well_formed)
                throw RowProblem{"", "the line is too long, or a quote in it is not closed"};
            if (record.fields.size() != width_)
                throw RowProblem{
                    "", fmt::format("{} fields where the heading has {}", record.fields.size(), width_)};
            rows_.push_back({record.text, record.line_end, ",,,"});
            const Numbers numbers = read_row(record, columns_);
            groups_[{numbers[0], numbers[1]}].push_back({rows_.size() - 1, numbers[2], numbers[3]});
        } catch (const RowProblem& problem) {
            ++count_.bad_rows;
            const std::string column = problem.column.empty() ? "" : fmt::format("{}: ", problem.column);
            errors << fmt::format("{}:{}: {}{}\n", name_, record.line, column, problem.text);
        }
    }

    CaseCount solve(Solver& solver, std::ostream& output) {
        for (const auto& [place, directions] : groups_) {
            solver.begin(place.first, place.second);
            for (const Direction& direction : directions)
                rows_[direction.row].added =
                    columns_of(solver.xyz(direction.view_zenith_deg, direction.rel_azimuth_deg));
        }
        for (const Row& row : rows_)
            output << row.text << row.added << row.line_end;
        count_.tables = groups_.size();
        return count_;
    }

  private:
    struct Direction {
        std::size_t row;
        double view_zenith_deg;
        double rel_azimuth_deg;
    };

    std::string name_;
    Columns columns_;
    std::size_t width_;
    std::vector<Row> rows_;
    std::map<std::pair<double, double>, std::vector<Direction>> groups_;
    CaseCount count_;
};

}  // namespace

CaseCount run_cases(std::istream& input, const std::string& input_name, const OpenOutput& open_output,
                    std::ostream& errors, Solver& solver) {
    CsvReader reader(input);
    const auto require_readable = [&] {
        if (reader.failed())
            throw std::runtime_error(fmt::format("{}:{}: cannot be read", input_name, reader.line() + 1));
    };
    const std::optional<CsvRecord> heading = reader.next();
    require_readable();
    if (!heading) throw std::runtime_error(input_name + ": no heading line");
    std::optional<Table> table;
    try {
        table.emplace(input_name, *heading);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}:{}: {}", input_name, heading->line, error.what()));
    }
    while (const std::optional<CsvRecord> record = reader.next())
        table->add(*record, errors);
    require_readable();
    std::ostream& output = open_output();
    output << heading->text;
    for (const std::string_view name : kSkyColumns)
        output << ',' << name;
    output << heading->line_end;
    return table->solve(solver, output);
}

}  // namespace skyig::clients::sky
