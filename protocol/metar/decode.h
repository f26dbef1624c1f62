// METAR and SPECI reports from text.
#pragma once

#include <optional>
#include <string_view>

#include "protocol/metar/report.h"

namespace skyig::protocol::metar {

/// Takes the next report, with the = that ends it and without blanks around it, off `text`; nothing when only
/// blanks are left.
[[nodiscard]] std::optional<std::string_view> next_report(std::string_view& text) noexcept;

/// Reads one report, up to its = or the text's end. Capitals or not, any control characters and blanks
/// between groups, any bytes at all: a group that is wrong is told in `problems`, one of no known kind stands
/// in `unparsed`, the others are read. Behind the station and the time groups may stand in any order.
[[nodiscard]] Report decode(std::string_view text);

}  // namespace skyig::protocol::metar
