// The settings that hold, as a file that brings them about again.
#pragma once

#include <string>
#include <string_view>

#include "config/key_log.h"

namespace skyig::config::reference {

/// TOML of everything that a reading asked for. What the file gives stands as it is given; what it leaves out
/// follows as a comment with the value that holds: its default, or what a preset says. Keys that have no
/// value unless given are told as comments without one.
[[nodiscard]] std::string effective_text(const KeyLog& keys);

/// "channel.display" of "channel[2].display".
[[nodiscard]] std::string without_numbers(std::string_view path);

}  // namespace skyig::config::reference
