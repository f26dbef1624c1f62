// The float march with tables against a double march without them, on the same medium.
#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "render/sky/air_tables.h"
#include "render/sky/path.h"
#include "render/sky/phase.h"
#include "tests/render/sky/reference.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky {
namespace {

struct Ray {
    double height_m;
    double elevation_rad;
    double azimuth_rad;
    double source_rad;
    bool to_ground;
};

// Straight up and down, exactly horizontal, tangent to the ground (from both sides), grazing, along the
// source.
std::vector<Ray> hard_rays(const Shell& shell) {
    std::vector<Ray> rays;
    for (const double height_m : {0.01, 2.0, 1500.0, 20.0e3, 100.0e3, 400.0e3, 3.6e7}) {
        const double horizon = -shell.dip_rad(height_m);
        for (const double source_deg : {90.0, 45.0, 5.0, 0.0, -3.0, -6.0, -12.0}) {
            const double source = source_deg * kDeg;
            for (const double azimuth : {0.0, 90.0 * kDeg, 180.0 * kDeg}) {
                for (const double elevation :
                     {90.0 * kDeg, 10.0 * kDeg, source, 0.0, horizon + 1e-3, horizon}) {
                    if (elevation >= horizon) rays.push_back({height_m, elevation, azimuth, source, false});
                }
                for (const double elevation : {-90.0 * kDeg, 0.5 * (horizon - 90.0 * kDeg), horizon - 1e-4}) {
                    rays.push_back({height_m, elevation, azimuth, source, true});
                }
            }
        }
    }
    return rays;
}

struct Luminances {
    double truth = 0.0;
    double ours = 0.0;
};

Luminances luminances(const AirData& data, const Reference& reference, const Ray& ray, int steps) {
    const std::array<double, 3> view = {std::cos(ray.elevation_rad) * std::cos(ray.azimuth_rad),
                                        std::cos(ray.elevation_rad) * std::sin(ray.azimuth_rad),
                                        std::sin(ray.elevation_rad)};
    const std::array<double, 3> sun = {std::cos(ray.source_rad), 0.0, std::sin(ray.source_rad)};
    const double cosine = view[0] * sun[0] + view[2] * sun[2];
    const double rayleigh = rayleigh_phase(cosine);
    const double haze = cornette_shanks_phase(data.model.aerosol_g, cosine);

    std::vector<PathStep> storage(static_cast<std::size_t>(steps));
    Path path{};
    path.steps = storage.data();
    lay_path(data, ray.height_m, view[2], ray.to_ground ? Side::kGround : Side::kSky, steps, path);
    kernels().weigh(data.medium, path);
    Lanes light{};
    Lanes aerosol{};
    kernels().add_first_order(data.medium, data.source_table(), path,
                              {sun[2], cosine, static_cast<float>(rayleigh)}, light, aerosol);
    const Reference::Light truth = reference.march(ray.height_m, view, sun, ray.to_ground, 500);
    Luminances y;
    for (std::size_t i = 0; i < kWavelengths; ++i) {
        const double weight = static_cast<double>(data.model.sunlight_xyz_lux[1][i]);
        y.truth += weight * (truth.air[i] * rayleigh + truth.aerosol[i] * haze + truth.ground[i]);
        y.ours += weight * (static_cast<double>(light.v[i]) + static_cast<double>(aerosol.v[i]) * haze);
    }
    return y;
}

Errors measure(const AirTables& tables, int steps) {
    const Reference reference(tables.data());
    Errors errors;
    for (const Ray& ray : hard_rays(tables.data().shell)) {
        const Luminances y = luminances(tables.data(), reference, ray, steps);
        EXPECT_TRUE(std::isfinite(y.ours));
        EXPECT_GE(y.ours, 0.0);
        if (y.truth == 0.0) {
            EXPECT_NEAR(y.ours, 0.0, 1e-6)
                << ray.height_m << ' ' << ray.elevation_rad << ' ' << ray.source_rad;
            continue;
        }
        // The natural night sky drowns what is darker.
        errors.add((y.ours - y.truth) / (y.truth + 1.7e-4));
    }
    return errors;
}

TEST(SingleScattering, FollowsDoublePrecisionOnHardRays) {
    const AirTables tables(straight(air_model({})));
    const Errors fine = measure(tables, 400);
    const Errors usual = measure(tables, 48);
    for (const auto& [errors, steps] : {std::pair{&fine, 400}, std::pair{&usual, 48}}) {
        std::printf(
            "%d steps: %zu rays, relative luminance error p50 %.3f %%, p90 %.2f %%, p99 %.2f %%, largest "
            "%.2f %%\n",
            steps, errors->count(), 100.0 * errors->quantile(0.5), 100.0 * errors->quantile(0.9),
            100.0 * errors->quantile(0.99), 100.0 * errors->largest());
    }
    EXPECT_GT(fine.count(), 500U);
    EXPECT_LT(fine.quantile(0.5), 0.001);
    EXPECT_LT(fine.quantile(0.99), 0.02);
    EXPECT_LT(usual.quantile(0.5), 0.003);
    EXPECT_LT(usual.quantile(0.99), 0.10);
}

TEST(SunColumns, FollowDoublePrecisionDownToTheHorizon) {
    const AirTables tables(straight(air_model({})));
    const AirData& data = tables.data();
    const Reference reference(data);
    Errors errors;
    for (const double height_m : {0.0, 37.0, 800.0, 3.3e3, 11.0e3, 24.0e3, 61.0e3, 97.0e3}) {
        const double dip = data.shell.dip_rad(height_m);
        for (const double above_deg : {0.28, 0.31, 0.7, 1.9, 4.3, 11.0, 29.0, 71.0, 90.0}) {
            const double elevation = std::min(above_deg * kDeg - dip, 90.0 * kDeg);
            const Spectrum ours = tables.transmittance(height_m, elevation);
            const auto c = reference.columns(height_m, std::sin(elevation), 2000);
            for (std::size_t i = 0; i < kWavelengths; ++i) {
                const double depth = static_cast<double>(data.model.rayleigh_per_m[i]) * c.molecules +
                                     static_cast<double>(data.model.aerosol_extinction_per_m[i]) * c.aerosol +
                                     static_cast<double>(data.model.ozone_peak_per_m[i]) * c.ozone;
                errors.add(static_cast<double>(ours[i]) - std::exp(-depth));
            }
        }
    }
    std::printf("transmittance error: p50 %.1e, p99 %.1e, largest %.1e\n", errors.quantile(0.5),
                errors.quantile(0.99), errors.largest());
    EXPECT_LT(errors.quantile(0.5), 1e-4);
    EXPECT_LT(errors.quantile(0.99), 5e-3);
    EXPECT_LT(errors.largest(), 0.015);
}

}  // namespace
}  // namespace skyig::render::sky
