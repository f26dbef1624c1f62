// Tables of truth as text, clients/csv.h with one heading line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace skyig::clients::bench {

class TruthTable {
  public:
    /// Throws std::runtime_error that names the file, and the line where one is bad.
    explicit TruthTable(const std::filesystem::path& path);

    [[nodiscard]] std::size_t rows() const noexcept { return rows_.size(); }
    /// Throws std::runtime_error when there is no such column.
    [[nodiscard]] const std::string& text(std::size_t row, std::string_view column) const;
    /// Throws std::runtime_error too when the field is no number.
    [[nodiscard]] double number(std::size_t row, std::string_view column) const;

  private:
    std::string name_;
    std::vector<std::string> heading_;
    std::vector<std::vector<std::string>> rows_;
};

}  // namespace skyig::clients::bench
