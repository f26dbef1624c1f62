// The two ends of a verb that adds columns to a table: files, or the standard streams by "-".
#pragma once

#include <fstream>
#include <iosfwd>
#include <stdexcept>
#include <string>

namespace skyig::clients {

/// What leads to exit status 2.
struct WrongUsage : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class TableStreams {
  public:
    /// Opens the input. \param out_path  empty is "-", too
    /// \throws std::runtime_error when it cannot be read, WrongUsage when both are one file
    TableStreams(const std::string& in_path, const std::string& out_path, const std::string& out_option);

    [[nodiscard]] std::istream& input() noexcept;
    /// As errors name it.
    [[nodiscard]] const std::string& input_name() const noexcept { return input_name_; }
    [[nodiscard]] bool to_file() const noexcept { return to_file_; }

    /// Opens the output, so that nothing is written over before the input has turned out usable.
    /// \throws std::runtime_error when it cannot be written
    std::ostream& open_output();
    /// After the last row. \throws std::runtime_error when not all was read or written
    void finish();

  private:
    [[nodiscard]] std::ostream& output() noexcept;

    std::string input_name_;
    std::string out_path_;
    bool to_file_ = false;
    std::ifstream input_file_;
    std::ofstream output_file_;
};

}  // namespace skyig::clients
