// One page from an HTTP server, with an end to the waiting.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/result.h"
#include "server/clock.h"

namespace skyig::clients::status {

/// Where a daemon tells of itself: "http://127.0.0.1:8006".
struct Url {
    /// A name or an IPv4 address.
    std::string host = "127.0.0.1";
    std::uint16_t port = 8006;

    friend bool operator==(const Url&, const Url&) = default;
};

/// "http://HOST", "http://HOST:PORT", a slash or "/status" behind it; "http://" may be left out. Without a
/// port it is that of a daemon, not 80. The error is one line that says what would be right.
[[nodiscard]] protocol::Result<Url, std::string> parse_url(std::string_view text);
[[nodiscard]] std::string to_string(const Url& url);

/// The page's body. The error is a few words: "nobody listens there", "it answers 404 Not Found".
/// \param path  begins with a slash
[[nodiscard]] protocol::Result<std::string, std::string> http_get(const Url& url, std::string_view path,
                                                                  std::chrono::milliseconds limit,
                                                                  const server::Clock& clock);

/// The body of a whole answer; the error as above.
[[nodiscard]] protocol::Result<std::string, std::string> body_of(std::string_view answer);

}  // namespace skyig::clients::status
