// The light that what falls near the eye shows: that of its surroundings.
#pragma once

#include <glm/glm.hpp>

#include "render/sky_light.h"
#include "render/weather.h"

namespace skyig::render {

/// Of all directions round the eye, smooth: mean + gradient * direction, linear Rec.709, cd/m2. Discs are
/// left out.
struct Surroundings {
    glm::vec3 mean_cd_m2{0.0F};
    glm::mat3 gradient_cd_m2{0.0F};
};
[[nodiscard]] Surroundings surroundings(const SkyLight& light) noexcept;

/// What a drop, flake or stone shows, seen in a direction: mean + gradient * direction.
///
/// Water gathers the light of the half of directions beyond it and passes 94 % of it (Garg and Nayar 2007,
/// Vision and Rain): the mean over that half, by the cosine. Flakes scatter 90 % of what comes from all
/// sides. Sleet and hail: half as water, half as flakes.
[[nodiscard]] Surroundings shown_by(Precipitation::Kind kind, const Surroundings& around) noexcept;

}  // namespace skyig::render
