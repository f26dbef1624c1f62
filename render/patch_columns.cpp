#include "render/patch_columns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/geometry.h"

namespace skyig::render {

namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
constexpr double kThickness_m = 100.0;

double ring_m(int ring) noexcept {
    return shaders64::patch_ring_m(static_cast<double>(ring));
}

double azimuth_of(int column) noexcept {
    return kTurn_rad * (static_cast<double>(column) / PatchColumns::kAzimuths - 0.5);
}

}  // namespace

void PatchColumns::update(cloud::CloudMaker& maker, const cloud::CloudMoment& moment) {
    const auto clouds = moment.scene.weather.all_clouds();
    const auto found = std::find_if(clouds.begin(), clouds.end(), [](const CloudLayer& cloud) {
        return cloud.genus == CloudGenus::kFogPatches && cloud.coverage > 0.0;
    });
    if (found == clouds.end()) {
        stop();
        return;
    }
    const double eye_m = moment.scene.eye.height_m;
    const double base_m = found->base_m - eye_m;
    heights_m_ = {base_m - found->bottom_band_m, base_m, base_m + found->thickness_m,
                  base_m + found->thickness_m + found->top_band_m};
    extinction_per_m_ = found->extinction_per_m;
    eye_radius_m_ = kEarthRadius_m + eye_m;
    mean_ = found->area ? 0.0 : std::clamp(found->coverage, 0.0, 1.0);
    // A column of depth 1 where it is full: what a beam straight down keeps tells how full it is.
    CloudLayer layer = *found;
    layer.base_m = 0.0;
    layer.thickness_m = kThickness_m;
    layer.bottom_band_m = layer.top_band_m = 0.0;
    layer.extinction_per_m = 1.0 / kThickness_m;
    const Eye& eye = moment.scene.eye;
    const bool same_place = eye_.latitude_deg == eye.latitude_deg && eye_.longitude_deg == eye.longitude_deg;
    if (shown_ && same_place && layer == layer_) return;
    layer_ = layer;
    eye_ = eye;
    scene_.eye = {eye.latitude_deg, eye.longitude_deg, 0.0};
    scene_.weather.clouds[0] = layer;
    scene_.weather.cloud_count = 1;
    lay(maker.freeze(cloud::CloudMaker::kPatchSlot, {scene_, scene_.eye, moment.light}));
    shown_ = true;
    ++revision_;
}

void PatchColumns::lay(const cloud::CloudSource& source) {
    constexpr auto kAcross = static_cast<std::size_t>(kColumns);
    texels_.resize(kAcross * (kRings + 1));
    places_m_.resize(kAcross);
    passed_.resize(kAcross);
    std::fill_n(texels_.begin(), kAcross, 0.0F);
    for (int ring = 0; ring < kRings; ++ring) {
        const double from_m = ring_m(ring);
        const double to_m = ring_m(ring + 1);
        const double at_m = 0.5 * (from_m + to_m);
        for (int column = 0; column < kColumns; ++column) {
            const double azimuth_rad = azimuth_of(column % kAzimuths);
            places_m_[static_cast<std::size_t>(column)] =
                glm::vec2{at_m * glm::dvec2{std::sin(azimuth_rad), std::cos(azimuth_rad)}};
        }
        source.shadow({}, 0.0F, places_m_, passed_);
        const float* last = &texels_[static_cast<std::size_t>(ring) * kAcross];
        float* next = &texels_[static_cast<std::size_t>(ring + 1) * kAcross];
        for (std::size_t column = 0; column < kAcross; ++column) {
            const float full = std::clamp(-std::log(std::max(passed_[column], 1e-6F)), 0.0F, 1.0F);
            next[column] = last[column] + full * static_cast<float>(to_m - from_m);
        }
    }
}

// As patch_sum() of cloud/things.glsl.
double PatchColumns::sum_at(double azimuth_rad, double ground_m) const noexcept {
    const double inside_m = std::min(ground_m, ring_m(kRings));
    const double column =
        std::clamp((azimuth_rad / kTurn_rad + 0.5) * kAzimuths, 0.0, static_cast<double>(kAzimuths));
    const double ring = std::clamp(shaders64::patch_ring(inside_m), 0.0, static_cast<double>(kRings));
    const int left = std::min(static_cast<int>(column), kAzimuths - 1);
    const int low = std::min(static_cast<int>(ring), kRings - 1);
    const auto across = [&](int r) {
        const float* texels = &texels_[static_cast<std::size_t>(r * kColumns + left)];
        return std::lerp(static_cast<double>(texels[0]), static_cast<double>(texels[1]), column - left);
    };
    return std::lerp(across(low), across(low + 1), ring - low) + mean_ * (ground_m - inside_m);
}

double PatchColumns::optical_depth(const glm::dvec3& direction_enu, double distance_m) const noexcept {
    if (!shown_) return 0.0;
    const shaders64::VeilRay ray{direction_enu.z, eye_radius_m_};
    const double level = std::max(std::hypot(direction_enu.x, direction_enu.y), 1e-4);
    const double azimuth_rad = std::atan2(direction_enu.x, direction_enu.y);
    double way_m = 0.0;
    for (int i = 0; i < 3; ++i) {
        const shaders64::PatchBand band = shaders64::patch_band(i, heights_m_);
        const glm::dvec2 piece_m = shaders64::patch_piece_m(band, ray);
        const double to_m = std::min(piece_m.y, distance_m);
        if (!(to_m > piece_m.x)) continue;
        const int parts = shaders64::patch_parts(band);
        double sum = sum_at(azimuth_rad, piece_m.x * level);
        double density = shaders64::patch_density(piece_m.x, band, ray);
        for (int k = 1; k <= parts; ++k) {
            const double at_m = std::lerp(piece_m.x, to_m, static_cast<double>(k) / parts);
            const double next_sum = sum_at(azimuth_rad, at_m * level);
            const double next_density = shaders64::patch_density(at_m, band, ray);
            way_m += 0.5 * (density + next_density) * (next_sum - sum);
            sum = next_sum;
            density = next_density;
        }
    }
    return extinction_per_m_ * way_m / level;
}

}  // namespace skyig::render
