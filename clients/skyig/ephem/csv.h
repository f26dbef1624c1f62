// Tables of comma-separated text, read record by record with every byte kept, so that columns can be added to
// a file of someone else's.
#pragma once

#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skyig::clients::ephem {

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
};

/// Gives the records of a stream. Empty lines and lines that begin with '#' are left out; a byte order mark
/// is dropped. A field in double quotes may hold commas and doubled quotes, not line ends.
class CsvReader {
  public:
    explicit CsvReader(std::istream& stream) : stream_(stream) {}

    /// Nothing at the end of the stream.
    [[nodiscard]] std::optional<CsvRecord> next();

  private:
    std::istream& stream_;
    std::size_t line_ = 0;
};

/// A whole field as a number; blanks around it, a plus sign and exponents are allowed. Nothing when it is
/// another text, infinite or not-a-number.
[[nodiscard]] std::optional<double> parse_number(std::string_view text) noexcept;

}  // namespace skyig::clients::ephem
