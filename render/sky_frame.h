// What all channels of a frame share and what needs no GL: tables, adaptation, plan and dome.
#pragma once

#include <cstdint>

#include "render/display.h"
#include "render/dome.h"
#include "render/eye/adaptation.h"
#include "render/glare.h"
#include "render/light_tables.h"
#include "render/plan.h"
#include "render/scene.h"
#include "render/sky_light.h"

namespace skyig::render {

class SkyFrame {
  public:
    SkyFrame(const DisplaySettings& display, const Quality& quality);

    /// \param pixel_rad  angle of the finest pixel of the rig: edges are softened over it. Allocates nothing
    /// in steady state. The first call builds all tables and may throw std::bad_alloc; later ones do not
    /// throw.
    void prepare(const Scene& scene, double pixel_rad);

    // All of this is the prepared frame's.
    [[nodiscard]] const Plan& plan() const noexcept { return plan_; }
    [[nodiscard]] const SkyLight& light() const noexcept { return light_; }
    [[nodiscard]] const shaders64::ToneParameters& tone() const noexcept { return tone_; }
    [[nodiscard]] double adaptation_cd_m2() const noexcept { return adaptation_.luminance_cd_m2(); }
    [[nodiscard]] const sky::AirTables& air() const noexcept { return tables_.air(); }
    [[nodiscard]] const LightTables& tables() const noexcept { return tables_; }
    [[nodiscard]] const Glare& sun_glare() const noexcept { return sun_glare_; }
    [[nodiscard]] const Glare& moon_glare() const noexcept { return moon_glare_; }
    [[nodiscard]] Dome& dome() noexcept { return dome_; }
    [[nodiscard]] const Dome& dome() const noexcept { return dome_; }
    /// From the dome's mesh, (direction, 1), to the scene.
    [[nodiscard]] glm::dmat4 enu_from_mesh() const noexcept {
        return dome_.enu_from_mesh(mesh_azimuth_rad_, light_.horizon_elevation_rad);
    }

    /// Rise by one when the dome's triangles or its vertices have changed.
    [[nodiscard]] std::uint64_t triangles_revision() const noexcept { return triangles_revision_; }
    [[nodiscard]] std::uint64_t vertices_revision() const noexcept { return vertices_revision_; }

    /// The colour that the frame's light and tone curve give for one direction, before dither.
    [[nodiscard]] glm::dvec3 exact_colour(const glm::dvec3& direction_enu) const;

  private:
    void adapt(const Scene& scene, double pixel_rad);
    void dazzle(const Scene& scene);
    void refresh_dome(double pixel_rad);
    void tell_dome() noexcept;

    DisplaySettings display_;
    Quality quality_;
    LightTables tables_;
    eye::Adaptation adaptation_;
    Glare sun_glare_;
    Glare moon_glare_;
    DomeBend bend_;
    Dome dome_;

    Plan plan_;
    SkyLight light_;
    shaders64::ToneParameters tone_{};
    double mesh_azimuth_rad_ = 0.0;
    double dome_error_codes_ = 0.0;
    std::uint64_t triangles_revision_ = 0;
    std::uint64_t vertices_revision_ = 0;

    // What the dome's colours were made from.
    struct Shaded {
        std::uint64_t tables = 0;
        double adaptation_cd_m2 = 0.0;
        glm::vec3 sun_scale{-1.0F};
        glm::vec3 moon_scale{-1.0F};
        double moon_from_sun_rad = 0.0;
    } shaded_;
};

}  // namespace skyig::render
