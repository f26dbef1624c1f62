#include "render/thing_cover.h"

#include "render/precipitation/exposure.h"
#include "render/sky_veil.h"

namespace skyig::render {

void ThingCover::prepare(const Scene& scene, const SkyFrame& frame) {
    scene_ = &scene;
    frame_ = &frame;
    const precipitation::ExposureView exposure = precipitation::exposure_view(scene);
    if (cover_ && frame.plan().needs(Pass::kCoveredThings))
        cover_->prepare(scene, white_ground_cd_m2(scene, frame.air(), frame.light()), exposure);
    if (wet_ && frame.plan().needs(Pass::kWetThings)) wet_->prepare(scene, frame.light(), exposure);
}

DeferredInput ThingCover::covered(std::size_t index, const Channel& channel, const ChannelView& view,
                                  const DeferredInput& input) {
    if (!frame_->plan().needs(Pass::kCoveredThings)) return input;
    if (!cover_) {
        cover_ = std::make_unique<CoverPass>(channels_);
        prepare(*scene_, *frame_);
    }
    return cover_->draw(index, channel, view, input);
}

void ThingCover::draw_film(const Channel& channel, const ChannelView& view,
                           const shaders32::ToneParameters& tone, const DeferredInput& input) {
    if (!frame_->plan().needs(Pass::kWetThings)) return;
    if (!wet_) {
        wet_ = std::make_unique<WetPass>();
        prepare(*scene_, *frame_);
    }
    wet_->draw(channel, view, tone, input);
}

}  // namespace skyig::render
