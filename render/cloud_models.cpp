#include "render/cloud_models.h"

#include <algorithm>
#include <array>

#include "render/cloud/field/shapes.h"

namespace skyig::render {

namespace {

constexpr unsigned kVolumes = 1U;
constexpr unsigned kLayers = 2U;
constexpr unsigned kImpostors = 4U;

constexpr std::array<std::string_view, 8> kReasons{
    "no layer has any",
    "clouds stand in the sky: volumes, whose light is nearest to the truth",
    "clouds stand in the sky: sheets, which ice clouds are without being asked for, and others by request",
    "clouds stand in the sky: volumes, whose light is nearest to the truth, and sheets: ice, or by request",
    "clouds stand in the sky: impostors by request",
    "clouds stand in the sky: volumes, whose light is nearest to the truth, and impostors by request",
    "clouds stand in the sky: sheets (ice, or by request) and impostors by request",
    "clouds stand in the sky: volumes, sheets (ice, or by request) and impostors by request"};
constexpr std::string_view kTooMany =
    "clouds stand in the sky: two layers of impostors by request, further ones as volumes for want of memory";

constexpr std::string_view kPatches = "fog lies in patches: a volume, so that each of them is seen";
constexpr std::string_view kPatchesToo =
    "clouds stand in the sky, and fog lies in patches: volumes, so that each of them is seen";

}  // namespace

CloudModel drawn_as(const Weather& weather, std::size_t layer) noexcept {
    const CloudLayer& cloud = weather.clouds[layer];
    if (cloud.model == CloudModel::kAuto) {
        const bool sheet = cloud.look.has_value() || cloud::field::genus_of(cloud.genus).ice;
        return sheet ? CloudModel::kLayer : CloudModel::kVolume;
    }
    if (cloud.model != CloudModel::kImpostor) return cloud.model;
    const auto before =
        std::count_if(weather.clouds.begin(), weather.clouds.begin() + static_cast<std::ptrdiff_t>(layer),
                      [](const CloudLayer& other) { return other.model == CloudModel::kImpostor; });
    return static_cast<std::size_t>(before) < kMostImpostorLayers ? CloudModel::kImpostor
                                                                  : CloudModel::kVolume;
}

std::string_view drawn_models(const Weather& weather) noexcept {
    unsigned models = 0;
    bool patches = false;
    for (std::size_t i = 0; i < weather.cloud_count; ++i) {
        const CloudLayer& cloud = weather.clouds[i];
        if (!(cloud.coverage > 0.0)) continue;
        if (cloud.genus == CloudGenus::kFogPatches) {
            patches = true;
            continue;
        }
        const CloudModel drawn = drawn_as(weather, i);
        if (cloud.model == CloudModel::kImpostor && drawn != cloud.model) return kTooMany;
        models |= drawn == CloudModel::kVolume  ? kVolumes
                  : drawn == CloudModel::kLayer ? kLayers
                                                : kImpostors;
    }
    if (patches) return models == 0 ? kPatches : kPatchesToo;
    return kReasons[models];
}

}  // namespace skyig::render
