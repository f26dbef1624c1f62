#include "clients/instructor/daemon_watch.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace skyig::clients::instructor {

namespace {

constexpr std::int64_t kStatusEvery_ns = 200'000'000;
constexpr std::int64_t kPicturesEvery_ns = 250'000'000;
constexpr std::chrono::milliseconds kAnswerWithin{2000};

}  // namespace

DaemonWatch::DaemonWatch(const status::Url& url, const server::Clock& clock) : url_(url), clock_(clock) {
    threads_[0] = std::thread([this] { watch_status(); });
    threads_[1] = std::thread([this] { watch_pictures(); });
}

DaemonWatch::~DaemonWatch() {
    stopping_.store(true);
    for (auto& signal : stop_)
        signal.raise();
    for (std::thread& thread : threads_)
        thread.join();
}

bool DaemonWatch::wait_until(std::size_t thread, std::int64_t next_ns) {
    const std::int64_t left_ms = std::max<std::int64_t>((next_ns - clock_.monotonic_ns()) / 1'000'000, 1);
    (void)stop_[thread].wait(std::chrono::milliseconds(left_ms), [this] { return stopping_.load(); });
    return !stopping_.load();
}

void DaemonWatch::watch_status() {
    std::int64_t next_ns = clock_.monotonic_ns();
    do {
        next_ns = clock_.monotonic_ns() + kStatusEvery_ns;
        auto body = status::http_get(url_, "/status", kAnswerWithin, clock_);
        News news;
        if (body) {
            news.status = std::move(*body);
        } else {
            news.silence = body.error();
        }
        const std::scoped_lock lock(mutex_);
        news_ = std::move(news);
    } while (wait_until(0, next_ns));
}

void DaemonWatch::watch_pictures() {
    std::int64_t next_ns = clock_.monotonic_ns();
    do {
        next_ns = clock_.monotonic_ns() + kPicturesEvery_ns;
        std::vector<std::string> channels;
        {
            const std::scoped_lock lock(mutex_);
            channels = wanted_;
        }
        for (const std::string& channel : channels) {
            if (stopping_.load()) return;
            auto jpeg = status::http_get(url_, "/channels/" + channel + ".jpg", kAnswerWithin, clock_);
            if (!jpeg) continue;
            const std::scoped_lock lock(mutex_);
            pictures_[channel] = std::move(*jpeg);
        }
    } while (wait_until(1, next_ns));
}

std::optional<DaemonWatch::News> DaemonWatch::take_news() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(news_, std::nullopt);
}

std::vector<DaemonWatch::Picture> DaemonWatch::take_pictures() {
    std::map<std::string, std::string> come;
    {
        const std::scoped_lock lock(mutex_);
        come.swap(pictures_);
    }
    std::vector<Picture> pictures;
    for (auto& [channel, jpeg] : come)
        pictures.push_back({channel, std::move(jpeg)});
    return pictures;
}

void DaemonWatch::want(std::vector<std::string> channels) {
    const std::scoped_lock lock(mutex_);
    wanted_ = std::move(channels);
}

}  // namespace skyig::clients::instructor
