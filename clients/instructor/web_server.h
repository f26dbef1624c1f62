// The station's port: pages over HTTP, one WebSocket a page. One thread owns all sockets and calls step();
// nobody who connects can make it wait, grow or starve the others.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <poll.h>

#include "clients/instructor/admission.h"
#include "protocol/result.h"
#include "protocol/transport/tcp.h"
#include "server/clock.h"
#include "server/status/http.h"

namespace skyig::clients::instructor {

struct WebOptions {
    /// Port 0: the system's choice.
    protocol::transport::Endpoint listen{0x7F000001, 8080};
    std::string token;
    std::vector<std::string> names;
    /// Pages at once, a WebSocket each; one more is told so.
    std::size_t sockets = 64;
    /// Connections that are no WebSocket, or not yet; for one more the oldest of them gives way, so that
    /// nobody can keep pages out by connecting and asking nothing.
    std::size_t connections = 32;
    /// Longer messages end the connection.
    std::size_t most_message_bytes = std::size_t{64} << 10U;
    /// Messages and pings a second of one page; twice as many may come at once. More are thrown away, and
    /// whoever has ten times as many thrown away is ended.
    double messages_per_s = 50.0;
    /// For a page over HTTP, from the connection on; and how long what was sent over a WebSocket may wait for
    /// a client that does not read, or whose machine is gone without a word.
    std::chrono::milliseconds time_limit{5000};
    /// What may wait to be sent to one client.
    std::size_t most_waiting_bytes = std::size_t{1} << 20U;
};

/// Everything that happened at the port since the start.
struct WebCounts {
    std::uint64_t connections = 0;
    std::uint64_t pages = 0;           ///< answered over HTTP
    std::uint64_t sockets = 0;         ///< WebSockets opened
    std::uint64_t messages = 0;        ///< taken
    std::uint64_t refused_full = 0;    ///< WebSockets beyond the most
    std::uint64_t gave_way = 0;        ///< connections without a WebSocket that gave way to a newer one
    std::uint64_t refused_bad = 0;     ///< no HTTP, another method, no such page, a wrong handshake
    std::uint64_t refused_host = 0;    ///< another name in Host
    std::uint64_t refused_origin = 0;  ///< a page from elsewhere, or none
    std::uint64_t refused_token = 0;   ///< no token or a wrong one
    std::uint64_t too_big = 0;         ///< ended for a message that is too long
    std::uint64_t not_frames = 0;      ///< ended for what is no text in frames
    std::uint64_t rate_limited = 0;    ///< messages thrown away
    std::uint64_t ended_for_rate = 0;  ///< connections ended for them
    std::uint64_t ended_for_slow = 0;  ///< connections ended that do not read, or have gone without a word
    std::uint64_t timed_out = 0;       ///< pages that were not asked for, or not read, in time
    std::uint64_t skipped = 0;         ///< pictures and updates left out for who reads slowly
};

struct NamedWebCount {
    std::string_view name;
    std::uint64_t WebCounts::*value;
};
inline constexpr std::array kWebCountNames{
    NamedWebCount{"connections", &WebCounts::connections},
    NamedWebCount{"pages", &WebCounts::pages},
    NamedWebCount{"sockets", &WebCounts::sockets},
    NamedWebCount{"messages", &WebCounts::messages},
    NamedWebCount{"refused_full", &WebCounts::refused_full},
    NamedWebCount{"gave_way", &WebCounts::gave_way},
    NamedWebCount{"refused_bad", &WebCounts::refused_bad},
    NamedWebCount{"refused_host", &WebCounts::refused_host},
    NamedWebCount{"refused_origin", &WebCounts::refused_origin},
    NamedWebCount{"refused_token", &WebCounts::refused_token},
    NamedWebCount{"too_big", &WebCounts::too_big},
    NamedWebCount{"not_frames", &WebCounts::not_frames},
    NamedWebCount{"rate_limited", &WebCounts::rate_limited},
    NamedWebCount{"ended_for_rate", &WebCounts::ended_for_rate},
    NamedWebCount{"ended_for_slow", &WebCounts::ended_for_slow},
    NamedWebCount{"timed_out", &WebCounts::timed_out},
    NamedWebCount{"skipped", &WebCounts::skipped},
};
static_assert(sizeof(WebCounts) == kWebCountNames.size() * sizeof(std::uint64_t));

class WebServer {
  public:
    struct Handlers {
        /// A page by its path; status 404 for none.
        std::function<server::status::HttpAnswer(std::string_view path)> page;
        /// Texts for a client that has just opened its WebSocket.
        std::function<std::vector<std::string>()> greeting;
        /// A client's text; what comes back goes to that client alone, empty: nothing.
        std::function<std::string(std::string_view text)> message;
    };

    /// The error is one line. `clock` must outlive it.
    [[nodiscard]] static protocol::Result<std::unique_ptr<WebServer>, std::string> open(
        const WebOptions& options, const server::Clock& clock, Handlers handlers);
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;
    WebServer(WebServer&&) = delete;
    WebServer& operator=(WebServer&&) = delete;
    ~WebServer();

    /// Serves what has come, or waits up to `most` for something to.
    void step(std::chrono::milliseconds most);

    /// To every page; who does not read them is ended.
    void publish(std::string_view text);
    /// To every page that has nothing waiting: there will be a newer one.
    void publish_update(std::string_view text);
    void publish_picture(std::string_view bytes);

    [[nodiscard]] std::size_t open_sockets() const noexcept;
    [[nodiscard]] const WebCounts& counts() const noexcept { return counts_; }
    [[nodiscard]] const protocol::transport::Endpoint& local() const noexcept { return listener_.local; }

  private:
    struct Client;
    using Frame = std::shared_ptr<const std::string>;

    WebServer(protocol::transport::TcpListener listener, const WebOptions& options,
              const server::Clock& clock, Handlers handlers);
    void watch();
    void take_new();
    void make_room();
    void receive(Client& client);
    void lose(Client& client, int fault);
    void read_head(Client& client);
    void upgrade(Client& client, const server::status::HttpRequest& request);
    void answer(Client& client, const server::status::HttpAnswer& answer, bool with_body);
    void refuse(Client& client, Refusal refusal);
    void read_frames(Client& client, std::string_view bytes);
    [[nodiscard]] bool may_speak(Client& client);
    void take_message(Client& client, std::string_view text);
    void end(Client& client, std::string frame);
    void push(Client& client, Frame frame);
    void send(Client& client);
    void tend(Client& client);
    void publish_if_idle(const Frame& frame);

    protocol::transport::TcpListener listener_;
    WebOptions options_;
    AdmissionRules rules_;
    const server::Clock& clock_;
    Handlers handlers_;
    std::vector<std::unique_ptr<Client>> clients_;
    std::vector<pollfd> events_;
    std::int64_t deaf_until_ns_ = 0;
    WebCounts counts_;
};

}  // namespace skyig::clients::instructor
