// Where light comes from in air that bends it: columns and brightness against rays traced step by step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/glm.hpp>

#include "render/sky/air_data.h"
#include "render/sky/air_tables.h"
#include "render/sky/ray_light.h"
#include "render/sky/refraction.h"
#include "render/sky/standard_air.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky {
namespace {

/// What a ray has met on its way out of the air, and how far it was turned.
struct Traced {
    glm::dvec3 column_m{0.0};  // molecules, aerosol, ozone
    double true_rad = 0.0;
    double lowest_m = 0.0;
};

// The ray equation d(n t)/ds = grad n in the plane of the ray, by Runge and Kutta. The densities are the
// model's, from their definition.
class Tracer {
  public:
    explicit Tracer(const AirModel& model)
        : model_(model), strength_(model.refractivity / kSeaLevelRefractivity) {}

    [[nodiscard]] Traced trace(double height_m, double seen_rad) const {
        const glm::dvec2 direction{std::cos(seen_rad), std::sin(seen_rad)};
        Ray ray{{0.0, model_.ground_radius_m + height_m}, direction * index(height_m)};
        Traced traced;
        traced.lowest_m = height_m;
        while (this->height_m(ray.place) < model_.top_height_m) {
            const double step_m = std::clamp(0.02 * this->height_m(ray.place), 40.0, 400.0);
            const Ray middle = moved(ray, slope(ray), 0.5 * step_m);
            const Ray again = moved(ray, slope(middle), 0.5 * step_m);
            const Ray end = moved(ray, slope(again), step_m);
            const auto mean = [&](auto part) {
                return (part(slope(ray)) + 2.0 * part(slope(middle)) + 2.0 * part(slope(again)) +
                        part(slope(end))) /
                       6.0;
            };
            const Ray last = ray;
            ray.place += step_m * mean([](const Ray& r) { return r.place; });
            ray.momentum += step_m * mean([](const Ray& r) { return r.momentum; });
            traced.lowest_m = std::min(traced.lowest_m, this->height_m(ray.place));
            traced.column_m +=
                step_m / 6.0 *
                (density(last.place) + 4.0 * density(0.5 * (last.place + ray.place)) + density(ray.place));
        }
        traced.true_rad = std::atan2(ray.momentum.y, ray.momentum.x);
        return traced;
    }

  private:
    struct Ray {
        glm::dvec2 place;
        glm::dvec2 momentum;
    };
    [[nodiscard]] double height_m(const glm::dvec2& place) const {
        return glm::length(place) - model_.ground_radius_m;
    }
    [[nodiscard]] double index(double height_m) const {
        return 1.0 + strength_ * air_.at(height_m).refractivity;
    }
    [[nodiscard]] Ray slope(const Ray& ray) const {
        const StandardAir::At here = air_.at(height_m(ray.place));
        return {ray.momentum / (1.0 + strength_ * here.refractivity),
                glm::normalize(ray.place) * (strength_ * here.slope_per_m)};
    }
    static Ray moved(const Ray& ray, const Ray& slope, double step_m) {
        return {ray.place + step_m * slope.place, ray.momentum + step_m * slope.momentum};
    }
    [[nodiscard]] glm::dvec3 density(const glm::dvec2& place) const {
        const double h = std::max(0.0, height_m(place));
        const DensityProfile& p = model_.molecules;
        std::size_t k = 0;
        while (k + 2 < p.knot_count && h > p.height_m[k + 1])
            ++k;
        const double part = (h - p.height_m[k]) / (p.height_m[k + 1] - p.height_m[k]);
        const double ozone =
            std::min((h - model_.ozone_bottom_m) / (model_.ozone_peak_m - model_.ozone_bottom_m),
                     (model_.ozone_top_m - h) / (model_.ozone_top_m - model_.ozone_peak_m));
        return {std::exp(p.log_density[k] + part * (p.log_density[k + 1] - p.log_density[k])),
                std::exp(-h / model_.aerosol_scale_height_m), std::max(0.0, ozone)};
    }

