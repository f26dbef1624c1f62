// Tables of keys for the pages of docs/, made from what the reader of settings asks for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skyig::config::reference {

struct KeyRow {
    /// "weather.layer", "" for the root.
    std::string table;
    std::string key;
    std::string unit;
    std::string range;
    std::string otherwise;
    std::string meaning;
};

/// Every key there is, in the order in which they are read; meanings are empty where nobody has said.
[[nodiscard]] std::vector<KeyRow> every_key();

/// A page in which the lines after each "<!-- keys of TABLE -->", up to the next empty line, are the table of
/// its keys: "| `[air]` | unit | range | default | meaning |" and so on. Other lines stay as they are.
[[nodiscard]] std::string with_key_tables(std::string_view page);

/// The tables that a page shows in this way.
[[nodiscard]] std::vector<std::string> tables_shown(std::string_view page);

}  // namespace skyig::config::reference
