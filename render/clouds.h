// Who makes the clouds of a scene's weather for the renderer.
#pragma once

#include <memory>

#include "render/cloud/cloud_light.h"
#include "render/cloud/cloud_maker.h"
#include "render/scene.h"

namespace skyig::render {

class LightTables;
struct Plan;
struct SkyLight;

struct Clouds {
    /// Nobody: clouds are not drawn.
    std::unique_ptr<cloud::CloudMaker> maker;
    /// What shines on them in a frame; none: what it was before.
    void (*light)(const Scene& scene, const Plan& plan, const LightTables& tables, const SkyLight& sky,
                  cloud::CloudLight& on_clouds) = nullptr;
};

/// Clouds by the model of each layer, lit by the frame's Sun, Moon and dark sky. Makes their noise: a quarter
/// of a second of one core. May throw std::bad_alloc.
[[nodiscard]] Clouds scene_clouds();

}  // namespace skyig::render
