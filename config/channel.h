// A display channel as configured.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "config/overlay.h"
#include "config/pattern.h"
#include "config/screen.h"
#include "config/warp/maps.h"
#include "config/window.h"

namespace skyig::config {

inline constexpr std::size_t kMaxChannels = 16;
/// All channels of one daemon share one eye point; views further apart than this need a daemon of their own.
inline constexpr double kMaxEyeSpread_m = 50.0;
/// Furthest offset of an eye point from what carries it, each axis.
inline constexpr double kMaxOffset_m = 1000.0;
/// Largest half angle of a frustum side, either sign.
inline constexpr double kMaxHalfAngle_deg = 87.5;
inline constexpr int kMaxChannelSize_px = 16384;
/// From the eye to a windscreen.
inline constexpr double kLeastWindscreen_m = 0.3;
inline constexpr double kMostWindscreen_m = 3.0;

/// How a warped channel is drawn: each thing where the screen shows it, or a flat picture that is resampled.
enum class WarpDrawing : std::uint8_t { kDirect, kResampled };

struct Channel {
    /// 1..32 of letters, digits, '-' and '_', unique: it becomes part of file names.
    std::string name;
    /// Machine of the rig that draws it; empty without a rig.
    std::string node;
    int width_px = 1280;
    int height_px = 1024;
    /// Signed half angles from the view axis to each side: left < right, bottom < top; left and bottom
    /// normally negative; each within +-kMaxHalfAngle_deg.
    double left_deg = -30.0;
    double right_deg = 30.0;
    double bottom_deg = -24.79;
    double top_deg = 24.79;
    /// Turn of the view axis from the body axes: yaw right, then pitch up, then roll right.
    double yaw_deg = 0.0;
    double pitch_deg = 0.0;
    double roll_deg = 0.0;
    /// Eye point from the ownship's reference point, body axes: forward, right, down; each within
    /// +-kMaxOffset_m.
    std::array<double, 3> offset_m{0.0, 0.0, 0.0};
    /// How the host's View Control and View Definition address it; unique. If not given: its place in the
    /// file, from 1.
    int view_id = 1;
    /// 0 = in no group, 1..255.
    int group_id = 0;
    /// Its own, what it leaves out taken from [display]; not given: that of [display].
    std::optional<Screen> display;
    /// Shown in place of the sky until the host asks for another.
    Pattern pattern = Pattern::kOff;
    /// Its own, what it leaves out taken from [overlay]; not given: that of [overlay].
    std::optional<Overlay> overlay;
    /// Where it is shown; given for all channels where there are windows.
    std::optional<Viewport> viewport;
    /// Null: the screen shows the frustum's flat picture.
    std::shared_ptr<const warp::WarpMesh> warp;
    WarpDrawing warp_drawing = WarpDrawing::kDirect;
    /// Of the flat picture that is resampled, by the screen's pixels each way, 0.25..4.
    double render_scale = 1.0;
    /// From the eye to a windscreen on which rain stands in drops, kLeastWindscreen_m..kMostWindscreen_m.
    std::optional<double> windscreen_m;
    /// As large as the channel; null: no other projector shines on its screen.
    std::shared_ptr<const warp::BlendMask> blend;
};

/// The field on the other side of a picture, `other_px` long, that makes its pixels square.
[[nodiscard]] double matching_field_deg(double field_deg, double own_px, double other_px) noexcept;

}  // namespace skyig::config
