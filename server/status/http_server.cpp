#include "server/status/http_server.h"

#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

#include "protocol/transport/event_signal.h"
#include "protocol/transport/tcp.h"

namespace skyig::server::status {

namespace transport = protocol::transport;

namespace {

constexpr int kBacklog = 128;
/// Connections are counted over so long.
constexpr std::int64_t kWindow_ns = 100'000'000;
constexpr std::int64_t kMs_ns = 1'000'000;
/// How long to wait for the client's own end, so that what was sent is not torn away by a reset.
constexpr std::int64_t kLinger_ns = 1'000'000'000;
/// How often answers that come later are asked for.
constexpr std::int64_t kAskEvery_ns = 20'000'000;
/// The frame loop goes before: this thread may wait.
constexpr int kNice = 10;

void add(std::atomic<std::uint64_t>& counter) noexcept {
    counter.fetch_add(1, std::memory_order_relaxed);
}

enum class Progress : std::uint8_t { kWaits, kDone, kBroken };

/// One client: its head comes in, one answer goes out, at once or in parts as they come, then its end is
/// waited for.
struct Connection {
    enum class State : std::uint8_t { kReading, kWaiting, kWriting, kEnding };

    transport::FileDescriptor socket;
    std::int64_t since_ns = 0;
    State state = State::kReading;
    std::array<char, kMaxHeadBytes> head;
    std::size_t head_bytes = 0;
    std::string answer_head;
    /// Null: the answer is its head alone.
    std::shared_ptr<const std::string> body;
    std::size_t sent = 0;
    /// What has still to come.
    HttpAnswer pending;

    Progress receive() noexcept;
    Progress send() noexcept;
    /// Throws away what still comes.
    Progress end() noexcept;
};

Progress Connection::receive() noexcept {
    const ssize_t got = ::recv(socket.get(), head.data() + head_bytes, head.size() - head_bytes, 0);
    if (got < 0) return errno == EAGAIN || errno == EINTR ? Progress::kWaits : Progress::kBroken;
    if (got == 0) return Progress::kBroken;
    head_bytes += static_cast<std::size_t>(got);
    return Progress::kDone;
}

Progress Connection::send() noexcept {
    const std::string_view page = body ? std::string_view(*body) : std::string_view();
    while (sent < answer_head.size() + page.size()) {
        const std::string_view rest = sent < answer_head.size() ? std::string_view(answer_head).substr(sent)
                                                                : page.substr(sent - answer_head.size());
        const int more = sent < answer_head.size() && !page.empty() ? MSG_MORE : 0;
        const ssize_t gone = ::send(socket.get(), rest.data(), rest.size(), MSG_NOSIGNAL | more);
        if (gone < 0) return errno == EAGAIN || errno == EINTR ? Progress::kWaits : Progress::kBroken;
        sent += static_cast<std::size_t>(gone);
    }
    if (!pending.later) ::shutdown(socket.get(), SHUT_WR);
    return Progress::kDone;
}

Progress Connection::end() noexcept {
    // At most so much a turn: one that never stops sending is ended by its time.
    const ssize_t got = ::recv(socket.get(), head.data(), head.size(), 0);
    if (got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR))) return Progress::kWaits;
    return Progress::kDone;
}

}  // namespace

class HttpServer::Loop {
  public:
    Loop(transport::TcpListener listener, const HttpOptions& options, const Clock& clock, Handler handler)
        : listener_(std::move(listener)), options_(options), clock_(clock), handler_(std::move(handler)) {
        connections_.reserve(options_.connections);
        events_.reserve(options_.connections + 2);
    }
    Loop(const Loop&) = delete;
    Loop& operator=(const Loop&) = delete;
    Loop(Loop&&) = delete;
    Loop& operator=(Loop&&) = delete;
    ~Loop() {
        stopping_.store(true, std::memory_order_relaxed);
        stop_.raise();
        if (thread_.joinable()) thread_.join();
    }

