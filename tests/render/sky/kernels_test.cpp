// Every variant that this processor runs must give the same light, and how fast it is is worth knowing.
#include "render/sky/kernels.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "render/sky/air_tables.h"
#include "render/sky/path.h"
#include "render/sky/phase.h"
#include "tests/render/sky/truth.h"

namespace skyig::render::sky {
namespace {

std::vector<const Kernels*> variants() {
    std::vector<const Kernels*> found = {&portable::kernels()};
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) found.push_back(&avx2::kernels());
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl")) {
        found.push_back(&avx512::kernels());
    }
#endif
    return found;
}

TEST(Kernels, ExponentialKeepsItsBound) {
    for (const Kernels* variant : variants()) {
        double largest = 0.0;
        for (const double x : steps(-87.0, 88.0, 0.00371)) {
            Lanes lanes{};
            for (float& value : lanes.v)
                value = f32(x);
            variant->exponential(lanes);
            const double exact = std::exp(static_cast<double>(f32(x)));
            for (const float value : lanes.v) {
                largest = std::max(largest, std::abs(static_cast<double>(value) / exact - 1.0));
            }
        }
        Lanes ends{};
        ends.v[0] = -1e30F;
        ends.v[1] = 1e30F;
        ends.v[2] = 0.0F;
        variant->exponential(ends);
        std::printf("%s: largest relative error of exp %.2e\n", variant->name, largest);
        EXPECT_LT(largest, 2e-7);
        EXPECT_LT(ends.v[0], 2e-38F);
        EXPECT_TRUE(std::isfinite(ends.v[1]));
        EXPECT_EQ(ends.v[2], 1.0F);
    }
}

struct Ray {
    std::vector<PathStep> steps = std::vector<PathStep>(48);
    Path path{};
};

void lay(const AirData& data, double sine, Ray& ray) {
    ray.path.steps = ray.steps.data();
    lay_path(data, 10.0, sine, sine < -0.002 ? Side::kGround : Side::kSky, 48, ray.path);
}

std::vector<Source> fan(double source_sine, double view_sine) {
    std::vector<Source> sources;
    for (int j = 0; j < 33; ++j) {
        const double cosine = view_sine * source_sine +
                              std::sqrt((1.0 - view_sine * view_sine) * (1.0 - source_sine * source_sine)) *
                                  std::cos(std::numbers::pi * j / 32.0);
        sources.push_back({source_sine, cosine, static_cast<float>(rayleigh_phase(cosine))});
    }
    return sources;
}

struct Fan {
    std::vector<Lanes> light = std::vector<Lanes>(33);
    std::vector<Lanes> aerosol = std::vector<Lanes>(33);
};

void march(const Kernels& variant, const AirData& data, Ray& ray, const std::vector<Source>& sources,
           Fan& out) {
    variant.weigh(data.medium, ray.path);
    for (std::size_t j = 0; j < sources.size(); ++j) {
        out.light[j] = out.aerosol[j] = Lanes{};
        variant.add_first_order(data.medium, data.source_table(), ray.path, sources[j], out.light[j],
                                out.aerosol[j]);
    }
    variant.add_higher_orders(data.medium, data.moment_table(), ray.path, sources.data(),
                              static_cast<int>(sources.size()), out.light.data());
}

TEST(Kernels, VariantsAgreeAndTheirCostIsKnown) {
    const AirTables tables(air_model({}));
    const AirData& data = tables.data();
    for (const Kernels* variant : variants()) {
        double largest = 0.0;
        double best_us = 1e9;
        for (const double view_sine : {1.0, 0.3, 0.02, 0.0, -0.01, -0.7}) {
            for (const double source_sine : {1.0, 0.4, 0.0, -0.08, -0.2}) {
                Ray ray;
                lay(data, view_sine, ray);
                const auto sources = fan(source_sine, view_sine);
                Fan ours;
                Fan plain;
                march(portable::kernels(), data, ray, sources, plain);
                const auto start = std::chrono::steady_clock::now();
                march(*variant, data, ray, sources, ours);
                const std::chrono::duration<double, std::micro> spent =
                    std::chrono::steady_clock::now() - start;
                if (view_sine == 0.0) best_us = std::min(best_us, spent.count());
                for (std::size_t j = 0; j < sources.size(); ++j) {
                    for (int i = 0; i < kLanes; ++i) {
                        const auto a = static_cast<double>(ours.light[j].v[i]);
                        const auto b = static_cast<double>(plain.light[j].v[i]);
                        largest = std::max(largest, std::abs(a - b) / (b + 1e-10));
                    }
                }
            }
        }
        std::printf(
            "%s: largest relative difference from portable %.1e; horizontal ray, 33 azimuths: %.0f us\n",
            variant->name, largest, best_us);
        EXPECT_LT(largest, 2e-4);
    }
}

}  // namespace
}  // namespace skyig::render::sky
