#include "config/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/nearest.h"

namespace skyig::config {
namespace {

std::string list_of(std::span<const std::string_view> names) {
    std::string list;
    for (const std::string_view name : names) {
        if (!list.empty()) list += ", ";
        list += fmt::format("\"{}\"", name);
    }
    return list;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> candidates) {
    const std::string_view near = nearest(word, candidates);
    return near.empty() ? std::string() : fmt::format("; did you mean \"{}\"?", near);
}

}  // namespace

void ErrorList::add(const Place& place, std::string key, std::string message) {
    errors_.push_back({file_, place.line, place.column, std::move(key), std::move(message)});
}

std::vector<ConfigError> ErrorList::sorted() && {
    std::stable_sort(errors_.begin(), errors_.end(), [](const ConfigError& a, const ConfigError& b) {
        return a.line != b.line ? a.line < b.line : a.column < b.column;
    });
    return std::move(errors_);
}

std::string_view type_name(const Value& value) {
    struct Names {
        std::string_view operator()(bool) const { return "a truth value"; }
        std::string_view operator()(std::int64_t) const { return "a whole number"; }
        std::string_view operator()(double) const { return "a number"; }
        std::string_view operator()(const std::string&) const { return "text"; }
        std::string_view operator()(const UtcDateTime&) const { return "a date and time"; }
        std::string_view operator()(const OtherDate&) const { return "a date or time that is not UTC"; }
        std::string_view operator()(const Array&) const { return "a list"; }
        std::string_view operator()(const Table&) const { return "a table"; }
    };
    return std::visit(Names{}, value.data);
}

bool as_number(const Value& value, double& out) noexcept {
    if (const auto* integer = std::get_if<std::int64_t>(&value.data)) {
        out = static_cast<double>(*integer);
        return true;
    }
    const auto* number = std::get_if<double>(&value.data);
    if (number == nullptr || !std::isfinite(*number)) return false;
    out = *number;
    return true;
}

namespace {

/// Without its unit; empty: any finite number.
std::string bounds_of(const Range& range) {
    const bool has_max = range.max < std::numeric_limits<double>::max();
    const bool has_min = range.min > -std::numeric_limits<double>::max();
    if (!has_max && !has_min) return {};
    if (!has_max) return fmt::format("{} {}", range.above_min ? "above" : "at least", range.min);
    if (range.above_min) return fmt::format("above {} up to {}", range.min, range.max);
    return fmt::format("{}..{}", range.min, range.max);
}

}  // namespace

std::string to_text(const Range& range) {
    const std::string_view gap = range.unit.empty() ? "" : " ";
    const std::string bounds = bounds_of(range);
    return fmt::format("{}{}{}", bounds.empty() ? "a finite number" : bounds, gap, range.unit);
}

TableReader::TableReader(ErrorList& errors, const Table* table, const Place& place, std::string path)
    : errors_(errors), table_(table), place_(place), path_(std::move(path)) {}

std::string TableReader::key_path(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void TableReader::error(const Value& at, std::string_view key, std::string message) {
    errors_.add(at.place, key_path(key), std::move(message));
}

const Value* TableReader::any(std::string_view key) {
    known_.push_back(key);
    const Value* value = table_ == nullptr ? nullptr : table_->find(key);
    if (KeyLog* keys = errors_.keys(); keys != nullptr) keys->at(path_, key).given = value != nullptr;
    return value;
}

void TableReader::describe(std::string_view key, std::string_view range, std::optional<std::string> value) {
    KeyLog* keys = errors_.keys();
    if (keys == nullptr) return;
    KeyUse& use = keys->at(path_, key);
    use.range = range;
    use.value = std::move(value);
}

void TableReader::describe_number(std::string_view key, const Range& range, std::optional<double> value) {
    if (errors_.keys() == nullptr) return;
    const std::string bounds = bounds_of(range);
    describe(key, bounds.empty() ? "a finite number" : bounds,
             value ? std::optional(to_toml(*value)) : std::nullopt);
    errors_.keys()->at(path_, key).unit = range.unit;
}

void TableReader::describe_integer(std::string_view key, int min, int max, std::string_view unit,
                                   std::optional<int> value) {
    if (errors_.keys() == nullptr) return;
    describe(key, fmt::format("{}..{}, whole", min, max),
             value ? std::optional(to_toml(*value)) : std::nullopt);
    errors_.keys()->at(path_, key).unit = unit;
}

bool TableReader::has(std::string_view key) const {
    return table_ != nullptr && table_->find(key) != nullptr;
}

const Value* TableReader::number(std::string_view key, double& out, const Range& range) {
    const Value* value = read_number(key, out, range);
    describe_number(key, range, out);
    return value;
}

const Value* TableReader::number(std::string_view key, std::optional<double>& out, const Range& range) {
    double read = 0.0;
    const Value* value = read_number(key, read, range);
    if (value != nullptr) out = read;
    describe_number(key, range, out);
    return value;
}

const Value* TableReader::read_number(std::string_view key, double& out, const Range& range) {
    const Value* value = any(key);
    if (value == nullptr) return nullptr;
    double read = 0.0;
    if (!as_number(*value, read)) {
        const bool is_float = std::holds_alternative<double>(value->data);
        error(*value, key,
              fmt::format("is {}; it must be a number, {}", is_float ? "not finite" : type_name(*value),
                          to_text(range)));
        return nullptr;
    }
    if (read < range.min || read > range.max || (range.above_min && read <= range.min)) {
        error(*value, key, fmt::format("is {}; it must be {}", read, to_text(range)));
        return nullptr;
    }
    out = read;
    return value;
}

const Value* TableReader::integer(std::string_view key, int& out, int min, int max, std::string_view unit) {
    const Value* value = read_integer(key, out, min, max, unit);
    describe_integer(key, min, max, unit, out);
    return value;
}

const Value* TableReader::integer(std::string_view key, std::optional<int>& out, int min, int max,
                                  std::string_view unit) {
    int read = 0;
    const Value* value = read_integer(key, read, min, max, unit);
    if (value != nullptr) out = read;
    describe_integer(key, min, max, unit, out);
    return value;
}

const Value* TableReader::read_integer(std::string_view key, int& out, int min, int max,
                                       std::string_view unit) {
    const Value* value = any(key);
    if (value == nullptr) return nullptr;
    const std::string_view gap = unit.empty() ? "" : " ";
    const auto* read = std::get_if<std::int64_t>(&value->data);
    if (read == nullptr) {
        error(*value, key,
              fmt::format("is {}; it must be a whole number, {}..{}{}{}", type_name(*value), min, max, gap,
                          unit));
        return nullptr;
    }
    if (*read < min || *read > max) {
        error(*value, key, fmt::format("is {}; it must be {}..{}{}{}", *read, min, max, gap, unit));
        return nullptr;
    }
    out = static_cast<int>(*read);
    return value;
}

const Value* TableReader::boolean(std::string_view key, bool& out) {
    const Value* value = any(key);
    const bool* read = value == nullptr ? nullptr : std::get_if<bool>(&value->data);
    if (value != nullptr && read == nullptr)
        error(*value, key, fmt::format("is {}; it must be true or false", type_name(*value)));
    if (read != nullptr) out = *read;
    if (errors_.keys() != nullptr) describe(key, "true, false", to_toml(out));
    return read == nullptr ? nullptr : value;
}

const Value* TableReader::text(std::string_view key, std::string& out) {
    const Value* value = read_text(key, out);
    // No key may hold an empty text: that means none.
    if (errors_.keys() != nullptr)
        describe(key, "text", out.empty() ? std::nullopt : std::optional(to_toml(std::string_view(out))));
    return value;
}

const Value* TableReader::read_text(std::string_view key, std::string& out) {
    const Value* value = any(key);
    if (value == nullptr) return nullptr;
    const auto* read = std::get_if<std::string>(&value->data);
    if (read == nullptr) {
        error(*value, key, fmt::format("is {}; it must be text in quotes", type_name(*value)));
        return nullptr;
    }
    out = *read;
    return value;
}

const Value* TableReader::name_of(std::string_view key, std::size_t& out,
                                  std::span<const std::string_view> names) {
    std::string read;
    const Value* value = read_text(key, read);
    const auto found = std::find(names.begin(), names.end(), read);
    if (value != nullptr && found == names.end()) {
        error(*value, key,
              fmt::format("is \"{}\"; it must be {}{}{}", read, names.size() > 1 ? "one of " : "",
                          list_of(names), suggestion(read, names)));
        value = nullptr;
    }
    if (value != nullptr) out = static_cast<std::size_t>(found - names.begin());
    if (errors_.keys() != nullptr) describe(key, list_of(names), to_toml(names[out]));
    return value;
}

const Value* TableReader::numbers(std::string_view key, std::span<double> out, const Range& range,
                                  std::string_view wanted) {
    const Value* value = read_numbers(key, out, range, wanted);
    if (errors_.keys() != nullptr) {
        describe(key, fmt::format("{} x {}", out.size(), bounds_of(range)),
                 to_toml(std::span<const double>(out)));
        errors_.keys()->at(path_, key).unit = range.unit;
    }
    return value;
}

const Value* TableReader::read_numbers(std::string_view key, std::span<double> out, const Range& range,
                                       std::string_view wanted) {
    const Value* value = any(key);
    if (value == nullptr) return nullptr;
    const auto* list = std::get_if<Array>(&value->data);
    if (list == nullptr || list->items.size() != out.size()) {
        error(*value, key, fmt::format("is {}; it must be {}", type_name(*value), wanted));
        return nullptr;
    }
    bool good = true;
    for (std::size_t i = 0; i < out.size(); ++i) {
        double read = 0.0;
        if (as_number(list->items[i], read) && read >= range.min && read <= range.max) {
            out[i] = read;
            continue;
        }
        good = false;
        error(list->items[i], key,
              fmt::format("holds what is not a number {}; it must be {}", to_text(range), wanted));
    }
    return good ? value : nullptr;
}

TableReader TableReader::table(std::string_view key) {
    const Value* value = any(key);
    if (value == nullptr) return {errors_, nullptr, {}, key_path(key)};
    const auto* below = std::get_if<Table>(&value->data);
    if (below == nullptr)
        error(*value, key, fmt::format("is {}; it must be a table: [{}]", type_name(*value), key_path(key)));
    return {errors_, below, value->place, key_path(key)};
}

void TableReader::require(std::string_view key, std::string_view wanted) {
    if (KeyLog* keys = errors_.keys(); keys != nullptr) keys->at(path_, key).required = true;
    if (has(key)) return;
    errors_.add(place_, key_path(key), fmt::format("is missing; it must be {}", wanted));
}

void TableReader::finish() {
    if (table_ == nullptr) return;
    for (const Value& value : table_->entries) {
        if (std::find(known_.begin(), known_.end(), value.key) != known_.end()) continue;
        std::string hint = suggestion(value.key, known_);
        if (hint.empty()) hint = fmt::format("; keys here: {}", list_of(known_));
        errors_.add(value.key_place, key_path(value.key), fmt::format("unknown key{}", hint));
    }
}

void read_tables(TableReader& owner, ErrorList& errors, std::string_view key, std::string_view list_path,
                 std::size_t there, std::size_t most, const ReadItem& read) {
    const Value* value = owner.any(key);
    if (value == nullptr) return;
    const auto* list = std::get_if<Array>(&value->data);
    if (list == nullptr) {
        owner.error(*value, key, fmt::format("must be tables: write [[{}]] in double brackets", list_path));
        return;
    }
    if (const std::size_t count = there + list->items.size(); count > most) {
        const std::string_view whose = there > 0 ? " with the preset's" : "";
        owner.error(*value, key, fmt::format("makes {}{}; at most {}", count, whose, most));
        return;
    }
    int number = 0;
    for (const Value& item : list->items) {
        const auto* table = std::get_if<Table>(&item.data);
        if (table == nullptr) {
            owner.error(item, key, fmt::format("holds {}; write [[{}]] tables", type_name(item), list_path));
            continue;
        }
        TableReader reader(errors, table, item.place, fmt::format("{}[{}]", owner.key_path(key), ++number));
        read(reader);
        reader.finish();
    }
}

}  // namespace skyig::config