    [[nodiscard]] bool start() {
        if (!stop_) return false;
        thread_ = std::thread([this] { run(); });
        return true;
    }
    [[nodiscard]] transport::Endpoint local() const noexcept { return listener_.local; }
    [[nodiscard]] PortCounts counts() const noexcept {
        const auto value = [](const std::atomic<std::uint64_t>& counter) {
            return counter.load(std::memory_order_relaxed);
        };
        return {value(taken_), value(answered_), value(refused_), value(timed_out_)};
    }

  private:
    using Connections = std::vector<std::unique_ptr<Connection>>;

    void run();
    void watch(std::int64_t now_ns);
    void take_new(std::int64_t now_ns);
    void go_on(Connection& connection, std::int64_t now_ns) noexcept;
    void read(Connection& connection, std::int64_t now_ns);
    void answer(Connection& connection, const HttpAnswer& answer, bool with_body, std::int64_t now_ns);
    void tend(Connection& connection, std::int64_t now_ns) noexcept;
    void ask_again(Connection& connection, std::int64_t now_ns);
    void give_up(Connection& connection, std::int64_t now_ns);
    [[nodiscard]] std::size_t endless_answers() const noexcept;
    [[nodiscard]] HttpAnswer answer_to(const Head& head) const;
    [[nodiscard]] std::int64_t ends_ns(const Connection& connection) const noexcept;
    [[nodiscard]] bool gives_way(const Connection& connection, std::int64_t now_ns) const noexcept;
    [[nodiscard]] int wait_ms(std::int64_t now_ns) const noexcept;

    transport::TcpListener listener_;
    HttpOptions options_;
    const Clock& clock_;
    Handler handler_;
    Connections connections_;
    /// The stop signal, the listener or nothing, then the connections in their order.
    std::vector<pollfd> events_;
    std::int64_t window_ns_ = 0;
    std::size_t taken_in_window_ = 0;
    transport::EventSignal stop_;
    std::atomic<bool> stopping_{false};
    std::atomic<std::uint64_t> taken_{0};
    std::atomic<std::uint64_t> answered_{0};
    std::atomic<std::uint64_t> refused_{0};
    std::atomic<std::uint64_t> timed_out_{0};
    std::thread thread_;
};

void HttpServer::Loop::run() {
    // For this thread alone, as Linux has it; refused in some containers, and then left.
    ::setpriority(PRIO_PROCESS, 0, kNice);
    while (!stopping_.load(std::memory_order_relaxed)) {
        const std::int64_t before_ns = clock_.monotonic_ns();
        watch(before_ns);
        ::poll(events_.data(), events_.size(), wait_ms(before_ns));
        const std::int64_t now_ns = clock_.monotonic_ns();
        for (std::size_t i = 0; i < connections_.size(); ++i) {
            if (events_[i + 2].revents != 0) go_on(*connections_[i], now_ns);
            tend(*connections_[i], now_ns);
        }
        std::erase_if(connections_, [](const auto& connection) { return !connection->socket; });
        if (events_[1].revents != 0) take_new(now_ns);
    }
}

std::int64_t HttpServer::Loop::ends_ns(const Connection& connection) const noexcept {
    return connection.since_ns + (connection.state == Connection::State::kEnding
                                      ? kLinger_ns
                                      : options_.time_limit.count() * kMs_ns);
}

bool HttpServer::Loop::gives_way(const Connection& connection, std::int64_t now_ns) const noexcept {
    if (connection.state == Connection::State::kEnding) return true;
    return connection.state == Connection::State::kReading &&
           now_ns - connection.since_ns >= options_.gives_way_after.count() * kMs_ns;
}

