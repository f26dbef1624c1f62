// A body's disc as the air shows it: lifted and flattened by refraction, dimmed and reddened towards the
// horizon. Free of GL.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/glm.hpp>

#include "render/display.h"
#include "render/scene.h"
#include "render/shaders/shared.h"
#include "render/sky/air_tables.h"
#include "render/sky_light.h"

namespace skyig::render {

/// As the vertex shader sky/disc.vert takes it: one end of a level line across the disc. Offsets are tangents
/// of angles (gnomonic coordinates).
struct DiscVertex {
    glm::vec2 seen;   ///< from the centre as it is seen: right, up
    float true_up;    ///< from the centre without refraction
    float stretch;    ///< d(true_up) / d(seen.y), >= 1 above the horizon
    glm::vec3 light;  ///< what the body's pass multiplies, linear Rec.709, behind the air
};

/// What a disc's pass knows of the frame, whatever the channel.
struct DiscFrame {
    static constexpr std::size_t kRows = 17;

    glm::vec3 centre_enu{0.0F};  ///< as it is seen
    glm::vec3 right_enu{0.0F};
    glm::vec3 up_enu{0.0F};
    /// The body's own axes: of its airless direction. `right_enu` is common.
    glm::vec3 true_centre_enu{0.0F};
    glm::vec3 true_up_enu{0.0F};
    float radius = 0.0F;     ///< tangent of the angular radius
    float pixel_rad = 0.0F;  ///< softening of edges
    float horizon_rad = 0.0F;
    glm::vec3 background_cd_m2{0.0F};  ///< of the sky at the centre,
    glm::vec3 background_right{0.0F};  ///< and what it gains over one radius
    glm::vec3 background_up{0.0F};
    /// Where each row is seen, from the bottom up; straight elevations are what the air's tables are asked
    /// at.
    std::array<double, kRows> straight_elevation_rad{};
    std::array<DiscVertex, 2 * kRows> vertices{};  ///< left and right end of each row, a strip

    /// Largest luminance by which what the vertices have is to be multiplied.
    float brightness = 1.0F;

    /// Of a vertex' place, unit vector.
    [[nodiscard]] glm::dvec3 direction_enu(const glm::vec2& at) const noexcept {
        return glm::normalize(glm::dvec3{centre_enu + at.x * right_enu + at.y * up_enu});
    }
    void set_light(std::size_t row, const glm::vec3& light) noexcept {
        vertices[2 * row].light = vertices[2 * row + 1].light = light;
    }
};

/// Axes and rows of a disc about its centre: up is towards the zenith, right completes them as the viewer
/// sees it. The rows reach over the disc by `reach_radii` radii at least and two pixels; light is left at 0.
/// The width is the airless one (refraction narrows it by 3e-4 at most). \param direction_enu  airless
[[nodiscard]] DiscFrame disc_frame(const glm::dvec3& direction_enu, double angular_radius_rad,
                                   double pixel_rad, const SkyLight& light,
                                   double reach_radii = 1.0) noexcept;

/// Puts clouds before a disc whose light is set. \param through  (light behind, cd/m2; direction, unit
/// vector) -> what is seen of it \param passed  (direction) -> transmittance \return whether it still shows
template <class Through, class Passed>
bool put_behind_clouds(DiscFrame& frame, Through through, Passed passed) {
    float brightest = 0.0F;
    for (DiscVertex& vertex : frame.vertices) {
        vertex.light *= static_cast<float>(passed(frame.direction_enu(vertex.seen)));
        brightest = std::max(brightest, shaders32::luminance_709(vertex.light));
    }
    const auto seen = [&](float right, float up) {
        const glm::vec3 behind =
            frame.background_cd_m2 + right * frame.background_right + up * frame.background_up;
        return glm::vec3{
            through(glm::dvec3{behind}, frame.direction_enu(frame.radius * glm::vec2{right, up}))};
    };
    const glm::vec3 left = seen(-1.0F, 0.0F), right = seen(1.0F, 0.0F);
    const glm::vec3 low = seen(0.0F, -1.0F), high = seen(0.0F, 1.0F);
    frame.background_cd_m2 = seen(0.0F, 0.0F);
    frame.background_right = 0.5F * (right - left);
    frame.background_up = 0.5F * (high - low);
    constexpr float kShows = 1e-3F;
    return brightest * frame.brightness > kShows * shaders32::luminance_709(frame.background_cd_m2);
}

/// How the eye that looks at the Moon takes its light: exact for the sunlit face behind the air, and for 1e-4
/// of it, deep in the Earth's shadow. \param tone  the frame's, made of `display`
[[nodiscard]] shaders64::Fovea moon_fovea(const Scene& scene, const sky::AirTables& air,
                                          const SkyLight& light, const DisplaySettings& display,
                                          const shaders64::ToneParameters& tone) noexcept;

}  // namespace skyig::render
