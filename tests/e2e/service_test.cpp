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
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
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
using ::testing::Not;
using Json = nlohmann::json;

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

Json status_of(const Process& daemon) {
    const Finished told = run({SKYIG_PROGRAM, "status", "--json", "--url", status_url(daemon)});
    EXPECT_EQ(told.status, 0) << told.err;
    return Json::parse(told.out);
}

/// The site's settings with one text in place of another.
void rewrite(const Site& site, const std::string& from, const std::string& to) {
    std::string settings = read_text(site.config_path);
    const std::size_t at = settings.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    (void)site.scratch.write("site.toml", settings.replace(at, from.size(), to));
}

TEST(Service, TakesWhatCanChangeLiveAndSaysWhatCannot) {
    const Service service;
    Process daemon(service.command(), service.environment("0"));
    ASSERT_TRUE(service.manager.hears("READY=1"));
    rewrite(service.site, "version = 1\n", "version = 1\nair.visibility_m = 5000\n");
    rewrite(service.site, "yaw_deg = 0", "yaw_deg = 20");
    daemon.signal(SIGHUP);
    EXPECT_TRUE(service.manager.hears("RELOADING=1\nMONOTONIC_USEC="));
    EXPECT_TRUE(service.manager.hears("READY=1\nSTATUS=settings taken"));
    ASSERT_TRUE(daemon.wait_for_err("settings read anew: air.visibility_m\n"));
    ASSERT_TRUE(daemon.wait_for_err(": channel[1].yaw_deg: is taken at the next start only\n"));
    EXPECT_THAT(daemon.err_so_far(), HasSubstr("/site.toml:17:11: channel[1]."));
    Json status = status_of(daemon);
    for (int i = 0; i < 50 && status["settings"]["times_taken"] != 1; ++i)
        status = status_of(daemon);
    EXPECT_EQ(status["settings"]["times_taken"], 1);
    EXPECT_TRUE(status["settings"]["last_taken_utc"].is_string());
    EXPECT_EQ(status["world"]["air"]["visibility_m"], 5000.0);
}

TEST(Service, TakesAnotherQualityWithoutAFailedFrame) {
    const Service service;
    Process daemon(service.command(), service.environment("0"));
    ASSERT_TRUE(service.manager.hears("READY=1"));
    rewrite(service.site, "version = 1\n", "version = 1\nquality.error_codes = 4.0\n");
    daemon.signal(SIGHUP);
    EXPECT_TRUE(service.manager.hears("READY=1\nSTATUS=settings taken"));
    ASSERT_TRUE(daemon.wait_for_err("settings read anew: quality.error_codes\n"));
    const std::uint64_t frames = status_of(daemon)["frames"];
    Json status = status_of(daemon);
    for (int i = 0; i < 100 && status["frames"] < frames + 3; ++i)
        status = status_of(daemon);
    EXPECT_GE(status["frames"], frames + 3) << "frames go on";
    EXPECT_EQ(status["gl_errors"], 0);
    EXPECT_THAT(daemon.err_so_far(), Not(HasSubstr("cannot be drawn")));
    daemon.signal(SIGTERM);
    EXPECT_EQ(daemon.wait().status, 0);
}

// All of the picture is set up anew, which takes as long as a start: the manager is told so before, and that
// it is over after.
TEST(Service, AnotherQualityHoldsUpTheWatchdogNotTheManager) {
    const Service service;
    Process daemon(service.command(), service.environment("1200000"));
    ASSERT_TRUE(service.manager.hears("READY=1"));
    rewrite(service.site, "version = 1\n", "version = 1\nquality.error_codes = 3\n");
    daemon.signal(SIGHUP);
    ASSERT_TRUE(service.manager.hears("RELOADING=1"));
    const std::vector<std::string> wanted{"WATCHDOG=1\nWATCHDOG_USEC=60000000",
                                          "WATCHDOG=1\nWATCHDOG_USEC=1200000",
                                          "READY=1\nSTATUS=settings taken"};
    std::vector<std::string> heard;
    while (heard.size() < wanted.size()) {
        const std::string message = service.manager.hear(milliseconds(30000));
        ASSERT_NE(message, "");
        if (message != "WATCHDOG=1") heard.push_back(message);
    }
    EXPECT_EQ(heard, wanted);
    EXPECT_EQ(service.manager.hear(milliseconds(1200)), "WATCHDOG=1");
    daemon.signal(SIGTERM);
    EXPECT_EQ(daemon.wait().status, 0);
}

