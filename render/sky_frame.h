// What all channels of a frame share and what needs no GL: tables, adaptation, plan and dome.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "render/cloud/lightning.h"
#include "render/cloud_frame.h"
#include "render/clouds.h"
#include "render/display.h"
#include "render/dome.h"
#include "render/eye/adaptation.h"
#include "render/glare.h"
#include "render/ground_shadow.h"
#include "render/light_tables.h"
#include "render/milky_way.h"
#include "render/plan.h"
#include "render/scene.h"
#include "render/sea_mesh.h"
#include "render/sky_light.h"
#include "render/sky_veil.h"
#include "render/target.h"

namespace skyig::render {

/// As sky/sea.frag takes it.
struct SeaShading {
    double height_m = 1.0;
    double curvature_m2 = 0.0;
    double pixel_rad = 1e-3;
    glm::dvec3 source_enu{0.0, 0.0, 1.0};
    glm::dvec3 variance{1e-3, 1e-3, 0.0};
};

/// Parts of the probed directions, 0..1.
struct ClippedLight {
    double below_black = 0.0;  ///< shown as code 0
    double above_white = 0.0;  ///< asks for more than full white, before the shoulder
};

class SkyFrame {
  public:
    /// \param screens  different ones that the light is toned for; none: that of `display`
    /// \param target  a target of luminance has the finest dome and all stars; the displays still decide
    /// where the dome's nodes lie
    SkyFrame(const DisplaySettings& display, const Quality& quality, std::span<const Screen> screens = {},
             Target target = Target::kDisplay);

    /// From the next frame on.
    void draw_clouds(Clouds clouds) noexcept { made_clouds_ = std::move(clouds); }

    /// What frames leave out from the next one on.
    void thin(Thinned thinned) noexcept { quality_.thinned = thinned; }

    /// \param pixel_rad  angle of the finest pixel of the rig: edges are softened over it \param
    /// smallest_pixel_sr  of the rig, where stars show best. Allocates nothing in steady state. The first
    /// call builds all tables and may throw std::bad_alloc; later ones do not throw.
    void prepare(const Scene& scene, double pixel_rad, double smallest_pixel_sr);
    /// For square pixels of one size.
    void prepare(const Scene& scene, double pixel_rad) { prepare(scene, pixel_rad, pixel_rad * pixel_rad); }

    // All of this is the prepared frame's.
    [[nodiscard]] const Plan& plan() const noexcept { return plan_; }
    [[nodiscard]] const SkyLight& light() const noexcept { return light_; }
    /// Lightning that shines, for whoever draws the clouds.
    [[nodiscard]] const cloud::Flashes& flashes() const noexcept { return flashes_; }
    /// What turns light into the target's values.
    [[nodiscard]] const shaders64::ToneParameters& tone(std::size_t screen = 0) const noexcept {
        return tones_[screen];
    }
    /// k of what a target of luminance holds, light times 2^k. \see eye::exposure_exponent()
    [[nodiscard]] int exposure_exponent() const noexcept { return exposure_exponent_; }
    [[nodiscard]] double adaptation_cd_m2() const noexcept { return adaptation_.luminance_cd_m2(); }
    [[nodiscard]] const eye::Adaptation& adaptation() const noexcept { return adaptation_; }
    /// \see Renderer::adapt_as()
    void adapt_as(const eye::Adaptation& eyes) noexcept { adaptation_ = eyes; }
    [[nodiscard]] const sky::AirTables& air() const noexcept { return tables_.air(); }
    [[nodiscard]] const LightTables& tables() const noexcept { return tables_; }
    [[nodiscard]] const DisplaySettings& display(std::size_t screen = 0) const noexcept {
        return displays_[screen];
    }
    [[nodiscard]] const Glare& sun_glare(std::size_t screen = 0) const noexcept {
        return sun_glares_[screen];
    }
    [[nodiscard]] const Glare& moon_glare(std::size_t screen = 0) const noexcept {
        return moon_glares_[screen];
    }
    [[nodiscard]] const CloudFrame& clouds() const noexcept { return clouds_; }
    [[nodiscard]] const GroundShadow& ground_shadow() const noexcept { return ground_shadow_; }
    /// What is seen of light that stands behind the clouds, in a direction that a view sees. The same without
    /// clouds.
    [[nodiscard]] glm::dvec3 through_clouds(const glm::dvec3& behind_cd_m2,
                                            const glm::dvec3& direction_enu) const noexcept;
    /// The air between the eye and things: kept from the first call on, or from the first clouds.
    const DeferredAir& air_between(const Scene& scene);
    /// As air_between() left it, if it was called.
    [[nodiscard]] const DeferredAir* air_between() const noexcept {
        return air_between_ ? &*air_between_ : nullptr;
    }
    /// From this frame on things stand among the clouds.
    void serve_things() noexcept;
    [[nodiscard]] Dome& dome() noexcept { return dome_; }
    [[nodiscard]] const Dome& dome() const noexcept { return dome_; }
    [[nodiscard]] MilkyWay& milky_way() noexcept { return milky_way_; }
    /// From the dome's mesh, (direction, 1), to the scene.
    [[nodiscard]] glm::dmat4 enu_from_mesh() const noexcept {
        return dome_.enu_from_mesh(mesh_azimuth_rad_, light_.horizon_elevation_rad);
    }

