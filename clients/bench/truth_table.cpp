#include "clients/bench/truth_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <utility>

#include "clients/csv.h"

namespace skyig::clients::bench {

TruthTable::TruthTable(const std::filesystem::path& path) : name_(path.string()) {
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error(
            fmt::format("{}: cannot be read; --truth names the folder of the truth tables", name_));
    CsvReader reader(file);
    const auto refuse = [&](std::size_t line, const std::string& what) {
        throw std::runtime_error(fmt::format("{}:{}: {}", name_, line, what));
    };
    while (std::optional<CsvRecord> record = reader.next()) {
        if (record->too_long || !record->well_formed)
            refuse(record->line, "the line is too long or a quote in it is not closed");
        if (heading_.empty()) {
            heading_ = std::move(record->fields);
            continue;
        }
        if (record->fields.size() != heading_.size())
            refuse(record->line,
                   fmt::format("{} fields, the heading has {}", record->fields.size(), heading_.size()));
        rows_.push_back(std::move(record->fields));
    }
    if (reader.failed()) refuse(reader.line() + 1, "cannot be read");
}

const std::string& TruthTable::text(std::size_t row, std::string_view column) const {
    const auto found = std::find(heading_.begin(), heading_.end(), column);
    if (found == heading_.end())
        throw std::runtime_error(fmt::format("{}: there is no column {}", name_, column));
    return rows_.at(row)[static_cast<std::size_t>(found - heading_.begin())];
}

double TruthTable::number(std::size_t row, std::string_view column) const {
    const std::string& field = text(row, column);
    const std::optional<double> value = parse_number(field);
    if (!value)
        throw std::runtime_error(
            fmt::format("{}: row {}: {} '{}' is not a number", name_, row + 1, column, field));
    return *value;
}

}  // namespace skyig::clients::bench
