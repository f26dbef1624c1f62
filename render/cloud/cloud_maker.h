// Freezes moments of the clouds for the map, which follows some of them at a time.
#pragma once

#include <cstddef>

#include "render/cloud/cloud_light.h"
#include "render/cloud/cloud_source.h"
#include "render/scene.h"

namespace skyig::render::cloud {

/// What a source is frozen from.
struct CloudMoment {
    const Scene& scene;
    /// Where the clouds are seen from: near by the scene's eye, for which the scene's places are told.
    Eye eye;
    const CloudLight& light;
};

class CloudMaker {
  public:
    /// Moments that are in use together.
    static constexpr std::size_t kSlots = 6;
    /// Of them, that of the map of near clouds, that of shadows and that of fog's patches.
    static constexpr std::size_t kNearSlot = 3;
    static constexpr std::size_t kShadowSlot = 4;
    static constexpr std::size_t kPatchSlot = 5;

    virtual ~CloudMaker() = default;

    /// Once a frame, before what is frozen in it and while nothing is marched: what is kept from frame to
    /// frame is brought up to date. \param ray_rad  of the map's rays \param jumped  nothing that was frozen
    /// before is marched again
    virtual void follow(const CloudMoment& /*moment*/, float /*ray_rad*/, bool /*jumped*/) {}

    /// Replaces what the slot held; other slots go on. What is returned lives until the slot is frozen anew.
    /// Allocates nothing after the first call for each slot.
    [[nodiscard]] virtual const CloudSource& freeze(std::size_t slot, const CloudMoment& moment) = 0;

  protected:
    CloudMaker() = default;
    CloudMaker(const CloudMaker&) = default;
    CloudMaker& operator=(const CloudMaker&) = default;
    CloudMaker(CloudMaker&&) = default;
    CloudMaker& operator=(CloudMaker&&) = default;
};

}  // namespace skyig::render::cloud
