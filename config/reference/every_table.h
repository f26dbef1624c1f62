// A settings file in which every table and every alternative occurs, so that reading it asks for every key.
#pragma once

#include <string_view>

namespace skyig::config::reference {

/// It is for the log of keys alone: what it leaves out and the files it names make errors, which are of no
/// interest.
[[nodiscard]] std::string_view every_table() noexcept;

}  // namespace skyig::config::reference
