#include "render/cloud/cloud_light.h"

#include <algorithm>
#include <cmath>

namespace skyig::render::cloud {

CloudLight::At CloudLight::at(double height_m) const noexcept {
    const double place = std::clamp((height_m - kLowest_m) / kStep_m, 0.0, static_cast<double>(kHeights - 1));
    const auto low = std::min(static_cast<std::size_t>(place), kHeights - 2);
    const auto part = static_cast<float>(place - static_cast<double>(low));
    At light;
    for (std::size_t source = 0; source < kSources; ++source)
        light.beam_lx[source] = glm::mix(beam_lx[source][low], beam_lx[source][low + 1], part);
    light.above_cd_m2 = glm::mix(above_cd_m2[low], above_cd_m2[low + 1], part);
    light.below_cd_m2 = glm::mix(below_cd_m2[low], below_cd_m2[low + 1], part);
    return light;
}

}  // namespace skyig::render::cloud
