// The image generator's side of one CIGI link as plain value logic: frame numbers, modes, database handshake.
// No clock, no socket: the caller brings the messages and sends what comes out.
#pragma once

#include <cstdint>
#include <string_view>

#include "protocol/cigi/packets.h"
#include "protocol/cigi/wire.h"

namespace skyig::protocol::cigi {

/// "standby", "operate", "debug", "offline maintenance"
[[nodiscard]] std::string_view mode_name(IgMode mode) noexcept;

enum class DatabasePolicy : std::uint8_t {
    kAccept,  // any number n: -n for a frame at least, +n when the host has sent 0
    kNone     // 0 always: the image generator needs no database
};

struct SessionOptions {
    /// Announced until a first valid IG Control came.
    Version version = Version::k33;
    DatabasePolicy database = DatabasePolicy::kAccept;
};

/// What one IG Control has changed.
struct SessionEvents {
    /// The other packets of this message are to be obeyed (not late, and the mode after it is not Standby).
    bool obey = false;
    bool first_contact = false;
    /// The host began anew: its frame numbers jumped back.
    bool host_restarted = false;
    /// An old message, overtaken by newer ones; nothing of it was taken in.
    bool late = false;
    bool version_changed = false;
    bool mode_changed = false;
    /// Standby was entered: everything goes back to its defaults.
    bool entered_standby = false;
    /// Messages missing between this one and the one before.
    std::uint32_t frames_missed = 0;
};

class Session {
  public:
    /// A jump back by more frames than this is a restarted host; a smaller one is a late message ...
    static constexpr std::int32_t kLateFrames = 300;
    /// ... unless so many messages in a row are late.
    static constexpr int kLateRun = 8;

    explicit Session(const SessionOptions& options = {}) noexcept;

    /// Takes in the IG Control of an accepted message; `control` is validated.
    SessionEvents receive(const IgControl& control, Version version, ByteOrder order) noexcept;

    /// The Start of Frame of the next IG frame; to be called once a frame, host or no host. Status, earth
    /// model and condition flags may be set on the result. \param timestamp_ticks  10 us each, of the
    /// caller's own reference, wrapping at 2^32
    [[nodiscard]] StartOfFrame next_frame(std::uint32_t timestamp_ticks,
                                          bool timestamp_valid = true) noexcept;

    /// The next frame bears the number after this one: that of another image generator goes on here.
    void count_from(std::uint32_t ig_frame_number) noexcept { ig_frame_number_ = ig_frame_number; }

    [[nodiscard]] IgMode mode() const noexcept { return mode_; }
    /// The host's version, else the announced default.
    [[nodiscard]] Version version() const noexcept { return version_; }
    /// The order to answer in: the machine's own, whatever the host's is.
    [[nodiscard]] static constexpr ByteOrder order() noexcept { return kNativeOrder; }
    [[nodiscard]] ByteOrder host_order() const noexcept { return host_order_; }
    /// The next message begins a new sequence of frame numbers, whoever sends it; all else stays.
    void new_peer() noexcept {
        connected_ = false;
        late_run_ = 0;
    }

    [[nodiscard]] bool connected() const noexcept { return connected_; }
    [[nodiscard]] std::uint32_t ig_frame_number() const noexcept { return ig_frame_number_; }
    [[nodiscard]] std::uint32_t last_host_frame_number() const noexcept { return last_host_frame_number_; }
    /// IG frames between the host's echo and now: depth of the loop as the host sees it.
    [[nodiscard]] std::uint32_t round_trip_frames() const noexcept { return round_trip_frames_; }

  private:
    enum class Load : std::uint8_t { kIdle, kLoading };

    [[nodiscard]] bool is_late(const IgControl& control, bool version_changed,
                               SessionEvents& events) noexcept;
    void change_mode(IgMode mode, SessionEvents& events) noexcept;
    void request_database(std::int8_t number) noexcept;
    [[nodiscard]] std::int8_t report_database() noexcept;

    DatabasePolicy policy_;
    Version version_;
    ByteOrder host_order_ = kNativeOrder;
    IgMode mode_ = IgMode::kStandby;
    bool connected_ = false;
    std::uint32_t ig_frame_number_ = 0;
    std::uint32_t last_host_frame_number_ = 0;
    std::uint32_t round_trip_frames_ = 0;
    int late_run_ = 0;
    std::uint32_t late_frame_number_ = 0;

    Load load_ = Load::kIdle;
    std::int8_t loaded_number_ = 0;
    std::int8_t loading_number_ = 0;
    bool loading_reported_ = false;
    bool host_sent_zero_ = false;
};

}  // namespace skyig::protocol::cigi
