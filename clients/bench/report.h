// What is known about a family of models: one shape for all families, kept as JSON (docs/accuracy/schema.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/bench/errors.h"
#include "clients/bench/timing.h"

namespace skyig::clients::bench {

/// How far a model is from the truth in one quantity over one set of cases.
struct ErrorEntry {
    std::string quantity;
    std::string cases;
    std::string unit;
    ErrorFigures figures;
};

/// What one call of one of a model's works costs.
struct CostEntry {
    std::string name;
    Quartiles ns;
    /// As multiples of the report's floor.
    Quartiles floors;
    std::optional<double> instructions;
};

/// Memory that a model holds while it is in use.
struct SizeEntry {
    std::string name;
    std::size_t bytes = 0;
};

/// One row of a truth table beside what the model has.
struct RowEntry {
    std::string cases;
    std::string row;
    std::string unit;
    double known = 0.0;
    double ours = 0.0;
    /// In the unit of the errors of these cases.
    double off = 0.0;
};

struct ModelEntry {
    std::string name;
    std::string what;
    std::vector<ErrorEntry> errors;
    std::vector<CostEntry> costs;
    /// Empty where memory is no matter.
    std::vector<SizeEntry> sizes = {};
    /// Empty for most families, whose tables are long.
    std::vector<RowEntry> rows = {};
};

/// A quantity whose error is drawn against a cost, one point a model.
struct PlotSeries {
    std::string label;
    std::string quantity;
    std::string cost;
};

/// A picture of the largest errors over `cases` against costs.
struct Plot {
    std::string name;  ///< part of the file's name
    std::string title;
    std::string cases;
    std::vector<PlotSeries> series;
};

/// One line over an axis of luminances or the like.
struct Curve {
    std::string label;
    struct Point {
        double x = 0.0;
        double y = 0.0;
    };
    std::vector<Point> points;
};

/// A picture of what models do, x logarithmic, y from 0 to 1.
struct CurvePlot {
    std::string name;  ///< part of the file's name
    std::string title;
    std::string x;
    std::string y;
    std::vector<Curve> curves;
};

/// The one error and the one cost that stand for a model in the table over all families; beside it what a
/// call costs at worst, empty where all calls are alike.
struct Headline {
    std::string quantity;
    std::string cases;
    std::string cost;
    std::string worst_cost = {};
};

struct Report {
    std::string family;
    std::string title;
    /// What was computed, and what held against.
    std::string cases;
    std::string truth;
    /// What each named cost is.
    std::string costs;
    std::string floor;
    Quartiles floor_ns;
    int rounds = 0;
    std::string machine;
    std::vector<ModelEntry> models;
    std::vector<Plot> plots;
    /// Empty for most families.
    std::vector<CurvePlot> curves = {};
    Headline headline;
};

/// Nothing where the model has no such entry.
[[nodiscard]] const ErrorEntry* find_error(const ModelEntry& model, std::string_view quantity,
                                           std::string_view cases) noexcept;
[[nodiscard]] const CostEntry* find_cost(const ModelEntry& model, std::string_view name) noexcept;

/// Figures are rounded to four significant digits.
[[nodiscard]] std::string to_json(const Report& report);
/// Throws std::runtime_error that says what is missing or of another shape.
[[nodiscard]] Report report_from_json(std::string_view text);

/// Tables for people.
[[nodiscard]] std::string to_text(const Report& report);

/// Four significant digits, the shortest form: "0.03125", "1234", "123500", "1.2e-06".
[[nodiscard]] std::string short_number(double value);

}  // namespace skyig::clients::bench
