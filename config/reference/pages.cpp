#include "config/reference/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "config/reference/effective.h"
#include "config/reference/every_table.h"
#include "config/reference/meanings.h"

namespace skyig::config::reference {
namespace {

constexpr std::string_view kMark = "<!-- keys of ";
constexpr std::string_view kMarkEnd = " -->";

/// Names and texts as code: "clock", "display" become `"clock"`, `"display"`.
std::string with_code(std::string_view text) {
    if (text.find('`') != std::string_view::npos) return std::string(text);
    std::string marked;
    bool inside = false;
    for (const char c : text) {
        if (c != '"') {
            marked += c;
            continue;
        }
        marked += inside ? "\"`" : "`\"";
        inside = !inside;
    }
    return marked;
}

std::string otherwise_of(const KeyUse& use, const Meaning* meaning) {
    if (meaning != nullptr && !meaning->otherwise.empty()) return std::string(meaning->otherwise);
    if (use.required) return "required";
    if (!use.value) return "none";
    const bool is_code = use.value->find_first_of("\"[") != std::string::npos;
    return is_code ? fmt::format("`{}`", *use.value) : *use.value;
}

KeyRow row_of(const KeyUse& use) {
    const Meaning* meaning = meaning_of(use.table, use.key);
    const bool own_range = meaning != nullptr && !meaning->range.empty();
    return {table_of_meanings(use.table),
            use.key,
            use.unit,
            with_code(own_range ? meaning->range : std::string_view(use.range)),
            otherwise_of(use, meaning),
            meaning == nullptr ? std::string() : std::string(meaning->text)};
}

/// The first of a key stays.
void add_row(KeyRow row, std::vector<KeyRow>& rows) {
    const bool told = std::any_of(rows.begin(), rows.end(), [&row](const KeyRow& other) {
        return other.table == row.table && other.key == row.key;
    });
    if (!told) rows.push_back(std::move(row));
}

/// "`[air]`"; "`[[channel]]`" where there may be several; TIME and DAY stand for one of several names.
std::string title_of(const std::string& table, const std::vector<std::string>& several) {
    if (table.empty()) return "above all tables";
    const bool of_several = std::find(several.begin(), several.end(), table) != several.end();
    return of_several ? fmt::format("`[[{}]]`", table) : fmt::format("`[{}]`", table);
}

std::string key_table(const std::string& table, const std::vector<KeyRow>& keys) {
    const std::vector<std::string> several{
        "night.city", "weather.layer", "weather.sheet", "weather.sheet.texture", "weather.area", "source",
        "rig.node",   "window",        "channel"};
    std::string text = fmt::format("| {} | unit | range | default | meaning |\n|---|---|---|---|---|\n",
                                   title_of(table, several));
    for (const KeyRow& row : keys) {
        if (row.table != table) continue;
        fmt::format_to(std::back_inserter(text), "| `{}` |", row.key);
        for (const std::string* cell : {&row.unit, &row.range, &row.otherwise, &row.meaning})
            fmt::format_to(std::back_inserter(text), "{}{} |", cell->empty() ? "" : " ", *cell);
        text += '\n';
    }
    return text;
}

/// Calls `take(line)` for each line, without its end.
template <class Take>
void for_each_line(std::string_view text, Take take) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        take(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

bool is_mark(std::string_view line) {
    return line.starts_with(kMark) && line.ends_with(kMarkEnd);
}

/// The root is told as "the file".
std::string marked_table(std::string_view line) {
    line.remove_prefix(kMark.size());
    line.remove_suffix(kMarkEnd.size());
    return line == "the file" ? std::string() : std::string(line);
}

}  // namespace

std::vector<KeyRow> every_key() {
    std::vector<KeyRow> rows;
    // Defaults are those of a file that says nothing.
    for (const std::string_view text : {std::string_view("version = 1"), every_table()}) {
        KeyLog keys;
        (void)parse_config(text, "every-table.toml", &keys);
        for (const KeyUse& use : keys.uses())
            if (use.is_value()) add_row(row_of(use), rows);
    }
    return rows;
}

std::string with_key_tables(std::string_view page) {
    const std::vector<KeyRow> keys = every_key();
    std::string made;
    bool in_table = false;
    for_each_line(page, [&](std::string_view line) {
        if (line.empty()) in_table = false;
        if (!in_table) made += fmt::format("{}\n", line);
        if (!is_mark(line)) return;
        made += key_table(marked_table(line), keys);
        in_table = true;
    });
    return made;
}

std::vector<std::string> tables_shown(std::string_view page) {
    std::vector<std::string> tables;
    for_each_line(page, [&tables](std::string_view line) {
        if (is_mark(line)) tables.push_back(marked_table(line));
    });
    return tables;
}

}  // namespace skyig::config::reference
