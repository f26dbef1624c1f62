// The server against clients of all kinds: quick, slow, silent, garbled, many.
#include "server/status/http_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "protocol/transport/tcp.h"
#include "server/status/status_port.h"
#include "tests/server/status/example.h"

namespace skyig::server::status {
namespace {

namespace transport = protocol::transport;
using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Client {
  public:
    explicit Client(const transport::Endpoint& to) {
        auto connected = transport::connect_tcp(to, milliseconds(5000));
        if (connected) socket_ = std::move(connected).value();
    }

    [[nodiscard]] bool connected() const { return static_cast<bool>(socket_); }
    /// False when the other side does not take it any more.
    bool send(std::string_view text) const {
        return ::send(socket_.get(), text.data(), text.size(), MSG_NOSIGNAL) ==
               static_cast<ssize_t>(text.size());
    }
    /// All until the end; nothing if that does not come in time.
    [[nodiscard]] std::optional<std::string> receive(milliseconds limit = milliseconds(5000)) const {
        std::string text;
        for (;;) {
            pollfd event{socket_.get(), POLLIN, 0};
            if (::poll(&event, 1, static_cast<int>(limit.count())) <= 0) return std::nullopt;
            char buffer[4096];
            const ssize_t got = ::recv(socket_.get(), buffer, sizeof(buffer), 0);
            if (got <= 0) return text;
            text.append(buffer, static_cast<std::size_t>(got));
        }
    }

    /// What comes holds `part`, before its end and in time.
    [[nodiscard]] bool receives(std::string_view part) const {
        std::string text;
        while (text.find(part) == std::string::npos) {
            pollfd event{socket_.get(), POLLIN, 0};
            if (::poll(&event, 1, 5000) <= 0) return false;
            char buffer[4096];
            const ssize_t got = ::recv(socket_.get(), buffer, sizeof(buffer), 0);
            if (got <= 0) return false;
            text.append(buffer, static_cast<std::size_t>(got));
        }
        return true;
    }

  private:
    transport::FileDescriptor socket_;
};

class HttpServerTest : public ::testing::Test {
  protected:
    /// A page of `page_bytes` under /page.
    void open(HttpOptions options = {}, std::size_t page_bytes = 100) {
        const auto page = std::make_shared<const std::string>(page_bytes, 'x');
        auto opened = HttpServer::open(options, clock_, [page](std::string_view path, const PortCounts&) {
            return path == "/page" ? HttpAnswer{200, "text/plain", page} : line_answer(404, "no page");
        });
        ASSERT_TRUE(opened) << opened.error();
        server_ = std::move(opened).value();
    }
    [[nodiscard]] Client client() const { return Client(server_->local()); }
    [[nodiscard]] std::string ask(std::string_view request) const {
        const Client one = client();
        one.send(request);
        return one.receive().value_or("nothing");
    }

