#include "clients/instructor/web_server.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <deque>
#include <utility>

#include "clients/instructor/websocket.h"

namespace skyig::clients::instructor {

namespace transport = protocol::transport;
using server::status::HeadState;
using server::status::HttpAnswer;
using server::status::HttpRequest;

namespace {

constexpr int kBacklog = 64;
constexpr std::int64_t kMs_ns = 1'000'000;
/// What the system keeps for a client that does not read, so that it shows soon.
constexpr int kSendBuffer_bytes = 256 * 1024;
/// So many rates of messages thrown away end a connection.
constexpr double kRatesThrownAway = 10.0;
/// How long nobody new is taken when no descriptor is left.
constexpr std::int64_t kNoDescriptors_ns = 100 * kMs_ns;
/// How long a client may take to end after it was told to.
constexpr std::int64_t kLinger_ns = 500 * kMs_ns;

}  // namespace

struct WebServer::Client {
    enum class State : std::uint8_t { kHead, kPage, kSocket, kEnding };

    transport::FileDescriptor socket;
    State state = State::kHead;
    std::int64_t since_ns = 0;
    std::string head;
    MessageReader reader;
    std::deque<Frame> waiting;
    std::size_t sent_of_first = 0;
    std::size_t waiting_bytes = 0;
    /// Since when nothing of what waits was taken.
    std::int64_t stuck_since_ns = 0;
    /// Messages that may come now.
    double allowance = 0.0;
    std::int64_t allowed_ns = 0;
    double thrown_away = 0.0;