TEST(Service, RefusesABrokenFileWholeAndGoesOn) {
    const Service service;
    Process daemon(service.command(), service.environment("0"));
    ASSERT_TRUE(service.manager.hears("READY=1"));
    rewrite(service.site, "version = 1\n", "version = 1\nair.visibility_m = 5000\nair.wind_m_s = 900\n");
    daemon.signal(SIGHUP);
    EXPECT_TRUE(service.manager.hears("READY=1\nSTATUS=settings refused"));
    ASSERT_TRUE(daemon.wait_for_err("settings not taken, those that held go on: "));
    EXPECT_THAT(daemon.err_so_far(), HasSubstr("site.toml:3:16: air.wind_m_s: is 900; it must be 0..60 m/s"));
    Json status = status_of(daemon);
    for (int i = 0; i < 50 && status["settings"]["times_refused"] != 1; ++i)
        status = status_of(daemon);
    EXPECT_EQ(status["settings"]["times_refused"], 1);
    EXPECT_TRUE(status["settings"]["last_taken_utc"].is_null());
    EXPECT_EQ(status["world"]["air"]["visibility_m"], 80000.0);
    daemon.signal(SIGTERM);
    EXPECT_EQ(daemon.wait().status, 0);
}

TEST(Service, LogsAnObjectOfJsonALine) {
    const Site site;
    const Finished finished =
        run({SKYIGD_PROGRAM, "--config", site.config_path, "--headless", "--frames", "2", "--log-json"});
    std::istringstream lines(finished.err);
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
        const Json object = Json::parse(line);
        EXPECT_EQ(object.size(), 4U) << line;
        EXPECT_EQ(object["level"], "info") << line;
        EXPECT_EQ(object["source"], "skyigd");
        EXPECT_EQ(object["time"].get<std::string>().size(), 24U) << line;
        EXPECT_FALSE(object["text"].get<std::string>().empty());
    }
    EXPECT_GE(count, 3);
}

TEST(Service, AFullDiskCostsTheRecordingOnly) {
    const Site site;
    const Finished finished = run({SKYIGD_PROGRAM, "--config", site.config_path, "--headless", "--frames",
                                   "40", "--record", "/dev/full", "--report", site.report_path});
    EXPECT_EQ(finished.status, 1) << "what an option asks for is part of the work";
    EXPECT_THAT(finished.err, HasSubstr("/dev/full: writing failed; the recording ends there"));
    EXPECT_THAT(finished.err, Not(HasSubstr("too slow")));
    EXPECT_EQ(Json::parse(read_text(site.report_path))["frames"], 40);
}

TEST(Service, AFullDiskUnderFilesThatWereAskedForIsAFailure) {
    const Site site;
    for (const char* const option : {"--hashes", "--times", "--events"}) {
        const Finished finished = run({SKYIGD_PROGRAM, "--config", site.config_path, "--headless", "--frames",
                                       "4", option, "/dev/full"});
        EXPECT_EQ(finished.status, 1) << option;
        EXPECT_THAT(finished.err, HasSubstr("skyigd: /dev/full: not all could be written")) << option;
    }
}

/// A shell's words in a mount namespace of their own, where `directory` is a disk that takes no writes.
Finished run_with_read_only(const std::string& directory, const std::string& words) {
    const std::string mounted = "mount -t tmpfs tmpfs '" + directory + "' && mount -o remount,ro '" +
                                directory + "' || exit 77; " + words;
    Finished finished = run({"/usr/bin/unshare", "--mount", "/bin/sh", "-c", mounted});
    if (finished.status == 77 || finished.err.starts_with("unshare:"))
        finished = run({"/usr/bin/unshare", "--map-root-user", "--mount", "/bin/sh", "-c", mounted});
    return finished;
}

TEST(Service, OnADiskThatIsReadOnlySaysWhichFileCannotBeMade) {
    const Site site;
    const std::string disk = site.scratch.file("disk");
    ASSERT_TRUE(std::filesystem::create_directory(disk));
    const std::string daemon =
        std::string(SKYIGD_PROGRAM) + " --headless --frames 3 --config '" + site.config_path + "' ";
    for (const char* const option : {"--record", "--hashes", "--times", "--events", "--out", "--report"}) {
        const std::string path = disk + "/" + (option + 2);
        const Finished finished = run_with_read_only(disk, daemon + option + " '" + path + "'");
        if (finished.status == 77) GTEST_SKIP() << "no mount namespaces here: " << finished.err;
        EXPECT_EQ(finished.status, 1) << option;
        EXPECT_THAT(finished.err, HasSubstr("skyigd: " + path + ": ")) << option;
    }
}

TEST(Service, WhereNothingCanBeWrittenItDoesNotStart) {
    const Site site;
    const Finished finished = run({SKYIGD_PROGRAM, "--config", site.config_path, "--headless", "--frames",
                                   "1", "--record", "/proc/sky.pcapng"});
    EXPECT_EQ(finished.status, 1);
    EXPECT_THAT(finished.err, HasSubstr("skyigd: /proc/sky.pcapng: "));
}

}  // namespace
}  // namespace skyig::tests