/// Builds what poll() is to look at.
void HttpServer::Loop::watch(std::int64_t now_ns) {
    if (now_ns - window_ns_ >= kWindow_ns) {
        window_ns_ = now_ns;
        taken_in_window_ = 0;
    }
    const bool room = connections_.size() < options_.connections ||
                      std::any_of(connections_.begin(), connections_.end(),
                                  [&](const auto& connection) { return gives_way(*connection, now_ns); });
    const bool in_time =
        taken_in_window_ < options_.connections_per_s * static_cast<std::size_t>(kWindow_ns) / 1'000'000'000U;
    events_.clear();
    events_.push_back(stop_.watched());
    events_.push_back({room && in_time ? listener_.socket.get() : -1, POLLIN, 0});
    for (const auto& connection : connections_) {
        const bool writes = connection->state == Connection::State::kWriting;
        events_.push_back({connection->socket.get(), static_cast<short>(writes ? POLLOUT : POLLIN), 0});
    }
}

/// Until something is due by the clock alone.
int HttpServer::Loop::wait_ms(std::int64_t now_ns) const noexcept {
    std::int64_t due_ns = INT64_MAX;
    for (const auto& connection : connections_)
        due_ns = std::min(due_ns, ends_ns(*connection));
    if (events_[1].fd < 0) due_ns = std::min(due_ns, now_ns + kWindow_ns);
    if (std::any_of(connections_.begin(), connections_.end(),
                    [](const auto& one) { return one->state == Connection::State::kWaiting; }))
        due_ns = std::min(due_ns, now_ns + kAskEvery_ns);
    if (due_ns == INT64_MAX) return -1;
    return static_cast<int>(std::clamp<std::int64_t>((due_ns - now_ns) / kMs_ns + 1, 1, 60'000));
}

void HttpServer::Loop::take_new(std::int64_t now_ns) {
    if (connections_.size() >= options_.connections) {
        const auto oldest = std::find_if(connections_.begin(), connections_.end(),
                                         [&](const auto& one) { return gives_way(*one, now_ns); });
        if (oldest == connections_.end()) return;
        if ((*oldest)->state == Connection::State::kReading) add(timed_out_);
        connections_.erase(oldest);
    }
    ++taken_in_window_;
    transport::FileDescriptor socket = transport::accept_tcp(listener_);
    if (!socket) {
        // Without descriptors the listener would be ready for ever: look again when the window is over.
        if (errno != EAGAIN && errno != ECONNABORTED) taken_in_window_ = options_.connections_per_s;
        return;
    }
    add(taken_);
    auto connection = std::make_unique<Connection>();
    connection->socket = std::move(socket);
    connection->since_ns = now_ns;
    connections_.push_back(std::move(connection));
}

void HttpServer::Loop::go_on(Connection& connection, std::int64_t now_ns) noexcept {
    Progress progress = Progress::kBroken;
    try {
        switch (connection.state) {
            case Connection::State::kReading:
                progress = connection.receive();
                if (progress == Progress::kDone) read(connection, now_ns);
                break;
            case Connection::State::kWriting:
                progress = connection.send();
                if (progress == Progress::kDone) {
                    connection.state =
                        connection.pending.later ? Connection::State::kWaiting : Connection::State::kEnding;
                    connection.since_ns = now_ns;
                }
                break;
            case Connection::State::kWaiting:
            case Connection::State::kEnding:
                if (connection.end() == Progress::kWaits) progress = Progress::kWaits;
                break;
        }
    } catch (const std::exception&) {
        // Memory ran out: this client gets nothing.
        progress = Progress::kBroken;
    }
    if (progress == Progress::kBroken) connection.socket = {};
}

void HttpServer::Loop::read(Connection& connection, std::int64_t now_ns) {
    const Head head = read_head({connection.head.data(), connection.head_bytes});
    if (head.state == HeadState::kIncomplete) return;
    HttpAnswer made = answer_to(head);
    const bool one_too_many = made.endless && endless_answers() >= options_.endless_answers;
    if (one_too_many) made = line_answer(503, "as many streams are read as may be: take single pictures");
    add(!one_too_many && (made.status == 200 || made.status == 503) ? answered_ : refused_);
    answer(connection, made, head.request.method != "HEAD", now_ns);
}

std::size_t HttpServer::Loop::endless_answers() const noexcept {
    return static_cast<std::size_t>(std::count_if(connections_.begin(), connections_.end(),
                                                  [](const auto& one) { return one->pending.endless; }));
}

/// What is due without a word from the client.
void HttpServer::Loop::tend(Connection& connection, std::int64_t now_ns) noexcept {
    try {
        if (connection.state == Connection::State::kWaiting) ask_again(connection, now_ns);
        if (connection.socket && now_ns >= ends_ns(connection)) give_up(connection, now_ns);
    } catch (const std::exception&) {
        // Memory ran out: this client gets nothing.
        connection.socket = {};
    }
}

/// Sends what has come of an answer meanwhile.
void HttpServer::Loop::ask_again(Connection& connection, std::int64_t now_ns) {
    std::shared_ptr<const std::string> part = connection.pending.later();
    if (!part) return;
    connection.sent = 0;
    connection.body = std::move(part);
    if (connection.pending.endless) {
        connection.answer_head.clear();
    } else {
        connection.pending.later = nullptr;
        connection.pending.body = connection.body;
        connection.answer_head = status::answer_head(connection.pending);
    }
    connection.state = Connection::State::kWriting;
    connection.since_ns = now_ns;
    go_on(connection, now_ns);
}

/// Its time is over.
void HttpServer::Loop::give_up(Connection& connection, std::int64_t now_ns) {
    if (connection.state != Connection::State::kEnding) add(timed_out_);
    const bool nothing_came = connection.state == Connection::State::kWaiting && !connection.pending.endless;
    if (!nothing_came) {
        connection.socket = {};
        return;
    }
    connection.pending = {};
    connection.since_ns = now_ns;
    answer(connection, line_answer(503, "nothing came in time: is the daemon drawing?"), true, now_ns);
}

HttpAnswer HttpServer::Loop::answer_to(const Head& head) const {
    constexpr transport::Ipv4 kLoopbackNet = 127;
    switch (head.state) {
        case HeadState::kTooLong:
            return line_answer(431, "the request is too long: its head may have 4096 bytes");
        case HeadState::kBadVersion:
            return line_answer(505, "HTTP/1.1 and 1.0 are spoken here");
        case HeadState::kBad:
        case HeadState::kIncomplete:
            return line_answer(400, "this is no HTTP request");
        case HeadState::kComplete:
            break;
    }
    if (head.request.method != "GET" && head.request.method != "HEAD")
        return line_answer(405, "this port is for reading: GET and HEAD");
    if (listener_.local.address >> 24U == kLoopbackNet && !is_local_name(head.request.host))
        return line_answer(403, "this port is for this machine: name it by its address or as localhost");
    return handler_(head.request.path, counts());
}

void HttpServer::Loop::answer(Connection& connection, const HttpAnswer& answer, bool with_body,
                              std::int64_t now_ns) {
    if (with_body && answer.later) {
        connection.pending = answer;
        if (!answer.endless) {
            connection.state = Connection::State::kWaiting;
            return;
        }
    }
    connection.answer_head = status::answer_head(answer);
    if (with_body) connection.body = answer.body;
    connection.state = Connection::State::kWriting;
    go_on(connection, now_ns);
}

HttpServer::HttpServer(std::unique_ptr<Loop> loop) noexcept : loop_(std::move(loop)) {}
HttpServer::~HttpServer() = default;

protocol::Result<std::unique_ptr<HttpServer>, std::string> HttpServer::open(const HttpOptions& options,
                                                                            const Clock& clock,
                                                                            Handler handler) {
    auto listener = transport::listen_tcp(options.listen, kBacklog);
    if (!listener) return protocol::Error{listener.error()};
    auto loop = std::make_unique<Loop>(std::move(listener).value(), options, clock, std::move(handler));
    if (!loop->start()) return protocol::Error{std::string("no descriptor is left for the status port")};
    return std::unique_ptr<HttpServer>(new HttpServer(std::move(loop)));
}

transport::Endpoint HttpServer::local() const noexcept {
    return loop_->local();
}

PortCounts HttpServer::counts() const noexcept {
    return loop_->counts();
}

}  // namespace skyig::server::status
