// Glare: the veil that the eye's own media lay round Sun and Moon. Free of GL.
//
// Law: the CIE general disability glare equation (Vos and van den Berg, CIE 135/1, 1999), valid from 0.1 to
// 100 deg, for an eye of 35 years and medium pigment. Only what a display leaves out is drawn. It shows the
// discs no brighter than its white, so that the crew's own eyes add next to nothing round them; but the wide
// even part lowers contrast everywhere alike, belongs to what eyes are adapted to, and is faded out towards
// kReach_rad. How bright a veil is shown is a matter of adaptation: an eye on the disc sees none, an eye
// beside it adapts to the veil it gets there (eye/fovea.h); it is shown 0.3 times as strong as to the second.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/display.h"
#include "render/scene.h"
#include "render/shaders/shared.h"
#include "render/sky/air_tables.h"
#include "render/sky_light.h"

namespace skyig::render {

/// Veil luminance, cd/m2 per lux at the eye, of a source that stands that far from where the eye looks. Rises
/// without a bound towards 0; angles below 0.1 deg count as that.
[[nodiscard]] double veil_per_lux(double angle_rad) noexcept;

/// What dazzles: a disc as the eye gets it.
struct GlareSource {
    /// As it is seen.
    Horizontal at;
    double radius_rad = 0.0;
    /// Linear Rec.709 components of the illuminance, lux, behind the air; it falls with the part of the disc
    /// above the horizon and out of eclipse.
    glm::dvec3 rgb_lux{0.0};
};
/// Whether a veil laid for `made` still serves `now`: its place within 0.02 deg, its light within a half
/// percent.
[[nodiscard]] bool still_serves(const GlareSource& made, const GlareSource& now) noexcept;
[[nodiscard]] GlareSource sun_glare(const Scene& scene, const sky::AirTables& air,
                                    const SkyLight& light) noexcept;
[[nodiscard]] GlareSource moon_glare(const Scene& scene, const sky::AirTables& air,
                                     const SkyLight& light) noexcept;

/// As the vertex shader eye/glare.vert takes it: place in tangents of angles (gnomonic, right and up of the
/// source), and what is added to the picture there, encoded for the display, before sky and before ground.
struct GlareVertex {
    glm::vec2 offset;
    glm::vec3 over_sky;
    glm::vec3 over_ground;
};

/// The veil of one source in one frame, as rings of vertices: a function of direction alone, whatever the
/// channel.
class Glare {
  public:
    static constexpr double kReach_rad = 0.1745;
    static constexpr std::size_t kRings = 14;
    static constexpr std::size_t kSectors = 24;

    Glare();

    /// \param tone  the frame's, made of `display`. Allocates nothing.
    void update(const GlareSource& source, const SkyLight& light, const DisplaySettings& display,
                const shaders64::ToneParameters& tone) noexcept;

    /// The same veil, for a source and a horizon that have moved by little since update().
    void follow(const GlareSource& source, const SkyLight& light) noexcept;

    /// How far from the source it adds half a display code or more; 0: nowhere outside the disc.
    [[nodiscard]] double reach_rad() const noexcept { return reach_rad_; }
    /// The veil on the disc's edge, as the frame's tone curve is to show it.
    struct Limb {
        glm::vec3 rgb_cd_m2{0.0F};
        float own_cd_m2 = 0.0F;  ///< luminance of veil and sky, not dimmed
    };
    [[nodiscard]] const Limb& limb() const noexcept { return limb_; }

    // Only while reach_rad() > 0.
    [[nodiscard]] std::span<const GlareVertex> vertices() const noexcept { return vertices_; }
    [[nodiscard]] const glm::mat3& enu_from_source() const noexcept {
        return enu_from_source_;
    }  ///< right, up, out
    [[nodiscard]] float horizon_rad() const noexcept { return horizon_rad_; }

    /// Triangles of the vertices: those on the disc first, kOnDisc indices.
    [[nodiscard]] static std::vector<std::uint32_t> indices();
    static constexpr std::size_t kOnDisc = kSectors * 3;
    static constexpr std::size_t kIndices = kOnDisc + (kRings - 1) * kSectors * 6;
    static constexpr std::size_t kVertices = 1 + kRings * kSectors;

  private:
    struct Veiled;
    void find_reach(const Veiled& veiled, const GlareSource& source, const SkyLight& light) noexcept;
    void lay(const Veiled& veiled, const GlareSource& source, const SkyLight& light) noexcept;

    std::array<GlareVertex, kVertices> vertices_{};
    std::array<glm::vec2, kSectors> circle_{};
    glm::mat3 enu_from_source_{1.0F};
    Limb limb_;
    double reach_rad_ = 0.0;
    float horizon_rad_ = 0.0F;
};

}  // namespace skyig::render
