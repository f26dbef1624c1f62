// SHA-1, for the handshake of WebSockets alone, which asks for it (RFC 6455, 4.2.2). It guards nothing.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace skyig::clients::instructor {

/// FIPS 180-4, 6.1.
[[nodiscard]] std::array<std::uint8_t, 20> sha1(std::string_view bytes);

}  // namespace skyig::clients::instructor
