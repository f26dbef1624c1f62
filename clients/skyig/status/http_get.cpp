#include "clients/skyig/status/http_get.h"

#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <optional>

#include "protocol/transport/socket_address.h"
#include "protocol/transport/tcp.h"

namespace skyig::clients::status {

namespace transport = protocol::transport;
using protocol::Error;
using protocol::Result;

namespace {

constexpr std::string_view kScheme = "http://";
/// More is no status page.
constexpr std::size_t kMostBytes = std::size_t{4} << 20U;

Result<transport::Endpoint, std::string> resolve(const Url& url) {
    if (const auto address = transport::parse_ipv4(url.host)) return transport::Endpoint{*address, url.port};
    addrinfo wanted{};
    wanted.ai_family = AF_INET;
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int failure = ::getaddrinfo(url.host.c_str(), nullptr, &wanted, &found);
    if (failure != 0) return Error{std::string(::gai_strerror(failure))};
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(found, &::freeaddrinfo);
    sockaddr_in address{};
    std::memcpy(&address, found->ai_addr, sizeof(address));
    return transport::Endpoint{transport::to_endpoint(address).address, url.port};
}

/// A socket and the time that is left for it.
class Talk {
  public:
    Talk(int socket, std::chrono::milliseconds limit, const server::Clock& clock)
        : socket_(socket),
          clock_(clock),
          end_ns_(clock.monotonic_ns() + std::chrono::nanoseconds(limit).count()) {}

    [[nodiscard]] bool send(std::string_view text) {
        while (!text.empty()) {
            if (!wait(POLLOUT)) return false;
            const ssize_t sent = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
            if (sent < 0 && errno != EAGAIN && errno != EINTR) return false;
            text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(sent, 0)));
        }
        return true;
    }

    /// All until the other side ends; nothing if it does not, or breaks off.
    [[nodiscard]] std::optional<std::string> receive() {
        std::string text;
        std::array<char, 16384> buffer{};
        while (text.size() <= kMostBytes && wait(POLLIN)) {
            const ssize_t got = ::recv(socket_, buffer.data(), buffer.size(), 0);
            if (got == 0) return text;
            if (got < 0 && errno != EAGAIN && errno != EINTR) break;
            text.append(buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
        }
        return std::nullopt;
    }

  private:
    [[nodiscard]] bool wait(short events) const {
        const std::int64_t left_ms = (end_ns_ - clock_.monotonic_ns()) / 1'000'000;
        pollfd event{socket_, events, 0};
        return left_ms > 0 && ::poll(&event, 1, static_cast<int>(left_ms)) > 0;
    }

    int socket_;
    const server::Clock& clock_;
    std::int64_t end_ns_;
};

}  // namespace

Result<Url, std::string> parse_url(std::string_view text) {
    const auto wrong = [text] {
        return Error{fmt::format("'{}' is no address of a daemon; write it as http://127.0.0.1:8006", text)};
    };
    std::string_view rest = text;
    if (rest.starts_with(kScheme)) rest.remove_prefix(kScheme.size());
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const std::string_view path = rest.substr(slash);
    if (!path.empty() && path != "/" && path != "/status") return wrong();
    rest = rest.substr(0, slash);
    Url url;
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    url.host = rest.substr(0, colon);
    if (url.host.empty() || url.host.find_first_of(" @[]") != std::string::npos) return wrong();
    if (colon == rest.size()) return url;
    const std::string_view port = rest.substr(colon + 1);
    const auto [end, failure] = std::from_chars(port.data(), port.data() + port.size(), url.port);
    if (failure != std::errc{} || end != port.data() + port.size() || url.port == 0) return wrong();
    return url;
}

std::string to_string(const Url& url) {
    return fmt::format("{}{}:{}", kScheme, url.host, url.port);
}

Result<std::string, std::string> body_of(std::string_view answer) {
    const std::size_t head_end = answer.find("\r\n\r\n");
    if (!answer.starts_with("HTTP/1.") || head_end == std::string_view::npos)
        return Error{std::string("what answers there speaks no HTTP")};
    const std::string_view line = answer.substr(0, answer.find("\r\n"));
    const std::size_t space = std::min(line.find(' '), line.size() - 1);
    const std::string_view status = line.substr(space + 1);
    if (!status.starts_with("200")) return Error{fmt::format("it answers {}", status)};
    return std::string(answer.substr(head_end + 4));
}

Result<std::string, std::string> http_get(const Url& url, std::string_view path,
                                          std::chrono::milliseconds limit, const server::Clock& clock) {
    const auto to = resolve(url);
    if (!to) return Error{to.error()};
    auto socket = transport::connect_tcp(*to, limit);
    if (!socket) return Error{socket.error()};
    Talk talk(socket->get(), limit, clock);
    const std::string request =
        fmt::format("GET {} HTTP/1.1\r\nHost: {}:{}\r\nConnection: close\r\n\r\n", path, url.host, url.port);
    if (!talk.send(request)) return Error{std::string("it does not take the request")};
    const std::optional<std::string> answer = talk.receive();
    if (!answer) return Error{std::string("its answer does not end")};
    return body_of(*answer);
}

}  // namespace skyig::clients::status