    /// Waves of this frame, and where they are drawn: rows of the dome's quads from the nadir, 0 if nowhere.
    [[nodiscard]] const sky::SeaWaves& waves() const noexcept { return waves_; }
    [[nodiscard]] const SeaMesh& sea() const noexcept { return sea_; }
    [[nodiscard]] int sea_rows() const noexcept { return sea_rows_; }
    /// What all waves' shading shares.
    [[nodiscard]] const SeaShading& sea_shading() const noexcept { return sea_shading_; }
    [[nodiscard]] std::uint64_t sea_revision() const noexcept { return sea_revision_; }

    /// Rise by one when the dome's triangles or its vertices have changed.
    [[nodiscard]] std::uint64_t triangles_revision() const noexcept { return triangles_revision_; }
    [[nodiscard]] std::uint64_t vertices_revision() const noexcept { return vertices_revision_; }

    /// What a screen cannot show of the directions that the eye adapts to.
    [[nodiscard]] const ClippedLight& clipped(std::size_t screen = 0) const noexcept {
        return clipped_[screen];
    }

    /// The colour that the frame's light and tone curve give for one direction, before dither.
    [[nodiscard]] glm::dvec3 exact_colour(const glm::dvec3& direction_enu, std::size_t screen = 0) const;
    /// The same of what the dome carries: without the Milky Way's belt.
    [[nodiscard]] glm::dvec3 exact_dome_colour(const glm::dvec3& direction_enu, std::size_t screen = 0) const;

  private:
    void take_weather(const Scene& scene) noexcept;
    void refresh_milky_way(const Scene& scene);
    void refresh_clouds(const Scene& scene, double pixel_rad);
    void tone_clouds() noexcept;
    void adapt(const Scene& scene);
    void tone_screens(const Scene& scene, double smallest_pixel_sr);
    [[nodiscard]] double luminance_cd_m2(double elevation_rad, double azimuth_rad) const;
    [[nodiscard]] double clouded_luminance_cd_m2(double elevation_rad, double azimuth_rad) const;
    /// What the veils of a source were laid for.
    struct VeilMade {
        GlareSource source;
        std::uint64_t tables = 0;
        double adaptation_cd_m2 = 0.0;
        std::uint64_t fog = 0;
    };
    void dazzle(const Scene& scene);
    void veil(const GlareSource& source, std::vector<Glare>& glares, VeilMade& made);
    void refresh_dome(double pixel_rad);
    void refresh_sea(const Scene& scene, double pixel_rad);
    void tell_dome() noexcept;
    [[nodiscard]] glm::dvec3 waves_colour(const glm::dvec3& direction_enu, const glm::dvec3& mean_cd_m2,
                                          std::size_t screen) const;

    std::vector<DisplaySettings> displays_;  // the same eye before each screen
    Quality quality_;
    Target target_;
    LightTables tables_;
    SkyVeil veil_;
    eye::Adaptation adaptation_;
    std::vector<Glare> sun_glares_;  // one a screen
    std::vector<Glare> moon_glares_;
    VeilMade sun_veiled_;
    VeilMade moon_veiled_;
    DomeBend bend_;
    Dome dome_;
    SeaMesh sea_;
    Clouds made_clouds_;
    cloud::CloudLight cloud_light_;
    std::optional<DeferredAir> air_between_;
    bool air_between_fresh_ = false;
    GroundShadow ground_shadow_;
    CloudFrame clouds_;
    MilkyWay milky_way_;
    bool milky_way_shown_ = false;
    double milky_way_codes_ = 0.0;

    Plan plan_;
    SkyLight light_;
    cloud::Flashes flashes_;
    std::array<double, eye::kProbeCount> probes_cd_m2_{};
    std::vector<shaders64::ToneParameters> display_tones_;
    std::vector<shaders64::ToneParameters> tones_;  // of the target
    int exposure_exponent_ = 0;
    std::vector<ClippedLight> clipped_;
    double mesh_azimuth_rad_ = 0.0;
    double dome_error_codes_ = 0.0;
    std::uint64_t triangles_revision_ = 0;
    std::uint64_t vertices_revision_ = 0;
    sky::SeaWaves waves_;
    SeaShading sea_shading_;
    int sea_rows_ = 0;
    std::uint64_t sea_revision_ = 0;
    /// Of the dome when the sea was laid out and when it was coloured.
    std::uint64_t sea_light_seen_ = 0;
    std::uint64_t sea_colours_seen_ = 0;
    std::uint64_t light_revision_ = 0;

    // What the dome's colours were made from.
    struct Shaded {
        std::uint64_t tables = 0;
        double adaptation_cd_m2 = 0.0;
        int exposure_exponent = 0;
        glm::vec3 sun_scale{-1.0F};
        glm::vec3 moon_scale{-1.0F};
        double moon_from_sun_rad = 0.0;
        float night_share = 0.0F;
        std::uint64_t veil = 0;
        float flash_cd_m2 = 0.0F;
        double film = 0.0;
    } shaded_;
};

}  // namespace skyig::render
