#include "render/cloud_shade.h"

#include <algorithm>
#include <cmath>

#include "render/cloud/field/shapes.h"
#include "render/cloud/slab_light.h"
#include "render/geometry.h"
#include "render/weather_area.h"

namespace skyig::render {

namespace {

// Of a layer that the eye may be outside of, at the eye: 1 inside its area, 0 beyond the perimeter.
double part_here(const CloudLayer& cloud) noexcept {
    return cloud.area ? area_weight(*cloud.area, glm::dvec2{0.0}) : 1.0;
}

// A layer with gaps is not as deep in the mean as in its middle.
double mean_depth_part(double coverage) noexcept {
    return 0.6 + 0.4 * coverage;
}

}  // namespace

CloudShade::CloudShade(const Weather& weather, double ground_albedo) noexcept
    : ground_albedo_(std::clamp(ground_albedo, 0.0, 0.98)) {
    for (const CloudLayer& cloud : weather.all_clouds()) {
        const double coverage = std::clamp(cloud.coverage, 0.0, 1.0) * part_here(cloud);
        if (!(coverage > 0.0) || !(cloud.thickness_m > 0.0)) continue;
        const cloud::field::Genus& genus = cloud::field::genus_of(cloud.genus);
        const double extinction = cloud.extinction_per_m > 0.0 ? cloud.extinction_per_m
                                                               : static_cast<double>(genus.extinction_per_m);
        const double apart_m = static_cast<double>(genus.apart_m);
        // Half of a band's depth is in its layer.
        layers_[count_++] = {cloud.base_m - 0.5 * cloud.bottom_band_m,
                             cloud.base_m + cloud.thickness_m + 0.5 * cloud.top_band_m,
                             coverage,
                             apart_m > 0.0 ? cloud.thickness_m / apart_m : 0.0,
                             static_cast<float>(extinction * cloud.thickness_m * mean_depth_part(coverage)),
                             genus.ice ? cloud::field::kIceG : cloud::field::kWaterG};
    }
    std::sort(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(count_),
              [](const Layer& a, const Layer& b) { return a.base_m > b.base_m; });
}

// Of the beam, by the part `above` of the layer that lies over the height.
double CloudShade::covered(const Layer& layer, double above, double height_m, double mu0) noexcept {
    constexpr double kSteep = 0.5;
    // At the layer, over the round Earth: never 0.
    const double climb_m = std::max(0.5 * (layer.base_m + layer.top_m) - height_m, 100.0);
    const double sine2 = mu0 * mu0 + 2.0 * climb_m / kEarthRadius_m;
    const double cotangent = std::sqrt(std::max(1.0 / sine2 - 1.0, 0.0));
    const double power = 1.0 + above * layer.sides * std::max(cotangent - kSteep, 0.0);
    return 1.0 - std::pow(1.0 - layer.coverage, power);
}

CloudShare CloudShade::at(double height_m, double mu0) const noexcept {
    if (!any()) return {};
    double direct = 1.0;     // the beam past all cloud so far
    double scattered = 0.0;  // of the beam, downward below the layers so far
    double sky = 1.0;
    double returned = 0.0;  // by the layers so far, of even light from below
    for (std::size_t i = 0; i < count_; ++i) {
        const Layer& layer = layers_[i];
        const double above = std::clamp((layer.top_m - height_m) / (layer.top_m - layer.base_m), 0.0, 1.0);
        if (!(above > 0.0)) continue;
        const cloud::Slab slab{static_cast<float>(above) * layer.depth, layer.g, 1.0F};
        const cloud::SlabFluxes<float> beam =
            cloud::slab_fluxes(slab, static_cast<float>(std::max(mu0, 0.0)));
        const cloud::SlabFluxes<float> even = cloud::slab_fluxes_diffuse(slab);
        const double reflected = layer.coverage * static_cast<double>(even.reflected);
        const double passed = 1.0 - layer.coverage * (1.0 - static_cast<double>(even.transmitted));
        const double to_and_fro = 1.0 / (1.0 - returned * reflected);
        const double covered = CloudShade::covered(layer, above, height_m, std::max(mu0, 0.0));
        // The beam's light that the layer sends up comes back from those above.
        const double up = covered * direct * static_cast<double>(beam.reflected);
        const double new_direct = direct * (1.0 - covered * (1.0 - static_cast<double>(beam.direct)));
        const double from_beam = covered * direct * static_cast<double>(beam.transmitted - beam.direct);
        scattered = from_beam + (scattered + returned * up) * to_and_fro * passed;
        sky *= to_and_fro * passed;
        returned = reflected + passed * passed * returned * to_and_fro;
        direct = new_direct;
    }
    const double ground = 1.0 / (1.0 - returned * ground_albedo_);
    return {static_cast<float>((direct + scattered) * ground), static_cast<float>(direct),
            static_cast<float>(sky * ground)};
}

}  // namespace skyig::render
