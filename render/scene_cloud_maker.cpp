#include "render/scene_cloud_maker.h"

#include <algorithm>

namespace skyig::render {

using cloud::CloudSample;
using cloud::impostor::ImpostorClouds;
using cloud::impostor::ImpostorField;

namespace {

// That the second source is asked at a time.
constexpr std::size_t kRays = 64;

// Pictures as large as the map's rays can tell, some 2 ms of one core a frame in flight.
cloud::impostor::ImpostorSettings settings() noexcept {
    cloud::impostor::ImpostorSettings settings;
    settings.lights_per_update = 2;
    settings.pictures_per_update = 3;
    return settings;
}

void put_behind(const CloudSample& behind, CloudSample& sample) noexcept {
    const float passed = sample.transmittance;
    const float opacity = 1.0F - passed;
    const float added = passed * (1.0F - behind.transmittance);
    sample.light_cd_m2 += passed * behind.light_cd_m2;
    if (opacity + added > 0.0F)
        sample.distance_m = (opacity * sample.distance_m + added * behind.distance_m) / (opacity + added);
    sample.transmittance *= behind.transmittance;
}

}  // namespace

void JoinedClouds::join(const cloud::CloudSource& one, const cloud::CloudSource& other) noexcept {
    one_ = &one;
    other_ = &other;
}

void JoinedClouds::march(std::span<const cloud::CloudRay> rays, const cloud::CloudRange& range, float ray_rad,
                         std::span<CloudSample> out) const noexcept {
    one_->march(rays, range, ray_rad, out);
    std::array<CloudSample, kRays> others;
    for (std::size_t first = 0; first < rays.size(); first += kRays) {
        const std::size_t count = std::min(kRays, rays.size() - first);
        other_->march(rays.subspan(first, count), range, ray_rad, {others.data(), count});
        for (std::size_t i = 0; i < count; ++i) {
            CloudSample& sample = out[first + i];
            const CloudSample& other = others[i];
            if (other.transmittance == 1.0F) continue;
            CloudSample before = sample;
            if (before.transmittance < 1.0F && before.distance_m <= other.distance_m) {
                put_behind(other, sample);
            } else {
                sample = other;
                put_behind(before, sample);
            }
        }
    }
}

void JoinedClouds::shadow(const cloud::CloudBeam& beam, float grain_m, std::span<const glm::vec2> ground_m,
                          std::span<float> passed) const noexcept {
    one_->shadow(beam, grain_m, ground_m, passed);
    std::array<float, kRays> others;
    for (std::size_t first = 0; first < ground_m.size(); first += kRays) {
        const std::size_t count = std::min(kRays, ground_m.size() - first);
        other_->shadow(beam, grain_m, ground_m.subspan(first, count), {others.data(), count});
        for (std::size_t i = 0; i < count; ++i)
            passed[first + i] *= others[i];
    }
}

// The one that had the layer before, else one that is free, if possible without another layer's clouds in it.
// At most as many are asked for as there are.
SceneCloudMaker::Impostors& SceneCloudMaker::impostors_of(const CloudLayer& layer) {
    Impostors* free = nullptr;
    for (Impostors& impostors : impostors_) {
        if (impostors.used) continue;
        if (impostors.clouds && impostors.seed == layer.seed && impostors.genus == layer.genus)
            return impostors;
        if (free == nullptr || (free->clouds && !impostors.clouds)) free = &impostors;
    }
    free->seed = layer.seed;
    free->genus = layer.genus;
    return *free;
}

void SceneCloudMaker::follow(const cloud::CloudMoment& moment, float ray_rad, bool jumped) {
    for (Impostors& impostors : impostors_)
        impostors.used = false;
    const Weather& weather = moment.scene.weather;
    for (std::size_t i = 0; i < weather.cloud_count; ++i) {
        const CloudLayer& layer = weather.clouds[i];
        if (drawn_as(weather, i) != CloudModel::kImpostor) continue;
        Impostors& impostors = impostors_of(layer);
        if (!impostors.clouds) {
            impostors.clouds = std::make_unique<ImpostorClouds>(settings());
            for (Slot& slot : slots_) {
                if (!slot.impostors) slot.impostors = std::make_unique<ImpostorField>();
            }
        }
        impostors.used = true;
        impostors.clouds->update({.eye = moment.eye,
                                  .layer = layer,
                                  .beams = moment.light.beams,
                                  .texel_rad = ray_rad,
                                  .time_s = moment.scene.time_s,
                                  .jumped = jumped});
    }
}

const cloud::CloudSource& SceneCloudMaker::freeze(std::size_t slot, const cloud::CloudMoment& moment) {
    // Fog alone is asked for there.
    if (slot == kPatchSlot) return fields_.freeze(slot, moment);
    std::array<const ImpostorClouds*, kMostImpostorLayers> used{};
    std::size_t count = 0;
    for (Impostors& impostors : impostors_) {
        if (!impostors.clouds) continue;
        if (impostors.used) {
            impostors.clouds->hold(slot);
            used[count++] = impostors.clouds.get();
        } else {
            impostors.clouds->let_go(slot);
        }
    }
    if (count == 0) return fields_.freeze(slot, moment);

    Slot& own = slots_[slot];
    own.impostors->freeze({used.data(), count}, moment.light, moment.eye);
    const Weather& weather = moment.scene.weather;
    bool all = true;
    scene_ = moment.scene;
    for (std::size_t i = 0; i < weather.cloud_count; ++i) {
        const CloudModel drawn = drawn_as(weather, i);
        all = all && (drawn == CloudModel::kImpostor || !(weather.clouds[i].coverage > 0.0));
        if (weather.clouds[i].model == CloudModel::kImpostor) scene_.weather.clouds[i].model = drawn;
    }
    if (all) return *own.impostors;
    own.joined.join(fields_.freeze(slot, {scene_, moment.eye, moment.light}), *own.impostors);
    return own.joined;
}

}  // namespace skyig::render
