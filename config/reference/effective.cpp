#include "config/reference/effective.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace skyig::config::reference {
namespace {

/// "[channel.display]", or "[[channel]]" for one of several.
std::string header_of(const std::string& table) {
    const bool one_of_several = table.back() == ']';
    const std::string name = without_numbers(table);
    return one_of_several ? fmt::format("[[{}]]", name) : fmt::format("[{}]", name);
}

void append_keys(const KeyLog& keys, const std::string& table, std::string& text) {
    for (const KeyUse& use : keys.uses()) {
        if (use.table != table || !use.is_value()) continue;
        if (use.value) {
            fmt::format_to(std::back_inserter(text), "{}{} = {}\n", use.given ? "" : "# ", use.key,
                           *use.value);
        } else {
            fmt::format_to(std::back_inserter(text), "# {}: not given\n", use.key);
        }
    }
}

}  // namespace

std::string without_numbers(std::string_view path) {
    std::string plain;
    bool in_number = false;
    for (const char c : path) {
        if (c == '[') in_number = true;
        if (!in_number) plain += c;
        if (c == ']') in_number = false;
    }
    return plain;
}

std::string effective_text(const KeyLog& keys) {
    std::vector<std::string> tables;
    for (const KeyUse& use : keys.uses()) {
        if (use.is_value() && std::find(tables.begin(), tables.end(), use.table) == tables.end())
            tables.push_back(use.table);
    }
    std::string text;
    for (const std::string& table : tables) {
        if (!table.empty()) text += fmt::format("\n{}\n", header_of(table));
        append_keys(keys, table, text);
    }
    return text;
}

}  // namespace skyig::config::reference
