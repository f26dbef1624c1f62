// What shines on the clouds of one frame. Plain values, made once a frame; linear Rec.709.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

namespace skyig::render::cloud {

/// Parallel light, as it arrives through the air alone (no cloud has dimmed it).
struct Beam {
    bool lit = false;
    /// Towards the source, unit vector, east-north-up at the eye.
    glm::vec3 direction_enu{0.0F, 0.0F, 1.0F};
};

/// Light at heights kLowest_m + i * kStep_m above the ellipsoid, linear between, the ends going on.
struct CloudLight {
    static constexpr std::size_t kHeights = 24;
    static constexpr double kLowest_m = 0.0;
    static constexpr double kStep_m = 750.0;

    enum Source : std::size_t { kSun, kMoon, kSources };
    std::array<Beam, kSources> beams{};
    /// On a plane that faces the source, lux; 0 where the Earth is in the way.
    std::array<std::array<glm::vec3, kHeights>, kSources> beam_lx{};
    /// Mean luminance of the clear sky over the upper half of directions, weighed by the sine of their
    /// elevation (irradiance / pi): of Sun, Moon and the dark sky together.
    std::array<glm::vec3, kHeights> above_cd_m2{};
    /// The same of the lower half: ground and air below, without clouds.
    std::array<glm::vec3, kHeights> below_cd_m2{};

    struct At {
        std::array<glm::vec3, kSources> beam_lx{};
        glm::vec3 above_cd_m2{0.0F};
        glm::vec3 below_cd_m2{0.0F};
    };
    [[nodiscard]] At at(double height_m) const noexcept;
};

}  // namespace skyig::render::cloud
