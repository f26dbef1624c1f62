// Finished frames on their way to files: a fixed pool of buffers, and one thread that empties them.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "render/channel.h"
#include "render/scene.h"

namespace skyig::server {

/// A live frame loop never waits for a disk: when no buffer is free, that frame's images are skipped and
/// counted. A replay, whose files may not depend on how fast it is drawn, waits.
class ImageWriter {
  public:
    /// What the writer is handed of a frame.
    enum class Takes : std::uint8_t {
        kPixels,  ///< as they are shown
        kScene,   ///< what they are drawn of: who writes draws too
    };

    struct Frame {
        std::uint64_t number = 0;
        /// RGBA, top row first, of each channel; none where scenes are taken.
        std::vector<std::vector<std::byte>> channels;
        /// Where scenes are taken.
        render::Scene scene;
        /// False: the scene comes before one that is written, and is only seen. Clouds and eyes have a past.
        bool written = true;
    };

    /// Writes one channel's image; false and one line in `error` when it cannot.
    using WriteFile = std::function<bool(const std::string& path, const Frame& frame, std::size_t channel,
                                         std::string& error)>;
    /// A frame that is not written.
    using SeeFrame = std::function<void(const Frame& frame)>;

    struct Files {
        WriteFile write;
        SeeFrame see = [](const Frame&) {};
    };

    struct Settings {
        std::string directory;
        std::vector<render::Channel> channels;
        /// Frames that may be under way at once, at least 1; allocated at the start.
        std::size_t buffers = 1;
        Takes takes = Takes::kPixels;
        /// Of the files' names.
        std::string extension = "png";
    };

    struct Counts {
        std::uint64_t written = 0;  ///< files complete
        std::uint64_t failed = 0;   ///< files that could not be written
        std::uint64_t skipped = 0;  ///< frames without a free buffer
    };

    /// Files are named directory/CHANNEL_NNNNNN.extension after the channel and the frame's number.
    /// \param files  called, and destroyed, on the writer's thread alone
    ImageWriter(Settings settings, Files files);
    ImageWriter(Settings settings, WriteFile write_file)
        : ImageWriter(std::move(settings), Files{std::move(write_file)}) {}
    /// Finishes.
    ~ImageWriter();
    ImageWriter(const ImageWriter&) = delete;
    ImageWriter& operator=(const ImageWriter&) = delete;
    ImageWriter(ImageWriter&&) = delete;
    ImageWriter& operator=(ImageWriter&&) = delete;

    [[nodiscard]] bool takes_scenes() const noexcept { return settings_.takes == Takes::kScene; }
    /// A buffer to fill, or null when all are under way (the frame then counts as skipped). Does not block on
    /// I/O.
    [[nodiscard]] Frame* try_acquire();
    /// The same, but waits until there is one.
    [[nodiscard]] Frame* acquire();
    /// Hands a filled buffer to the writing thread.
    void submit(Frame* frame);
    /// Returns when everything submitted has been written; nothing may be submitted afterwards.
    void finish();

    [[nodiscard]] Counts counts() const;
    /// The first failure, empty when there was none.
    [[nodiscard]] std::string first_error() const;

  private:
    [[nodiscard]] Frame* take_free() noexcept;
    void run(const Files& files);
    void write(const Frame& frame, const WriteFile& write_file);

    const Settings settings_;
    std::vector<Frame> frames_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable freed_;
    std::vector<Frame*> free_;
    std::vector<Frame*> queue_;  ///< oldest first
    Counts counts_;
    std::string first_error_;
    bool finishing_ = false;
    std::thread thread_;
};

}  // namespace skyig::server
