// Another renderer's picture of one channel, to be put under our air.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <memory>

#include "render/channel.h"
#include "render/display.h"
#include "render/fog/veil.h"
#include "render/light_tables.h"
#include "render/scene.h"
#include "render/shaders/shared.h"
#include "render/sky/models/aerial_table.h"
#include "render/sky_light.h"

namespace skyig::render {

/// GL names of two textures of the renderer's context, each of the channel's size, bottom row first, drawn
/// from the channel's eye through its frustum. Where depth is 1 or more (or not a number) nothing was drawn:
/// the sky stays. Depths below 0 count as 0, colours below 0 or not a number as black.
struct DeferredInput {
    /// Linear Rec.709 in cd/m2, three or four components of any float format; alpha is not used.
    unsigned colour_texture = 0;
    /// Distance along the view axis over `far_m`, one float component.
    unsigned depth_texture = 0;
    /// Of the far plane, metres, > 0.
    double far_m = 100e3;
    /// The clouds' shadows fall on what is drawn. It is then told in the area's mean light under clouds, and
    /// gets what a level surface gets there; false: it has its own shadows.
    bool shadows = true;
    /// What keeps rain and snow off: the other renderer's depths through Renderer::exposure_view(), 0 at the
    /// near plane and 1 at the far one and where nothing stands, one float component, ExposureView::kSize_px
    /// a side, its bottom row first. 0: everything lies open.
    unsigned exposure_texture = 0;
};

/// The air between the eye and things for a frame's Sun and Moon, kept fresh in slices like LightTables. Free
/// of GL.
class DeferredAir {
  public:
    static constexpr int kRowsAFrame = 8;
    enum class Body { kSun, kMoon };

    /// After LightTables::update(). The first call, and one that finds the clock, the eye or a light
    /// somewhere else altogether, builds the whole table at once.
    void update(const Scene& scene, const Plan& plan, const LightTables& tables, const SkyLight& light);

    /// One light of the frame: where it stands, what its table's light becomes.
    struct Source {
        glm::dvec3 direction_enu{0.0, 0.0, 1.0};
        glm::dmat3 rgb{1.0};
    };
    [[nodiscard]] const sky::models::AerialTable& table() const noexcept { return front_; }
    [[nodiscard]] std::size_t source_count() const noexcept { return source_count_; }
    [[nodiscard]] const Source& source(std::size_t i) const noexcept { return sources_[i]; }
    /// Of endless air, what is alike on all sides: the dark sky's, and clouds' where they cover. Linear
    /// Rec.709.
    [[nodiscard]] const glm::dvec3& even_cd_m2() const noexcept { return even_cd_m2_; }
    /// Fog and the like of the frame, null where there is none, and the light from past it: sky, ground.
    [[nodiscard]] const fog::Veil* veil() const noexcept { return veil_; }
    [[nodiscard]] const glm::dvec3& beyond_veil_cd_m2(bool ground) const noexcept {
        return beyond_veil_cd_m2_[ground ? 1 : 0];
    }
    [[nodiscard]] const shaders64::VeilAir& air_before_veil() const noexcept { return front_air_; }
    /// Rises whenever the table in use is replaced.
    [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }

    /// What the air, and fog in it, do to smooth light on its way from there, to the sum of all lights.
    /// \param direction_enu  unit vector
    [[nodiscard]] sky::models::AirBetween between(const glm::dvec3& direction_enu,
                                                  double distance_m) const noexcept;
    /// What the shader makes of a thing, in double. \param direction_enu  unit vector
    [[nodiscard]] glm::dvec3 under_air(const glm::dvec3& rgb_cd_m2, const glm::dvec3& direction_enu,
                                       double distance_m) const noexcept;

  private:
    struct Light {
        Body body = Body::kSun;
        double elevation_rad = 0.0;
    };
    /// What a table was made for.
    struct Made {
        std::shared_ptr<const sky::AirData> air;
        SkySettings sky;
        double height_m = 0.0;
        std::array<Light, sky::models::AerialTable::kMaxLights> lights{};
        std::size_t count = 0;
    };
    [[nodiscard]] static bool same_bodies(const Made& a, const Made& b) noexcept;
    [[nodiscard]] static double largest_step_rad(const Made& a, const Made& b) noexcept;
    void begin(const Made& wanted, const LightTables& tables);
    [[nodiscard]] sky::models::AirBetween clear_between(const glm::dvec3& direction_enu,
                                                        double distance_m) const noexcept;
    [[nodiscard]] fog::Veil::Both veil_along(const glm::dvec3& ray_enu, double distance_m) const noexcept;
    [[nodiscard]] glm::dvec3 veil_in_air(const shaders64::VeilSum& sum, const glm::dvec3& ray_enu,
                                         const glm::dvec3& endless_cd_m2,
                                         const glm::dvec3& behind_cd_m2) const noexcept;
    [[nodiscard]] glm::dvec3 endless_cd_m2(const Horizontal& view) const noexcept;
    void tell_veil(const SkyLight& light) noexcept;
    void tell_sources(const Scene& scene, const Plan& plan, const SkyLight& light) noexcept;

    sky::models::AerialTable front_;
    sky::models::AerialTable back_;
    Made front_made_;
    Made back_made_;
    bool building_ = false;
    std::array<Source, sky::models::AerialTable::kMaxLights> sources_{};
    std::size_t source_count_ = 0;
    glm::dvec3 even_cd_m2_{0.0};
    const fog::Veil* veil_ = nullptr;
    shaders64::VeilAir front_air_{};
    std::array<glm::dvec3, 2> beyond_veil_cd_m2_{};
    std::uint64_t revision_ = 0;
};

}  // namespace skyig::render
