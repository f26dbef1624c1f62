// Shadows of single clouds on the ground as it is seen: what they change of the light that the area's mean
// brings (CloudShade), so that the mean stays as it is. Of one source at a time, the Sun or at night the
// Moon, whichever brings more. Free of GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "render/cloud/map_geometry.h"
#include "render/cloud/shadow_map.h"
#include "render/deferred.h"
#include "render/sky/air_tables.h"
#include "render/sky_light.h"

namespace skyig::render {

class GroundShadow {
  public:
    /// After LightTables::light(). Allocates at the first call.
    void update(cloud::CloudMaker& maker, const cloud::CloudMoment& moment, const sky::AirTables& air,
                const SkyLight& light, bool jumped);
    void stop() noexcept;

    /// Whether shadows could be told from the mean.
    [[nodiscard]] bool shown() const noexcept { return shown_; }
    [[nodiscard]] const cloud::ShadowMap& map() const noexcept { return map_; }
    /// Of the ground under all of the beam alone, without the air between, linear Rec.709. Fades out where
    /// the source is low.
    [[nodiscard]] const glm::dvec3& sunlit_cd_m2() const noexcept { return sunlit_cd_m2_; }
    /// What a level surface gets by the whole beam over what it gets in the mean, by component.
    [[nodiscard]] const glm::dvec3& beam_over_mean() const noexcept { return beam_over_mean_; }
    [[nodiscard]] const glm::dvec3& source_enu() const noexcept { return source_enu_; }
    /// Lowest base and highest top of the clouds, over the ground: between them shadows begin.
    [[nodiscard]] const glm::dvec2& heights_m() const noexcept { return heights_m_; }
    [[nodiscard]] double eye_height_m() const noexcept { return height_m_; }
    /// What a level thing's light becomes, that is told under the mean. \param at_m  east, north, up of the
    /// eye
    [[nodiscard]] glm::dvec3 on_thing(const glm::dvec3& at_m) const noexcept;

    /// Where a ray meets the ground, as seen (refraction would move it by a hundredth).
    struct Place {
        glm::vec2 at_m{0.0F};    ///< east and north of below the eye
        glm::vec2 half_m{0.0F};  ///< of the stretch that the ray's angle stands for
        float distance_m = 0.0F;
    };
    /// False: nowhere that shadows are told of. \param direction_enu  any length \param ray_rad  its angle
    [[nodiscard]] bool meets(const glm::vec3& direction_enu, float ray_rad, Place& place) const noexcept;
    /// How far the nearest ground in a cone of directions is that shadows are told of; 0: there is none.
    [[nodiscard]] double nearest_m(const cloud::Cone& cone) const noexcept;
    /// Part of the beam that comes there over the mean, -1..1.
    [[nodiscard]] float over_mean(const Place& place) const noexcept {
        return map_.along(place.at_m, place.half_m) - map_.mean();
    }
    /// over_mean() for many rays of one angle at once, until the next update().
    [[nodiscard]] cloud::ShadowCells cells(float ray_rad) const noexcept;
    /// Of the ground under all of the beam, as it is seen from the eye; 0 where no shadow is told.
    [[nodiscard]] glm::dvec3 seen_sunlit_cd_m2(const DeferredAir& air,
                                               const glm::dvec3& direction_enu) const noexcept;
    /// What shadows and gaps add to the light of the ground there.
    [[nodiscard]] glm::dvec3 change_cd_m2(const DeferredAir& air, const glm::dvec3& direction_enu,
                                          double ray_rad) const noexcept;

    /// What a picture of a part of the ground was made from.
    struct Made {
        bool shaded = false;
        std::uint64_t revision = 0;
        glm::dvec2 origin_m{0.0};
        double height_m = 0.0;
    };
    [[nodiscard]] Made as_made() const noexcept {
        return {true, map_.revision(), map_.origin_m(), height_m_};
    }
    /// Whether it still shows what it should from that far. Slow changes are shown every few frames, not in
    /// all parts at once. \param part  its number \param still_rad  what turns by less shows no motion
    [[nodiscard]] bool serves(const Made& made, double distance_m, int part, double still_rad) const noexcept;

  private:
    cloud::ShadowMap map_;
    bool shown_ = false;
    bool of_moon_ = false;
    bool begun_ = false;  // told of a scene before
    glm::dvec3 source_enu_{0.0, 0.0, 1.0};
    glm::dvec3 sunlit_cd_m2_{0.0};
    glm::dvec3 beam_over_mean_{0.0};
    glm::dvec2 heights_m_{0.0};
    double height_m_ = 0.0;
    // Of the round ground below the eye: lengths and ratios that do not cancel.
    float excess_m_ = 0.0F;
    float excess_ = 0.0F;
    float radius_m_ = 1.0F;
    std::uint64_t frames_ = 0;
};

}  // namespace skyig::render
