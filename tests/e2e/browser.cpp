#include "tests/e2e/browser.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace skyig::tests {

using Json = nlohmann::json;

namespace {

constexpr const char* kProgram = "/usr/bin/chromium";
/// The pipes' ends in the browser (--remote-debugging-pipe).
constexpr int kItsIn = 3;
constexpr int kItsOut = 4;
constexpr int kAnswerWithin_ms = 20'000;

struct Pipe {
    int read = -1;
    int write = -1;
};

Pipe make_pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe for the browser");
    // Away from the numbers that the browser wants them at.
    Pipe pipe{::fcntl(ends[0], F_DUPFD_CLOEXEC, 10), ::fcntl(ends[1], F_DUPFD_CLOEXEC, 10)};
    ::close(ends[0]);
    ::close(ends[1]);
    return pipe;
}

std::string from_base64(const std::string& text) {
    static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0, held = 0;
    for (const char c : text) {
        const std::size_t digit = kDigits.find(c);
        if (digit == std::string::npos) break;
        held = held << 6U | static_cast<unsigned>(digit);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += static_cast<char>(held >> bits & 0xFFU);
    }
    return bytes;
}

}  // namespace

bool Browser::installed() {
    return ::access(kProgram, X_OK) == 0;
}

Browser::Browser() {
    const Pipe to = make_pipe();
    const Pipe from = make_pipe();
    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, to.read, kItsIn);
    posix_spawn_file_actions_adddup2(&files, from.write, kItsOut);
    const std::string log = profile_.file("log");
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&files, stream, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    // A group of its own, so that its helpers end with it.
    posix_spawnattr_t attributes{};
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::vector<std::string> words{kProgram,
                                   "--headless=new",
                                   "--remote-debugging-pipe",
                                   "--no-sandbox",
                                   "--disable-gpu",
                                   "--disable-dev-shm-usage",
                                   "--no-first-run",
                                   "--disable-extensions",
                                   "--disable-background-networking",
                                   "--disable-component-update",
                                   "--hide-scrollbars",
                                   "--user-data-dir=" + profile_.file("profile"),
                                   "about:blank"};
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int failed = posix_spawn(&pid_, kProgram, &files, &attributes, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    ::close(to.read);
    ::close(from.write);
    to_ = to.write;
    from_ = from.read;
    if (failed != 0) throw std::runtime_error("the browser cannot be started");
    const Json page = call("Target.createTarget", {{"url", "about:blank"}});
    session_ =
        call("Target.attachToTarget", {{"targetId", page["targetId"]}, {"flatten", true}})["sessionId"];
}

Browser::~Browser() {
    ::close(to_);
    ::close(from_);
    if (pid_ <= 0) return;
    ::kill(-pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
}

Json Browser::read_message() {
    std::size_t end = come_.find('\0');
    while (end == std::string::npos) {
        pollfd event{from_, POLLIN, 0};
        std::array<char, 65536> buffer;
        const ssize_t got =
            ::poll(&event, 1, kAnswerWithin_ms) > 0 ? ::read(from_, buffer.data(), buffer.size()) : 0;
        if (got <= 0)
            throw std::runtime_error("the browser does not answer: " + read_text(profile_.file("log")));
        come_.append(buffer.data(), static_cast<std::size_t>(got));
        end = come_.find('\0');
    }
    Json message = Json::parse(come_.substr(0, end));
    come_.erase(0, end + 1);
    return message;
}

Json Browser::call(const std::string& method, const Json& parameters) {
    Json request{{"id", ++calls_}, {"method", method}, {"params", parameters}};
    if (!session_.empty()) request["sessionId"] = session_;
    const std::string text = request.dump() + '\0';
    for (std::size_t sent = 0; sent < text.size();) {
        const ssize_t gone = ::write(to_, text.data() + sent, text.size() - sent);
        if (gone <= 0) throw std::runtime_error("the browser is gone");
        sent += static_cast<std::size_t>(gone);
    }
    while (true) {
        Json answer = read_message();
        if (answer.value("id", 0) != calls_) continue;
        if (answer.contains("error")) throw std::runtime_error(method + ": " + answer["error"].dump());
        return answer["result"];
    }
}

void Browser::open(const std::string& url) {
    (void)call("Page.navigate", {{"url", url}});
}

void Browser::resize(int width_px, int height_px) {
    (void)call("Emulation.setDeviceMetricsOverride",
               {{"width", width_px}, {"height", height_px}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

Json Browser::evaluate(const std::string& expression) {
    const Json result = call("Runtime.evaluate",
                             {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
    if (result.contains("exceptionDetails"))
        throw std::runtime_error(expression + ": " + result["exceptionDetails"].dump());
    return result["result"].value("value", Json());
}

void Browser::mouse(const std::string& type, double x, double y) {
    (void)call("Input.dispatchMouseEvent", {{"type", type},
                                            {"x", x},
                                            {"y", y},
                                            {"button", "left"},
                                            {"buttons", type == "mouseReleased" ? 0 : 1},
                                            {"clickCount", 1}});
}

void Browser::drag(double from_x, double from_y, double to_x, double to_y) {
    constexpr int kSteps = 8;
    mouse("mousePressed", from_x, from_y);
    for (int step = 1; step <= kSteps; ++step) {
        const double part = static_cast<double>(step) / kSteps;
        mouse("mouseMoved", from_x + part * (to_x - from_x), from_y + part * (to_y - from_y));
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
    }
    mouse("mouseReleased", to_x, to_y);
}

void Browser::press(const std::string& key) {
    const int code = key == "Tab" ? 9 : key == "ArrowUp" ? 38 : key == "ArrowRight" ? 39 : 0;
    if (code == 0) throw std::runtime_error("no code is known of the key " + key);
    for (const char* type : {"keyDown", "keyUp"})
        (void)call("Input.dispatchKeyEvent",
                   {{"type", type}, {"key", key}, {"code", key}, {"windowsVirtualKeyCode", code}});
}

std::string Browser::screenshot(bool whole_page) {
    return from_base64(call("Page.captureScreenshot", {{"captureBeyondViewport", whole_page}})["data"]);
}

}  // namespace skyig::tests
