// One frame after the other: answer the host, take what it has sent, move the world, draw, write pictures.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "config/config.h"
#include "server/answers.h"
#include "server/clock.h"
#include "server/delays.h"
#include "server/frame_hashes.h"
#include "server/frame_table.h"
#include "server/image_writer.h"
#include "server/inbox.h"
#include "server/lock_step.h"
#include "server/log.h"
#include "server/overlay_text.h"
#include "server/overload.h"
#include "server/pace.h"
#include "server/painter.h"
#include "server/preview.h"
#include "server/report.h"
#include "server/scene_builder.h"
#include "server/service/service_manager.h"
#include "server/status/snapshot_exchange.h"
#include "server/wire.h"
#include "server/world/world.h"

namespace skyig::server {

/// What the loop works with; all must outlive it.
struct FrameLoopParts {
    Clock& clock;
    Log& log;
    Pace& pace;
    Wire& wire;
    world::World& world;
    Painter& painter;
    /// Null: no pictures are written.
    ImageWriter* images = nullptr;
    /// Null: pictures are not hashed.
    FrameHashes* hashes = nullptr;
    /// Null: frames are timed for the report alone.
    FrameTable* table = nullptr;
    /// Null: nobody is told how frames go.
    status::SnapshotExchange* status = nullptr;
    /// Null: nobody asks for small pictures.
    Preview* preview = nullptr;
    /// Null: nobody watches that frames come.
    service::ServiceManager* service = nullptr;
};

/// Neither a host nor a disk can hold it up. A frame allocates nothing in steady state.
class FrameLoop {
  public:
    /// \param frame_limit  frames to run, 0 = no limit
    /// \param image_every  images of each n-th frame are written, at least 1
    /// \param orientation  UT1 and pole as measured, what load_earth_orientation() gives
    FrameLoop(const config::Config& config, const FrameLoopParts& parts, std::uint64_t frame_limit,
              std::uint64_t image_every, ephemeris::EarthOrientation orientation = {});

    /// Draws the world as it stands once, so that tables and programs are there before the first frame is
    /// due. Not counted, not told to the host.
    void warm_up();

    /// Runs frames until the limit is reached, the pace ends or `stop` says so (asked once a frame).
    void run(const std::function<bool()>& stop);

    /// Waits for the next frame's start and runs it. \return false when there is none any more, or nobody
    /// wants to see another
    bool run_frame();

    /// Of the frame at hand or the last.
    [[nodiscard]] std::uint64_t frame_number() const noexcept { return frame_number_; }

    /// The settings have been read anew, and taken or refused.
    void note_settings(bool taken) noexcept;

    /// Everything counted so far; the images' counts are final once the writer has finished.
    [[nodiscard]] RunReport report() const;
    /// What of the status stays in a run; start and addresses are the caller's to add.
    [[nodiscard]] status::Facts facts() const;

  private:
    class Stopwatch;

    /// What the frame leaves out: as the recording has it, or as the last frames took their time.
    void thin(const FramePacer::Slot& slot);
    void answer_host(const FramePacer::Slot& slot, std::int64_t utc_ns);
    void take_input(const FramePacer::Slot& slot, status::FrameParts& times, Stopwatch& stopwatch);
    void draw(const render::Scene& scene, Stopwatch& stopwatch, status::FrameParts& times);
    void hand_out(const render::Scene& scene);
    void hand_out_images(const render::Scene& scene, bool written);
    void tell_host_of_pictures(std::int64_t first_utc_ns, std::int64_t last_utc_ns);
    void close_frame(const FramePacer::Slot& slot, const status::FrameParts& times);
    void tell_thinning(Overload::Step step);
    void tell_resets();
    void tell_channels();
    void tell_monitors();
    void hash_images();
    void watch(const FramePacer::Slot& slot);
    void tell_late_frames();
    void tell_spacing();
    void tell_dropped_datagrams();
    void tell_what_is_drawn_otherwise();
    void tell_date();
    /// A few times a second: a snapshot for who watches.
    void publish_status(const render::Scene& scene);
    void take_stock(status::Snapshot& snapshot) const;
    void take_stock_of_sources(status::Snapshot& snapshot) const;
    void take_stock_of_world(status::Snapshot& snapshot) const;
    void take_stock_of_pacing(status::Snapshot& snapshot) const;

    const config::Config& config_;
    FrameLoopParts parts_;
    std::uint64_t frame_limit_;
    std::uint64_t image_every_;

    Answers answers_;
    Inbox inbox_;
    SceneBuilder scenes_;
    OverlayText overlay_;
    FrameTimes times_;
    status::FrameRecord record_;
    LockStep lock_step_;
    Delays delays_;
    /// Nothing where the settings want none, and in a replay.
    std::optional<Overload> overload_;
    render::Thinned thinned_;
    bool on_processor_;
    std::size_t gl_objects_ = 0;

    std::uint64_t frame_number_ = 0;
    std::uint64_t late_frames_ = 0;
    std::uint64_t slots_left_out_ = 0;
    std::uint64_t start_of_frame_sent_ = 0;
    std::uint64_t start_of_frame_failed_ = 0;
    std::int64_t first_start_ns_ = 0;
    std::int64_t last_end_ns_ = 0;
    std::int64_t published_ns_ = 0;
    /// Since the last look at what goes wrong.
    struct Watched {
        std::uint64_t frames = 0;
        std::uint64_t slots = 0;
        std::uint64_t late = 0;
    };
    Watched watched_;
    std::vector<std::byte> read_back_;
    status::SettingsState settings_;
    /// Channels of which it has been said that they cannot be drawn.
    std::bitset<config::kMaxChannels> told_failed_;
    /// That their monitors are gone.
    std::bitset<config::kMaxChannels> told_hidden_;
    /// What has been said of the date, until it is said anew.
    std::uint64_t told_resets_ = 0;
    std::uint64_t told_spaced_ = 0;
    bool told_clamped_ = false;
    bool told_leap_seconds_ = false;
    protocol::transport::UdpCounters told_wire_;
};

}  // namespace skyig::server
