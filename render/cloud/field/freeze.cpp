#include "render/cloud/field/freeze.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/cloud/field/shapes.h"
#include "render/cloud/slab_light.h"
#include "render/sky/sea_waves.h"

namespace skyig::render::cloud::field {
namespace {

float f32(double x) {
    return static_cast<float>(x);
}

bool is_cloud(const CloudLayer& cloud) {
    if (cloud.model == CloudModel::kImpostor) return false;
    for (const double number : {cloud.base_m, cloud.thickness_m, cloud.bottom_band_m, cloud.top_band_m,
                                cloud.coverage, cloud.extinction_per_m, cloud.drift_m.x, cloud.drift_m.y,
                                cloud.age_s, cloud.bottom_scud, cloud.top_scud, cloud.severity}) {
        if (!std::isfinite(number)) return false;
    }
    return cloud.thickness_m > 0.0 && cloud.coverage > 0.0;
}

double extinction_of(const CloudLayer& cloud) {
    const double own = static_cast<double>(genus_of(cloud.genus).extinction_per_m);
    return std::clamp(cloud.extinction_per_m > 0.0 ? cloud.extinction_per_m : own, 1e-12, 1e3);
}

Area area_of(const CloudLayer& cloud, double closing) {
    Area area{};
    area.perimeter_m = -1.0F;
    if (!cloud.area) return area;
    const WeatherArea& told = *cloud.area;
    return {{f32(told.centre_m.x), f32(told.centre_m.y)},
            {f32(std::sin(told.axis_rad)), f32(std::cos(told.axis_rad))},
            {f32(told.half_size_m.x), f32(told.half_size_m.y)},
            f32(told.corner_radius_m),
            f32(std::max(told.perimeter_m, 0.0)),
            f32(closing)};
}

bool has_look(const CloudLayer& cloud) {
    return cloud.look && (cloud.model == CloudModel::kLayer || cloud.model == CloudModel::kAuto);
}

// A storm grows from a tower to an anvil with its severity.
float grown(const CloudLayer& cloud) {
    return cloud.genus == CloudGenus::kCumulonimbus ? f32(std::clamp(cloud.severity, 0.0, 1.0)) : 1.0F;
}

float threshold_of(const Coverage& coverage, const CloudLayer& cloud, double part, Coverage::Drawn drawn) {
    const double depth = extinction_of(cloud) * cloud.thickness_m;
    const float full = coverage.threshold(cloud.genus, part, depth, drawn);
    const float young = 1.0F - grown(cloud);
    return young > 0.0F ? glm::mix(full, coverage.threshold(kTower, part, depth, drawn), young) : full;
}

// Coverage moves the sum's mean from where no tile brings it over 0 to where none brings it below.
void tell(const CloudLayer& cloud, Layer& layer) {
    double weights = 0.0;
    for (const CloudLook::Tile& tile : cloud.look->tiles)
        weights += std::abs(tile.weight);
    const double mean = cloud.look->density_offset + (cloud.coverage - 0.5) * weights;
    layer.threshold = f32(-mean);
    layer.dry = f32(std::max(mean, 0.0) + weights);
    layer.self_shadow = f32(std::max(cloud.look->self_shadow, 0.0));
}

// The most that a shape's lift changes by, per height from base to top.
float steepest(const Shape& shape) {
    const auto& lift = shape.lift;
    const auto at = [&](float q) { return std::abs(lift[0] + q * (2.0F * lift[1] + 3.0F * q * lift[2])); };
    const float bend = lift[2] != 0.0F ? std::clamp(-lift[1] / (3.0F * lift[2]), 0.0F, 1.0F) : 0.0F;
    return std::max({at(0.0F), at(bend), at(1.0F)});
}

// Taller clouds are lit as finely as those of this height.
constexpr float kTallest_m = 1000.0F;

Layer layer_of(const Matrix& matrix, const CloudLayer& cloud, const sky::SeaAnchor& anchor) {
    const Genus& genus = genus_of(cloud.genus);
    const ShapePlace place{anchor.eye_m.x - cloud.drift_m.x, anchor.eye_m.y - cloud.drift_m.y, cloud.age_s,
                           cloud.seed};
    const double extinction = extinction_of(cloud);
    Layer layer{};
    // Ice is thin: a look shows its threads as well as a march, and sharper.
    layer.slab_lit = cloud.model == CloudModel::kAuto && (genus.ice || has_look(cloud));
    layer.sheet = layer.slab_lit || cloud.model == CloudModel::kLayer;
    if (has_look(cloud)) {
        layer.shape = shape_of(matrix.noise, *cloud.look, place);
        tell(cloud, layer);
    } else {
        layer.shape = shape_of(matrix.noise, cloud.genus, place);
        for (std::size_t i = 0; i < 3; ++i)
            layer.shape.lift[i] = glm::mix(genus_of(kTower).lift[i], layer.shape.lift[i], grown(cloud));
        layer.shape.fibres.weight *= grown(cloud);
        const auto drawn = layer.sheet ? Coverage::Drawn::kSheet : Coverage::Drawn::kVolume;
        layer.threshold = threshold_of(matrix.coverage, cloud, cloud.coverage, drawn);
        layer.dry = threshold_of(matrix.coverage, cloud, 0.0, drawn) - layer.threshold + 0.5F;
        layer.self_shadow = 1.0F;
    }
    layer.base_m = f32(cloud.base_m);
    layer.thickness_m = f32(cloud.thickness_m);
    layer.bottom_band_m = f32(std::max(cloud.bottom_band_m, 0.0));
    layer.top_band_m = f32(std::max(cloud.top_band_m, 0.0));
    layer.bottom_scud = f32(std::clamp(cloud.bottom_scud, 0.0, 1.0));
    layer.top_scud = f32(std::clamp(cloud.top_scud, 0.0, 1.0));
    layer.extinction_per_m = f32(extinction);
    layer.lift_per_m = steepest(layer.shape) / layer.thickness_m;
    layer.look_m = 0.05F * std::min(layer.thickness_m, kTallest_m);
    layer.area = area_of(cloud, anchor.closing);
    layer.g = genus.ice ? kIceG : kWaterG;
    layer.inside = (genus.ice ? matrix.ice : matrix.water).nodes();
    return layer;
}

float upper(const Layer& layer) {
    return layer.base_m + layer.thickness_m;
}

// How much of `layer` lies under `other`: 0 at the same height, 1 where it lies wholly below.
float part_under(const Layer& layer, const Layer& other) {
    const float apart = other.base_m + upper(other) - layer.base_m - upper(layer);
    return std::clamp(apart / (other.thickness_m + layer.thickness_m), 0.0F, 1.0F);
}

struct Veil {
    float passed = 1.0F;  // of light from beyond the other layers
    float returned = 0.0F;
};

// What the layer as a whole, with its gaps, leaves of light on it.
Veil veil_of(const CloudLayer& cloud, double mu0) {
    // Its full depth is that of its middle only: the mean is less.
    constexpr double kMean = 0.6;
    const Slab slab{f32(kMean * extinction_of(cloud) * cloud.thickness_m),
                    genus_of(cloud.genus).ice ? kIceG : kWaterG, 1.0F};
    const SlabFluxes<float> fluxes = slab_fluxes(slab, f32(mu0));
    const auto part = f32(std::min(cloud.coverage, 1.0));
    // Weather that is elsewhere dims nothing here.
    const float here = cloud.area ? 0.0F : part;
    return {1.0F - here * (1.0F - fluxes.transmitted), here * fluxes.reflected};
}

Shine shine_of(const glm::vec3& base, const glm::vec3& top, const glm::vec3& part) {
    Shine shine{};
    for (int c = 0; c < 3; ++c) {
        shine.base[c] = part[c] * base[c];
        shine.gain[c] = part[c] * (top[c] - base[c]);
    }
    return shine;
}

struct Known {
    const CloudLayer* cloud = nullptr;
    Layer layer{};
};

struct Sky {
    std::array<Known, Weather::kMaxClouds> layers{};
    std::size_t count = 0;
};

// Of light that comes from above (or below), what the layers on its way leave of it.
float left_over(const Sky& sky, const Layer& layer, double mu0, bool above) {
    float left = 1.0F;
    for (std::size_t k = 0; k < sky.count; ++k) {
        const Known& other = sky.layers[k];
        const float part = above ? part_under(layer, other.layer) : part_under(other.layer, layer);
        if (part > 0.0F) left *= 1.0F - part * (1.0F - veil_of(*other.cloud, mu0).passed);
    }
    return left;
}

constexpr double kDiffuseMu = 0.6;

void shine_beams(const Sky& sky, float closing, const CloudLight& light, const CloudLight::At& base,
                 const CloudLight::At& top, Layer& layer) {
    for (std::size_t s = 0; s < CloudLight::kSources; ++s) {
        const Beam& beam = light.beams[s];
        LayerBeam& own = layer.beams[s];
        const glm::vec3 most = glm::max(base.beam_lx[s], top.beam_lx[s]);
        own.lit = beam.lit && most.x + most.y + most.z > 0.0F;
        if (!own.lit) continue;
        for (int c = 0; c < 3; ++c)
            own.direction[c] = beam.direction_enu[c];
        own.along[0] = beam.direction_enu.x + closing * beam.direction_enu.y;
        own.along[1] = beam.direction_enu.y;
        const double mu0 = std::max(0.05, std::abs(static_cast<double>(beam.direction_enu.z)));
        own.lx = shine_of(base.beam_lx[s], top.beam_lx[s],
                          glm::vec3(left_over(sky, layer, mu0, beam.direction_enu.z >= 0.0F)));
    }
    // A source that is a ten-thousandth of the other is not worth its looks.
    constexpr float kFaint = 1e-4F;
    const auto strength = [&](std::size_t s) {
        return layer.beams[s].lit ? layer.beams[s].lx.base[1] + std::max(layer.beams[s].lx.gain[1], 0.0F)
                                  : 0.0F;
    };
    const float sun = strength(CloudLight::kSun);
    const float moon = strength(CloudLight::kMoon);
    if (moon < kFaint * sun) layer.beams[CloudLight::kMoon].lit = false;
    if (sun < kFaint * moon) layer.beams[CloudLight::kSun].lit = false;
}

// Even light: the sky through what lies above, and from below what ground and clouds there throw up of what
// the clouds let through.
void shine_evenly(const Sky& sky, const CloudLight::At& base, const CloudLight::At& top, const Known& own,
                  Layer& layer) {
    const float from_sky = left_over(sky, layer, kDiffuseMu, true);
    layer.above_cd_m2 = shine_of(base.above_cd_m2, top.above_cd_m2, glm::vec3(from_sky));
    glm::vec3 down = std::numbers::pi_v<float> * base.above_cd_m2 * from_sky;
    for (const LayerBeam& beam : layer.beams) {
        if (beam.lit && beam.direction[2] > 0.0F)
            down += beam.direction[2] * glm::vec3(beam.lx.base[0], beam.lx.base[1], beam.lx.base[2]);
    }
    const float through = veil_of(*own.cloud, kDiffuseMu).passed;
    down *= through;
    glm::vec3 up = base.below_cd_m2 * (from_sky * through * left_over(sky, layer, kDiffuseMu, false));
    for (std::size_t k = 0; k < sky.count; ++k) {
        const float part = part_under(sky.layers[k].layer, layer);
        if (part > 0.0F)
            up +=
                part * veil_of(*sky.layers[k].cloud, kDiffuseMu).returned * down / std::numbers::pi_v<float>;
    }
    layer.below_cd_m2 = shine_of(up, up, glm::vec3(1.0F));
}

void tint(Shine& shine, const glm::vec3& colour) {
    for (int c = 0; c < 3; ++c) {
        shine.base[c] *= colour[c];
        shine.gain[c] *= colour[c];
    }
}

void colour_layer(const CloudLayer& cloud, Layer& layer) {
    if (!has_look(cloud)) return;
    const glm::vec3 colour = glm::max(glm::vec3(cloud.look->colour), glm::vec3(0.0F));
    for (LayerBeam& beam : layer.beams)
        tint(beam.lx, colour);
    tint(layer.above_cd_m2, colour);
    tint(layer.below_cd_m2, colour);
}

void shine_on(Sky& sky, float closing, const CloudLight& light) {
    for (std::size_t k = 0; k < sky.count; ++k) {
        Layer& layer = sky.layers[k].layer;
        const CloudLight::At base = light.at(static_cast<double>(layer.base_m));
        const CloudLight::At top = light.at(static_cast<double>(upper(layer)));
        shine_beams(sky, closing, light, base, top, layer);
        shine_evenly(sky, base, top, sky.layers[k], layer);
        colour_layer(*sky.layers[k].cloud, layer);
    }
}

float low_of(const Layer& layer) {
    return layer.base_m - layer.bottom_band_m;
}
float high_of(const Layer& layer) {
    return upper(layer) + layer.top_band_m;
}

// A step is this part of the way to it where it is neither shortest nor longest.
constexpr float kRate = 0.008F;

Cells cells_of(float least_m, float most_m) {
    Cells cells{};
    cells.least_m = least_m;
    cells.rate = kRate;
    cells.most_m = std::max(most_m, least_m);
    cells.near_m = least_m / kRate;
    cells.near = 1.0F / kRate;
    cells.far_m = cells.most_m / kRate;
    cells.far = cells.near + std::log(cells.far_m / cells.near_m) / kRate;
    return cells;
}

// Layers by height, those that overlap together; sheets each for themselves.
void stack(const Sky& sky, Field& field) {
    std::array<const Known*, Weather::kMaxClouds> order{};
    for (std::size_t k = 0; k < sky.count; ++k)
        order[k] = &sky.layers[k];
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(sky.count);
    std::sort(order.begin(), end, [](const Known* one, const Known* other) {
        const Layer& a = one->layer;
        const Layer& b = other->layer;
        if (a.sheet != b.sheet) return b.sheet;
        return low_of(a) != low_of(b) ? low_of(a) < low_of(b) : one < other;
    });
    field.deck_count = 0;
    for (std::size_t k = 0; k < sky.count; ++k) {
        const Layer& layer = order[k]->layer;
        const Genus& genus = genus_of(order[k]->cloud->genus);
        const Cells own =
            cells_of(std::min(genus.step_m, genus.step_part * layer.thickness_m), genus.stride_m);
        const bool joins =
            field.deck_count > 0 && !layer.sheet && low_of(layer) < field.decks[field.deck_count - 1].high_m;
        if (!joins)
            field.decks[field.deck_count++] = {static_cast<int>(k), 0, low_of(layer), high_of(layer), own};
        Deck& deck = field.decks[field.deck_count - 1];
        ++deck.count;
        deck.high_m = std::max(deck.high_m, high_of(layer));
        deck.cells =
            cells_of(std::min(deck.cells.least_m, own.least_m), std::min(deck.cells.most_m, own.most_m));
        field.layers[k] = layer;
    }
    std::sort(field.decks, field.decks + field.deck_count, [](const Deck& a, const Deck& b) {
        const float gap = (a.low_m + a.high_m) - (b.low_m + b.high_m);
        return gap != 0.0F ? gap < 0.0F : a.first < b.first;
    });
}

}  // namespace

void freeze_field(const Matrix& matrix, const Scene& scene, const CloudLight& light, Field& field) noexcept {
    const sky::SeaAnchor anchor = sky::sea_anchor(scene.eye);
    field.eye_m = f32(scene.eye.height_m);
    field.ground_m = std::min(0.0F, field.eye_m);
    field.closing = f32(anchor.closing);
    Sky sky;
    for (const CloudLayer& cloud : scene.weather.all_clouds()) {
        if (is_cloud(cloud)) sky.layers[sky.count++] = {&cloud, layer_of(matrix, cloud, anchor)};
    }
    shine_on(sky, field.closing, light);
    stack(sky, field);
}

}  // namespace skyig::render::cloud::field
