// The light of any direction of a frame, discs and stars left out: what the dome, the backgrounds of stars
// and discs, the adaptation and the tests all ask.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "render/cloud/lightning.h"
#include "render/fog/veil.h"
#include "render/geometry.h"
#include "render/night/milky_way_map.h"
#include "render/night/night_sky.h"
#include "render/scene.h"
#include "render/sky/refraction.h"
#include "render/sky/sea_surface.h"
#include "render/sky/sea_view.h"
#include "render/sky/sky_radiance.h"

namespace skyig::render {

/// What clouds leave of light as a mean over the area (CloudShade): of the air round the eye and of the
/// ground. Each direction lies between: near the horizon it is seen through air of the eye's height, higher
/// up through that above all clouds, lower down on the ground.
struct CloudedAir {
    float at_eye = 1.0F;
    float at_ground = 1.0F;
    /// Part of the beam that does not come to the eye: so much of the air there is lit from all sides instead
    /// (SkyLight::even_cd_m2), which `at_eye` leaves out, and of_ground() tells what it does to the ground.
    float covered = 0.0F;

    /// Of the clear table's light. Exactly 1 without clouds; continuous.
    [[nodiscard]] float share(double above_horizon_rad) const noexcept;
    /// Of the ground's own light, without the air before it, what share() leaves out.
    [[nodiscard]] float of_ground() const noexcept { return covered * at_ground; }
    /// Of a direction, how much is air of the eye's height: 1 at the horizon.
    [[nodiscard]] static float near_part(double above_horizon_rad) noexcept;
};

/// A light source and the table of the air and ground it lights.
struct LitAir {
    const sky::SkyRadiance* view = nullptr;  ///< null: this source lights nothing
    Horizontal source;                       ///< where it stands in this frame; the table may lag by 0.01 deg
    /// Factors on X, Y, Z of the table (distance, obscuration, the Moon's share and tint).
    glm::vec3 scale_xyz{0.0F};
    /// What the sea reflects of it and of its sky; null over land. It lags as `view` does.
    const sky::SeaView* sea = nullptr;
    CloudedAir clouded;
    /// Of the beam that glitters on the ground, what clouds leave.
    float beam_share = 1.0F;
    /// Of land under all of a clear sky's light, without the air before it, linear Rec.709; told where clouds
    /// cover.
    glm::vec3 land_cd_m2{0.0F};
};

/// What the Milky Way adds to even starlight.
struct LitBelt {
    const night::MilkyWayMap* map = nullptr;  ///< null: it is not drawn
    glm::dmat3 galactic_from_enu{1.0};
    float share = 1.0F;  ///< of the map's light
};

/// The belt of a scene's sky. \param night_share  of the dark sky that is drawn
[[nodiscard]] LitBelt lit_belt(const Scene& scene, const night::MilkyWayMap& map,
                               double night_share) noexcept;

/// Which side of the horizon a direction is taken from when it lies on the edge.
enum class Side { kByElevation, kSky, kGround };

/// What slopes of the sea change of its light, linear Rec.709: shaders' WaveLight says how.
struct SlopeLight {
    glm::vec3 east{0.0F};
    glm::vec3 north{0.0F};
    glm::vec3 bend_cd_m2{0.0F};
    glm::vec3 glitter{0.0F};
    /// Of the mirroring slope, over all slopes: the mean light holds `glitter` times this.
    float density = 0.0F;

