// A read-only HTTP server on one thread of its own, for a handful of clients. No client can make it wait,
// grow or starve the others: heads are short, answers come from memory, time is limited, and connections that
// do nothing give way.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "protocol/result.h"
#include "protocol/transport/endpoint.h"
#include "server/clock.h"
#include "server/status/account.h"
#include "server/status/http.h"

namespace skyig::server::status {

struct HttpOptions {
    /// Port 0: the system's choice.
    protocol::transport::Endpoint listen{0x7F000001, 0};
    std::size_t connections = 32;
    /// Of them so many may read what has no end, so that places are left for everything else.
    std::size_t endless_answers = 8;
    /// From a connection's first to its last byte; of an endless answer, from each part to the next.
    std::chrono::milliseconds time_limit{5000};
    /// A connection that has sent no whole request after so long gives way when others wait.
    std::chrono::milliseconds gives_way_after{500};
    /// More wait with the system: so many a second are taken.
    std::size_t connections_per_s = 500;
};

class HttpServer {
  public:
    /// Called on the server's thread, for GET and HEAD alike; `counts` are its own.
    using Handler = std::function<HttpAnswer(std::string_view path, const PortCounts& counts)>;

    /// Binds and starts the thread. `clock` must outlive it. The error is one line: "tcp 127.0.0.1:8006:
    /// address already in use; ...".
    [[nodiscard]] static protocol::Result<std::unique_ptr<HttpServer>, std::string> open(
        const HttpOptions& options, const Clock& clock, Handler handler);
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;
    HttpServer(HttpServer&&) = delete;
    HttpServer& operator=(HttpServer&&) = delete;
    /// Stops at once, whoever is connected.
    ~HttpServer();

    /// Where it listens, with the port that the system chose.
    [[nodiscard]] protocol::transport::Endpoint local() const noexcept;
    /// From any thread.
    [[nodiscard]] PortCounts counts() const noexcept;

  private:
    class Loop;
    explicit HttpServer(std::unique_ptr<Loop> loop) noexcept;

    std::unique_ptr<Loop> loop_;
};

}  // namespace skyig::server::status