    explicit Client(std::size_t most_message_bytes) noexcept : reader(most_message_bytes) {}
};

protocol::Result<std::unique_ptr<WebServer>, std::string> WebServer::open(const WebOptions& options,
                                                                          const server::Clock& clock,
                                                                          Handlers handlers) {
    auto listener = transport::listen_tcp(options.listen, kBacklog);
    if (!listener) return protocol::Error{listener.error()};
    return std::unique_ptr<WebServer>(
        new WebServer(std::move(listener).value(), options, clock, std::move(handlers)));
}

WebServer::WebServer(transport::TcpListener listener, const WebOptions& options, const server::Clock& clock,
                     Handlers handlers)
    : listener_(std::move(listener)), options_(options), clock_(clock), handlers_(std::move(handlers)) {
    constexpr transport::Ipv4 kLoopbackNet = 127;
    rules_ = {listener_.local.address >> 24U == kLoopbackNet, options_.token, options_.names};
    clients_.reserve(options_.sockets + options_.connections);
    events_.reserve(options_.sockets + options_.connections + 1);
}

WebServer::~WebServer() {
    const Frame bye = std::make_shared<const std::string>(make_close(CloseCode::kGoingAway));
    for (const auto& client : clients_) {
        if (client->state != Client::State::kSocket) continue;
        push(*client, bye);
        send(*client);
    }
}

void WebServer::watch() {
    events_.clear();
    events_.push_back({clock_.monotonic_ns() < deaf_until_ns_ ? -1 : listener_.socket.get(), POLLIN, 0});
    for (const auto& client : clients_) {
        const bool writes = !client->waiting.empty();
        // Who is to be sent a page has said all that is of interest.
        const bool reads = client->state != Client::State::kPage;
        events_.push_back(
            {client->socket.get(), static_cast<short>((reads ? POLLIN : 0) | (writes ? POLLOUT : 0)), 0});
    }
}

void WebServer::step(std::chrono::milliseconds most) {
    watch();
    ::poll(events_.data(), events_.size(), static_cast<int>(most.count()));
    for (std::size_t i = 0; i < clients_.size(); ++i) {
        Client& client = *clients_[i];
        const short events = events_[i + 1].revents;
        if ((events & POLLOUT) != 0) send(client);
        if (client.socket && (events & (POLLIN | POLLHUP | POLLERR)) != 0) receive(client);
        if (client.socket) tend(client);
    }
    std::erase_if(clients_, [](const auto& client) { return !client->socket; });
    if (events_.front().revents != 0) take_new();
}

void WebServer::take_new() {
    // Who connects without end must not keep the others waiting.
    for (int i = 0; i < kBacklog; ++i) {
        transport::FileDescriptor socket = transport::accept_tcp(listener_);
        if (!socket) {
            // Without descriptors the listener would be ready for ever.
            if (errno != EAGAIN && errno != ECONNABORTED)
                deaf_until_ns_ = clock_.monotonic_ns() + kNoDescriptors_ns;
            return;
        }
        ++counts_.connections;
        make_room();
        ::setsockopt(socket.get(), SOL_SOCKET, SO_SNDBUF, &kSendBuffer_bytes, sizeof(kSendBuffer_bytes));
        // A machine that is gone without a word acknowledges nothing: the system itself ends that connection.
        const auto limit_ms = static_cast<unsigned>(options_.time_limit.count());
        ::setsockopt(socket.get(), IPPROTO_TCP, TCP_USER_TIMEOUT, &limit_ms, sizeof(limit_ms));
        auto client = std::make_unique<Client>(options_.most_message_bytes);
        client->socket = std::move(socket);
        client->since_ns = clock_.monotonic_ns();
        clients_.push_back(std::move(client));
        // What it asks is mostly there already, and is heard before it could have to give way.
        receive(*clients_.back());
    }
}

/// For one more connection. The oldest stands first.
void WebServer::make_room() {
    const auto is_socket = [](const auto& client) { return client->state == Client::State::kSocket; };
    const auto others = clients_.size() - open_sockets();
    if (others < options_.connections) return;
    clients_.erase(std::find_if_not(clients_.begin(), clients_.end(), is_socket));
    ++counts_.gave_way;
}

/// The connection failed or was ended by its client.
/// \param fault  what the system said, 0: nothing
void WebServer::lose(Client& client, int fault) {
    const bool said = fault == 0 || fault == ECONNRESET || fault == EPIPE;
    if (!said && client.state == Client::State::kSocket) ++counts_.ended_for_slow;
    client.socket = {};
}

void WebServer::receive(Client& client) {
    std::array<char, 16384> buffer;
    const ssize_t got = ::recv(client.socket.get(), buffer.data(), buffer.size(), 0);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (got <= 0) {
        lose(client, got == 0 ? 0 : errno);
        return;
    }
    const std::string_view bytes(buffer.data(), static_cast<std::size_t>(got));
    switch (client.state) {
        case Client::State::kHead:
            client.head.append(bytes.substr(0, server::status::kMaxHeadBytes + 1 - client.head.size()));
            read_head(client);
            break;
        case Client::State::kSocket:
            read_frames(client, bytes);
            break;
        case Client::State::kPage:
        case Client::State::kEnding:
            break;
    }
}

void WebServer::read_head(Client& client) {
    const server::status::Head head = server::status::read_head(client.head);
    if (head.state == HeadState::kIncomplete) return;
    if (head.state != HeadState::kComplete) {
        ++counts_.refused_bad;
        answer(client, server::status::line_answer(400, "this is no HTTP request that is understood here"),
               true);
        return;
    }
    if (const Refusal refusal = check_host(head.request, rules_); refusal != Refusal::kNone) {
        refuse(client, refusal);
    } else if (head.request.path == "/ws") {
        upgrade(client, head.request);
    } else if (head.request.method != "GET" && head.request.method != "HEAD") {
        ++counts_.refused_bad;
        answer(client, server::status::line_answer(405, "pages are for reading: GET and HEAD"), true);
    } else {
        const HttpAnswer page = handlers_.page(head.request.path);
        ++(page.status == 200 ? counts_.pages : counts_.refused_bad);
        answer(client, page, head.request.method == "GET");
    }
}

void WebServer::refuse(Client& client, Refusal refusal) {
    switch (refusal) {
        case Refusal::kHost:
            ++counts_.refused_host;
            answer(client,
                   server::status::line_answer(
                       403, "name this machine by its address or as localhost, or allow the name (--name)"),
                   true);
            break;
        case Refusal::kOrigin:
            ++counts_.refused_origin;
            answer(client, server::status::line_answer(403, "only the station's own page may ask this"),
                   true);
            break;
        case Refusal::kToken:
            ++counts_.refused_token;
            answer(client, server::status::line_answer(401, "the token is wrong"), true);
            break;
        case Refusal::kNone:
            break;
    }
}

void WebServer::upgrade(Client& client, const HttpRequest& request) {
    if (const Handshake asked = check_handshake(request); asked != Handshake::kGood) {
        ++counts_.refused_bad;
        const int status = asked == Handshake::kBad ? 400 : 426;
        HttpAnswer no = server::status::line_answer(status, "a WebSocket of version 13 is opened here");
        no.more_fields = "Sec-WebSocket-Version: 13\r\n";
        answer(client, no, true);
        return;
    }
    if (const Refusal refusal = check_upgrade(request, rules_); refusal != Refusal::kNone) {
        refuse(client, refusal);
        return;
    }
    if (open_sockets() >= options_.sockets) {
        ++counts_.refused_full;
        answer(client, server::status::line_answer(503, "as many pages are open as may be"), true);
        return;
    }
    ++counts_.sockets;
    client.state = Client::State::kSocket;
    client.allowance = 2.0 * options_.messages_per_s;
    client.allowed_ns = clock_.monotonic_ns();
    push(client, std::make_shared<const std::string>(
                     "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                     "Sec-WebSocket-Accept: " +
                     accept_key(server::status::field(request, "sec-websocket-key")) + "\r\n\r\n"));
    for (const std::string& text : handlers_.greeting())
        push(client, std::make_shared<const std::string>(make_frame(Opcode::kText, text)));
    // What came with the head is the first of its frames.
    const std::string rest = client.head.substr(client.head.find("\r\n\r\n") + 4);
    client.head.clear();
    if (!rest.empty()) read_frames(client, rest);
    send(client);
}

void WebServer::answer(Client& client, const HttpAnswer& answer, bool with_body) {
    push(client, std::make_shared<const std::string>(server::status::answer_head(answer)));
    if (with_body && answer.body) push(client, answer.body);
    client.state = Client::State::kPage;
    send(client);
}

void WebServer::read_frames(Client& client, std::string_view bytes) {
    std::span<const char> rest(bytes.data(), bytes.size());
    while (client.state == Client::State::kSocket) {
        using Event = MessageReader::Event;
        switch (client.reader.take(rest)) {
            case Event::kNothing:
                return;
            case Event::kText:
                take_message(client, client.reader.message());
                break;
            case Event::kPing:
                if (!may_speak(client)) break;
                push(client,
                     std::make_shared<const std::string>(make_frame(Opcode::kPong, client.reader.message())));
                break;
            case Event::kClose:
                end(client, make_frame(Opcode::kClose, client.reader.message()));
                break;
            case Event::kTooBig:
                ++counts_.too_big;
                end(client, make_close(CloseCode::kTooBig));
                break;
            case Event::kBinary:
                ++counts_.not_frames;
                end(client, make_close(CloseCode::kNotUnderstood));
                break;
            case Event::kBroken:
                ++counts_.not_frames;
                end(client, make_close(CloseCode::kProtocolError));
                break;
        }
    }
}

/// One more message or ping; one too many is counted, and by and by ends the connection.
bool WebServer::may_speak(Client& client) {
    const std::int64_t now_ns = clock_.monotonic_ns();
    const double earned = static_cast<double>(now_ns - client.allowed_ns) * 1e-9 * options_.messages_per_s;
    client.allowed_ns = now_ns;
    client.allowance = std::min(client.allowance + earned, 2.0 * options_.messages_per_s);
    client.thrown_away = std::max(client.thrown_away - earned, 0.0);
    if (client.allowance < 1.0) {
        ++counts_.rate_limited;
        if (++client.thrown_away < kRatesThrownAway * options_.messages_per_s) return false;
        ++counts_.ended_for_rate;
        end(client, make_close(CloseCode::kPolicy));
        return false;
    }
    client.allowance -= 1.0;
    return true;
}

void WebServer::take_message(Client& client, std::string_view text) {
    if (!may_speak(client)) return;
    ++counts_.messages;
    const std::string reply = handlers_.message(text);
    if (!reply.empty()) push(client, std::make_shared<const std::string>(make_frame(Opcode::kText, reply)));
}

void WebServer::end(Client& client, std::string frame) {
    push(client, std::make_shared<const std::string>(std::move(frame)));
    client.state = Client::State::kEnding;
    client.since_ns = clock_.monotonic_ns();
    send(client);
}

void WebServer::push(Client& client, Frame frame) {
    if (client.waiting.empty()) client.stuck_since_ns = clock_.monotonic_ns();
    client.waiting_bytes += frame->size();
    client.waiting.push_back(std::move(frame));
}

void WebServer::send(Client& client) {
    while (!client.waiting.empty()) {
        const std::string& frame = *client.waiting.front();
        const ssize_t gone = ::send(client.socket.get(), frame.data() + client.sent_of_first,
                                    frame.size() - client.sent_of_first, MSG_NOSIGNAL);
        if (gone < 0 && (errno == EAGAIN || errno == EINTR)) return;
        if (gone < 0) {
            lose(client, errno);
            return;
        }
        client.stuck_since_ns = clock_.monotonic_ns();
        client.sent_of_first += static_cast<std::size_t>(gone);
        client.waiting_bytes -= static_cast<std::size_t>(gone);
        if (client.sent_of_first < frame.size()) return;
        client.waiting.pop_front();
        client.sent_of_first = 0;
    }
    if (client.state != Client::State::kPage) return;
    // Its own end is waited for: a reset would tear away what it has not read.
    ::shutdown(client.socket.get(), SHUT_WR);
    client.state = Client::State::kEnding;
    client.since_ns = clock_.monotonic_ns();
}

/// What is due by the clock alone.
void WebServer::tend(Client& client) {
    const std::int64_t now_ns = clock_.monotonic_ns();
    const std::int64_t limit_ns = options_.time_limit.count() * kMs_ns;
    switch (client.state) {
        case Client::State::kHead:
        case Client::State::kPage:
            if (now_ns - client.since_ns < limit_ns) return;
            ++counts_.timed_out;
            break;
        case Client::State::kSocket:
            if (client.waiting_bytes <= options_.most_waiting_bytes &&
                (client.waiting.empty() || now_ns - client.stuck_since_ns < limit_ns))
                return;
            ++counts_.ended_for_slow;
            break;
        case Client::State::kEnding:
            if (now_ns - client.since_ns < kLinger_ns) return;
            break;
    }
    client.socket = {};
}

void WebServer::publish(std::string_view text) {
    const Frame frame = std::make_shared<const std::string>(make_frame(Opcode::kText, text));
    for (const auto& client : clients_) {
        if (client->state != Client::State::kSocket || !client->socket) continue;
        push(*client, frame);
        send(*client);
    }
}

void WebServer::publish_if_idle(const Frame& frame) {
    for (const auto& client : clients_) {
        if (client->state != Client::State::kSocket || !client->socket) continue;
        if (!client->waiting.empty()) {
            ++counts_.skipped;
            continue;
        }
        push(*client, frame);
        send(*client);
    }
}

void WebServer::publish_update(std::string_view text) {
    publish_if_idle(std::make_shared<const std::string>(make_frame(Opcode::kText, text)));
}

void WebServer::publish_picture(std::string_view bytes) {
    publish_if_idle(std::make_shared<const std::string>(make_frame(Opcode::kBinary, bytes)));
}

std::size_t WebServer::open_sockets() const noexcept {
    return static_cast<std::size_t>(std::count_if(clients_.begin(), clients_.end(), [](const auto& client) {
        return client->state == Client::State::kSocket;
    }));
}

}  // namespace skyig::clients::instructor
