// The port against clients that are no friends: real sockets, a server that steps on a thread of its own.
#include "clients/instructor/web_server.h"

#include <gtest/gtest.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "clients/instructor/page_files.h"
#include "clients/instructor/websocket.h"

namespace skyig::clients::instructor {
namespace {

namespace transport = protocol::transport;

class Port : public ::testing::Test {
  protected:
    void SetUp() override { start({}); }
    void TearDown() override { stop(); }

    void start(WebOptions options) {
        stop();
        options.listen.port = 0;
        options.time_limit = std::chrono::milliseconds(400);
        server_ = WebServer::open(options, clock_,
                                  {[](std::string_view path) { return page_answer(path); },
                                   [] { return std::vector<std::string>{"welcome"}; },
                                   [](std::string_view text) { return "heard " + std::string(text); }})
                      .value();
        stopping_ = false;
        thread_ = std::thread([this] {
            while (!stopping_) {
                server_->step(std::chrono::milliseconds(5));
                if (pictures_) server_->publish_picture(std::string(200'000, 'p'));
            }
        });
    }
    /// What it has counted.
    WebCounts stop() {
        stopping_ = true;
        if (thread_.joinable()) thread_.join();
        return server_ ? server_->counts() : WebCounts{};
    }
    [[nodiscard]] std::string name() const { return transport::to_string(server_->local()); }
    [[nodiscard]] std::string upgrade(const std::string& origin, const std::string& query = "") const {
        return "GET /ws" + query + " HTTP/1.1\r\nHost: " + name() + "\r\nOrigin: " + origin +
               "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
    }

    server::SystemClock clock_;
    std::unique_ptr<WebServer> server_;
    std::atomic<bool> stopping_{true};
    std::atomic<bool> pictures_{false};
    std::thread thread_;
};

class Client {
  public:
    explicit Client(const transport::Endpoint& to)
        : socket_(transport::connect_tcp(to, std::chrono::seconds(2)).value()) {}

    /// False once the other side has closed.
    bool send(const std::string& bytes) {
        for (std::size_t sent = 0; sent < bytes.size();) {
            const ssize_t gone =
                ::send(socket_.get(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
            if (gone > 0) sent += static_cast<std::size_t>(gone);
            if (gone < 0 && errno != EAGAIN) return false;
            if (gone < 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return true;
    }
    /// All that comes until it holds `part`, the other side ends, or the time is over.
    std::string read_until(const std::string& part,
                           std::chrono::milliseconds limit = std::chrono::seconds(5)) {
        const auto end = std::chrono::steady_clock::now() + limit;
        while (come_.find(part) == std::string::npos && std::chrono::steady_clock::now() < end) {
            std::array<char, 65536> buffer;
            const ssize_t got = ::recv(socket_.get(), buffer.data(), buffer.size(), 0);
            if (got > 0) come_.append(buffer.data(), static_cast<std::size_t>(got));
            if (got == 0 || (got < 0 && errno != EAGAIN)) {
                ended_ = true;
                break;
            }
            if (got < 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return come_;
    }
    bool ends() {
        (void)read_until("\1never\2");
        return ended_;
    }

  private:
    transport::FileDescriptor socket_;
    std::string come_;
    bool ended_ = false;
};

/// A text of up to 125 bytes, masked with zeros.
std::string text_frame(const std::string& text) {
    return std::string("\x81", 1) + static_cast<char>(0x80U | text.size()) + std::string(4, '\0') + text;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST_F(Port, ServesThePageAndTalks) {
    Client page(server_->local());
    page.send("GET / HTTP/1.1\r\nHost: " + name() + "\r\n\r\n");
    const std::string html = page.read_until("</html>");
    EXPECT_TRUE(has(html, "200 OK") && has(html, "app.js") && has(html, "frame-ancestors 'none'")) << html;
    Client client(server_->local());
    client.send(upgrade("http://" + name()));
    EXPECT_TRUE(has(client.read_until("welcome"), "s3pPLMBiTxaQ9kYGzzhZRbK+xOo="));
    client.send(text_frame("hello"));
    EXPECT_TRUE(has(client.read_until("heard hello"), "heard hello"));
    Client wrong(server_->local());
    wrong.send("GET /../secret HTTP/1.1\r\nHost: " + name() + "\r\n\r\n");
    EXPECT_TRUE(has(wrong.read_until("404"), "404"));
    const WebCounts counts = stop();
    EXPECT_EQ(counts.pages, 1U);
    EXPECT_EQ(counts.sockets, 1U);
    EXPECT_EQ(counts.messages, 1U);
    EXPECT_EQ(counts.refused_bad, 1U);
}

TEST_F(Port, RefusesPagesFromElsewhereAndWrongTokens) {
    Client elsewhere(server_->local());
    elsewhere.send(upgrade("http://evil.example"));
    EXPECT_TRUE(has(elsewhere.read_until("403"), "403"));
    Client renamed(server_->local());
    renamed.send("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n");
    EXPECT_TRUE(has(renamed.read_until("403"), "403"));
    WebCounts counts = stop();
    EXPECT_EQ(counts.refused_origin, 1U);
    EXPECT_EQ(counts.refused_host, 1U);
    WebOptions options;
    options.token = "rather-secret";
    start(options);
    Client guesses(server_->local());
    guesses.send(upgrade("http://" + name(), "?token=guess"));
    EXPECT_TRUE(has(guesses.read_until("401"), "401"));
    Client knows(server_->local());
    knows.send(upgrade("http://" + name(), "?token=rather-secret"));
    EXPECT_TRUE(has(knows.read_until("welcome"), "101 Switching"));
    counts = stop();
    EXPECT_EQ(counts.refused_token, 1U);
    EXPECT_EQ(counts.sockets, 1U);
}

TEST_F(Port, EndsWhoSendsTenMegabytes) {
    Client client(server_->local());
    client.send(upgrade("http://" + name()));
    (void)client.read_until("welcome");
    client.send(std::string("\x81\xff\0\0\0\0\0\x98\x96\x80\0\0\0\0", 14));
    client.send(std::string(10'000'000, 'x'));
    EXPECT_TRUE(client.ends());
    EXPECT_EQ(stop().too_big, 1U);
}

TEST_F(Port, ThrowsAwayAFloodAndThenEndsIt) {
    Client client(server_->local());
    client.send(upgrade("http://" + name()));
    (void)client.read_until("welcome");
    for (int i = 0; i < 1000; ++i)
        client.send(text_frame("spam"));
    EXPECT_TRUE(client.ends());
    const WebCounts counts = stop();
    EXPECT_GE(counts.messages, 100U);
    EXPECT_LE(counts.messages, 300U);
    EXPECT_GE(counts.rate_limited, 500U);
    EXPECT_EQ(counts.ended_for_rate, 1U);
}

TEST_F(Port, AFloodOfPingsIsOneTooAndItsAnswersAreNotKept) {
    Client client(server_->local());
    client.send(upgrade("http://" + name()));
    (void)client.read_until("welcome");
    std::string pings;
    for (int i = 0; i < 1000; ++i)
        pings += std::string("\x89\x80\0\0\0\0", 6);
    client.send(pings);
    EXPECT_TRUE(client.ends());
    const WebCounts counts = stop();
    EXPECT_GE(counts.rate_limited, 500U);
    EXPECT_EQ(counts.ended_for_rate, 1U);
    EXPECT_EQ(counts.messages, 0U);
}

TEST_F(Port, DropsWhoNeverReadsAndServesTheOthers) {
    Client deaf(server_->local());
    deaf.send(upgrade("http://" + name()));
    Client reader(server_->local());
    reader.send(upgrade("http://" + name()));
    (void)reader.read_until("welcome");
    pictures_ = true;
    const std::size_t pictures =
        reader.read_until("\1never\2", std::chrono::milliseconds(1500)).size() / 200'000;
    pictures_ = false;
    const WebCounts counts = stop();
    EXPECT_EQ(counts.ended_for_slow, 1U);
    EXPECT_GT(counts.skipped, 0U);
    EXPECT_GT(pictures, 20U);
    std::printf("%zu pictures read beside one that reads none, %llu left out\n", pictures,
                static_cast<unsigned long long>(counts.skipped));
}

TEST_F(Port, EndsWhoAsksNothingOrAsksOneLetterAtATime) {
    Client silent(server_->local());
    Client slow(server_->local());
    const auto begin = std::chrono::steady_clock::now();
    const auto passed = [begin] { return std::chrono::steady_clock::now() - begin; };
    bool open = true;
    for (const char letter : "GET /" + std::string(1000, 'x')) {
        if (!open || passed() > std::chrono::seconds(5)) break;
        open = slow.send(std::string(1, letter));
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_FALSE(open);
    EXPECT_TRUE(silent.ends());
    EXPECT_EQ(stop().timed_out, 2U);
}

TEST_F(Port, ManyWhoAskNothingKeepNobodyOut) {
    WebOptions options;
    options.connections = 4;
    start(options);
    Client page(server_->local());
    page.send(upgrade("http://" + name()));
    EXPECT_TRUE(has(page.read_until("welcome"), "welcome"));
    std::vector<std::unique_ptr<Client>> idlers;
    for (int i = 0; i < 40; ++i)
        idlers.push_back(std::make_unique<Client>(server_->local()));
    Client late(server_->local());
    late.send(upgrade("http://" + name()));
    EXPECT_TRUE(has(late.read_until("welcome"), "welcome"));
    page.send(text_frame("hello"));
    EXPECT_TRUE(has(page.read_until("heard hello"), "heard hello"));
    const WebCounts counts = stop();
    EXPECT_GE(counts.gave_way, 36U);
    EXPECT_EQ(counts.refused_full, 0U);
    EXPECT_EQ(counts.sockets, 2U);
}

TEST_F(Port, SixtyFourPagesHearAllAndOneMoreIsToldSo) {
    std::vector<std::unique_ptr<Client>> tabs;
    for (int i = 0; i < 64; ++i) {
        tabs.push_back(std::make_unique<Client>(server_->local()));
        tabs.back()->send(upgrade("http://" + name()));
    }
    for (const auto& tab : tabs)
        ASSERT_TRUE(has(tab->read_until("welcome"), "welcome"));
    Client more(server_->local());
    more.send(upgrade("http://" + name()));
    EXPECT_TRUE(has(more.read_until("503"), "503"));
    for (const auto& tab : tabs)
        tab->send(text_frame("hello"));
    for (const auto& tab : tabs)
        EXPECT_TRUE(has(tab->read_until("heard hello"), "heard hello"));
    // One that is closed makes room.
    tabs.pop_back();
    bool welcome = false;
    for (int tries = 0; tries < 100 && !welcome; ++tries) {
        Client next(server_->local());
        next.send(upgrade("http://" + name()));
        welcome = has(next.read_until("\r\n\r\n"), "101");
    }
    EXPECT_TRUE(welcome);
    EXPECT_GE(stop().refused_full, 1U);
}

TEST(NoDescriptors, AreWaitedForAndNotSpunOn) {
    WebOptions options;
    options.listen.port = 0;
    const server::SystemClock clock;
    const auto server = WebServer::open(options, clock,
                                        {[](std::string_view path) { return page_answer(path); },
                                         [] { return std::vector<std::string>{"welcome"}; },
                                         [](std::string_view) { return std::string(); }})
                            .value();
    Client page(server->local());
    page.send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
    const int next = transport::FileDescriptor(::dup(STDERR_FILENO)).get();
    const rlimit none{static_cast<rlim_t>(next), before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
    int steps = 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
    for (; std::chrono::steady_clock::now() < end; ++steps)
        server->step(std::chrono::milliseconds(20));
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
    EXPECT_EQ(server->counts().connections, 0U);
    EXPECT_LE(steps, 40);
    for (int i = 0; i < 100 && server->counts().pages == 0; ++i)
        server->step(std::chrono::milliseconds(20));
    EXPECT_EQ(server->counts().pages, 1U);
}

/// The loopback interface of the calling thread's own network, up or down; false where it may not.
bool set_loopback(bool up) {
    const transport::FileDescriptor any(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    ifreq interface {};
    std::snprintf(interface.ifr_name, sizeof(interface.ifr_name), "lo");
    if (::ioctl(any.get(), SIOCGIFFLAGS, &interface) != 0) return false;
    interface.ifr_flags =
        static_cast<short>(up ? interface.ifr_flags | IFF_UP : interface.ifr_flags & ~IFF_UP);
    return ::ioctl(any.get(), SIOCSIFFLAGS, &interface) == 0;
}

TEST(HalfOpen, WhoIsGoneWithoutAWordIsEnded) {
    bool may = true;
    WebCounts counts;
    // A thread of its own, for a network of its own, whose cable can be pulled.
    std::thread([&] {
        may = ::unshare(CLONE_NEWNET) == 0 && set_loopback(true);
        if (!may) return;
        WebOptions options;
        options.listen.port = 0;
        options.time_limit = std::chrono::milliseconds(400);
        const server::SystemClock clock;
        const auto server = WebServer::open(options, clock,
                                            {[](std::string_view path) { return page_answer(path); },
                                             [] { return std::vector<std::string>{"welcome"}; },
                                             [](std::string_view) { return std::string(); }})
                                .value();
        Client page(server->local());
        const std::string name = transport::to_string(server->local());
        page.send("GET /ws HTTP/1.1\r\nHost: " + name + "\r\nOrigin: http://" + name +
                  "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: "
                  "13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        const auto step_while = [&](std::size_t sockets) {
            while (server->open_sockets() == sockets && std::chrono::steady_clock::now() < end) {
                server->step(std::chrono::milliseconds(5));
                server->publish_update("status");
            }
        };
        step_while(0);
        EXPECT_EQ(server->open_sockets(), 1U);
        EXPECT_TRUE(set_loopback(false));
        step_while(1);
        EXPECT_EQ(server->open_sockets(), 0U);
        counts = server->counts();
    }).join();
    if (!may) GTEST_SKIP() << "no network of its own is allowed here";
    EXPECT_EQ(counts.ended_for_slow, 1U);
}

}  // namespace
}  // namespace skyig::clients::instructor
