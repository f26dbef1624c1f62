// What the daemon tells: its /status and its channels' pictures, asked for on two threads of their own, so
// that a slow answer holds up nobody else.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "clients/skyig/status/http_get.h"
#include "protocol/transport/event_signal.h"
#include "server/clock.h"

namespace skyig::clients::instructor {

class DaemonWatch {
  public:
    /// Starts both threads. `clock` must outlive it.
    DaemonWatch(const status::Url& url, const server::Clock& clock);
    DaemonWatch(const DaemonWatch&) = delete;
    DaemonWatch& operator=(const DaemonWatch&) = delete;
    DaemonWatch(DaemonWatch&&) = delete;
    DaemonWatch& operator=(DaemonWatch&&) = delete;
    /// Waits for the request at hand, 2 s at most.
    ~DaemonWatch();

    struct News {
        /// The body of /status; else `silence` says why there is none.
        std::optional<std::string> status;
        std::string silence;
    };
    struct Picture {
        std::string channel;
        std::string jpeg;
    };

    /// What has come since the last call.
    [[nodiscard]] std::optional<News> take_news();
    [[nodiscard]] std::vector<Picture> take_pictures();
    /// Whose pictures are wanted from now on; none: the daemon is not asked for any.
    void want(std::vector<std::string> channels);

  private:
    void watch_status();
    void watch_pictures();
    /// False: it is to stop.
    [[nodiscard]] bool wait_until(std::size_t thread, std::int64_t next_ns);

    status::Url url_;
    const server::Clock& clock_;
    std::atomic<bool> stopping_{false};
    /// Of each thread.
    std::array<protocol::transport::EventSignal, 2> stop_;
    std::mutex mutex_;
    std::optional<News> news_;
    std::vector<std::string> wanted_;
    std::map<std::string, std::string> pictures_;
    std::array<std::thread, 2> threads_;
};

}  // namespace skyig::clients::instructor