    AirModel model_;
    StandardAir air_;
    double strength_;
};

// As the tables give it, by the source's true elevation. No disc: the whole source is up.
Lanes light_at(const AirData& data, double height_m, double true_rad) {
    const double dip_sine = data.dip_sine(data.source_dip_sine, height_m);
    Lanes light{};
    kernels().transmit(data.medium, data.source_table(), f32(data.source_row(height_m)),
                       f32(std::sin(true_rad) + dip_sine), f32(dip_sine), light);
    return light;
}

double seen_dip_rad(const AirModel& model, double height_m) {
    // The ray keeps n r cos(elevation) from the ground on.
    const StandardAir air;
    const double index = (1.0 + air.at(0.0).refractivity) / (1.0 + air.at(height_m).refractivity);
    return std::acos(std::min(1.0, index * model.ground_radius_m / (model.ground_radius_m + height_m)));
}

TEST(BentColumns, LightArrivesAsAlongRaysTracedStepByStep) {
    const AirTables tables(air_model({}));
    const AirData& data = tables.data();
    const Tracer tracer(data.model);
    Errors clear;
    Errors tropopause;
    double lowest_deg = 90.0;
    for (const double height_m : {0.0, 700.0, 4.4e3, 12.3e3, 27.0e3, 61.0e3, 97.0e3}) {
        for (const double above_deg : {0.03, 0.2, 0.5, 1.0, 1.7, 2.6, 4.0, 7.0, 12.0, 40.0}) {
            constexpr double kStep_rad = 1e-4;
            const double seen_rad = above_deg * kDeg - seen_dip_rad(data.model, height_m);
            const Traced traced = tracer.trace(height_m, seen_rad);
            // How much more solid angle the source covers than without air.
            const double focus = (std::sin(seen_rad + kStep_rad) - std::sin(seen_rad - kStep_rad)) /
                                 (std::sin(tracer.trace(height_m, seen_rad + kStep_rad).true_rad) -
                                  std::sin(tracer.trace(height_m, seen_rad - kStep_rad).true_rad));
            const Lanes ours = light_at(data, height_m, traced.true_rad);
            lowest_deg = std::min(lowest_deg, traced.true_rad / kDeg);
            // Rays that graze the tropopause cross over within less than the Sun's disc: the table is
            // smoother.
            const bool crossed = std::abs(traced.lowest_m - kTropopause_m) < 3.5 * kTropopauseRounding_m &&
                                 traced.lowest_m < height_m - 1.0;
            for (std::size_t i = 0; i < kWavelengths; ++i) {
                const double depth =
                    glm::dot(traced.column_m,
                             glm::dvec3(data.model.rayleigh_per_m[i], data.model.aerosol_extinction_per_m[i],
                                        data.model.ozone_peak_per_m[i]));
                (crossed ? tropopause : clear).add(static_cast<double>(ours.v[i]) - focus * std::exp(-depth));
            }
        }
    }
    std::printf(
        "sources down to %.1f deg: light off by p50 %.1e, p99 %.1e, largest %.1e of sunlight; past the "
        "tropopause largest %.1e\n",
        lowest_deg, clear.quantile(0.5), clear.quantile(0.99), clear.largest(), tropopause.largest());
    EXPECT_LT(lowest_deg, -10.0);
    EXPECT_GT(clear.count(), 60U * kWavelengths);
    EXPECT_LT(clear.quantile(0.5), 1e-4);
    EXPECT_LT(clear.quantile(0.99), 0.01);
    EXPECT_LT(clear.largest(), 0.02);
    EXPECT_LT(tropopause.largest(), 0.1);
}

// The tables that the eye's own refraction uses trace the same rays for themselves.
TEST(BentColumns, SourcesSetWhereTheEyesRefractionHasIt) {
    const AirTables tables(air_model({}));
    const Refraction refraction;
    double largest_rad = 0.0;
    for (const double height_m : {0.0, 30.0, 1.2e3, 8.0e3, 21.0e3, 55.0e3, 90.0e3}) {
        const double ours_rad = -std::asin(tables.data().dip_sine(tables.data().source_dip_sine, height_m));
        const double theirs_rad = refraction.at(height_m, 1013.25, 15.0).setting_elevation_rad();
        std::printf("from %5.0f m: %.4f deg, %.4f\n", height_m, ours_rad / kDeg, theirs_rad / kDeg);
        largest_rad = std::max(largest_rad, std::abs(ours_rad - theirs_rad));
    }
    EXPECT_LT(largest_rad, 0.005 * kDeg);
}

TEST(BentColumns, WithoutRefractionEveryRayIsStraight) {
    const AirTables tables(straight(air_model({})));
    const AirData& data = tables.data();
    for (const double height_m : {0.0, 2.0e3, 40.0e3}) {
        const double dip_rad = data.shell.dip_rad(height_m);
        EXPECT_NEAR(std::asin(data.dip_sine(data.source_dip_sine, height_m)), dip_rad, 1e-6);
        for (const double above_deg : {0.3, 1.0, 5.0, 60.0}) {
            const Lanes source = light_at(data, height_m, above_deg * kDeg - dip_rad);
            const Spectrum seen = tables.transmittance(height_m, above_deg * kDeg - dip_rad);
            for (std::size_t i = 0; i < kWavelengths; ++i)
                EXPECT_NEAR(source.v[i], seen[i], 1e-4) << height_m << ' ' << above_deg;
        }
    }
}

// Through the shadow's edge, the end of twilight, and the tables' nodes.
TEST(BentColumns, SkyFadesSmoothlyWhileTheSunSets) {
    const AirTables tables(air_model({}));
    double largest = 0.0;
    double at_deg = 0.0;
    for (const double height_m : {0.0, 11.0e3}) {
        for (const double elevation_deg : {90.0, 20.0, 1.0}) {
            RayQuery query;
            query.eye_height_m = height_m;
            query.elevation_rad = elevation_deg * kDeg;
            double last = 0.0;
            double last_step = 0.0;
            constexpr double kStep_deg = 0.01;
            for (const double sun_deg : steps(3.0, -14.0, -kStep_deg)) {
                query.source_elevation_rad = sun_deg * kDeg;
                const double now = -2.5 * std::log10(ray_light(tables, query).xyz.y);
                const double step = now - last;
                if (sun_deg < 3.0 - 1.5 * kStep_deg && std::abs(step - last_step) > largest) {
                    largest = std::abs(step - last_step);
                    at_deg = sun_deg;
                }
                last = now;
                last_step = step;
            }
        }
    }
    std::printf("largest change of a step of 0.01 deg: %.4f mag, at %.2f deg\n", largest, at_deg);
    EXPECT_LT(largest, 0.006);
}

}  // namespace
}  // namespace skyig::render::sky
