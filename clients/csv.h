// Tables of comma-separated text, read record by record with every byte kept, so that columns can be added to
// a file of someone else's.
#pragma once

#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skyig::clients {

struct CsvRecord {
    /// Counted from 1.
    std::size_t line = 0;
    /// As it stood, without the line's end.
    std::string text;
    /// "\n" or "\r\n".
    std::string_view line_end = "\n";
    /// Without the blanks around a field and the quotes around a quoted one.
    std::vector<std::string> fields;
    /// False: a quote is not closed on its line; the fields are not to be trusted.
    bool well_formed = true;
    /// Longer than kMostLineBytes: text and fields are empty, and the next record is that of the next line.
    bool too_long = false;
};

inline constexpr std::size_t kMostLineBytes = std::size_t{1} << 20U;

/// Gives the records of a stream. Empty lines and lines that begin with '#', blanks before it or not, are
/// left out; a byte order mark is dropped. A field in double quotes may hold commas and doubled quotes, not
/// line ends.
class CsvReader {
  public:
    explicit CsvReader(std::istream& stream) : stream_(stream) {}

    /// Nothing at the end of the stream, or where it cannot be read any further: see failed().
    [[nodiscard]] std::optional<CsvRecord> next();
    /// The stream gave an error, and what follows line() is not known.
    [[nodiscard]] bool failed() const noexcept { return stream_.bad(); }
    /// Lines read so far, those left out too.
    [[nodiscard]] std::size_t line() const noexcept { return line_; }

  private:
    bool read_line(CsvRecord& record);

    std::istream& stream_;
    std::size_t line_ = 0;
};

/// A whole field as a number; blanks around it, a plus sign and exponents are allowed. Nothing when it is
/// another text, infinite or not-a-number.
[[nodiscard]] std::optional<double> parse_number(std::string_view text) noexcept;

}  // namespace skyig::clients
