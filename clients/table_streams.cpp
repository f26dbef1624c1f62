#include "clients/table_streams.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <system_error>

namespace skyig::clients {
namespace {

constexpr const char* kStandardStream = "-";

}  // namespace

TableStreams::TableStreams(const std::string& in_path, const std::string& out_path,
                           const std::string& out_option)
    : input_name_(in_path == kStandardStream ? "standard input" : in_path),
      out_path_(out_path),
      to_file_(!out_path.empty() && out_path != kStandardStream) {
    if (in_path == kStandardStream) return;
    input_file_.open(in_path);
    if (!input_file_) throw std::runtime_error(fmt::format("{}: cannot be read", in_path));
    std::error_code none;
    if (to_file_ && std::filesystem::equivalent(in_path, out_path, none))
        throw WrongUsage(fmt::format("{} is the table that is read; name another file", out_option));
}

std::istream& TableStreams::input() noexcept {
    return input_file_.is_open() ? static_cast<std::istream&>(input_file_) : std::cin;
}

std::ostream& TableStreams::output() noexcept {
    return to_file_ ? static_cast<std::ostream&>(output_file_) : std::cout;
}

std::ostream& TableStreams::open_output() {
    if (to_file_) output_file_.open(out_path_, std::ios::binary);
    if (!output()) throw std::runtime_error(fmt::format("{}: cannot be written", out_path_));
    return output();
}

void TableStreams::finish() {
    // An error of C's stream looks to std::cin like the end.
    if (!input_file_.is_open() && std::ferror(stdin) != 0)
        throw std::runtime_error(fmt::format("{}: cannot be read", input_name_));
    output().flush();
    if (!output())
        throw std::runtime_error(
            fmt::format("{}: cannot be written", to_file_ ? out_path_ : "standard output"));
}

}  // namespace skyig::clients
