#include "render/sky/reference/sky_solver.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>

#include "render/sky/reference/path_tracer.h"

namespace skyig::render::sky::reference {
namespace {

constexpr double kLowestEyeM = 0.01;

glm::dvec3 direction_of(double zenith_rad, double azimuth_rad) {
    return {std::sin(zenith_rad) * std::cos(azimuth_rad), std::sin(zenith_rad) * std::sin(azimuth_rad),
            std::cos(zenith_rad)};
}

Samples times(const Samples& a, const Samples& b) {
    Samples product{};
    for (std::size_t i = 0; i < product.size(); ++i)
        product[i] = a[i] * b[i];
    return product;
}

// Independent runs of the same estimate, each with a sampler of its own; their spread is the error.
class Replicates {
  public:
    explicit Replicates(std::uint64_t seed) {
        Random seeds(seed);
        samplers_.reserve(kReplicates);
        for (int r = 0; r < kReplicates; ++r)
            samplers_.emplace_back(seeds.bits());
    }

    template <class Path>
    void run_round(const Path& path) {
        for (std::size_t r = 0; r < samplers_.size(); ++r) {
            for (int k = 0; k < kPathsARound / kReplicates; ++k) {
                const Samples light = path(samplers_[r]);
                for (std::size_t i = 0; i < kSampleCount; ++i)
                    sums_[r][i] += light[i];
            }
        }
        paths_ += kPathsARound;
    }

    /// Until the error of the luminance, `constant` included, is small enough. `scale` turns samples into W.
    template <class Path>
    void run(const Effort& effort, const Samples& scale, double constant, const Path& path) {
        do {
            run_round(path);
        } while (paths_ + kPathsARound <= effort.most_paths &&
                 (paths_ < 2 * kPathsARound ||
                  luminance_error(scale) >
                      effort.relative_error * std::abs(constant + xyz_of(times(mean(), scale)).y)));
    }

    [[nodiscard]] int paths() const { return paths_; }
    [[nodiscard]] Samples mean() const {
        Samples mean{};
        for (const Samples& sum : sums_) {
            for (std::size_t i = 0; i < kSampleCount; ++i)
                mean[i] += sum[i] / paths_;
        }
        return mean;
    }
    [[nodiscard]] double luminance_error(const Samples& scale) const {
        std::array<double, kReplicates> values{};
        for (std::size_t r = 0; r < values.size(); ++r)
            values[r] = xyz_of(times(sums_[r], scale)).y;
        return error_of(values);
    }
    [[nodiscard]] Samples error() const {
        Samples error{};
        for (std::size_t i = 0; i < kSampleCount; ++i) {
            std::array<double, kReplicates> values{};
            for (std::size_t r = 0; r < values.size(); ++r)
                values[r] = sums_[r][i];
            error[i] = error_of(values);
        }
        return error;
    }

  private:
    // Of the mean of values that are sums over the paths of one replicate.
    [[nodiscard]] double error_of(const std::array<double, kReplicates>& values) const {
        double mean = 0.0;
        for (const double value : values)
            mean += value / kReplicates;
        double squares = 0.0;
        for (const double value : values)
            squares += (value - mean) * (value - mean);
        const double paths_each = static_cast<double>(paths_) / kReplicates;
        return std::sqrt(squares / ((kReplicates - 1.0) * kReplicates)) / paths_each;
    }

    std::vector<Sampler> samplers_;
    std::array<Samples, kReplicates> sums_{};
    int paths_ = 0;
};

}  // namespace

glm::dvec3 xyz_of(const Samples& spectrum) noexcept {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < kSampleCount; ++i)
        sum += spectrum[i] * glm::dvec3(kObserverX[i], kObserverY[i], kObserverZ[i]);
    return 683.0 * kSampleStepNm * sum;
}

Radiance SkySolver::radiance(const View& view, const Effort& effort) const {
    const PathTracer tracer(medium_, direction_of(view.sun_zenith_rad, 0.0));
    const ViewRay ray{{std::max(view.eye_height_m, kLowestEyeM), {0.0, 0.0, 1.0}},
                      direction_of(view.view_zenith_rad, view.relative_azimuth_rad)};
    const Samples& sunlight = medium_.sunlight_w_m2_nm();
    const Samples single = times(tracer.first_order(ray), sunlight);
    Radiance radiance;
    radiance.single_luminance = xyz_of(single).y;

    Replicates replicates(effort.seed);
    replicates.run(effort, sunlight, radiance.single_luminance,
                   [&](Sampler& sampler) { return tracer.later_orders(ray, sampler); });
    const Samples later = times(replicates.mean(), sunlight);
    for (std::size_t i = 0; i < kSampleCount; ++i)
        radiance.spectral_w_m2_sr_nm[i] = single[i] + later[i];
    radiance.spectral_error = times(replicates.error(), sunlight);
    radiance.xyz = xyz_of(radiance.spectral_w_m2_sr_nm);
    radiance.luminance_error = replicates.luminance_error(sunlight);
    radiance.paths = replicates.paths();
    return radiance;
}

GroundLight SkySolver::ground_light(double sun_zenith_rad, const Effort& effort) const {
    const PathTracer tracer(medium_, direction_of(sun_zenith_rad, 0.0));
    const Samples& sunlight = medium_.sunlight_w_m2_nm();
    GroundLight light;
    light.transmittance = tracer.sunlight({kLowestEyeM, {0.0, 0.0, 1.0}});
    light.direct_normal_xyz = xyz_of(times(light.transmittance, sunlight));

    Samples scale = sunlight;
    for (double& value : scale)
        value *= std::numbers::pi;
    Replicates replicates(effort.seed);
    replicates.run(effort, scale, 0.0, [&](Sampler& sampler) { return tracer.sky_on_ground(sampler); });
    light.diffuse_xyz = xyz_of(times(replicates.mean(), scale));
    light.diffuse_error = replicates.luminance_error(scale);
    light.paths = replicates.paths();
    return light;
}

std::vector<Radiance> SkySolver::radiances(std::span<const View> views, const Effort& effort,
                                           unsigned threads) const {
    std::vector<Radiance> results(views.size());
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < views.size(); i = next++) {
            Effort own = effort;
            own.seed += i;
            results[i] = radiance(views[i], own);
        }
    };
    std::vector<std::jthread> others;
    for (unsigned t = 1; t < threads; ++t)
        others.emplace_back(work);
    work();
    others.clear();
    return results;
}

}  // namespace skyig::render::sky::reference
