// The daemon as a service manager sees it: a socket that it tells, signals that it gets.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/transport/file_descriptor.h"
#include "tests/e2e/process.h"
#include "tests/e2e/site.h"

namespace skyig::tests {
namespace {

using protocol::transport::FileDescriptor;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using ::testing::HasSubstr;

/// The manager's end of NOTIFY_SOCKET.
class Manager {
  public:
    explicit Manager(const std::string& path) : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        if (path.size() >= sizeof(address.sun_path)) throw std::runtime_error("path is too long");
        std::memcpy(address.sun_path, path.data(), path.size());
        if (::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
            throw std::runtime_error("no socket for a service manager");
    }

    /// The next message, or nothing in that time.
    [[nodiscard]] std::string hear(milliseconds limit) const {
        pollfd ready{socket_.get(), POLLIN, 0};
        if (::poll(&ready, 1, static_cast<int>(limit.count())) != 1) return {};
        std::array<char, 1024> text{};
        const ssize_t size = ::recv(socket_.get(), text.data(), text.size(), 0);
        return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : std::string();
    }

    /// Whether a message with this in it comes before the limit; what comes before it is passed over.
    [[nodiscard]] bool hears(const std::string& part, milliseconds limit = milliseconds(30000)) const {
        const auto end = steady_clock::now() + limit;
        while (steady_clock::now() < end) {
            const auto left = std::chrono::duration_cast<milliseconds>(end - steady_clock::now());
            if (hear(left).find(part) != std::string::npos) return true;
        }
        return false;
    }

  private:
    FileDescriptor socket_;
};

struct Service {
    Site site;
    std::string socket_path = site.scratch.file("notify");
    Manager manager{socket_path};

    [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words{SKYIGD_PROGRAM, "--config", site.config_path, "--headless"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    [[nodiscard]] std::vector<std::string> environment(const std::string& watchdog_us) const {
        return {"NOTIFY_SOCKET=" + socket_path, "WATCHDOG_USEC=" + watchdog_us};
    }
};

TEST(Service, SaysThatItServesAndEndsWithinASecond) {
    const Service service;
    Process daemon(service.command(), service.environment("0"));
    ASSERT_TRUE(service.manager.hears("READY=1\nSTATUS=CIGI on udp 127.0.0.1:"));
    EXPECT_EQ(service.manager.hear(milliseconds(300)), "") << "nobody asked for a watchdog";
    const auto asked = steady_clock::now();
    daemon.signal(SIGTERM);
    EXPECT_TRUE(service.manager.hears("STOPPING=1", milliseconds(1000)));
    const Finished finished = daemon.wait();
    const auto took = std::chrono::duration<double>(steady_clock::now() - asked);
    EXPECT_EQ(finished.status, 0) << finished.err;
    std::printf("ended %.0f ms after SIGTERM\n", took.count() * 1e3);
    EXPECT_LT(took.count(), 1.0);
}

// The hashes of pictures are written by the frame loop itself: into a pipe that nobody empties it gets stuck.
TEST(Service, AStuckFrameLoopStopsTheWatchdogAndNothingElseDoes) {
    constexpr milliseconds kWatchdog{1200};
    const Service service;
    std::string settings = read_text(service.site.config_path);
    settings.replace(settings.find("rate_hz = 60"), 12, "rate_hz = 240");
    (void)service.site.scratch.write("site.toml", settings);
    const std::string pipe_path = service.site.scratch.file("hashes");
    ASSERT_EQ(::mkfifo(pipe_path.c_str(), 0600), 0);
    const FileDescriptor pipe(::open(pipe_path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    ASSERT_GE(::fcntl(pipe.get(), F_SETPIPE_SZ, 4096), 0);
    Process daemon(service.command({"--hashes", pipe_path}), service.environment("1200000"));
    ASSERT_TRUE(service.manager.hears("READY=1"));
    int fed = 0;
    while (service.manager.hear(kWatchdog) == "WATCHDOG=1" && fed < 200)
        ++fed;
    std::printf("fed %d times, then not for %lld ms: the manager would act\n", fed,
                static_cast<long long>(kWatchdog.count()));
    EXPECT_GE(fed, 2);
    ASSERT_LT(fed, 200) << "the frame loop was to be stuck in a full pipe";
    const Finished health = run({SKYIG_PROGRAM, "status", "--url", status_url(daemon)});
    EXPECT_THAT(health.out, HasSubstr("no frame for")) << "its other threads go on: " << health.err;

    std::array<char, 8192> emptied{};
    EXPECT_GT(::read(pipe.get(), emptied.data(), emptied.size()), 0);
    EXPECT_TRUE(service.manager.hears("WATCHDOG=1", kWatchdog));
}

}  // namespace
}  // namespace skyig::tests
