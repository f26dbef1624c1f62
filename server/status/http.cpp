#include "server/status/http.h"

#include <fmt/format.h>

#include <algorithm>

namespace skyig::server::status {

namespace {

constexpr std::size_t kLongestMethod = 16;

bool is_upper(char c) noexcept {
    return c >= 'A' && c <= 'Z';
}

/// Visible ASCII, space and tab: all that a head may hold here.
bool is_text(char c) noexcept {
    return c == '\t' || (c >= ' ' && c <= '~');
}

char lower(char c) noexcept {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string_view trimmed(std::string_view text) noexcept {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Takes the next line off `rest`, without its end.
std::string_view take_line(std::string_view& rest) noexcept {
    const std::size_t end = rest.find("\r\n");
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 2);
    return line;
}

/// Whether these bytes can be the beginning of a head: a method in capitals, then text and line ends.
bool may_begin_head(std::string_view bytes) noexcept {
    const std::size_t method = std::min(bytes.find(' '), bytes.size());
    if (method > kLongestMethod || !std::all_of(bytes.begin(), bytes.begin() + method, is_upper))
        return false;
    if (method == 0 && !bytes.empty()) return false;
    return std::all_of(bytes.begin(), bytes.end(),
                       [](char c) { return is_text(c) || c == '\r' || c == '\n'; });
}

HeadState read_request_line(std::string_view line, HttpRequest& request) noexcept {
    const std::size_t method = line.find(' ');
    const std::size_t target = line.rfind(' ');
    if (method == std::string_view::npos || target <= method + 1 || line[method + 1] != '/')
        return HeadState::kBad;
    const std::string_view version = line.substr(target + 1);
    if (!version.starts_with("HTTP/")) return HeadState::kBad;
    request.method = line.substr(0, method);
    request.version = version;
    request.path = line.substr(method + 1, target - method - 1);
    if (request.path.find(' ') != std::string_view::npos) return HeadState::kBad;
    const std::size_t query = request.path.find_first_of("?#");
    if (query != std::string_view::npos && request.path[query] == '?')
        request.query = request.path.substr(query + 1);
    request.path = request.path.substr(0, query);
    return version == "HTTP/1.1" || version == "HTTP/1.0" ? HeadState::kComplete : HeadState::kBadVersion;
}

std::string_view reason_phrase(int status) noexcept {
    switch (status) {
        case 200:
            return "OK";
        case 400:
            return "Bad Request";
        case 401:
            return "Unauthorized";
        case 403:
            return "Forbidden";
        case 404:
            return "Not Found";
        case 405:
            return "Method Not Allowed";
        case 426:
            return "Upgrade Required";
        case 431:
            return "Request Header Fields Too Large";
        case 503:
            return "Service Unavailable";
        case 505:
            return "HTTP Version Not Supported";
        default:
            return "Error";
    }
}

/// Host without its port; of an IPv6 address with its brackets.
std::string_view without_port(std::string_view host) noexcept {
    const std::size_t bracket = host.starts_with('[') ? host.find(']') : std::string_view::npos;
    return host.substr(0, bracket == std::string_view::npos ? host.rfind(':') : bracket + 1);
}

}  // namespace

bool same_word(std::string_view a, std::string_view b) noexcept {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower(x) == lower(y); });
}

HttpAnswer line_answer(int status, std::string_view line) {
    HttpAnswer answer;
    answer.status = status;
    answer.body = std::make_shared<const std::string>(fmt::format("{}\n", line));
    return answer;
}

Head read_head(std::string_view bytes) noexcept {
    if (!may_begin_head(bytes.substr(0, kMaxHeadBytes))) return {HeadState::kBad, {}};
    const std::size_t end = bytes.substr(0, kMaxHeadBytes).find("\r\n\r\n");
    if (end == std::string_view::npos)
        return {bytes.size() >= kMaxHeadBytes ? HeadState::kTooLong : HeadState::kIncomplete, {}};
    std::string_view rest = bytes.substr(0, end);
    Head head;
    head.state = read_request_line(take_line(rest), head.request);
    head.request.fields = rest;
    while (head.state == HeadState::kComplete && !rest.empty()) {
        const std::string_view line = take_line(rest);
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos || colon == 0) return {HeadState::kBad, {}};
    }
    head.request.host = without_port(field(head.request, "host"));
    return head;
}

std::string_view field(const HttpRequest& request, std::string_view name) noexcept {
    std::string_view rest = request.fields;
    while (!rest.empty()) {
        const std::string_view line = take_line(rest);
        const std::size_t colon = std::min(line.find(':'), line.size());
        if (same_word(line.substr(0, colon), name) && colon < line.size())
            return trimmed(line.substr(colon + 1));
    }
    return {};
}

bool is_local_name(std::string_view host) noexcept {
    // No name has brackets: what stands in them is an IPv6 address or nothing that leads anywhere.
    return host.empty() || same_word(host, "localhost") ||
           host.find_first_not_of("0123456789.") == host.npos ||
           (host.starts_with('[') && host.ends_with(']'));
}

std::string answer_head(const HttpAnswer& answer) {
    // What has no end has no length.
    const std::string length =
        answer.endless ? std::string()
                       : fmt::format("Content-Length: {}\r\n", answer.body ? answer.body->size() : 0);
    return fmt::format(
        "HTTP/1.1 {} {}\r\nContent-Type: {}\r\n{}{}{}Cache-Control: no-store\r\n"
        "X-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n",
        answer.status, reason_phrase(answer.status), answer.content_type, length,
        answer.status == 405 ? "Allow: GET, HEAD\r\n" : "", answer.more_fields);
}

}  // namespace skyig::server::status
