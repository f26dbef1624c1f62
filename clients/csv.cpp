#include "clients/csv.h"

#include <array>
#include <charconv>
#include <cmath>
#include <ios>
#include <utility>

namespace skyig::clients {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kBlanks = " \t";

std::string_view trimmed(std::string_view text) noexcept {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// A quoted field that starts at `at`, the opening quote; moves `at` behind the closing one.
std::optional<std::string> quoted_field(std::string_view text, std::size_t& at) {
    std::string field;
    for (++at; at < text.size(); ++at) {
        if (text[at] != '"') {
            field.push_back(text[at]);
        } else if (at + 1 < text.size() && text[at + 1] == '"') {
            field.push_back('"');
            ++at;
        } else {
            ++at;
            return field;
        }
    }
    return std::nullopt;
}

bool split(std::string_view text, std::vector<std::string>& fields) {
    std::size_t at = 0;
    while (true) {
        const std::size_t first = text.find_first_not_of(kBlanks, at);
        if (first != std::string_view::npos && text[first] == '"') {
            at = first;
            std::optional<std::string> field = quoted_field(text, at);
            if (!field) return false;
            fields.push_back(std::move(*field));
            at = text.find_first_not_of(kBlanks, at);
            if (at != std::string_view::npos && text[at] != ',') return false;
        } else {
            const std::size_t end = text.find(',', at);
            fields.emplace_back(trimmed(text.substr(at, end == std::string_view::npos ? end : end - at)));
            at = end;
        }
        if (at == std::string_view::npos) return true;
        ++at;
    }
}

}  // namespace

/// Piece by piece, so that a line without end takes no memory without end.
bool CsvReader::read_line(CsvRecord& record) {
    constexpr std::size_t kPieceBytes = 4096;
    std::array<char, kPieceBytes> piece;  // NOLINT: what is not read into is not looked at
    for (bool any = false;; any = true) {
        stream_.getline(piece.data(), static_cast<std::streamsize>(piece.size()));
        if (stream_.bad()) return false;
        const bool has_line_end = stream_.good();
        const auto count = static_cast<std::size_t>(stream_.gcount()) - (has_line_end ? 1U : 0U);
        if (stream_.eof() && count == 0) return any;
        record.too_long = record.too_long || record.text.size() + count > kMostLineBytes;
        if (record.too_long) {
            record.text.clear();
        } else {
            record.text.append(piece.data(), count);
        }
        if (!stream_.fail()) return true;
        // The piece is full and the line goes on.
        stream_.clear();
    }
}

std::optional<CsvRecord> CsvReader::next() {
    while (true) {
        CsvRecord record;
        if (!read_line(record)) return std::nullopt;
        ++line_;
        record.line = line_;
        if (record.too_long) return record;
        if (line_ == 1 && record.text.starts_with(kByteOrderMark))
            record.text.erase(0, kByteOrderMark.size());
        if (record.text.ends_with('\r')) {
            record.text.pop_back();
            record.line_end = "\r\n";
        }
        const std::string_view content = trimmed(record.text);
        if (content.empty() || content.front() == '#') continue;
        record.well_formed = split(record.text, record.fields);
        return record;
    }
}

std::optional<double> parse_number(std::string_view text) noexcept {
    text = trimmed(text);
    if (text.starts_with('+') && text.size() > 1 && text[1] != '-') text.remove_prefix(1);
    double value = 0.0;
    const std::from_chars_result result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

}  // namespace skyig::clients
