// Small pictures of the channels for people who watch from afar: made only while somebody asks, encoded on a
// thread of their own, the newest frame wins.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "render/channel.h"

namespace skyig::server {

class Preview {
  public:
    struct Settings {
        /// Pictures a second and channel, at most.
        double rate_hz = 5.0;
        /// Wider channels are made smaller by a whole factor.
        int width_px = 640;
        /// 1..100
        int quality = 80;
    };
    /// A picture as a file; false when it cannot be made. Called on the preview's thread.
    using Encode = std::function<bool(int width_px, int height_px, std::span<const std::byte> rgba,
                                      int quality, std::string& file)>;
    /// RGBA of a channel, top row first.
    using ReadBack = std::function<void(std::size_t channel, std::span<std::byte> rgba)>;

    /// Allocates what it needs for pictures here and as they are asked for first.
    Preview(std::vector<render::Channel> channels, const Settings& settings, Encode encode);
    ~Preview();
    Preview(const Preview&) = delete;
    Preview& operator=(const Preview&) = delete;
    Preview(Preview&&) = delete;
    Preview& operator=(Preview&&) = delete;

    /// For the frame loop, after a frame is drawn: takes of those channels that are asked for and due a
    /// quarter of all, rounded up, so that no frame reads back all of a rig. Never waits for the encoder.
    void offer(std::int64_t now_ns, const ReadBack& read_back);

    struct Picture {
        /// Null: none has been made yet.
        std::shared_ptr<const std::string> file;
        /// Rises with each picture of the channel.
        std::uint64_t number = 0;
    };
    /// From any thread. Asks for pictures of the channel for the next kAskedFor_ns. \param now_ns  of the
    /// clock that offer() goes by
    [[nodiscard]] Picture newest(std::size_t channel, std::int64_t now_ns);
    [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const noexcept;

    static constexpr std::int64_t kAskedFor_ns = 2'000'000'000;

  private:
    struct Slot {
        std::atomic<std::int64_t> asked_ns{-kAskedFor_ns};
        std::int64_t taken_ns = 0;  // the frame loop's
        std::vector<std::byte> rgba;
        bool full = false;
        Picture picture;
    };
    void run();
    [[nodiscard]] bool any_full() const noexcept;
    void shrink(const render::Channel& channel, int factor);

    std::vector<render::Channel> channels_;
    Settings settings_;
    Encode encode_;
    std::vector<std::unique_ptr<Slot>> slots_;
    std::vector<std::byte> frame_;     // the frame loop's
    std::vector<std::byte> working_;   // the thread's
    std::vector<std::uint32_t> sums_;  // likewise
    std::string file_;
    std::size_t next_ = 0;  // channel that offer() looks at first
    std::mutex mutex_;      // of the slots' rgba, full, picture, and of stopping_
    std::condition_variable filled_;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace skyig::server
