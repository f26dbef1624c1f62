#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "clients/bench/report.h"

namespace skyig::clients::bench {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kSchema = "skyig-bench-1";

double rounded(double value) {
    return std::stod(fmt::format("{:.3e}", value));
}

Json to_node(const Quartiles& quartiles) {
    return {{"median", rounded(quartiles.median)},
            {"p25", rounded(quartiles.p25)},
            {"p75", rounded(quartiles.p75)}};
}

Json to_node(const ErrorEntry& error) {
    return {{"quantity", error.quantity},
            {"cases", error.cases},
            {"unit", error.unit},
            {"max", rounded(error.figures.max)},
            {"rms", rounded(error.figures.rms)},
            {"p95", rounded(error.figures.p95)},
            {"count", error.figures.count}};
}

Json to_node(const CostEntry& cost) {
    Json node{{"name", cost.name}, {"unit", "ns"}};
    node.update(to_node(cost.ns));
    node["floors"] = to_node(cost.floors);
    if (cost.instructions) node["instructions"] = std::round(*cost.instructions);
    return node;
}

Json to_node(const ModelEntry& model) {
    Json node{
        {"name", model.name}, {"what", model.what}, {"errors", Json::array()}, {"costs", Json::array()}};
    for (const ErrorEntry& error : model.errors)
        node["errors"].push_back(to_node(error));
    for (const CostEntry& cost : model.costs)
        node["costs"].push_back(to_node(cost));
    for (const SizeEntry& size : model.sizes)
        node["sizes"].push_back({{"name", size.name}, {"bytes", size.bytes}});
    for (const RowEntry& row : model.rows) {
        node["rows"].push_back({{"cases", row.cases},
                                {"row", row.row},
                                {"unit", row.unit},
                                {"known", rounded(row.known)},
                                {"ours", rounded(row.ours)},
                                {"off", rounded(row.off)}});
    }
    return node;
}

Json to_node(const Plot& plot) {
    Json node{{"name", plot.name}, {"title", plot.title}, {"cases", plot.cases}, {"series", Json::array()}};
    for (const PlotSeries& series : plot.series)
        node["series"].push_back(
            {{"label", series.label}, {"quantity", series.quantity}, {"cost", series.cost}});
    return node;
}

Json to_node(const CurvePlot& plot) {
    Json node{
        {"name", plot.name}, {"title", plot.title}, {"x", plot.x}, {"y", plot.y}, {"lines", Json::array()}};
    for (const Curve& curve : plot.curves) {
        Json points = Json::array();
        for (const Curve::Point& point : curve.points)
            points.push_back({rounded(point.x), rounded(point.y)});
        node["lines"].push_back({{"label", curve.label}, {"points", std::move(points)}});
    }
    return node;
}

std::string text_of(const Json& node, const char* key) {
    return node.at(key).get<std::string>();
}

double number_of(const Json& node, const char* key) {
    return node.at(key).get<double>();
}

Quartiles quartiles_of(const Json& node) {
    return {number_of(node, "p25"), number_of(node, "median"), number_of(node, "p75")};
}

ErrorEntry error_of(const Json& node) {
    return {text_of(node, "quantity"),
            text_of(node, "cases"),
            text_of(node, "unit"),
            {number_of(node, "max"), number_of(node, "rms"), number_of(node, "p95"),
             node.at("count").get<std::size_t>()}};
}

CostEntry cost_of(const Json& node) {
    CostEntry cost{text_of(node, "name"), quartiles_of(node), quartiles_of(node.at("floors")), {}};
    if (node.contains("instructions")) cost.instructions = number_of(node, "instructions");
    return cost;
}

ModelEntry model_of(const Json& node) {
    ModelEntry model{text_of(node, "name"), text_of(node, "what"), {}, {}, {}};
    for (const Json& error : node.at("errors"))
        model.errors.push_back(error_of(error));
    for (const Json& cost : node.at("costs"))
        model.costs.push_back(cost_of(cost));
    for (const Json& size : node.value("sizes", Json::array()))
        model.sizes.push_back({text_of(size, "name"), size.at("bytes").get<std::size_t>()});
    for (const Json& row : node.value("rows", Json::array()))
        model.rows.push_back({text_of(row, "cases"), text_of(row, "row"), text_of(row, "unit"),
                              number_of(row, "known"), number_of(row, "ours"), number_of(row, "off")});
    return model;
}

Plot plot_of(const Json& node) {
    Plot plot{text_of(node, "name"), text_of(node, "title"), text_of(node, "cases"), {}};
    for (const Json& series : node.at("series"))
        plot.series.push_back(
            {text_of(series, "label"), text_of(series, "quantity"), text_of(series, "cost")});
    return plot;
}

CurvePlot curve_plot_of(const Json& node) {
    CurvePlot plot{text_of(node, "name"), text_of(node, "title"), text_of(node, "x"), text_of(node, "y"), {}};
    for (const Json& line : node.at("lines")) {
        Curve curve{text_of(line, "label"), {}};
        for (const Json& point : line.at("points"))
            curve.points.push_back({point.at(0).get<double>(), point.at(1).get<double>()});
        plot.curves.push_back(std::move(curve));
    }
    return plot;
}

Report report_of(const Json& node) {
    if (text_of(node, "schema") != kSchema)
        throw std::runtime_error(fmt::format("bench: schema is not {}", kSchema));
    Report report;
    report.family = text_of(node, "family");
    report.title = text_of(node, "title");
    report.cases = text_of(node, "cases");
    report.truth = text_of(node, "truth");
    report.costs = text_of(node, "costs");
    report.floor = text_of(node.at("floor"), "what");
    report.floor_ns = quartiles_of(node.at("floor"));
    report.rounds = node.at("rounds").get<int>();
    report.machine = text_of(node, "machine");
    for (const Json& model : node.at("models"))
        report.models.push_back(model_of(model));
    for (const Json& plot : node.at("plots"))
        report.plots.push_back(plot_of(plot));
    if (node.contains("curves")) {
        for (const Json& plot : node.at("curves"))
            report.curves.push_back(curve_plot_of(plot));
    }
    const Json& headline = node.at("headline");
    report.headline = {text_of(headline, "quantity"), text_of(headline, "cases"), text_of(headline, "cost"),
                       headline.contains("worst_cost") ? text_of(headline, "worst_cost") : ""};
    return report;
}

}  // namespace

