// What a run of the daemon did: collected frame by frame without allocation, told once at the end.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "server/time_histogram.h"

namespace skyig::server {

/// Durations of a run's frames: answering and listening, the work all channels share, each channel, and the
/// whole frame.
class FrameTimes {
  public:
    explicit FrameTimes(std::size_t channels) : channels_(channels) {}

    TimeHistogram& input() noexcept { return input_; }
    TimeHistogram& shared() noexcept { return shared_; }
    TimeHistogram& frame() noexcept { return frame_; }
    TimeHistogram& channel(std::size_t index) noexcept { return channels_[index]; }
    [[nodiscard]] const TimeHistogram& input() const noexcept { return input_; }
    [[nodiscard]] const TimeHistogram& shared() const noexcept { return shared_; }
    [[nodiscard]] const TimeHistogram& frame() const noexcept { return frame_; }
    [[nodiscard]] const TimeHistogram& channel(std::size_t index) const noexcept { return channels_[index]; }
    [[nodiscard]] std::size_t channels() const noexcept { return channels_.size(); }

  private:
    TimeHistogram input_;
    TimeHistogram shared_;
    TimeHistogram frame_;
    std::vector<TimeHistogram> channels_;
};

/// How many frames the host's answers lag: the difference between the number of the last Start of Frame sent
/// and the one that an IG Control echoes.
class FramesBehind {
  public:
    void add(std::uint32_t frames) noexcept;
    [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
    /// The lag that the fraction `q` (0..1) of all stay at or below; 0 when nothing was added. Lags of
    /// kLargest and more count as kLargest.
    [[nodiscard]] std::uint32_t quantile(double q) const noexcept;
    [[nodiscard]] std::uint32_t largest() const noexcept { return largest_; }

    static constexpr std::uint32_t kLargest = 255;

  private:
    std::array<std::uint32_t, kLargest + 1> bins_{};
    std::uint64_t count_ = 0;
    std::uint32_t largest_ = 0;
};

struct TimeRow {
    std::string name;
    double median_ms = 0.0;
    double p95_ms = 0.0;
    double largest_ms = 0.0;
};

struct DelayRow {
    std::string name;
    std::uint64_t count = 0;
    double median_ms = 0.0;
    double p99_ms = 0.0;
    double largest_ms = 0.0;
};

struct NamedCount {
    std::string name;
    std::uint64_t count = 0;
};

/// A CAN bus that was listened to.
struct BusRow {
    std::string source;
    std::string interface;
    /// At the end: "missing", "down", "up".
    std::string state;
    std::vector<NamedCount> counts;
};

struct RunReport {
    std::string version;
    std::string renderer;
    double rate_hz = 0.0;
    double elapsed_s = 0.0;
    /// Processor time of all threads, those of the driver too.
    double cpu_s = 0.0;
    std::uint64_t frames = 0;
    std::uint64_t late_frames = 0;
    /// Grid slots without a frame, since the frame before took longer than a whole period.
    std::uint64_t slots_left_out = 0;
    /// By the clock, where the display should have but the swap of the windows did not wait.
    std::uint64_t frames_spaced = 0;
    /// Late frames by what held them up.
    std::vector<NamedCount> late_by_cause;
    /// From a message's arrival in the kernel to its picture: the channels, then "shown"; then of the host in
    /// control "host interval" and, if it stamps its messages, "host jitter".
    std::vector<DelayRow> delays;
    /// Frames that went on without the host's answer.
    std::uint64_t host_timeouts = 0;
    /// What is left out now, and how often something was left out and came back.
    std::vector<std::string> thinned;
    std::uint64_t times_thinned = 0;
    std::uint64_t times_returned = 0;
    std::uint64_t gl_objects = 0;
    /// "input" and "shared" first, then the channels, "frame" last.
    std::vector<TimeRow> times;

    /// The host last heard, "127.0.0.1:8005"; empty when none was.
    std::string host;
    /// "3.3 little-endian"; empty when no host was heard.
    std::string host_protocol;
    /// How often a host fell silent.
    std::uint64_t host_losses = 0;
    std::uint64_t datagrams = 0;
    std::vector<BusRow> buses;
    std::vector<NamedCount> packets;
    std::vector<NamedCount> rejects;
    std::uint64_t start_of_frame_sent = 0;
    std::uint64_t start_of_frame_failed = 0;
    std::uint32_t host_frames_behind_median = 0;
    std::uint32_t host_frames_behind_largest = 0;

    std::uint64_t images_written = 0;
    std::uint64_t images_failed = 0;
    /// Frames whose images were skipped because every buffer was under way.
    std::uint64_t image_frames_skipped = 0;
    std::uint64_t gl_errors = 0;
    std::uint64_t gl_resets = 0;

    /// "series"
    std::string ephemeris;
    /// Days of the file of Earth orientation, "1962-01-01..2026-08-21"; empty without one.
    std::string earth_orientation;
    /// Of the last frame: its date was brought into 1900..2100, lay beyond the announced leap seconds.
    bool date_clamped = false;
    bool leap_seconds_assumed = false;

    /// Of one processor; 0 for a run without time.
    [[nodiscard]] double cpu_pct() const noexcept;
    /// "series, Earth orientation measured 1962-01-01..2026-08-21"
    [[nodiscard]] std::string ephemeris_text() const;
};

/// The table for people, several lines, each with its end. Counts that are zero are left out of the lists.
[[nodiscard]] std::string to_table(const RunReport& report);

/// The same as JSON; every count is there, also the zeros.
[[nodiscard]] std::string to_json(const RunReport& report);

}  // namespace skyig::server