    [[nodiscard]] glm::vec3 without_glitter(const glm::vec3& mean) const noexcept {
        return glm::max(mean - density * glitter, 0.0F);
    }
};

struct SkyLight {
    LitAir sun;
    LitAir moon;
    /// Where this frame's air shows a body that the scene gives airless.
    sky::RefractionRow refraction;
    /// Where the ground is seen to end: refraction's.
    double horizon_elevation_rad = 0.0;
    /// Where it would without refraction: as the tables have it. Of this frame's eye, exact; a table made a
    /// little lower or higher is asked at the same angle from its own horizon.
    double straight_horizon_rad = 0.0;
    double eye_height_m = 0.0;
    /// What the ground, or the water below the sea's surface, sends back of the dark sky's light, 0..1.
    double ground_albedo = 0.1;
    /// Null over land.
    const sky::SeaSurface* sea = nullptr;
    /// The dark sky, null where it does not count, and how much of it is drawn.
    const night::NightSky* night = nullptr;
    float night_share = 1.0F;
    CloudedAir night_clouded;
    /// Of endless air below clouds, which their base and the ground light alike from all sides: it has their
    /// hue, not the clear sky's. Linear Rec.709; 0 without clouds.
    glm::vec3 even_cd_m2{0.0F};
    /// Mean light of the sky and the clouds that cover it over that of the clear sky; exactly 1 without
    /// clouds.
    float overhead = 1.0F;
    LitBelt milky_way;
    /// What fog and its like lay before all of this; null where there is none.
    const fog::Veil* veil = nullptr;
    /// Rises when the veil shows otherwise.
    std::uint64_t veil_revision = 0;
    /// The clear air, before a veil far away and before the ground.
    shaders64::VeilAir front_air{};
    /// What lightning adds to everything.
    cloud::FlashLight flash;
    /// Part of the land under a film of water that mirrors the sky, 0..1.
    double film = 0.0;
    /// Of the air between the eye and what flashes and films do to the ground.
    double near_extinction_per_m = 0.0;

    /// Elevation of the straight ray that stands in the tables for the curved one seen at `elevation_rad`: it
    /// comes as near to the ground. The same above the level; on the horizon the straight horizon (0.2 deg
    /// lower at 11 km); below, the shift shrinks with the distance of the ground. Rises with its argument.
    [[nodiscard]] double straight_elevation_rad(double elevation_rad) const noexcept;

    /// \param elevation_rad  apparent
    /// \return linear Rec.709, cd/m2 (components may be negative outside the gamut; luminance is >= 0).
    [[nodiscard]] glm::vec3 rgb_cd_m2(double elevation_rad, double azimuth_rad, Side side) const noexcept;

    /// Of the sea in that direction, below the horizon; the dark sky's part has none. Nothing over land.
    [[nodiscard]] SlopeLight of_slopes(double elevation_rad, double azimuth_rad) const noexcept;
    /// The one source whose glitter waves break up: the Sun while its light counts, else the Moon.
    [[nodiscard]] const LitAir& glittering() const noexcept;
    /// smooth_rgb_cd_m2() of the sky that clouds cover, area mean: what drops and puddles show of it.
    [[nodiscard]] glm::vec3 covered_rgb_cd_m2(double elevation_rad, double azimuth_rad,
                                              Side side) const noexcept;
    /// The same without the Milky Way's belt: what the dome carries.
    [[nodiscard]] glm::vec3 smooth_rgb_cd_m2(double elevation_rad, double azimuth_rad,
                                             Side side) const noexcept;

    /// Part of the light of a disc or star that the veil lets through. \param straight_rad  as
    /// straight_elevation_rad() has it
    [[nodiscard]] double veil_passes(double straight_rad) const noexcept;

    /// Factors of the belt's luminance outside the air that make its light at the eye, without
    /// belt_above_horizon(). Linear Rec.709.
    [[nodiscard]] glm::vec3 belt_passes(double elevation_rad) const noexcept;

    /// Share of the belt over the horizon, where it ends over 0.6 deg; in the form that the shader has.
    [[nodiscard]] double belt_above_horizon(double elevation_rad) const noexcept;

    static constexpr double kBeltEdge = 0.01;

  private:
    [[nodiscard]] glm::vec3 clear_rgb_cd_m2(double straight_rad, double elevation_rad, double azimuth_rad,
                                            bool ground) const noexcept;
    [[nodiscard]] shaders64::VeilSum veil_sum(double straight_rad, double azimuth_rad,
                                              bool ground) const noexcept;
    [[nodiscard]] glm::vec3 veiled(const glm::vec3& clear_cd_m2, double straight_rad, double azimuth_rad,
                                   bool ground) const noexcept;
    [[nodiscard]] double end_m(double straight_rad, bool ground) const noexcept;
};

}  // namespace skyig::render
