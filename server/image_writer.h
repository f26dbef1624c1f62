// Finished frames on their way to files: a fixed pool of buffers, and one thread that empties them.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "render/channel.h"

namespace skyig::server {

/// The frame loop never waits for a disk: when no buffer is free, that frame's images are skipped and
/// counted.
class ImageWriter {
  public:
    /// Writes one image (RGBA, top row first); false and one line in `error` when it cannot.
    using WriteFile = std::function<bool(const std::string& path, const render::Channel& channel,
                                         std::span<const std::byte> rgba, std::string& error)>;

    /// The pixels of all channels of one frame.
    struct Frame {
        std::uint64_t number = 0;
        std::vector<std::vector<std::byte>> channels;
    };

    struct Counts {
        std::uint64_t written = 0;  ///< files complete
        std::uint64_t failed = 0;   ///< files that could not be written
        std::uint64_t skipped = 0;  ///< frames without a free buffer
    };

    /// Files are named directory/CHANNEL_NNNNNN.png after the channel and the frame's number.
    /// \param buffers  frames that may be under way at once, at least 1; allocated here, once
    ImageWriter(std::string directory, std::vector<render::Channel> channels, std::size_t buffers,
                WriteFile write_file);
    /// Finishes.
    ~ImageWriter();
    ImageWriter(const ImageWriter&) = delete;
    ImageWriter& operator=(const ImageWriter&) = delete;
    ImageWriter(ImageWriter&&) = delete;
    ImageWriter& operator=(ImageWriter&&) = delete;

    /// A buffer to fill, or null when all are under way (the frame then counts as skipped). Does not block on
    /// I/O.
    [[nodiscard]] Frame* try_acquire();
    /// Hands a filled buffer to the writing thread.
    void submit(Frame* frame);
    /// Returns when everything submitted has been written; nothing may be submitted afterwards.
    void finish();

    [[nodiscard]] Counts counts() const;
    /// The first failure, empty when there was none.
    [[nodiscard]] std::string first_error() const;

  private:
    void run();
    void write(const Frame& frame);

    const std::string directory_;
    const std::vector<render::Channel> channels_;
    const WriteFile write_file_;
    std::vector<Frame> frames_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::vector<Frame*> free_;
    std::vector<Frame*> queue_;  ///< oldest first
    Counts counts_;
    std::string first_error_;
    bool finishing_ = false;
    std::thread thread_;
};

}  // namespace skyig::server
