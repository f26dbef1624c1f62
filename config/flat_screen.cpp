#include "config/flat_screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/channel.h"

namespace skyig::config {
namespace {

constexpr double kDegPerRad = 180.0 / 3.14159265358979323846;
constexpr double kShortestEdge_m = 1e-3;
constexpr double kMostSkew_deg = 0.5;
/// An eye nearer to the screen's plane than this part of the screen's diagonal lies in it.
constexpr double kInPlane = 1e-6;

BodyPoint operator-(const BodyPoint& a, const BodyPoint& b) noexcept {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double dot(const BodyPoint& a, const BodyPoint& b) noexcept {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

BodyPoint cross(const BodyPoint& a, const BodyPoint& b) noexcept {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const BodyPoint& a) noexcept {
    return std::hypot(a[0], a[1], a[2]);
}

BodyPoint scaled(const BodyPoint& a, double factor) noexcept {
    return {a[0] * factor, a[1] * factor, a[2] * factor};
}

/// Body axes of the view: forward, right, down.
struct Axes {
    BodyPoint forward;
    BodyPoint right;
    BodyPoint down;
};

/// Yaw, pitch, roll of axes; an axis that points straight up or down has its turn in the roll.
void turn(const Axes& axes, Aim& aim) noexcept {
    const double level = std::hypot(axes.forward[0], axes.forward[1]);
    aim.pitch_deg = std::atan2(-axes.forward[2], level) * kDegPerRad;
    if (level > 1e-12) {
        aim.yaw_deg = std::atan2(axes.forward[1], axes.forward[0]) * kDegPerRad;
        aim.roll_deg = std::atan2(axes.right[2], axes.down[2]) * kDegPerRad;
        return;
    }
    const double up = axes.forward[2] < 0.0 ? 1.0 : -1.0;
    aim.yaw_deg = 0.0;
    aim.roll_deg = std::atan2(up * axes.right[0], axes.right[1]) * kDegPerRad;
}

}  // namespace

AimResult aim_at(const FlatScreen& screen, const BodyPoint& eye_m) {
    const BodyPoint along = screen.bottom_right_m - screen.bottom_left_m;
    const BodyPoint upward = screen.top_left_m - screen.bottom_left_m;
    const double width_m = length(along);
    const double height_m = length(upward);
    if (std::min(width_m, height_m) < kShortestEdge_m)
        return {{}, fmt::format("is {:.4g} m by {:.4g} m: such a screen has no area", width_m, height_m)};
    const double skew_deg = std::atan2(dot(along, upward), length(cross(along, upward))) * kDegPerRad;
    if (std::abs(skew_deg) > kMostSkew_deg) {
        return {
            {},
            fmt::format("has an angle of {:.2f} degrees at bottom_left_m; a flat screen's corners have 90",
                        90.0 - skew_deg)};
    }
    Axes axes;
    axes.right = scaled(along, 1.0 / width_m);
    const BodyPoint normal = cross(upward, axes.right);
    axes.forward = scaled(normal, 1.0 / length(normal));
    axes.down = cross(axes.forward, axes.right);

    const BodyPoint corner_m = screen.bottom_left_m - eye_m;
    const double distance_m = dot(corner_m, axes.forward);
    if (std::abs(distance_m) <= kInPlane * std::hypot(width_m, height_m))
        return {{}, "lies in one plane with the eye at offset_m: it would be seen on edge"};
    if (distance_m < 0.0) {
        return {{},
                "shows its back to the eye at offset_m: seen from there its left and right, or its top and "
                "bottom, are the other way round"};
    }
    const auto angle_deg = [&](double across_m) { return std::atan2(across_m, distance_m) * kDegPerRad; };
    Aim aim;
    const double left_m = dot(corner_m, axes.right);
    const double bottom_m = -dot(corner_m, axes.down);
    aim.left_deg = angle_deg(left_m);
    aim.right_deg = angle_deg(left_m + width_m);
    aim.bottom_deg = angle_deg(bottom_m);
    aim.top_deg = angle_deg(bottom_m - dot(upward, axes.down));
    turn(axes, aim);
    const double widest_deg = std::max(
        {std::abs(aim.left_deg), std::abs(aim.right_deg), std::abs(aim.bottom_deg), std::abs(aim.top_deg)});
    if (widest_deg > kMaxHalfAngle_deg) {
        return {{},
                fmt::format("reaches {:.2f} degrees from the line of sight straight on to its plane; at most "
                            "{} (move the eye away from the plane, or use two channels)",
                            widest_deg, kMaxHalfAngle_deg)};
    }
    return {aim, {}};
}

}  // namespace skyig::config
