// What each key of the settings means, in a line for people. Everything else that the reference says of a key
// (range, unit, default) is what the reader of settings itself goes by.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace skyig::config::reference {

struct Meaning {
    /// "air", "channel.display", "" for the root; without numbers.
    std::string_view table;
    std::string_view key;
    /// Markdown.
    std::string_view text;
    /// Where the key has no default: what holds then. Empty: "none", or "required".
    std::string_view otherwise = {};
    /// In place of what the reader says, where that is of one case only. Empty: as the reader says.
    std::string_view range = {};
};

/// Daemon, sources, display, eye, outputs, windows, channels; the world that is drawn.
[[nodiscard]] std::span<const Meaning> meanings_of_site() noexcept;
[[nodiscard]] std::span<const Meaning> meanings_of_world() noexcept;

/// Of a key in a table as the log of keys names it ("channel[1].display"); tables of one kind share theirs.
/// Null: nobody has said.
[[nodiscard]] const Meaning* meaning_of(std::string_view table, std::string_view key);

/// Where the meanings of a table's keys stand: "weather.layer" of "weather.area[1].layer[2]".
[[nodiscard]] std::string table_of_meanings(std::string_view table);

}  // namespace skyig::config::reference
