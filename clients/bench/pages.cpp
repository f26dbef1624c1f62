#include "clients/bench/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "clients/bench/plot.h"

namespace skyig::clients::bench {

namespace {

constexpr std::string_view kOrigin = "Written by `script/accuracy`; change the models, not the numbers.\n";

/// Text as one cell of a table.
std::string cell(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '|') out += '\\';
        out += c == '\n' ? ' ' : c;
    }
    return out;
}

/// Sets of cases in the order of their first entry.
std::vector<std::string> case_sets(const Report& report) {
    std::vector<std::string> sets;
    for (const ModelEntry& model : report.models) {
        for (const ErrorEntry& error : model.errors) {
            if (std::find(sets.begin(), sets.end(), error.cases) == sets.end()) sets.push_back(error.cases);
        }
    }
    return sets;
}

void put_errors(std::string& page, const Report& report, const std::string& cases) {
    const auto out = std::back_inserter(page);
    fmt::format_to(out, "\n### {}\n\n", cases);
    page += "| quantity | model | max | rms | 95 % | unit | cases |\n|---|---|--:|--:|--:|---|--:|\n";
    std::vector<std::string> quantities;
    for (const ModelEntry& model : report.models) {
        for (const ErrorEntry& error : model.errors) {
            if (error.cases == cases &&
                std::find(quantities.begin(), quantities.end(), error.quantity) == quantities.end())
                quantities.push_back(error.quantity);
        }
    }
    for (const std::string& quantity : quantities) {
        for (const ModelEntry& model : report.models) {
            const ErrorEntry* error = find_error(model, quantity, cases);
            if (!error) continue;
            fmt::format_to(out, "| {} | {} | {} | {} | {} | {} | {} |\n", cell(quantity), cell(model.name),
                           short_number(error->figures.max), short_number(error->figures.rms),
                           short_number(error->figures.p95), cell(error->unit), error->figures.count);
        }
    }
}

void put_costs(std::string& page, const Report& report) {
    const auto out = std::back_inserter(page);
    fmt::format_to(
        out,
        "\n## Cost\n\n{}\n\nThe floor is {}: {} ns. Floors are medians of ratios to the floor timed "
        "just before, {} rounds in one run, all models in turn; the quartiles are those of the ns. "
        "Measured on {}.\n\n",
        report.costs, report.floor, short_number(report.floor_ns.median), report.rounds, report.machine);
    page +=
        "| cost | model | ns | quartiles | floors | instructions |\n"
        "|---|---|--:|--:|--:|--:|\n";
    std::vector<std::string> names;
    for (const ModelEntry& model : report.models) {
        for (const CostEntry& cost : model.costs) {
            if (std::find(names.begin(), names.end(), cost.name) == names.end()) names.push_back(cost.name);
        }
    }
    for (const std::string& name : names) {
        for (const ModelEntry& model : report.models) {
            const CostEntry* cost = find_cost(model, name);
            if (!cost) continue;
            fmt::format_to(out, "| {} | {} | {} | {} - {} | {} | {} |\n", cell(name), cell(model.name),
                           short_number(cost->ns.median), short_number(cost->ns.p25),
                           short_number(cost->ns.p75), short_number(cost->floors.median),
                           cost->instructions ? fmt::format("{:.0f}", *cost->instructions) : "not counted");
        }
    }
}

void put_sizes(std::string& page, const Report& report) {
    std::string lines;
    for (const ModelEntry& model : report.models) {
        for (const SizeEntry& size : model.sizes)
            fmt::format_to(std::back_inserter(lines), "| {} | {} | {} |\n", cell(model.name), cell(size.name),
                           size.bytes);
    }
    if (!lines.empty()) page += "\n## Memory\n\n| model | of | bytes |\n|---|---|--:|\n" + lines;
}

void put_rows(std::string& page, const Report& report) {
    std::string lines;
    const auto out = std::back_inserter(lines);
    for (const ModelEntry& model : report.models) {
        for (const RowEntry& row : model.rows) {
            fmt::format_to(out, "| {} | {} | {} | {} | {} | {} | {} |\n", cell(model.name), cell(row.cases),
                           cell(row.row), short_number(row.known), short_number(row.ours), cell(row.unit),
                           short_number(row.off));
        }
    }
    if (lines.empty()) return;
    page +=
        "\n## Row by row\n\n| model | cases | row | known | ours | unit | off "
        "|\n|---|---|---|--:|--:|---|--:|\n";
    page += lines;
}

