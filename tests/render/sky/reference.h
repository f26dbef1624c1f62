// Single scattering in double precision, by brute force: no tables, no shared geometry, many small steps.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "render/sky/air_data.h"

namespace skyig::render::sky {

using Sum = std::array<double, kLanes>;

class Reference {
  public:
    explicit Reference(const AirData& data)
        : data_(data),
          ground_m_(data.model.ground_radius_m),
          top_m_(data.model.ground_radius_m + data.model.top_height_m) {}

    struct Light {
        Sum air{};      // times rayleigh phase
        Sum aerosol{};  // without phase
        Sum ground{};
    };

    /// Ray in the plane x (towards the source's azimuth), y, z (up at the eye).
    [[nodiscard]] Light march(double eye_height_m, const std::array<double, 3>& view,
                              const std::array<double, 3>& source, bool to_ground, int steps) const {
        Light light;
        const double r = ground_m_ + eye_height_m;
        double enter_m = 0.0;
        double leave_m = 0.0;
        if (!span(r, view[2], to_ground, enter_m, leave_m)) return light;
        const double closest_m = std::clamp(-r * view[2], enter_m, leave_m);
        Columns3 passed{};
        march_part(r, view, source, enter_m, closest_m, false, steps, passed, light);
        march_part(r, view, source, closest_m, leave_m, true, steps, passed, light);
        if (to_ground) add_ground(r, view, source, leave_m, passed, light);
        return light;
    }

    /// Columns in metres at the reference density from a point to the lid, along the ray.
    struct Columns3 {
        double molecules = 0.0;
        double aerosol = 0.0;
        double ozone = 0.0;
    };
    [[nodiscard]] Columns3 columns(double height_m, double sine, int steps) const {
        const double r = ground_m_ + height_m;
        const double end_m =
            -r * sine + std::sqrt(std::max(0.0, r * r * sine * sine + (top_m_ - r) * (top_m_ + r)));
        const double low_m = std::clamp(-r * sine, 0.0, end_m);
        Columns3 sum;
        for (int part = 0; part < 2; ++part) {
            const double length_m = part == 0 ? low_m : end_m - low_m;
            for (int i = 0; i < steps && length_m > 0.0; ++i) {
                const double s = (i + 0.5) / steps;
                const double along_m = part == 0 ? low_m - length_m * s * s : low_m + length_m * s * s;
                add(densities(height_along(r, sine, along_m)), 2.0 * s * length_m / steps, sum);
            }
        }
        return sum;
    }

