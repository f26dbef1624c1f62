// Stars as they are typed: by number in the Yale catalogue, or the brightest by name.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skyig::clients::ephem {

struct NamedStar {
    /// Harvard Revised number.
    int hr = 0;
    /// "Sirius"; "HR 2490" for stars without a name here.
    std::string name;
};

/// "Sirius" (in capitals or not), "2491" or "HR 2491". Nothing when the catalogue has no such star.
[[nodiscard]] std::optional<NamedStar> parse_star(std::string_view text);

}  // namespace skyig::clients::ephem
