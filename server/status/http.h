// The part of HTTP/1.1 (RFC 9112) that a read-only server needs: one request head in, one answer out. Pure:
// no socket, no clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace skyig::server::status {

/// Longer heads are refused.
inline constexpr std::size_t kMaxHeadBytes = 4096;

struct HttpRequest {
    std::string_view method;
    /// "HTTP/1.1" or "HTTP/1.0".
    std::string_view version;
    /// Without query and fragment; not decoded: no page has a name that needs it.
    std::string_view path;
    /// What stands behind a '?', as sent.
    std::string_view query;
    /// Without port, as sent, an IPv6 address in its brackets; empty if there is none.
    std::string_view host;
    /// All header lines.
    std::string_view fields;
};

/// Alike but for capitals, as header fields and names of machines are compared.
[[nodiscard]] bool same_word(std::string_view a, std::string_view b) noexcept;

/// The value of a header field, without blanks around it; empty if there is none.
[[nodiscard]] std::string_view field(const HttpRequest& request, std::string_view name) noexcept;

struct HttpAnswer {
    int status = 200;
    std::string_view content_type = "text/plain; charset=utf-8";
    /// Shared: many may be on their way at once.
    std::shared_ptr<const std::string> body;
    /// Given, it takes the place of `body`: asked every few milliseconds, it gives null until there is
    /// something to send. Then the answer is complete, or, where it is endless, goes on with the next part.
    std::function<std::shared_ptr<const std::string>()> later{};
    bool endless = false;
    /// More header lines, each with its CR LF.
    std::string_view more_fields{};
};

/// One line as a whole answer.
[[nodiscard]] HttpAnswer line_answer(int status, std::string_view line);

enum class HeadState : std::uint8_t {
    kIncomplete,  // more has to come
    kComplete,
    kBad,         // no HTTP
    kBadVersion,  // HTTP, and neither 1.0 nor 1.1
    kTooLong
};

struct Head {
    HeadState state = HeadState::kIncomplete;
    /// When complete; points into the bytes.
    HttpRequest request;
};

/// Reads what has come so far. Bytes that can begin no request are told at once, without waiting for more.
[[nodiscard]] Head read_head(std::string_view bytes) noexcept;

/// A name that this machine alone goes by: "localhost", or an address in numbers. A page from elsewhere that
/// has its own name resolved to this machine is told by it.
[[nodiscard]] bool is_local_name(std::string_view host) noexcept;

/// Status line and header fields; the connection is closed after the answer.
[[nodiscard]] std::string answer_head(const HttpAnswer& answer);

}  // namespace skyig::server::status
