#include "render/sky/path.h"

#include <algorithm>
#include <cmath>

namespace skyig::render::sky {
namespace {

struct Ray {
    const AirData& data;
    double eye_height_m;
    double cosine;

    [[nodiscard]] double height_m(double along_m) const noexcept {
        return std::clamp(data.shell.height_along_m(eye_height_m, cosine, along_m), 0.0,
                          data.shell.top_height_m);
    }
};

double depth_per_m(const AirData& data, const Densities& d) {
    constexpr int kGreen = 8;
    return static_cast<double>(data.medium.rayleigh.v[kGreen] * d.molecules +
                               data.medium.aerosol_extinction.v[kGreen] * d.aerosol +
                               data.medium.ozone.v[kGreen] * d.ozone);
}

float simpson(float a, float middle, float b) {
    return (a + 4.0F * middle + b) * (1.0F / 6.0F);
}

// The step's optics are means over it (Simpson); its light is gathered at its centre of optical mass.
void fill_step(const Ray& ray, double from_m, double to_m, const Densities& from, const Densities& to,
               PathStep& step) {
    const double middle_m = 0.5 * (from_m + to_m);
    const Densities middle = ray.data.densities(ray.height_m(middle_m));
    step.length_m = static_cast<float>(to_m - from_m);
    step.molecules = simpson(from.molecules, middle.molecules, to.molecules);
    step.aerosol = simpson(from.aerosol, middle.aerosol, to.aerosol);
    step.ozone = simpson(from.ozone, middle.ozone, to.ozone);

    const double mass_from = depth_per_m(ray.data, from);
    const double mass_middle = 4.0 * depth_per_m(ray.data, middle);
    const double mass_to = depth_per_m(ray.data, to);
    const double mass = mass_from + mass_middle + mass_to;
    const double along_m =
        mass > 0.0 ? (mass_from * from_m + mass_middle * middle_m + mass_to * to_m) / mass : middle_m;

    const double height_m = ray.height_m(along_m);
    const double eye_radius_m = ray.data.shell.ground_radius_m + ray.eye_height_m;
    const double radius_m = ray.data.shell.ground_radius_m + height_m;
    step.eye_part = eye_radius_m / radius_m;
    step.along_part = along_m / radius_m;
    step.view_sine =
        static_cast<float>(std::clamp((eye_radius_m * ray.cosine + along_m) / radius_m, -1.0, 1.0));
    step.column_row = static_cast<float>(ray.data.source_row(height_m));
    step.moment_row = static_cast<float>(ray.data.moment_row(height_m));
    const double dip_sine = ray.data.dip_sine(ray.data.source_dip_sine, height_m);
    step.dip_sine = static_cast<float>(dip_sine);
    step.dip_cosine = static_cast<float>(std::sqrt((1.0 - dip_sine) * (1.0 + dip_sine)));
}

// Long grazing paths need more steps than steep ones: half of them at least, all of them from the
// length of a horizontal ray at the ground on.
int steps_for(const Shell& shell, double length_m, int steps_most) {
    const double longest_m = std::sqrt(shell.excess_m2(shell.top_height_m));
    const double share = 0.5 + 0.5 * std::min(1.0, length_m / longest_m);
    return std::clamp(static_cast<int>(share * steps_most), 4, steps_most);
}

// Steps crowd at the low end as s^p: the first one is to be shorter than the free path of light and than the
// stretch over which the aerosol thins out there.
double crowding(const Ray& ray, double low_m, double length_m, int count) {
    const AirModel& model = ray.data.model;
    const double low_height_m = ray.height_m(low_m);
    const double radius_m = ray.data.shell.ground_radius_m + low_height_m;
    const double steepness =
        std::abs((ray.data.shell.ground_radius_m + ray.eye_height_m) * ray.cosine + low_m) / radius_m +
        std::sqrt(0.5 * model.aerosol_scale_height_m / radius_m);
    const double free_path_m = 1.0 / std::max(depth_per_m(ray.data, ray.data.densities(low_height_m)), 1e-9);
    const double first_m = 0.3 * std::min(free_path_m, model.aerosol_scale_height_m / steepness);
    return std::clamp(std::log(length_m / first_m) / std::log(static_cast<double>(count)), 1.2, 4.0);
}

// In thick air little is seen of what lies beyond some free paths.
bool hides_its_end(const Ray& ray, double near_m, double far_m) {
    constexpr double kHidingDepth = 6.0;
    return depth_per_m(ray.data, ray.data.densities(ray.height_m(near_m))) * (far_m - near_m) > kHidingDepth;
}

// Steps between two distances, `low_m` being the end at the lower height: there they crowd, unless thick air
// hides it.
void add_steps(const Ray& ray, double low_m, double high_m, int count, Path& path) {
    const bool rising = high_m >= low_m;
    if (!rising && hides_its_end(ray, high_m, low_m)) {
        add_steps(ray, high_m, low_m, count, path);
        return;
    }
    const double power = crowding(ray, low_m, std::abs(high_m - low_m), count);
    const auto boundary_m = [&](int i) {
        const double s = static_cast<double>(rising ? i : count - i) / count;
        return low_m + (high_m - low_m) * std::pow(s, power);
    };
    double from_m = boundary_m(0);
    Densities from = ray.data.densities(ray.height_m(from_m));
    for (int i = 0; i < count; ++i) {
        const double to_m = boundary_m(i + 1);
        const Densities to = ray.data.densities(ray.height_m(to_m));
        fill_step(ray, from_m, to_m, from, to, path.steps[path.count++]);
        from_m = to_m;
        from = to;
    }
}

}  // namespace

void lay_path(const AirData& data, double eye_height_m, double cosine, Side side, int steps_most, Path& path,
              double farthest_m) {
    path.count = 0;
    path.meets_ground = side == Side::kGround;
    const Ray ray{data, eye_height_m, cosine};
    double enter_m = 0.0;
    double leave_m = 0.0;
    const bool inside = data.shell.inside(eye_height_m, cosine, enter_m, leave_m);
    const double eye_radius_m = data.shell.ground_radius_m + eye_height_m;
    if (side == Side::kGround) {
        double ground_m = data.shell.distance_to_ground_m(eye_height_m, cosine);
        path.meets_ground = ground_m <= farthest_m;
        ground_m = std::min(ground_m, farthest_m);
        path.ground_eye_part = eye_radius_m / data.shell.ground_radius_m;
        path.ground_along_part = ground_m / data.shell.ground_radius_m;
        if (ground_m <= enter_m) return;
        add_steps(ray, ground_m, enter_m, steps_for(data.shell, ground_m - enter_m, steps_most), path);
        return;
    }
    leave_m = std::min(leave_m, farthest_m);
    if (!inside || leave_m <= enter_m) return;
    const int count = steps_for(data.shell, leave_m - enter_m, steps_most);
    const double low_m = std::max(enter_m, -eye_radius_m * cosine);
    if (low_m <= enter_m) {
        add_steps(ray, enter_m, leave_m, count, path);
        return;
    }
    if (low_m >= leave_m) {
        add_steps(ray, leave_m, enter_m, count, path);
        return;
    }
    const double share = std::sqrt((low_m - enter_m) / (leave_m - enter_m));
    const int before = std::clamp(static_cast<int>(share * count * 0.7), 2, count - 2);
    add_steps(ray, low_m, enter_m, before, path);
    add_steps(ray, low_m, leave_m, count - before, path);
}

void lay_steps_between(const AirData& data, double eye_height_m, double cosine,
                       std::span<const double> boundaries_m, Path& path) {
    path.count = 0;
    path.meets_ground = false;
    const Ray ray{data, eye_height_m, cosine};
    Densities from = data.densities(ray.height_m(boundaries_m.front()));
    for (std::size_t i = 1; i < boundaries_m.size(); ++i) {
        const Densities to = data.densities(ray.height_m(boundaries_m[i]));
        fill_step(ray, boundaries_m[i - 1], boundaries_m[i], from, to, path.steps[path.count++]);
        from = to;
    }
}

}  // namespace skyig::render::sky
