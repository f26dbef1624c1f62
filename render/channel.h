// A display channel: a rectangle of pixels that looks through its own frustum from the shared eye point.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "render/display.h"
#include "render/pattern/pattern.h"

namespace skyig::render {

namespace warp {
class Warp;
struct Blend;
}  // namespace warp

/// Signed half angles in radians from the view axis to each side plane of a perspective frustum:
/// left < right, bottom < top, each strictly inside (-pi/2, pi/2). Left and bottom are normally negative.
struct Frustum {
    double left_rad = 0.0;
    double right_rad = 0.0;
    double bottom_rad = 0.0;
    double top_rad = 0.0;

    friend bool operator==(const Frustum&, const Frustum&) = default;
};

/// How a warped channel is drawn: everything at once where the screen shows it, or flat and then resampled.
enum class WarpDrawing : std::uint8_t { kDirect, kResampled };

/// What of a channel never changes while the daemon runs.
struct Channel {
    std::string name;
    int width_px = 0;
    int height_px = 0;
    /// Its own; not given: that of the rig's DisplaySettings.
    std::optional<Screen> screen = {};
    /// Screen pixels to a pixel of the font in texts over its picture, 1..kMaxTextScale.
    int text_scale = 2;
    /// Null: the screen shows the frustum's flat picture. \see warp/warp.h
    std::shared_ptr<const warp::Warp> warp = {};
    WarpDrawing drawing = WarpDrawing::kDirect;
    /// Of the flat picture that is resampled, by the screen's pixels each way, 0.25..4.
    double render_scale = 1.0;
    /// Null: no other projector shines on the screen. Not of targets of luminance. \see warp/blend.h
    std::shared_ptr<const warp::Blend> blend = {};
    /// Another renderer draws it: it takes part in all that channels share, and has no picture here.
    bool elsewhere = false;
};

/// How what is drawn of a view becomes its channel's picture.
struct Showing {
    bool mirrored_across = false;   ///< left and right change places
    bool mirrored_upright = false;  ///< top and bottom do
    /// Each drawn pixel fills so many of the picture, 1..kMostRepeated.
    int repeat_across = 1;
    int repeat_upright = 1;
    /// Parallel lines of sight. The sky is infinitely far: all of them end at one point of it, that of the
    /// view axis, and what one pixel of the frustum would see there fills the picture.
    bool parallel = false;

    static constexpr int kMostRepeated = 2;
    /// Nothing is done to the picture.
    [[nodiscard]] bool plain() const noexcept { return *this == Showing{}; }
    friend bool operator==(const Showing&, const Showing&) = default;
};

/// Where a channel looks in one frame, and what it shows of it. The view frame is x right, y up, -z along the
/// view axis.
struct ChannelView {
    Frustum frustum;
    glm::dmat3 view_from_enu{1.0};
    Showing showing = {};
    /// Not kOff: this in place of the sky.
    Pattern pattern = Pattern::kOff;
    /// Which lines of Scene::overlay lie over it. \see Overlay
    std::uint8_t overlay = 0;
    /// From the eye to a pane on which rain stands in drops, across the view axis, metres; 0: there is none.
    /// Not of warped channels.
    float windscreen_m = 0.0F;
};

/// The extents of the image plane at distance 1: x in [left, right], y in [bottom, top].
struct ImagePlane {
    double left = 0.0;
    double right = 0.0;
    double bottom = 0.0;
    double top = 0.0;
};

[[nodiscard]] ImagePlane image_plane(const Frustum& frustum) noexcept;
/// Directions at infinity: z is 0, which no depth range clips; w is the distance along the view axis.
[[nodiscard]] glm::dmat4 clip_from_view(const Frustum& frustum) noexcept;

/// Direction in the view frame (unit) through image coordinates in pixels, origin at the lower left corner of
/// the lower left pixel, so that pixel (i, j) has its centre at (i + 0.5, j + 0.5); as its warp shows it.
[[nodiscard]] glm::dvec3 view_direction(const Channel& channel, const Frustum& frustum, double x_px,
                                        double y_px) noexcept;

/// Pixels that are drawn of a channel, and through which frustum, so that Showing makes its picture of them.
struct DrawnView {
    int width_px = 0;
    int height_px = 0;
    Frustum frustum;
    /// Pixels of the picture that one of them fills, from the lower left corner; what reaches beyond is cut
    /// off.
    int repeat_across = 1;
    int repeat_upright = 1;
};
[[nodiscard]] DrawnView drawn_view(int width_px, int height_px, const ChannelView& view) noexcept;

/// Angle between neighbouring pixel centres on the view axis, the larger of the two directions, radians; with
/// a warp where the screen's pixels are finest.
[[nodiscard]] double pixel_angle_rad(const Channel& channel, const Frustum& frustum) noexcept;

/// Longest edge of a triangle, radians, whose straight image in a warped channel is off by no more than some
/// 0.04 deg, 0.15 to 1 pixels; 2..180 deg, the latter without a warp.
[[nodiscard]] double longest_edge_rad(const Channel& channel, const Frustum& frustum) noexcept;

/// The least of those that are drawn directly and have a view with an area.
[[nodiscard]] double longest_direct_edge_rad(std::span<const Channel> channels,
                                             std::span<const ChannelView> views) noexcept;

/// Whether anything can be seen through a frustum.
[[nodiscard]] bool has_area(const Frustum& frustum) noexcept;

/// pixel_angle_rad() of the finest channel that has a view with an area; 0.02 if none has. What is softened
/// over one pixel is softened over this in all channels, so that they agree where they meet.
[[nodiscard]] double finest_pixel_rad(std::span<const Channel> channels,
                                      std::span<const ChannelView> views) noexcept;

/// Solid angle of the smallest pixel among the same channels, which lies in a corner: 0.02 each way if none
/// has a view with an area. A point of light has its brightest pixel there.
[[nodiscard]] double smallest_pixel_sr(std::span<const Channel> channels,
                                       std::span<const ChannelView> views) noexcept;

/// Rotation that takes north-east-down axes to the body axes (X forward, Y right, Z down) of something yawed,
/// then pitched, then rolled (CIGI order).
[[nodiscard]] glm::dmat3 body_from_ned(double yaw_rad, double pitch_rad, double roll_rad) noexcept;

/// Constant rotations between axes conventions.
[[nodiscard]] glm::dmat3 ned_from_enu() noexcept;
[[nodiscard]] glm::dmat3 view_from_body() noexcept;

}  // namespace skyig::render
