// Rays in a spherical shell, in forms that do not cancel: heights are carried, never differences of radii.
#pragma once

#include <algorithm>
#include <cmath>

namespace skyig::render::sky {

struct Shell {
    double ground_radius_m = 0.0;
    double top_height_m = 0.0;

    /// r^2 - R^2 for a point `height_m` above the ground.
    [[nodiscard]] double excess_m2(double height_m) const noexcept {
        return height_m * (2.0 * ground_radius_m + height_m);
    }
    /// Sine and cosine of the dip of the geometric horizon.
    [[nodiscard]] double dip_sine(double height_m) const noexcept {
        return std::sqrt(excess_m2(height_m)) / (ground_radius_m + height_m);
    }
    [[nodiscard]] double dip_cosine(double height_m) const noexcept {
        return ground_radius_m / (ground_radius_m + height_m);
    }
    [[nodiscard]] double dip_rad(double height_m) const noexcept {
        return std::atan2(std::sqrt(excess_m2(height_m)), ground_radius_m);
    }

    /// Height `along_m` down a ray that leaves `height_m` with `cosine` to the local vertical.
    [[nodiscard]] double height_along_m(double height_m, double cosine, double along_m) const noexcept {
        const double r = ground_radius_m + height_m;
        const double gain = along_m * (2.0 * r * cosine + along_m);
        return height_m + gain / (std::sqrt(std::max(0.0, r * r + gain)) + r);
    }

    /// Distance to the lid from a point below it.
    [[nodiscard]] double distance_to_top_m(double height_m, double cosine) const noexcept {
        const double r = ground_radius_m + height_m;
        const double shortfall =
            (top_height_m - height_m) * (2.0 * ground_radius_m + top_height_m + height_m);
        const double root = std::sqrt(std::max(0.0, r * r * cosine * cosine + shortfall));
        return cosine > 0.0 ? std::max(0.0, shortfall) / (r * cosine + root) : -r * cosine + root;
    }

    /// Distance to the ground of a ray that points at or below the horizon (cosine < 0).
    [[nodiscard]] double distance_to_ground_m(double height_m, double cosine) const noexcept {
        const double r = ground_radius_m + height_m;
        const double excess = excess_m2(height_m);
        const double root = std::sqrt(std::max(0.0, r * r * cosine * cosine - excess));
        const double divisor = -r * cosine + root;
        return divisor > 0.0 ? excess / divisor : 0.0;
    }

    /// Where a ray is below the lid, as if the ground were glass; false when it misses.
    [[nodiscard]] bool inside(double height_m, double cosine, double& enter_m,
                              double& leave_m) const noexcept {
        if (height_m <= top_height_m) {
            enter_m = 0.0;
            leave_m = distance_to_top_m(height_m, cosine);
            return leave_m > 0.0;
        }
        const double r = ground_radius_m + height_m;
        const double excess = (height_m - top_height_m) * (2.0 * ground_radius_m + top_height_m + height_m);
        const double root2 = r * r * cosine * cosine - excess;
        if (cosine >= 0.0 || root2 <= 0.0) return false;
        leave_m = -r * cosine + std::sqrt(root2);
        enter_m = excess / leave_m;
        return true;
    }
};

}  // namespace skyig::render::sky
