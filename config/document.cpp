#include "config/document.h"

#include <algorithm>

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
// Lists and tables in one another may each be on a line of their own, with its own dots; no setting has
// three.
#define TOML_MAX_NESTED_VALUES 16
// The library asserts where a malformed file only has to be refused, which its parser then does.
#define TOML_ASSERT(expression) static_cast<void>(0)
#include <toml++/toml.h>

namespace skyig::config {
namespace {

/// The library recurses once for every part of a dotted key, and so do we after it; no setting has more than
/// two.
constexpr int kMaxDotsPerLine = 32;

/// Walks over TOML text and tells the dots that are part of neither a string nor a comment. It is in step
/// with the library up to the first syntax error, where the library stops.
class DotCounter {
  public:
    explicit DotCounter(std::string_view text) noexcept : text_(text) {}

    /// Where a line has more than kMaxDotsPerLine dots; line 0 if none has.
    [[nodiscard]] Place too_many() noexcept {
        int dots = 0;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '\n') {
                dots = 0;
                start_line();
            } else if (c == '#') {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else if (c == '"' || c == '\'') {
                const int line = line_;
                skip_string(c);
                if (line_ != line) dots = 0;
            } else {
                if (c == '.' && ++dots > kMaxDotsPerLine)
                    return {line_, static_cast<int>(at_ - line_begin_) + 1};
                ++at_;
            }
        }
        return {};
    }

  private:
    void start_line() noexcept {
        ++line_;
        line_begin_ = ++at_;
    }

    [[nodiscard]] bool three_quotes(char quote) const noexcept {
        return text_.size() - at_ >= 3 && text_[at_] == quote && text_[at_ + 1] == quote &&
               text_[at_ + 2] == quote;
    }

    void skip_string(char quote) noexcept {
        const bool many_lines = three_quotes(quote);
        at_ += many_lines ? 3 : 1;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '\n') {
                if (!many_lines) return;
                start_line();
            } else if (c == '\\' && quote == '"' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') {
                at_ += 2;
            } else if (c == quote && (!many_lines || three_quotes(quote))) {
                at_ += many_lines ? 3 : 1;
                // Up to two quotes before the closing three belong to the string.
                for (int i = 0; many_lines && i < 2 && at_ < text_.size() && text_[at_] == quote; ++i)
                    ++at_;
                return;
            } else {
                ++at_;
            }
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t line_begin_ = 0;
    int line_ = 1;
};

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
    if (const Place place = DotCounter(text).too_many(); place.line > 0) {
        error.line = place.line;
        error.column = place.column;
        error.message =
            "keys are nested too deep: more than " + std::to_string(kMaxDotsPerLine) + " dots on a line";
        return false;
    }
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
