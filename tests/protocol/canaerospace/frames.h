// Frames for tests, written as candump writes them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/can_frame.h"

namespace skyig::protocol::canaerospace {

inline constexpr std::int64_t kMs = 1'000'000;
inline constexpr std::int64_t kSecond = 1'000'000'000;
/// When the tests begin.
inline constexpr std::int64_t kStart = 1'718'994'600 * kSecond;

/// The frame of "137#0102001040200000", received `after_ns` after kStart. Fails the test if it is none.
[[nodiscard]] CanFrame frame(std::string_view text, std::int64_t after_ns = 0);

/// A frame with a FLOAT; node 1.
[[nodiscard]] CanFrame float_frame(std::uint32_t id, std::uint8_t message_code, float value,
                                   std::int64_t after_ns, std::uint16_t channel = 0,
                                   std::uint8_t service_code = 0);

[[nodiscard]] std::string read_data(const std::string& name);

}  // namespace skyig::protocol::canaerospace
