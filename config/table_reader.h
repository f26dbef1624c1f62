// Reads the keys of one table into plain values and notes everything that is wrong with them. The keys that
// were asked for are the keys that exist: finish() reports all others with the nearest right one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/document.h"
#include "config/key_log.h"

namespace skyig::config {

class ErrorList {
  public:
    /// \param keys  null: nobody wants to know which keys are asked for; else it outlives the list
    explicit ErrorList(std::string file, KeyLog* keys = nullptr) : file_(std::move(file)), keys_(keys) {}

    void add(const Place& place, std::string key, std::string message);
    /// In the order of the text.
    [[nodiscard]] std::vector<ConfigError> sorted() &&;
    [[nodiscard]] bool empty() const noexcept { return errors_.empty(); }
    [[nodiscard]] const std::string& file() const noexcept { return file_; }
    [[nodiscard]] KeyLog* keys() const noexcept { return keys_; }

  private:
    std::string file_;
    KeyLog* keys_;
    std::vector<ConfigError> errors_;
};

/// Both ends are allowed unless `above_min`.
struct Range {
    double min = -std::numeric_limits<double>::max();
    double max = std::numeric_limits<double>::max();
    /// Said in errors: "degrees", "m", "" for none.
    std::string_view unit;
    bool above_min = false;
};

class TableReader {
  public:
    /// `table` null: the table is absent, every key keeps its default. `path` is its dotted name, empty for
    /// the root.
    TableReader(ErrorList& errors, const Table* table, const Place& place, std::string path);

    /// Each returns the value's node when the key is there and right and `out` was set, else null; `out` then
    /// keeps its default.
    const Value* number(std::string_view key, double& out, const Range& range);
    const Value* number(std::string_view key, std::optional<double>& out, const Range& range);
    const Value* integer(std::string_view key, int& out, int min, int max, std::string_view unit = {});
    const Value* integer(std::string_view key, std::optional<int>& out, int min, int max,
                         std::string_view unit = {});
    const Value* boolean(std::string_view key, bool& out);
    const Value* text(std::string_view key, std::string& out);
    /// One of `names`, which stand in the order of `out`'s values.
    template <class Enum>
    const Value* choice(std::string_view key, Enum& out, std::span<const std::string_view> names) {
        auto index = static_cast<std::size_t>(out);
        const Value* value = name_of(key, index, names);
        out = static_cast<Enum>(index);
        return value;
    }
    /// A list of as many numbers as `out` holds, each in the range. \param wanted  what the list is, for
    /// errors
    const Value* numbers(std::string_view key, std::span<double> out, const Range& range,
                         std::string_view wanted);
    /// The table below this one; an error if the key holds something else.
    [[nodiscard]] TableReader table(std::string_view key);
    /// Any value at all, for keys that may hold several types; who reads it tells of it by describe().
    const Value* any(std::string_view key);
    /// For the log of keys: what one that any() or text() gave may hold, and holds now (as TOML).
    void describe(std::string_view key, std::string_view range, std::optional<std::string> value);
    [[nodiscard]] bool has(std::string_view key) const;

    /// The key must be there; otherwise an error at the table, saying `wanted`.
    void require(std::string_view key, std::string_view wanted);
    /// Reports keys that nobody asked for.
    void finish();

    void error(const Value& at, std::string_view key, std::string message);
    [[nodiscard]] std::string key_path(std::string_view key) const;
    [[nodiscard]] const Place& place() const noexcept { return place_; }

  private:
    const Value* read_number(std::string_view key, double& out, const Range& range);
    const Value* read_integer(std::string_view key, int& out, int min, int max, std::string_view unit);
    const Value* read_text(std::string_view key, std::string& out);
    const Value* read_numbers(std::string_view key, std::span<double> out, const Range& range,
                              std::string_view wanted);
    const Value* name_of(std::string_view key, std::size_t& out, std::span<const std::string_view> names);
    void describe_number(std::string_view key, const Range& range, std::optional<double> value);
    void describe_integer(std::string_view key, int min, int max, std::string_view unit,
                          std::optional<int> value);

    ErrorList& errors_;
    const Table* table_;
    Place place_;
    std::string path_;
    std::vector<std::string_view> known_;
};

using ReadItem = std::function<void(TableReader& item)>;

/// The tables of a list such as [[weather.layer]], each finished after `read`.
/// \param list_path  "weather.layer", for errors
/// \param there  how many of `most` the preset has taken
void read_tables(TableReader& owner, ErrorList& errors, std::string_view key, std::string_view list_path,
                 std::size_t there, std::size_t most, const ReadItem& read);

/// "a number", "text", ... for errors.
[[nodiscard]] std::string_view type_name(const Value& value);
/// Integers count as numbers; null result for anything else or not finite.
[[nodiscard]] bool as_number(const Value& value, double& out) noexcept;
/// "1..240 Hz"
[[nodiscard]] std::string to_text(const Range& range);

}  // namespace skyig::config
