// Where each frame's time has gone, a line of CSV a frame: what the report's medians cannot tell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "config/config.h"
#include "server/report.h"

namespace skyig::server {

struct FrameRow {
    std::uint64_t number = 0;
    /// When it began, POSIX nanoseconds.
    std::int64_t utc_ns = 0;
    std::uint64_t slots = 0;
    bool late = false;
    /// Datagrams and CAN frames that it has taken.
    std::uint64_t arrivals = 0;
    /// When it was shown, on the machine's monotonic clock; 0: the picture before stayed.
    std::int64_t shown_ns = 0;
};

/// Columns frame, utc_ns, slots, late, arrivals, then microseconds: input_us, shared_us, one for each channel
/// by its name, frame_us; last shown_ns. Written by the frame loop itself, 64 KiB at a time: for measuring,
/// not for a cockpit.
class FrameTable {
  public:
    /// \throws std::runtime_error with one line when the file cannot be made
    FrameTable(const std::string& path, const std::vector<config::Channel>& channels);

    /// `times` with this frame added last.
    void add(const FrameRow& row, const FrameTimes& times) noexcept;
    /// No more comes. \return whether the file holds all
    [[nodiscard]] bool finish() noexcept;

  private:
    struct CloseFile {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };
    std::vector<char> buffer_;
    std::unique_ptr<std::FILE, CloseFile> file_;
};

}  // namespace skyig::server
