// Files of settings as text, and the errors that they bring.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "config/config.h"

namespace skyig::config::tests {

inline constexpr std::string_view kChannel = R"([[channel]]
name = "centre"
width_px = 1280
height_px = 1024
left_deg = -30
right_deg = 30
bottom_deg = -25
top_deg = 25
)";

/// A whole file: version, the given lines, one channel.
inline std::string with(std::string_view lines) {
    return fmt::format("version = 1\n{}\n{}", lines, kChannel);
}

inline std::vector<ConfigError> errors_of(std::string_view text) {
    return parse_config(text, "site.toml").errors;
}

/// The one error of a file that has one.
inline ConfigError error_of(std::string_view text) {
    const std::vector<ConfigError> errors = errors_of(text);
    EXPECT_EQ(errors.size(), 1U) << text;
    for (const ConfigError& error : errors)
        std::printf("  %s\n", to_text(error).c_str());
    return errors.empty() ? ConfigError{} : errors.front();
}

}  // namespace skyig::config::tests
