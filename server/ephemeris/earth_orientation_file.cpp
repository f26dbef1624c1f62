// Reads the three forms of files of Earth orientation.
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "server/ephemeris/earth_orientation.h"

namespace skyig::server::ephemeris {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{16} << 20U;
constexpr std::string_view kHeading = "mjd,ut1_minus_utc_s,x_arcsec,y_arcsec";
constexpr std::string_view kBlanks = " \t\r";
constexpr double kFirstMjd = 15020.0;  // 1900-01-01
constexpr double kLastMjd = 88434.0;   // 2101-01-01
constexpr double kMostApart_days = 31.0;

enum class Form { kUnknown, kFinals, kC04, kCommas };

/// The four fields of a line as text, without blanks around them.
using Fields = std::array<std::string_view, 4>;
struct Quantity {
    std::string_view name;
    double least;
    double most;
};
constexpr std::array<Quantity, 4> kQuantities{
    Quantity{"mjd", kFirstMjd, kLastMjd}, Quantity{"UT1-UTC in s", -1.0, 1.0},
    Quantity{"pole x in arcsec", -1.0, 1.0}, Quantity{"pole y in arcsec", -1.0, 1.0}};

std::string_view trimmed(std::string_view text) noexcept {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Columns counted from 1, both included.
std::string_view columns(std::string_view line, std::size_t from, std::size_t to) noexcept {
    if (line.size() < from) return {};
    return trimmed(line.substr(from - 1, to - from + 1));
}

std::string_view take_word(std::string_view& line) noexcept {
    line.remove_prefix(std::min(line.size(), line.find_first_not_of(kBlanks)));
    const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
    line.remove_prefix(word.size());
    return word;
}

bool is_number(std::string_view text, double& value) noexcept {
    const char* const end = text.data() + text.size();
    const auto [stop, fault] = std::from_chars(text.data(), end, value);
    return fault == std::errc{} && stop == end && std::isfinite(value);
}

Fields finals_fields(std::string_view line) noexcept {
    return {columns(line, 8, 15), columns(line, 59, 68), columns(line, 19, 27), columns(line, 38, 46)};
}

Fields c04_fields(std::string_view line) noexcept {
    std::array<std::string_view, 8> words;
    for (std::string_view& word : words)
        word = take_word(line);
    return {words[4], words[7], words[5], words[6]};
}

/// A missing field is empty; what is too much stays in the last, which is then no number.
Fields comma_fields(std::string_view line) noexcept {
    Fields fields;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const std::size_t comma = i + 1 < fields.size() ? line.find(',') : std::string_view::npos;
        fields[i] = trimmed(line.substr(0, comma));
        line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
    }
    return fields;
}

/// By the first line: both IERS forms have the day's number where only they have it.
Form form_of(std::string_view line) noexcept {
    double mjd = 0.0;
    if (trimmed(line) == kHeading) return Form::kCommas;
    if (line.size() > 12 && line[12] == '.' && is_number(columns(line, 8, 15), mjd)) return Form::kFinals;
    const std::string_view c04_mjd = c04_fields(line)[0];
    if (line.find(',') == std::string_view::npos && is_number(c04_mjd, mjd)) return Form::kC04;
    return Form::kUnknown;
}

/// The beginning of a field, fit to be printed.
std::string shown(std::string_view text) {
    constexpr std::size_t kMost = 24;
    std::string begin(text.substr(0, kMost));
    std::replace_if(
        begin.begin(), begin.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return begin;
}

class FileReader {
  public:
    explicit FileReader(std::string file_name) : file_name_(std::move(file_name)) {}

    EarthOrientationResult read(std::string_view text) {
        while (!text.empty() && error_.empty()) {
            ++line_number_;
            const std::string_view line = text.substr(0, text.find('\n'));
            text.remove_prefix(std::min(text.size(), line.size() + 1));
            if (!trimmed(line).empty() && line.front() != '#') read_line(line);
        }
        if (error_.empty() && rows_.size() < 2) {
            error_ = fmt::format("{}: holds {} of the at least two days that are needed", file_name_,
                                 rows_.empty() ? "none" : "one");
        }
        if (!error_.empty()) return {std::nullopt, std::move(error_)};
        return {EarthOrientation(rows_), {}};
    }

  private:
    void fail(const std::string& message) {
        error_ = fmt::format("{}:{}: {}", file_name_, line_number_, message);
    }

    void read_line(std::string_view line) {
        if (form_ == Form::kUnknown) {
            form_ = form_of(line);
            if (form_ == Form::kUnknown) {
                fail(
                    fmt::format("is no file of Earth orientation: it must be IERS finals2000A, IERS EOP 20 "
                                "C04, or begin with the line {}",
                                kHeading));
            }
            if (form_ == Form::kUnknown || form_ == Form::kCommas) return;
        }
        const Fields fields = form_ == Form::kFinals ? finals_fields(line)
                              : form_ == Form::kC04  ? c04_fields(line)
                                                     : comma_fields(line);
        // Days for which nothing is predicted yet.
        if (form_ == Form::kFinals && fields[1].empty() && fields[2].empty() && fields[3].empty()) return;
        add(fields);
    }

    void add(const Fields& fields) {
        std::array<double, 4> values{};
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const Quantity& quantity = kQuantities[i];
            const bool good =
                is_number(fields[i], values[i]) && values[i] >= quantity.least && values[i] <= quantity.most;
            if (good) continue;
            fail(fmt::format("{} is \"{}\"; it must be a number {:g}..{:g}", quantity.name, shown(fields[i]),
                             quantity.least, quantity.most));
            return;
        }
        if (!rows_.empty()) {
            const double step_days = values[0] - rows_.back().mjd;
            if (!(step_days > 0.0 && step_days <= kMostApart_days)) {
                fail(fmt::format("mjd is {} after {}; days must ascend by at most {:g}", values[0],
                                 rows_.back().mjd, kMostApart_days));
                return;
            }
        }
        rows_.push_back({values[0], values[1], values[2], values[3]});
    }

    std::string file_name_;
    int line_number_ = 0;
    Form form_ = Form::kUnknown;
    std::vector<EarthOrientationRow> rows_;
    std::string error_;
};

}  // namespace

EarthOrientationResult parse_earth_orientation(std::string_view text, const std::string& file_name) {
    return FileReader(file_name).read(text);
}

EarthOrientationResult read_earth_orientation(const std::string& path) {
    const auto failed = [&path](std::string_view what) {
        return EarthOrientationResult{std::nullopt, fmt::format("{}: {}", path, what)};
    };
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) return failed(fmt::format("cannot be opened: {}", std::strerror(errno)));
    std::string text(kMaxFileBytes + 1, '\0');
    const std::size_t size = std::fread(text.data(), 1, text.size(), file.get());
    if (std::ferror(file.get()) != 0) return failed(fmt::format("cannot be read: {}", std::strerror(errno)));
    if (size > kMaxFileBytes) return failed("is larger than 16 MiB: this is no file of Earth orientation");
    text.resize(size);
    return parse_earth_orientation(text, path);
}

}  // namespace skyig::server::ephemeris
