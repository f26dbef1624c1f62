// What one frame of a rig of several machines is made from: the leader tells it, every node draws it.
#pragma once

#include <cstdint>

#include "render/eye/adaptation.h"
#include "render/quality.h"
#include "render/scene.h"

namespace skyig::server::rig {

struct FrameState {
    render::Scene scene;           // complete; its frame_number is the rig's
    render::eye::Adaptation eyes;  // before this frame
    render::Thinned thinned;
    std::int64_t world_utc_ns = 0;  // the world's clock, for who takes over
    std::uint32_t slots = 1;        // periods since the frame before
};

}  // namespace skyig::server::rig
