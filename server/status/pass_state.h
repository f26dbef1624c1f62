// One pass of the last frame's plan, for people.
#pragma once

#include <cstddef>
#include <string_view>

namespace skyig::server::status {

inline constexpr std::size_t kMostPasses = 32;

/// Both texts are literals.
struct PassState {
    std::string_view name;
    bool needed = false;
    std::string_view reason;
};

}  // namespace skyig::server::status
