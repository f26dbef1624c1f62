#include "render/channel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/warp/warp.h"

namespace skyig::render {

namespace {

// Of a rig that shows nothing.
constexpr double kCoarsest_rad = 0.02;

}  // namespace

ImagePlane image_plane(const Frustum& frustum) noexcept {
    return {std::tan(frustum.left_rad), std::tan(frustum.right_rad), std::tan(frustum.bottom_rad),
            std::tan(frustum.top_rad)};
}

glm::dmat4 clip_from_view(const Frustum& frustum) noexcept {
    const ImagePlane p = image_plane(frustum);
    const double width = p.right - p.left;
    const double height = p.top - p.bottom;
    return {glm::dvec4{2.0 / width, 0.0, 0.0, 0.0}, glm::dvec4{0.0, 2.0 / height, 0.0, 0.0},
            glm::dvec4{(p.right + p.left) / width, (p.top + p.bottom) / height, 0.0, -1.0}, glm::dvec4{0.0}};
}

glm::dvec3 view_direction(const Channel& channel, const Frustum& frustum, double x_px, double y_px) noexcept {
    const ImagePlane plane = image_plane(frustum);
    glm::dvec2 at{x_px / channel.width_px, y_px / channel.height_px};
    if (channel.warp) at = channel.warp->picture_of(at);
    const double x = plane.left + (plane.right - plane.left) * at.x;
    const double y = plane.bottom + (plane.top - plane.bottom) * at.y;
    return glm::normalize(glm::dvec3{x, y, -1.0});
}

namespace {

/// Sides of pixels that repeat: the picture need not be a whole number of them wide.
void widen(double low_rad, double& high_rad, int picture_px, int drawn_px) noexcept {
    if (drawn_px == picture_px) return;
    const double low = std::tan(low_rad);
    high_rad = std::atan(low + (std::tan(high_rad) - low) * drawn_px / picture_px);
}

}  // namespace

DrawnView drawn_view(int width_px, int height_px, const ChannelView& view) noexcept {
    const Showing& showing = view.showing;
    if (showing.parallel) {
        const ImagePlane p = image_plane(view.frustum);
        const double across_rad = std::atan(0.5 * (p.right - p.left) / width_px);
        const double upright_rad = std::atan(0.5 * (p.top - p.bottom) / height_px);
        return {1, 1, {-across_rad, across_rad, -upright_rad, upright_rad}, width_px, height_px};
    }
    const int across = std::clamp(showing.repeat_across, 1, Showing::kMostRepeated);
    const int upright = std::clamp(showing.repeat_upright, 1, Showing::kMostRepeated);
    DrawnView drawn{(width_px + across - 1) / across, (height_px + upright - 1) / upright, view.frustum,
                    across, upright};
    widen(drawn.frustum.left_rad, drawn.frustum.right_rad, width_px, drawn.width_px * across);
    widen(drawn.frustum.bottom_rad, drawn.frustum.top_rad, height_px, drawn.height_px * upright);
    return drawn;
}

double pixel_angle_rad(const Channel& channel, const Frustum& frustum) noexcept {
    const ImagePlane plane = image_plane(frustum);
    return std::max((plane.right - plane.left) / channel.width_px,
                    (plane.top - plane.bottom) / channel.height_px) *
           (channel.warp ? channel.warp->finest_pixel() : 1.0);
}

double longest_edge_rad(const Channel& channel, const Frustum& frustum) noexcept {
    constexpr double kDegree = std::numbers::pi / 180.0;
    if (!channel.warp) return std::numbers::pi;
    const ImagePlane plane = image_plane(frustum);
    const double side = std::min(plane.right - plane.left, plane.top - plane.bottom);
    const double error_px = std::clamp(0.04 * kDegree / pixel_angle_rad(channel, frustum), 0.15, 1.0);
    // In the corner that is farthest off the axis the image plane stretches most.
    const double x = std::max(std::abs(plane.left), std::abs(plane.right));
    const double y = std::max(std::abs(plane.bottom), std::abs(plane.top));
    const double longest = channel.warp->longest_line(error_px) * side / (1.0 + x * x + y * y);
    return std::clamp(longest, 2.0 * kDegree, std::numbers::pi);
}

double longest_direct_edge_rad(std::span<const Channel> channels,
                               std::span<const ChannelView> views) noexcept {
    double longest_rad = std::numbers::pi;
    for (std::size_t i = 0; i < std::min(channels.size(), views.size()); ++i) {
        if (channels[i].drawing == WarpDrawing::kResampled || !has_area(views[i].frustum)) continue;
        longest_rad = std::min(longest_rad, longest_edge_rad(channels[i], views[i].frustum));
    }
    return longest_rad;
}

bool has_area(const Frustum& frustum) noexcept {
    return frustum.right_rad > frustum.left_rad && frustum.top_rad > frustum.bottom_rad;
}

double finest_pixel_rad(std::span<const Channel> channels, std::span<const ChannelView> views) noexcept {
    double finest_rad = kCoarsest_rad;
    for (std::size_t i = 0; i < std::min(channels.size(), views.size()); ++i) {
        if (has_area(views[i].frustum))
            finest_rad = std::min(finest_rad, pixel_angle_rad(channels[i], views[i].frustum));
    }
    return finest_rad;
}

double smallest_pixel_sr(std::span<const Channel> channels, std::span<const ChannelView> views) noexcept {
    double smallest_sr = kCoarsest_rad * kCoarsest_rad;
    for (std::size_t i = 0; i < std::min(channels.size(), views.size()); ++i) {
        if (!has_area(views[i].frustum)) continue;
        const ImagePlane plane = image_plane(views[i].frustum);
        const double on_axis_sr = (plane.right - plane.left) / channels[i].width_px *
                                  (plane.top - plane.bottom) / channels[i].height_px *
                                  (channels[i].warp ? channels[i].warp->smallest_area() : 1.0);
        const double x = std::max(std::abs(plane.left), std::abs(plane.right));
        const double y = std::max(std::abs(plane.bottom), std::abs(plane.top));
        smallest_sr = std::min(smallest_sr, on_axis_sr * std::pow(1.0 + x * x + y * y, -1.5));
    }
    return smallest_sr;
}

glm::dmat3 body_from_ned(double yaw_rad, double pitch_rad, double roll_rad) noexcept {
    const double cy = std::cos(yaw_rad), sy = std::sin(yaw_rad);
    const double cp = std::cos(pitch_rad), sp = std::sin(pitch_rad);
    const double cr = std::cos(roll_rad), sr = std::sin(roll_rad);
    // Columns are the body coordinates of the north, east and down axes (transpose of Rz(yaw) Ry(pitch)
    // Rx(roll)).
    return {glm::dvec3{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
            glm::dvec3{sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
            glm::dvec3{-sp, cp * sr, cp * cr}};
}

glm::dmat3 ned_from_enu() noexcept {
    return {glm::dvec3{0.0, 1.0, 0.0}, glm::dvec3{1.0, 0.0, 0.0}, glm::dvec3{0.0, 0.0, -1.0}};
}

glm::dmat3 view_from_body() noexcept {
    // Body X forward -> view -z, body Y right -> view x, body Z down -> view -y.
    return {glm::dvec3{0.0, 0.0, -1.0}, glm::dvec3{1.0, 0.0, 0.0}, glm::dvec3{0.0, -1.0, 0.0}};
}

}  // namespace skyig::render
