// Frames as an operator watches them: the last seconds one by one, all since the start in a few classes of
// duration, and why frames came late. Fixed memory, no allocation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace skyig::server::status {

/// What made the frame after it late. Our own: the longest of input, shared work, channels, output; kRebuild
/// instead of shared where tables were built anew. Not our own: the wait for the host, the swap of a window,
/// the machine, which woke us late or ran others meanwhile.
enum class LateCause : std::uint8_t {
    kInput,
    kShared,
    kChannels,
    kOutput,
    kRebuild,
    kHost,
    kDisplay,
    kMachine
};

inline constexpr std::size_t kLateCauses = 8;
inline constexpr std::array<std::string_view, kLateCauses> kLateCauseNames{
    "input", "shared", "channels", "output", "rebuild", "host", "display", "machine"};

/// Where one frame's time went. Host: the wait for its answer. Input: the answer to the host, what has come,
/// the world's step, the scene. Shared and channels: drawing. Output: pictures handed to files. Display: the
/// swap of the windows.
struct FrameParts {
    std::int64_t start_ns = 0;
    std::int64_t host_ns = 0;
    std::int64_t input_ns = 0;
    std::int64_t shared_ns = 0;
    std::int64_t channels_ns = 0;
    std::int64_t output_ns = 0;
    std::int64_t display_ns = 0;
    /// What all threads have worked meanwhile; nothing where the processor does not draw.
    std::optional<std::int64_t> processor_ns{};
    /// Its shared work built tables anew.
    bool rebuilt = false;

    [[nodiscard]] std::int64_t work_ns() const noexcept {
        return input_ns + shared_ns + channels_ns + output_ns;
    }
    [[nodiscard]] std::int64_t duration_ns() const noexcept { return host_ns + work_ns() + display_ns; }
};

/// Of a frame that took more than its period, or was woken too late. What would have fitted without its waits
/// waited; what took less processor time than the period would have fitted on a machine of its own; else it
/// is the longest of its own parts.
[[nodiscard]] LateCause late_cause(const FrameParts& parts, double period_s) noexcept;

/// The last frames taken together; zeros where there are none.
struct RecentFrames {
    std::size_t frames = 0;
    std::size_t late = 0;
    /// From start to start.
    double rate_hz = 0.0;
    double median_ms = 0.0;
    double p95_ms = 0.0;
    double largest_ms = 0.0;
};

class FrameRecord {
  public:
    /// So many frames are kept one by one: 8.5 s at 60 Hz.
    static constexpr std::size_t kKept = 512;
    /// Upper ends of the classes of duration; a last one without end follows.
    static constexpr std::array kClassEnds_s{0.001, 0.002, 0.004, 0.006, 0.008, 0.010, 0.012, 0.016,
                                             0.020, 0.025, 0.033, 0.050, 0.100, 0.250, 1.0};

    /// \param late  the frame itself began late, since the one before took too long: it counts for what held
    /// that one up, and so does one that is late since the one before had begun late
    void add(const FrameParts& parts, bool late, double period_s) noexcept;

    [[nodiscard]] RecentFrames recent() const noexcept;
    /// Frames since the start, by class.
    [[nodiscard]] const std::array<std::uint64_t, kClassEnds_s.size() + 1>& classes() const noexcept {
        return classes_;
    }
    [[nodiscard]] double sum_s() const noexcept { return static_cast<double>(sum_ns_) * 1e-9; }
    [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
    [[nodiscard]] std::uint64_t late(LateCause cause) const noexcept {
        return late_[static_cast<std::size_t>(cause)];
    }
    /// Of the last frame.
    [[nodiscard]] std::int64_t end_ns() const noexcept { return last_.start_ns + last_.duration_ns(); }

  private:
    struct Kept {
        std::int64_t start_ns = 0;
        float duration_ms = 0.0F;
        bool late = false;
    };

    std::array<Kept, kKept> kept_{};
    std::array<std::uint64_t, kClassEnds_s.size() + 1> classes_{};
    std::array<std::uint64_t, kLateCauses> late_{};
    std::uint64_t count_ = 0;
    std::int64_t sum_ns_ = 0;
    FrameParts last_;
    bool last_late_ = false;
    LateCause last_cause_ = LateCause::kMachine;
};

}  // namespace skyig::server::status
