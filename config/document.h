// A configuration file as a tree of values that know their place in the text. It keeps the TOML library in
// one source file, and lets the schema be read from anything that has places.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/config.h"

namespace skyig::config {

/// 1-based; 0 = unknown.
struct Place {
    int line = 0;
    int column = 0;
};

struct Value;

struct Table {
    /// With their keys, in the order of the text.
    std::vector<Value> entries;

    [[nodiscard]] const Value* find(std::string_view key) const noexcept;
};

struct Array {
    std::vector<Value> items;
};

/// A date with time of day and an offset from UTC other than zero, or none, or a lone date or time: nothing
/// that a setting may hold, kept so that the error can name it.
struct OtherDate {};

struct Value {
    std::variant<bool, std::int64_t, double, std::string, UtcDateTime, OtherDate, Array, Table> data;
    Place place;
    /// Empty for items of arrays.
    std::string key;
    /// Where the key stands; that of the value for items of arrays.
    Place key_place;
};

/// A file's text; nothing and `error` filled when it cannot be read or is larger than 256 KiB, more than
/// anyone writes by hand: a mistaken path (a device, a recording) is told at once.
[[nodiscard]] std::optional<std::string> read_settings_text(const std::string& path, ConfigError& error);

/// Reads TOML. A line with more than 32 dots outside strings and comments is refused: its keys would nest
/// deeper than a parser can follow. On a syntax error `error` is filled (line, column, message) and the table
/// is empty.
[[nodiscard]] bool parse_document(std::string_view text, Table& root, ConfigError& error);

}  // namespace skyig::config
