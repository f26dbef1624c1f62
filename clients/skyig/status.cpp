#include "clients/skyig/status.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "clients/skyig/status/http_get.h"
#include "clients/skyig/status/page.h"
#include "clients/skyig/status/rig_page.h"

namespace skyig::clients {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds kAnswerWithin{3000};
/// Cursor home, and everything below it cleared.
constexpr const char* kClearScreen = "\x1b[H\x1b[J";

/// A page, or one line that says why there is none.
struct Told {
    std::string text;
    std::optional<Json> status;
};

Told of_the_rig(const status::Url& url, const StatusOptions& options, const Json& status) {
    const Json rig = status.value("rig", Json());
    if (rig.is_null()) {
        const bool began = status.at("frames") != 0;
        return {fmt::format("{} {}\n", status::to_string(url),
                            began ? "draws alone: its settings have no [rig]" : "has drawn no frame yet"),
                {}};
    }
    if (!options.json) return {status::rig_text(rig), rig};
    return {rig.dump(options.watch_s ? -1 : 2) + '\n', rig};
}

Told ask(const status::Url& url, const StatusOptions& options, const std::optional<Json>& before,
         const server::Clock& clock) {
    const auto body = status::http_get(url, "/status", kAnswerWithin, clock);
    if (!body) {
        return {fmt::format("no answer from {}: {}; is skyigd running, and is that its [status] port?\n",
                            status::to_string(url), body.error()),
                {}};
    }
    try {
        Json status = Json::parse(*body);
        // Any web server answers something to any path.
        (void)status.at("frames");
        if (options.rig) return of_the_rig(url, options, status);
        if (options.json && !options.watch_s) return {*body, std::move(status)};
        if (options.json) return {status.dump() + '\n', std::move(status)};
        return {status::page_text(status, before ? &*before : nullptr), std::move(status)};
    } catch (const Json::exception&) {
        return {fmt::format("what answers at {} is not skyigd\n", status::to_string(url)), {}};
    }
}

}  // namespace

int run_status(const StatusOptions& options) {
    server::SystemClock clock;
    return run_status(options, clock, std::numeric_limits<int>::max());
}

int run_status(const StatusOptions& options, server::Clock& clock, int most_pages) {
    const auto url = status::parse_url(options.url);
    if (!url) {
        fmt::print(stderr, "skyig status: {}\n", url.error());
        return 1;
    }
    const bool clear = options.clear_screen && !options.json && ::isatty(STDOUT_FILENO) == 1;
    std::optional<Json> before;
    std::int64_t next_ns = clock.monotonic_ns();
    for (int page = 0; page < most_pages; ++page) {
        Told told = ask(*url, options, before, clock);
        if (!told.status && page == 0) {
            fmt::print(stderr, "skyig status: {}", told.text);
            return 1;
        }
        // Who reads JSON reads nothing else.
        if (!told.status && options.json) {
            fmt::print(stderr, "skyig status: {}", told.text);
        } else {
            fmt::print("{}{}", clear ? kClearScreen : page > 0 && !options.json ? "\n" : "", told.text);
        }
        if (!options.watch_s) return 0;
        std::fflush(stdout);
        before = std::move(told.status);
        // Pages that a slow answer has made late are not caught up on.
        next_ns = std::max(next_ns + static_cast<std::int64_t>(*options.watch_s * 1e9), clock.monotonic_ns());
        clock.sleep_until_ns(next_ns);
    }
    return 0;
}

}  // namespace skyig::clients
