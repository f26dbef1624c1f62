#include "clients/bench/truth_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <stdexcept>

namespace skyig::clients::bench {

namespace {

std::vector<std::string> split(std::string_view line) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
        if (c == ',') {
            fields.emplace_back();
        } else {
            fields.back().push_back(c);
        }
    }
    return fields;
}

}  // namespace

TruthTable::TruthTable(const std::filesystem::path& path) : name_(path.string()) {
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error(
            fmt::format("{}: cannot be read; --truth names the folder of the truth tables", name_));
    int number = 0;
    for (std::string line; std::getline(file, line);) {
        ++number;
        if (line.ends_with('\r')) line.pop_back();
        if (line.empty() || line.front() == '#') continue;
        std::vector<std::string> fields = split(line);
        if (heading_.empty()) {
            heading_ = std::move(fields);
            continue;
        }
        if (fields.size() != heading_.size())
            throw std::runtime_error(fmt::format("{}:{}: {} fields, the heading has {}", name_, number,
                                                 fields.size(), heading_.size()));
        rows_.push_back(std::move(fields));
    }
}

const std::string& TruthTable::text(std::size_t row, std::string_view column) const {
    const auto found = std::find(heading_.begin(), heading_.end(), column);
    if (found == heading_.end())
        throw std::runtime_error(fmt::format("{}: there is no column {}", name_, column));
    return rows_.at(row)[static_cast<std::size_t>(found - heading_.begin())];
}

double TruthTable::number(std::size_t row, std::string_view column) const {
    const std::string& field = text(row, column);
    double value = 0.0;
    const char* end = field.data() + field.size();
    const auto [rest, error] = std::from_chars(field.data(), end, value);
    if (error != std::errc() || rest != end)
        throw std::runtime_error(
            fmt::format("{}: row {}: {} '{}' is not a number", name_, row + 1, column, field));
    return value;
}

}  // namespace skyig::clients::bench
