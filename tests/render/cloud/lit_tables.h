// A scene's tables at rest and its light, for tests of light with clouds.
#pragma once

#include "render/light_tables.h"
#include "render/plan.h"
#include "render/scene.h"
#include "render/sky_light.h"

namespace skyig::render::tests {

struct LitTables {
    LightTables tables;
    Plan plan;
    SkyLight sky;

    explicit LitTables(const Scene& scene) { follow(scene); }
    /// Of a scene that stands; what counts is built at once.
    void follow(const Scene& scene) {
        const sky::RefractionRow refraction = tables.refraction(scene);
        for (int frame = 0; frame < 2; ++frame) {
            plan = make_plan(scene, tables.held(scene), refraction);
            tables.update(scene, plan);
        }
        sky = tables.light(scene, plan, refraction);
    }
};

}  // namespace skyig::render::tests
