// Words as they are typed: in capitals or not.
#pragma once

#include <algorithm>
#include <cctype>
#include <string_view>

namespace skyig::clients {

/// Equal but for the case of ASCII letters.
[[nodiscard]] inline bool same_letters(std::string_view a, std::string_view b) noexcept {
    const auto same = [](char x, char y) {
        return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
    };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

}  // namespace skyig::clients
