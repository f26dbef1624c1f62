// Reads the tables of tests/data/sky and keeps error statistics.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "render/sky/air_model.h"

namespace skyig::render::sky {

inline constexpr double kDeg = 3.14159265358979323846 / 180.0;

/// first, first + step, ... up to but without `end`; a negative step counts down.
inline std::vector<double> steps(double first, double end, double step) {
    const auto count = static_cast<std::size_t>(std::ceil((end - first) / step - 1e-9));
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = first + static_cast<double>(i) * step;
    return values;
}

/// first, first * factor, ... below `end`.
inline std::vector<double> powers(double first, double end, double factor) {
    const auto count = static_cast<std::size_t>(std::ceil(std::log(end / first) / std::log(factor)));
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = first * std::pow(factor, static_cast<double>(i));
    return values;
}

/// Sunlight as the truth tables have it.
inline AirModel straight(AirModel model) {
    model.refractivity = 0.0;
    return model;
}

/// Look-ups take single precision.
inline float f32(double value) {
    return static_cast<float>(value);
}

struct Table {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;

    [[nodiscard]] std::size_t column(const std::string& name) const {
        return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
    }
    [[nodiscard]] double number(std::size_t row, const std::string& name) const {
        return std::strtod(rows[row].at(column(name)).c_str(), nullptr);
    }
};

inline std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');)
        cells.push_back(cell);
    return cells;
}

/// Empty when the file is absent. Lines that begin with # are comments.
inline Table read_table(const std::string& path) {
    Table table;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        if (table.columns.empty()) {
            table.columns = cells_of(line);
        } else {
            table.rows.push_back(cells_of(line));
        }
    }
    return table;
}

class Errors {
  public:
    void add(double error) { values_.push_back(error); }
    [[nodiscard]] std::size_t count() const { return values_.size(); }
    [[nodiscard]] double rms() const {
        double sum = 0.0;
        for (double value : values_)
            sum += value * value;
        return values_.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values_.size()));
    }
    /// Of the absolute values.
    [[nodiscard]] double quantile(double part) const {
        if (values_.empty()) return 0.0;
        std::vector<double> sorted;
        sorted.reserve(values_.size());
        for (double value : values_)
            sorted.push_back(std::abs(value));
        std::sort(sorted.begin(), sorted.end());
        return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
    }
    [[nodiscard]] double largest() const { return quantile(1.0); }

  private:
    std::vector<double> values_;
};

}  // namespace skyig::render::sky
