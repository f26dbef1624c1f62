// A recording in the place of sockets and clock: the same arrivals in the same frames, as often as wanted.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "config/config.h"
#include "protocol/recording/capture_reader.h"
#include "server/clock.h"
#include "server/pace.h"
#include "server/wire.h"

namespace skyig::server {

/// Reads one of our recordings, any capture of UDP or CAN, or a candump log. Ours say when each frame began
/// and how far the world moved; with others frames stand on a grid from the first packet on. A packet is of
/// the source that is heard at its destination port (its sender must be allowed there), a CAN frame of the
/// source with its interface; with one source of a kind alone it is that one's in any case.
class Replay {
  public:
    /// \throws std::runtime_error with one line when the file cannot be read
    Replay(const std::string& path, const config::Config& config);

    /// Goes to the next frame; nothing at the end of the recording.
    [[nodiscard]] std::optional<FrameMark> begin_frame();
    /// What came in the frame that was begun last.
    void drain(ArrivalTaker& taker);

    /// The instant that the recorded world started from, if the recording tells.
    [[nodiscard]] const std::string& start_utc() const noexcept { return start_utc_; }
    [[nodiscard]] const std::string& renderer() const noexcept { return renderer_; }
    [[nodiscard]] bool has_marks() const noexcept { return has_marks_; }
    /// Of a file that does not end as it should: one line.
    [[nodiscard]] const std::string& trouble() const noexcept { return reader_.trouble(); }
    /// Packets that are of no source.
    [[nodiscard]] std::uint64_t strangers() const noexcept { return strangers_; }

    /// Of a packet that stands for a frame's beginning and never was on a wire.
    [[nodiscard]] static std::optional<FrameMark> mark_of(
        const protocol::recording::CapturedPacket& packet) noexcept;

  private:
    void read_facts(const std::string& path);
    void advance();
    [[nodiscard]] std::optional<std::size_t> bus_of(
        const protocol::recording::CapturedPacket& packet) const noexcept;
    [[nodiscard]] std::optional<std::size_t> source_of(
        const protocol::recording::CapturedPacket& packet) const noexcept;
    void hand_over(const protocol::recording::CapturedPacket& packet, ArrivalTaker& taker);

    const config::Config& config_;
    protocol::recording::CaptureReader reader_;
    bool has_marks_ = false;
    std::string start_utc_;
    std::string renderer_;
    double period_ns_;
    /// The packet that is up next; null at the end. Belongs to the reader.
    const protocol::recording::CapturedPacket* next_ = nullptr;
    /// Without marks: of the grid.
    std::int64_t origin_ns_ = 0;
    std::uint64_t frames_ = 0;
    std::int64_t frame_ns_ = 0;
    std::uint64_t strangers_ = 0;
};

class ReplayWire final : public Wire {
  public:
    explicit ReplayWire(Replay& replay) noexcept : replay_(replay) {}

    void open_frame(const FrameMark& /*mark*/, std::span<const std::byte> /*message*/) override {}
    void drain(ArrivalTaker& taker) override { replay_.drain(taker); }
    /// Nobody listens.
    bool send(std::size_t /*source*/, const protocol::transport::Endpoint& /*to*/,
              std::span<const std::byte> /*bytes*/) override {
        return true;
    }
    [[nodiscard]] protocol::transport::UdpCounters counters() const override { return {}; }

  private:
    Replay& replay_;
};

/// Frames as the recording has them; `now` is moved to each, so that what goes by it goes by the recording.
class ReplayPace final : public Pace {
  public:
    /// \param speed  of the recorded pace, measured on `wall`; 0: as fast as it goes
    ReplayPace(Replay& replay, ManualClock& now, Clock& wall, double rate_hz, double speed) noexcept;

    [[nodiscard]] std::optional<FramePacer::Slot> next() override;
    [[nodiscard]] double period_s() const noexcept override { return period_s_; }
    [[nodiscard]] bool replays() const noexcept override { return true; }

  private:
    Replay& replay_;
    ManualClock& now_;
    Clock& wall_;
    double period_s_;
    double speed_;
    std::int64_t wall_start_ns_ = 0;
    std::uint64_t slots_ = 0;
    bool started_ = false;
};

}  // namespace skyig::server
