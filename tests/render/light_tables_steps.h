// One frame of the light tables, and the luminance they then show: for tests of LightTables.
#pragma once

#include "render/light_tables.h"
#include "render/shaders/shared.h"
#include "tests/render/scenes.h"

namespace skyig::render::tests {

inline double luminance(const SkyLight& light, double elevation_deg, double azimuth_deg) {
    return static_cast<double>(shaders32::luminance_709(
        light.rgb_cd_m2(elevation_deg * kDegree, azimuth_deg * kDegree, Side::kByElevation)));
}

inline SkyLight step(LightTables& tables, const Scene& scene) {
    const sky::RefractionRow refraction = tables.refraction(scene);
    const Plan plan = make_plan(scene, tables.held(scene), refraction);
    tables.update(scene, plan);
    return tables.light(scene, plan, refraction);
}

}  // namespace skyig::render::tests
