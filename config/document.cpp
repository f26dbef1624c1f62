#include "config/document.h"

#include <algorithm>

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

namespace skyig::config {
namespace {

Place place_of(const toml::source_region& region) {
    return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

Table convert_table(const toml::table& from);

std::variant<bool, std::int64_t, double, std::string, UtcDateTime, OtherDate, Array, Table> convert_date(
    const toml::date_time& from) {
    if (!from.offset || from.offset->minutes != 0) return OtherDate{};
    UtcDateTime to;
    to.year = from.date.year;
    to.month = from.date.month;
    to.day = from.date.day;
    to.hour = from.time.hour;
    to.minute = from.time.minute;
    to.second = from.time.second + from.time.nanosecond * 1e-9;
    return to;
}

Value convert(const toml::node& from) {
    Value to;
    to.place = place_of(from.source());
    to.key_place = to.place;
    if (const auto* boolean = from.as_boolean()) {
        to.data = boolean->get();
    } else if (const auto* integer = from.as_integer()) {
        to.data = integer->get();
    } else if (const auto* number = from.as_floating_point()) {
        to.data = number->get();
    } else if (const auto* text = from.as_string()) {
        to.data = text->get();
    } else if (const auto* date = from.as_date_time()) {
        to.data = convert_date(date->get());
    } else if (const auto* table = from.as_table()) {
        to.data = convert_table(*table);
    } else if (const auto* array = from.as_array()) {
        Array items;
        for (const toml::node& item : *array)
            items.items.push_back(convert(item));
        to.data = std::move(items);
    } else {
        to.data = OtherDate{};
    }
    return to;
}

Table convert_table(const toml::table& from) {
    Table to;
    for (const auto& [key, node] : from) {
        Value& value = to.entries.emplace_back(convert(node));
        value.key = key.str();
        value.key_place = place_of(key.source());
    }
    // The library sorts by name; errors read better in the order of the text.
    std::stable_sort(to.entries.begin(), to.entries.end(), [](const Value& a, const Value& b) {
        const Place &p = a.key_place, &q = b.key_place;
        return p.line != q.line ? p.line < q.line : p.column < q.column;
    });
    return to;
}

}  // namespace

const Value* Table::find(std::string_view key) const noexcept {
    for (const Value& value : entries) {
        if (value.key == key) return &value;
    }
    return nullptr;
}

bool parse_document(std::string_view text, Table& root, ConfigError& error) {
    const toml::parse_result result = toml::parse(text);
    if (!result) {
        const Place place = place_of(result.error().source());
        error.line = place.line;
        error.column = place.column;
        error.message = std::string(result.error().description());
        return false;
    }
    root = convert_table(result.table());
    return true;
}

}  // namespace skyig::config
