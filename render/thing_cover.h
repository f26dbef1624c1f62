// Rain and snow on another renderer's things: the passes before and after the air is put over them, made when
// they are first needed.
#pragma once

#include <cstddef>
#include <memory>

#include "render/channel.h"
#include "render/cover_pass.h"
#include "render/deferred.h"
#include "render/scene.h"
#include "render/sky_frame.h"
#include "render/wet_pass.h"

namespace skyig::render {

class ThingCover {
  public:
    explicit ThingCover(std::size_t channels) noexcept : channels_(channels) {}

    /// Once a frame, after SkyFrame::prepare().
    void prepare(const Scene& scene, const SkyFrame& frame);
    /// Before the channel's own picture is bound, without blending. \throws std::runtime_error when what is
    /// needed for the first time cannot be made \return the same picture, darkened and whitened
    [[nodiscard]] DeferredInput covered(std::size_t index, const Channel& channel, const ChannelView& view,
                                        const DeferredInput& input);
    /// What their film mirrors, over things that have been drawn, blended by coverage. \throws likewise
    void draw_film(const Channel& channel, const ChannelView& view, const shaders32::ToneParameters& tone,
                   const DeferredInput& input);

  private:
    std::size_t channels_;
    const Scene* scene_ = nullptr;
    const SkyFrame* frame_ = nullptr;
    std::unique_ptr<CoverPass> cover_;
    std::unique_ptr<WetPass> wet_;
};

}  // namespace skyig::render
