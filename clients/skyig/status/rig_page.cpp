#include "clients/skyig/status/rig_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace skyig::clients::status {

namespace {

using RigJson = nlohmann::ordered_json;

const std::string& string_of(const RigJson& json, const char* key) {
    return json.at(key).get_ref<const std::string&>();
}

std::uint64_t count_of(const RigJson& json, const char* key) {
    return json.at(key).get<std::uint64_t>();
}

std::string joined(const RigJson& names) {
    std::string text;
    for (const RigJson& name : names)
        fmt::format_to(std::back_inserter(text), "{}{}", text.empty() ? "" : ",",
                       name.get_ref<const std::string&>());
    return text.empty() ? "-" : text;
}

std::string part_text(const RigJson& rig) {
    const std::string& role = string_of(rig, "role");
    if (role == "leads") return "leads";
    if (role == "follows") return fmt::format("follows {}", string_of(rig, "leader"));
    return "hears no leader";
}

/// Columns as wide as what stands in them; numbers to the right.
class Table {
  public:
    using Row = std::vector<std::string>;

    explicit Table(Row heads) : rows_{std::move(heads)} {}
    void add(Row row) { rows_.push_back(std::move(row)); }

    /// \param texts  so many columns, the first, stand to the left
    [[nodiscard]] std::string text(std::size_t texts) const {
        std::vector<std::size_t> widths(rows_.front().size());
        for (const Row& row : rows_)
            for (std::size_t i = 0; i < row.size(); ++i)
                widths[i] = std::max(widths[i], row[i].size());
        std::string text;
        for (const Row& row : rows_) {
            for (std::size_t i = 0; i < row.size(); ++i) {
                if (i < texts)
                    fmt::format_to(std::back_inserter(text), "{:<{}}  ", row[i], widths[i]);
                else
                    fmt::format_to(std::back_inserter(text), "{:>{}}  ", row[i], widths[i]);
            }
            text.erase(text.find_last_not_of(' ') + 1);
            text += '\n';
        }
        return text;
    }

  private:
    std::vector<Row> rows_;
};

std::string nodes_text(const RigJson& nodes) {
    Table table({"node", "channels", "state", "frame", "lag", "frame ms", "wait ms", "left out", "repeats",
                 "late", "lost", "heard"});
    for (const RigJson& node : nodes) {
        const RigJson& silent = node.at("silent_s");
        table.add({string_of(node, "name"), joined(node.at("channels")), string_of(node, "state"),
                   fmt::to_string(count_of(node, "frame")), fmt::to_string(count_of(node, "lag")),
                   fmt::format("{:.2f}", node.at("frame_ms").get<double>()),
                   fmt::format("{:.2f}", node.at("waited_ms").get<double>()),
                   fmt::to_string(count_of(node, "left_out")), fmt::to_string(count_of(node, "repeats")),
                   fmt::to_string(count_of(node, "late")), fmt::to_string(count_of(node, "losses")),
                   silent.is_null() ? "never" : fmt::format("{:.1f} s ago", silent.get<double>())});
    }
    return table.text(3);
}

}  // namespace

std::string rig_line(const RigJson& rig) {
    std::string text =
        fmt::format("{} {}, frame {}", string_of(rig, "name"), part_text(rig), count_of(rig, "frame"));
    std::vector<std::pair<std::string, int>> states;
    for (const RigJson& node : rig.at("nodes")) {
        const std::string& state = string_of(node, "state");
        const auto known = std::find_if(states.begin(), states.end(),
                                        [&state](const auto& one) { return one.first == state; });
        if (known == states.end())
            states.emplace_back(state, 1);
        else
            ++known->second;
    }
    const char* before = "; nodes: ";
    for (const auto& [state, count] : states) {
        fmt::format_to(std::back_inserter(text), "{}{} {}", before, count, state);
        before = ", ";
    }
    return text;
}

std::string rig_text(const RigJson& rig) {
    std::string text = fmt::format("{} {}, frame {}; draws {}\n", string_of(rig, "name"), part_text(rig),
                                   count_of(rig, "frame"), joined(rig.at("channels")));
    const RigJson& wait = rig.at("wait");
    if (count_of(wait, "count") > 0)
        fmt::format_to(std::back_inserter(text),
                       "wait for nodes: median {:.2f} ms, p99 {:.2f} ms, largest {:.2f} ms\n",
                       wait.at("median_ms").get<double>(), wait.at("p99_ms").get<double>(),
                       wait.at("largest_ms").get<double>());
    std::string counts;
    for (const auto& [name, value] : rig.at("counts").items())
        if (value != 0)
            fmt::format_to(std::back_inserter(counts), "{}{} {}", counts.empty() ? "" : ", ", name,
                           value.get<std::uint64_t>());
    if (!counts.empty()) fmt::format_to(std::back_inserter(text), "counts: {}\n", counts);
    const RigJson& nodes = rig.at("nodes");
    if (nodes.empty()) return text;
    text += '\n' + nodes_text(nodes) + '\n';
    for (const RigJson& node : nodes) {
        const std::string& build = string_of(node, "build");
        const std::string& gl = string_of(node, "gl");
        fmt::format_to(std::back_inserter(text), "{}: {}{}{}", string_of(node, "name"),
                       build.empty() ? "not heard of" : build, gl.empty() ? "" : ", ", gl);
        if (count_of(node, "gl_errors") > 0)
            fmt::format_to(std::back_inserter(text), ", {} GL ERRORS", count_of(node, "gl_errors"));
        if (!string_of(node, "why").empty())
            fmt::format_to(std::back_inserter(text), "; REFUSED: {}", string_of(node, "why"));
        text += '\n';
    }
    return text;
}

}  // namespace skyig::clients::status
