// Reads the truth tables that tests are held against: commas, one heading line, '#' lines skipped, no quotes.
#pragma once

#include <cstddef>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace skyig::tests {

class CsvRow {
  public:
    explicit CsvRow(std::map<std::string, std::string> fields) : fields_(std::move(fields)) {}

    [[nodiscard]] const std::string& text(const std::string& column) const { return fields_.at(column); }
    /// Not-a-number where the field is empty; throws when it is no number or the column is missing.
    [[nodiscard]] double number(const std::string& column) const {
        const std::string& field = text(column);
        return field.empty() ? std::numeric_limits<double>::quiet_NaN() : std::stod(field);
    }

  private:
    std::map<std::string, std::string> fields_;
};

inline std::vector<std::string> split_csv_line(const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
        if (c == ',') {
            fields.emplace_back();
        } else if (c != '\r') {
            fields.back().push_back(c);
        }
    }
    return fields;
}

/// \return no rows when the file cannot be read.
inline std::vector<CsvRow> read_csv(const std::string& path) {
    std::ifstream file(path);
    std::vector<std::string> heading;
    std::vector<CsvRow> rows;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#') continue;
        std::vector<std::string> fields = split_csv_line(line);
        if (heading.empty()) {
            heading = std::move(fields);
            continue;
        }
        if (fields.size() != heading.size()) throw std::runtime_error(path + ": wrong number of fields");
        std::map<std::string, std::string> named;
        for (std::size_t i = 0; i < fields.size(); ++i)
            named.emplace(heading[i], std::move(fields[i]));
        rows.emplace_back(std::move(named));
    }
    return rows;
}

}  // namespace skyig::tests
