// A flat screen before an eye, and the view that shows on it what stands behind it.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace skyig::config {

/// Forward, right, down from the ownship's reference point, metres.
using BodyPoint = std::array<double, 3>;

/// Three corners of a rectangle, as the one who looks at its picture names them.
struct FlatScreen {
    BodyPoint bottom_left_m{};
    BodyPoint bottom_right_m{};
    BodyPoint top_left_m{};
};

/// A view's axis and sides, as Channel has them.
struct Aim {
    double left_deg = 0.0;
    double right_deg = 0.0;
    double bottom_deg = 0.0;
    double top_deg = 0.0;
    double yaw_deg = 0.0;
    double pitch_deg = 0.0;
    double roll_deg = 0.0;
};

/// Either an aim or, as the rest of a sentence about the screen, why there is none.
struct AimResult {
    std::optional<Aim> aim;
    std::string refusal;
};

/// The view whose picture, shown on the screen, covers for the eye just what it stands before: its axis is
/// the screen's normal through the eye, which may lie beside the screen. Refused: sides that do not meet at a
/// right angle (0.5 deg), an edge below a millimetre, an eye in the screen's plane or behind it, a side
/// beyond kMaxHalfAngle_deg.
[[nodiscard]] AimResult aim_at(const FlatScreen& screen, const BodyPoint& eye_m);

}  // namespace skyig::config