/// Name, ns and floors; empty cells for nothing.
std::string cost_cells(const CostEntry* cost) {
    if (!cost) return " | | ";
    return fmt::format("{} | {} | {}", cell(cost->name), short_number(cost->ns.median),
                       short_number(cost->floors.median));
}

void write_file(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be written", path.string()));
}

Report read_report(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));
    try {
        return report_from_json(text.str());
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", path.string(), error.what()));
    }
}

std::vector<std::filesystem::path> json_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> paths;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        if (entry.path().extension() == ".json") paths.push_back(entry.path());
    }
    if (error) throw std::runtime_error(fmt::format("{}: {}", folder.string(), error.message()));
    if (paths.empty())
        throw std::runtime_error(fmt::format("{}: no .json of a family to render", folder.string()));
    std::sort(paths.begin(), paths.end());
    return paths;
}

}  // namespace

std::string plot_file_name(const Report& report, const Plot& plot) {
    return fmt::format("{}-{}.svg", report.family, plot.name);
}

std::string plot_file_name(const Report& report, const CurvePlot& plot) {
    return fmt::format("{}-{}.svg", report.family, plot.name);
}

std::string family_page(const Report& report) {
    std::string page = fmt::format("# {}\n\n{}\nCases: {}\n\nTruth: {}\n\n", report.title, kOrigin,
                                   report.cases, report.truth);
    const auto out = std::back_inserter(page);
    for (const ModelEntry& model : report.models)
        fmt::format_to(out, "- **{}**: {}\n", model.name, model.what);
    for (const Plot& plot : report.plots)
        fmt::format_to(out, "\n![{}, {}]({})\n", plot.title, plot.cases, plot_file_name(report, plot));
    for (const CurvePlot& plot : report.curves)
        fmt::format_to(out, "\n![{}]({})\n", plot.title, plot_file_name(report, plot));
    page += "\n## Error\n";
    for (const std::string& cases : case_sets(report))
        put_errors(page, report, cases);
    put_costs(page, report);
    put_sizes(page, report);
    put_rows(page, report);
    return page;
}

std::string index_page(std::span<const Report> reports) {
    std::string page = fmt::format(
        "# Error against cost\n\n{}\nOne line a model: its headline error and what a call costs, in ns and "
        "as a multiple of the family's floor, as it mostly is and at worst. The pages behind the links hold "
        "all quantities, the quartiles and the plots; [schema.md](schema.md) tells the shape of the JSON.\n\n"
        "| family | model | error of | cases | max | rms | unit | cost of | ns | floors | at worst | ns | "
        "floors |\n|---|---|---|---|--:|--:|---|---|--:|--:|---|--:|--:|\n",
        kOrigin);
    for (const Report& report : reports) {
        const Headline& headline = report.headline;
        for (const ModelEntry& model : report.models) {
            const ErrorEntry* error = find_error(model, headline.quantity, headline.cases);
            const CostEntry* cost = find_cost(model, headline.cost);
            if (!error || !cost) continue;
            fmt::format_to(std::back_inserter(page),
                           "| [{0}]({0}.md) | {1} | {2} | {3} | {4} | {5} | {6} | {7} | {8} |\n",
                           report.family, cell(model.name), cell(headline.quantity), cell(headline.cases),
                           short_number(error->figures.max), short_number(error->figures.rms),
                           cell(error->unit), cost_cells(cost),
                           cost_cells(find_cost(model, headline.worst_cost)));
        }
    }
    return page;
}

std::vector<std::filesystem::path> render_pages(const std::filesystem::path& folder) {
    std::vector<Report> reports;
    for (const std::filesystem::path& path : json_files(folder))
        reports.push_back(read_report(path));
    std::vector<std::filesystem::path> written;
    const auto write = [&](const std::string& name, const std::string& text) {
        written.push_back(folder / name);
        write_file(written.back(), text);
    };
    for (const Report& report : reports) {
        write(report.family + ".md", family_page(report));
        for (const Plot& plot : report.plots)
            write(plot_file_name(report, plot), to_svg(report, plot));
        for (const CurvePlot& plot : report.curves)
            write(plot_file_name(report, plot), to_svg(plot));
    }
    write("index.md", index_page(reports));
    return written;
}

}  // namespace skyig::clients::bench