std::string to_json(const Report& report) {
    Json node;
    node["schema"] = kSchema;
    node["family"] = report.family;
    node["title"] = report.title;
    node["cases"] = report.cases;
    node["truth"] = report.truth;
    node["costs"] = report.costs;
    node["floor"] = {{"what", report.floor}, {"unit", "ns"}};
    node["floor"].update(to_node(report.floor_ns));
    node["rounds"] = report.rounds;
    node["machine"] = report.machine;
    node["models"] = Json::array();
    for (const ModelEntry& model : report.models)
        node["models"].push_back(to_node(model));
    node["plots"] = Json::array();
    for (const Plot& plot : report.plots)
        node["plots"].push_back(to_node(plot));
    for (const CurvePlot& plot : report.curves)
        node["curves"].push_back(to_node(plot));
    node["headline"] = {{"quantity", report.headline.quantity},
                        {"cases", report.headline.cases},
                        {"cost", report.headline.cost}};
    if (!report.headline.worst_cost.empty()) node["headline"]["worst_cost"] = report.headline.worst_cost;
    return node.dump(1) + '\n';
}

Report report_from_json(std::string_view text) {
    try {
        return report_of(Json::parse(text));
    } catch (const nlohmann::json::exception& error) {
        throw std::runtime_error(fmt::format("bench: {}", error.what()));
    }
}

}  // namespace skyig::clients::bench
