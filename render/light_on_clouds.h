// What shines on a frame's clouds, from the tables of its air and dark sky.
#pragma once

#include "render/cloud/cloud_light.h"
#include "render/light_tables.h"
#include "render/plan.h"
#include "render/scene.h"
#include "render/sky_light.h"

namespace skyig::render {

/// After LightTables::update() and light(). Sun and Moon come through the air by height, also from below the
/// horizon of the ground while they are above that of the cloud. Even light from above is the sky's on level
/// ground, less with height as the air above gets thinner (its vertical depth); from below it is what the
/// ground sends back through the air, that air's own light, and towns by night. Allocates nothing.
void light_clouds(const Scene& scene, const Plan& plan, const LightTables& tables, const SkyLight& sky,
                  cloud::CloudLight& on_clouds) noexcept;

}  // namespace skyig::render