    SystemClock clock_;
    std::unique_ptr<HttpServer> server_;
};

constexpr std::string_view kGet = "GET /page HTTP/1.1\r\nHost: localhost\r\n\r\n";

TEST_F(HttpServerTest, AnswersGetAndHeadAndRefusesTheRest) {
    open();
    const std::string got = ask(kGet);
    EXPECT_THAT(got, StartsWith("HTTP/1.1 200 OK\r\n"));
    EXPECT_THAT(got, ::testing::EndsWith("\r\n\r\n" + std::string(100, 'x')));
    const std::string head = ask("HEAD /page HTTP/1.1\r\n\r\n");
    EXPECT_THAT(head, HasSubstr("Content-Length: 100\r\n"));
    EXPECT_THAT(head, ::testing::EndsWith("\r\n\r\n"));
    EXPECT_THAT(ask("GET /other HTTP/1.1\r\n\r\n"), StartsWith("HTTP/1.1 404 "));
    for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS"})
        EXPECT_THAT(ask(std::string(method) + " /page HTTP/1.1\r\n\r\n"), StartsWith("HTTP/1.1 405 "))
            << method;
    EXPECT_THAT(ask("GET /page HTTP/3.0\r\n\r\n"), StartsWith("HTTP/1.1 505 "));
    EXPECT_THAT(ask("\x16\x03\x01\x02"), StartsWith("HTTP/1.1 400 "));
    EXPECT_THAT(ask("GET /page HTTP/1.1\r\nHost: evil.example\r\n\r\n"), StartsWith("HTTP/1.1 403 "));
    const PortCounts counts = server_->counts();
    EXPECT_EQ(counts.connections, 10U);
    EXPECT_EQ(counts.answered, 2U);
    EXPECT_EQ(counts.refused, 8U);
}

TEST_F(HttpServerTest, RequestsThatAreTooLongAreRefusedWhole) {
    open();
    const std::string answer = ask("GET /page HTTP/1.1\r\nA: " + std::string(60'000, 'y'));
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 431 "));
    EXPECT_THAT(answer, HasSubstr("4096 bytes"));
}

TEST_F(HttpServerTest, TakesARequestByteByByte) {
    open();
    const Client slow = client();
    for (const char c : kGet) {
        ASSERT_TRUE(slow.send({&c, 1}));
        std::this_thread::sleep_for(milliseconds(1));
    }
    EXPECT_THAT(slow.receive().value_or(""), StartsWith("HTTP/1.1 200 "));
}

TEST_F(HttpServerTest, ASilentClientIsLetGoAndHoldsNobodyUp) {
    HttpOptions options;
    options.time_limit = milliseconds(200);
    open(options);
    const Client silent = client();
    silent.send("GET /pa");
    EXPECT_THAT(ask(kGet), StartsWith("HTTP/1.1 200 "));
    EXPECT_EQ(silent.receive(), "");
    EXPECT_EQ(server_->counts().timed_out, 1U);
}

TEST_F(HttpServerTest, AClientThatDoesNotReadIsLetGo) {
    HttpOptions options;
    options.time_limit = milliseconds(300);
    open(options, std::size_t{32} << 20U);
    const Client deaf = client();
    deaf.send(kGet);
    EXPECT_THAT(ask("HEAD /page HTTP/1.1\r\n\r\n"), StartsWith("HTTP/1.1 200 "));
    for (int i = 0; i < 100 && server_->counts().timed_out == 0; ++i)
        std::this_thread::sleep_for(milliseconds(20));
    EXPECT_EQ(server_->counts().timed_out, 1U);
}

TEST_F(HttpServerTest, AnswersAHundredAtOnce) {
    open();
    std::vector<std::unique_ptr<Client>> clients;
    for (int i = 0; i < 100; ++i)
        clients.push_back(std::make_unique<Client>(server_->local()));
    for (const auto& one : clients)
        ASSERT_TRUE(one->connected() && one->send(kGet));
    int answered = 0;
    for (const auto& one : clients)
        answered += one->receive().value_or("").starts_with("HTTP/1.1 200 ") ? 1 : 0;
    EXPECT_EQ(answered, 100);
}

TEST_F(HttpServerTest, SilentCrowdGivesWayToOneThatAsks) {
    HttpOptions options;
    options.connections = 4;
    options.gives_way_after = milliseconds(50);
    options.time_limit = milliseconds(60'000);
    open(options);
    std::vector<std::unique_ptr<Client>> crowd;
    for (int i = 0; i < 40; ++i)
        crowd.push_back(std::make_unique<Client>(server_->local()));
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THAT(ask(kGet), StartsWith("HTTP/1.1 200 "));
    const double waited_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("  behind 40 silent clients, 4 places: answered after %.2f s\n", waited_s);
    EXPECT_LT(waited_s, 5.0);
    EXPECT_GE(server_->counts().timed_out, 30U);
}

TEST_F(HttpServerTest, TakesSoManyASecondAndNoMore) {
    HttpOptions options;
    options.connections_per_s = 50;
    open(options);
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 30; ++i)
        EXPECT_THAT(ask(kGet), StartsWith("HTTP/1.1 200 "));
    const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("  30 requests at 50 a second: %.2f s\n", took_s);
    EXPECT_GE(took_s, 0.45);
    EXPECT_EQ(server_->counts().answered, 30U);
}

TEST_F(HttpServerTest, ATakenPortIsOneLine) {
    open();
    HttpOptions same;
    same.listen = server_->local();
    const auto second = HttpServer::open(same, clock_, {});
    ASSERT_FALSE(second);
    EXPECT_THAT(second.error(), HasSubstr("tcp " + to_string(server_->local()) + ": address already in use"));
}

TEST_F(HttpServerTest, EndsAtOnceWithClientsConnected) {
    open();
    const Client waiting = client();
    waiting.send("GET ");
    const auto start = std::chrono::steady_clock::now();
    server_.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - start, milliseconds(1000));
}

TEST(StatusPort, ServesThePagesOfTheNewestSnapshot) {
    const SystemClock clock;
    const auto exchange = std::make_unique<SnapshotExchange>();
    config::Status settings;
    settings.listen.port = 0;
    auto port = StatusPort::open(settings, tests::example_facts(), *exchange, clock, [] {
        Edges edges;
        edges.recorder = {"a.pcapng", 5, 0, 1000, false};
        return edges;
    });
    ASSERT_TRUE(port) << port.error();
    const auto get = [&port](const std::string& path) {
        const Client client((*port)->local());
        client.send("GET " + path + " HTTP/1.1\r\n\r\n");
        return client.receive().value_or("nothing");
    };
    EXPECT_THAT(get("/healthz"), ::testing::AllOf(StartsWith("HTTP/1.1 503 "), HasSubstr("no frame yet\n")));
    Snapshot& draft = exchange->draft();
    draft.frames = 77;
    FrameParts parts;
    parts.start_ns = clock.monotonic_ns();
    draft.record.add(parts, false, 0.02);
    exchange->publish();
    EXPECT_THAT(get("/healthz"),
                ::testing::AllOf(StartsWith("HTTP/1.1 200 "), ::testing::EndsWith("\r\n\r\nok\n")));
    EXPECT_THAT(get("/status"), ::testing::AllOf(HasSubstr("Content-Type: application/json\r\n"),
                                                 HasSubstr("\"frames\": 77"), HasSubstr("a.pcapng")));
    EXPECT_THAT(get("/metrics?x"),
                ::testing::AllOf(HasSubstr("version=0.0.4"), HasSubstr("\nskyig_frames_total 77\n")));
    EXPECT_THAT(get("/"), ::testing::AllOf(StartsWith("HTTP/1.1 404 "), HasSubstr("/status")));
    std::this_thread::sleep_for(milliseconds(1200));
    EXPECT_THAT(get("/healthz"), ::testing::AllOf(StartsWith("HTTP/1.1 503 "), HasSubstr("no frame for 1.")));
}

/// An answer that comes in parts, each when it is told to.
struct Parts {
    std::atomic<int> ready{0};
    int given = 0;  // the server's

    [[nodiscard]] HttpServer::Handler handler(bool endless) {
        return [this, endless](std::string_view, const PortCounts&) {
            HttpAnswer answer;
            answer.endless = endless;
            answer.later = [this]() -> std::shared_ptr<const std::string> {
                if (given >= ready.load()) return nullptr;
                return std::make_shared<const std::string>("part " + std::to_string(++given) + ";");
            };
            return answer;
        };
    }
};

TEST_F(HttpServerTest, AnswersLaterWhatComesLater) {
    Parts parts;
    HttpOptions options;
    options.time_limit = milliseconds(300);
    auto opened = HttpServer::open(options, clock_, parts.handler(false));
    ASSERT_TRUE(opened);
    server_ = std::move(opened).value();
    const Client waits = client();
    waits.send(kGet);
    std::this_thread::sleep_for(milliseconds(60));
    parts.ready = 1;
    const std::string got = waits.receive().value_or("nothing");
    EXPECT_THAT(got, HasSubstr("Content-Length: 7\r\n"));
    EXPECT_THAT(got, ::testing::EndsWith("\r\n\r\npart 1;"));
    // Nothing comes in time.
    EXPECT_THAT(ask(kGet), StartsWith("HTTP/1.1 503 "));
    EXPECT_EQ(server_->counts().timed_out, 1U);
}

TEST_F(HttpServerTest, WhoReadsStreamsLeavesPlacesForTheRest) {
    HttpOptions options;
    options.connections = 4;
    options.endless_answers = 2;
    auto opened = HttpServer::open(options, clock_, [](std::string_view path, const PortCounts&) {
        HttpAnswer answer = line_answer(200, "page");
        answer.endless = path == "/stream";
        if (answer.endless) answer.later = [] { return std::make_shared<const std::string>("part;"); };
        return answer;
    });
    ASSERT_TRUE(opened);
    server_ = std::move(opened).value();
    constexpr std::string_view kStream = "GET /stream HTTP/1.1\r\nHost: localhost\r\n\r\n";
    std::optional<Client> first(client());
    const Client second = client();
    for (const Client* one : {static_cast<const Client*>(&*first), &second}) {
        one->send(kStream);
        EXPECT_TRUE(one->receives("part;"));
    }
    EXPECT_THAT(ask(kStream), StartsWith("HTTP/1.1 503 "));
    EXPECT_EQ(server_->counts().refused, 1U);
    for (int i = 0; i < 10; ++i)
        EXPECT_THAT(ask(kGet), StartsWith("HTTP/1.1 200 "));
    // One that ends makes room.
    first.reset();
    bool again = false;
    for (int tries = 0; tries < 100 && !again; ++tries) {
        const Client next = client();
        next.send(kStream);
        again = next.receives("part;");
    }
    EXPECT_TRUE(again);
}

TEST_F(HttpServerTest, AnEndlessAnswerGoesOnAndHoldsNobodyUpWhoReadsNone) {
    Parts parts;
    HttpOptions options;
    options.time_limit = milliseconds(300);
    auto opened = HttpServer::open(options, clock_, parts.handler(true));
    ASSERT_TRUE(opened);
    server_ = std::move(opened).value();
    const Client reads = client();
    reads.send(kGet);
    for (int part = 1; part <= 3; ++part) {
        std::this_thread::sleep_for(milliseconds(40));
        parts.ready = part;
    }
    // Then nothing comes any more, and the answer ends.
    const std::string got = reads.receive().value_or("nothing");
    EXPECT_THAT(got, ::testing::Not(HasSubstr("Content-Length")));
    EXPECT_THAT(got, ::testing::EndsWith("\r\n\r\npart 1;part 2;part 3;"));
}

}  // namespace
}  // namespace skyig::server::status
