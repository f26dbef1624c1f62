// Any bytes as a rig's frame: what is taken is inside its bounds, and told again it comes out the same.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "render/cloud/field/texture.h"
#include "server/rig/frame_coder.h"
#include "server/rig/messages.h"

namespace {

using skyig::render::cloud::field::Texture;
using namespace skyig::server::rig;

const FrameCoder& coder() {
    static const std::vector<FrameCoder::Picture> kPictures{
        std::make_shared<Texture>(16, std::vector<float>(256, 0.25F)),
        std::make_shared<Texture>(16, std::vector<float>(256, 0.5F))};
    static const FrameCoder kCoder(kPictures);
    return kCoder;
}

void check(const skyig::render::Scene& scene) {
    const auto& weather = scene.weather;
    if (weather.cloud_count > weather.clouds.size() || weather.obscurant_count > weather.obscurants.size() ||
        weather.precipitation_count > weather.precipitations.size() ||
        weather.lightning_count > weather.lightnings.size() || scene.view_count > scene.views.size() ||
        scene.sea.wave_count > scene.sea.waves.size() || scene.night.city_count > scene.night.cities.size())
        std::abort();
    if (!std::isfinite(scene.time_s) || !std::isfinite(scene.eye.height_m)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto kTaken = std::make_unique<FrameState>();
    static std::vector<std::byte> told(kMostStateBytes), again(kMostStateBytes);
    if (!coder().decode(std::as_bytes(std::span(data, size)), *kTaken)) return 0;
    check(kTaken->scene);
    const std::size_t told_bytes = coder().encode(*kTaken, told);
    if (told_bytes == 0) std::abort();
    if (!coder().decode(std::span(told).first(told_bytes), *kTaken)) std::abort();
    const std::size_t again_bytes = coder().encode(*kTaken, again);
    if (again_bytes != told_bytes ||
        !std::equal(told.begin(), told.begin() + static_cast<std::ptrdiff_t>(told_bytes), again.begin()))
        std::abort();
    return 0;
}