  private:
    [[nodiscard]] double height_along(double r, double sine, double along_m) const {
        const double gain = along_m * (2.0 * r * sine + along_m);
        return std::max(0.0, (r - ground_m_) + gain / (std::sqrt(std::max(0.0, r * r + gain)) + r));
    }
    [[nodiscard]] Columns3 densities(double height_m) const {
        const AirModel& m = data_.model;
        const DensityProfile& p = m.molecules;
        std::size_t k = 0;
        while (k + 2 < p.knot_count && height_m > p.height_m[k + 1])
            ++k;
        const double part = (height_m - p.height_m[k]) / (p.height_m[k + 1] - p.height_m[k]);
        const double ozone = std::min((height_m - m.ozone_bottom_m) / (m.ozone_peak_m - m.ozone_bottom_m),
                                      (m.ozone_top_m - height_m) / (m.ozone_top_m - m.ozone_peak_m));
        return {std::exp(p.log_density[k] + part * (p.log_density[k + 1] - p.log_density[k])),
                std::exp(-height_m / m.aerosol_scale_height_m), std::max(0.0, ozone)};
    }
    static void add(const Columns3& density, double length_m, Columns3& sum) {
        sum.molecules += density.molecules * length_m;
        sum.aerosol += density.aerosol * length_m;
        sum.ozone += density.ozone * length_m;
    }
    [[nodiscard]] bool span(double r, double sine, bool to_ground, double& enter_m, double& leave_m) const {
        const double top2 = r * r * sine * sine + (top_m_ - r) * (top_m_ + r);
        if (top2 <= 0.0 || (r > top_m_ && sine >= 0.0)) return false;
        enter_m = r > top_m_ ? -r * sine - std::sqrt(top2) : 0.0;
        leave_m = -r * sine + std::sqrt(top2);
        if (to_ground) {
            const double ground2 = r * r * sine * sine + (ground_m_ - r) * (ground_m_ + r);
            leave_m = -r * sine - std::sqrt(std::max(0.0, ground2));
        }
        return true;
    }
    [[nodiscard]] double sun_part(double height_m, double sine) const {
        const double r = ground_m_ + height_m;
        const double dip_sine = std::sqrt(std::max(0.0, (r - ground_m_) * (r + ground_m_))) / r;
        const double part = std::clamp(0.5 + (sine + dip_sine) * r / ground_m_ / (2.0 * 0.004654), 0.0, 1.0);
        return part * part * (3.0 - 2.0 * part);
    }
    [[nodiscard]] double depth(const Columns3& c, std::size_t i, bool diffuse) const {
        const Medium& m = data_.medium;
        const float haze = diffuse ? m.aerosol_diffuse_extinction.v[i] : m.aerosol_extinction.v[i];
        return static_cast<double>(m.rayleigh.v[i]) * c.molecules + static_cast<double>(haze) * c.aerosol +
               static_cast<double>(m.ozone.v[i]) * c.ozone;
    }
    [[nodiscard]] Sum sunlight(double height_m, double sine) const {
        Sum sum{};
        const double part = sun_part(height_m, sine);
        if (part <= 0.0) return sum;
        const double r = ground_m_ + height_m;
        const double lowest = -std::sqrt(std::max(0.0, (r - ground_m_) * (r + ground_m_))) / r;
        const Columns3 c = columns(height_m, std::max(sine, lowest), 150);
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] = part * std::exp(-depth(c, i, false));
        return sum;
    }
    static double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    void march_part(double r, const std::array<double, 3>& view, const std::array<double, 3>& source,
                    double from_m, double to_m, bool low_first, int steps, Columns3& passed,
                    Light& light) const {
        const double length_m = to_m - from_m;
        if (length_m <= 0.0) return;
        for (int k = 0; k < steps; ++k) {
            const double s = (low_first ? k + 0.5 : steps - k - 0.5) / steps;
            const double along_m = low_first ? from_m + length_m * s * s : to_m - length_m * s * s;
            const double step_m = 2.0 * s * length_m / steps;
            const double height_m = height_along(r, view[2], along_m);
            const Columns3 density = densities(height_m);
            const double sine = (r * source[2] + along_m * dot(view, source)) / (ground_m_ + height_m);
            const Sum sun = sunlight(height_m, sine);
            Columns3 middle = passed;
            add(density, 0.5 * step_m, middle);
            for (std::size_t i = 0; i < sun.size(); ++i) {
                const double arriving = sun[i] * std::exp(-depth(middle, i, true)) * step_m;
                light.air[i] +=
                    arriving * density.molecules * static_cast<double>(data_.medium.rayleigh.v[i]);
                light.aerosol[i] +=
                    arriving * density.aerosol * static_cast<double>(data_.medium.aerosol_scattering.v[i]);
            }
            add(density, step_m, passed);
        }
    }
    void add_ground(double r, const std::array<double, 3>& view, const std::array<double, 3>& source,
                    double along_m, const Columns3& passed, Light& light) const {
        const double sine = (r * source[2] + along_m * dot(view, source)) / ground_m_;
        if (sine <= 0.0) return;
        const Sum sun = sunlight(0.0, sine);
        for (std::size_t i = 0; i < sun.size(); ++i) {
            light.ground[i] = sun[i] * sine * std::exp(-depth(passed, i, true)) *
                              static_cast<double>(data_.medium.albedo_over_pi.v[i]);
        }
    }

    const AirData& data_;
    double ground_m_;
    double top_m_;
};

}  // namespace skyig::render::sky
