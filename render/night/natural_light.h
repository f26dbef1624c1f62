// The light of a moonless sky outside the air, its stars left out: what NightSky takes through the air.
#pragma once

#include <glm/glm.hpp>

#include "render/night_settings.h"

namespace skyig::render::night {

/// Of a source of luminance 1, linear Rec.709.
struct NaturalColours {
    glm::dvec3 airglow;
    glm::dvec3 zodiacal;   ///< sunlight, B-V 0.65
    glm::dvec3 starlight;  ///< B-V 0.75
    glm::dvec3 town;       ///< lamps of 3000 K
};
[[nodiscard]] const NaturalColours& natural_colours() noexcept;

/// The parts of starlight that the settings leave, 0..1.
[[nodiscard]] double starlight_share(const NightSettings& settings) noexcept;

/// Luminance of the airglow straight up from the ground, cd/m2.
[[nodiscard]] double airglow_zenith_cd_m2(const NightSettings& settings) noexcept;

/// Zodiacal light and what of starlight is even, linear Rec.709 in cd/m2. \param direction_gcrs, sun_gcrs
/// unit vectors
[[nodiscard]] glm::dvec3 beyond_air_cd_m2(const NightSettings& settings, const glm::dvec3& direction_gcrs,
                                          const glm::dvec3& sun_gcrs) noexcept;

/// The same with the Milky Way's mean in it: what all the sky sends.
[[nodiscard]] glm::dvec3 whole_beyond_air_cd_m2(const NightSettings& settings,
                                                const glm::dvec3& direction_gcrs,
                                                const glm::dvec3& sun_gcrs) noexcept;

}  // namespace skyig::render::night
