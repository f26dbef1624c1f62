// What the sea reflects into the eye, by direction, for one eye height and one light source: the sky in the
// waves and the source's own glitter, through the air between. The air's light before the sea, and what comes
// up out of the water, are the day sky's ground rows.
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "render/sky/air_tables.h"
#include "render/sky/sea_surface.h"

namespace skyig::render::sky {

/// begin() and build_rows() spread one build over frames, as SkyView's do; only the constructor allocates.
/// Double buffering is the caller's.
class SeaView {
  public:
    static constexpr int kRows = 24;
    static constexpr int kColumns = 17;

    SeaView();
    ~SeaView();
    SeaView(const SeaView&) = delete;
    SeaView& operator=(const SeaView&) = delete;
    SeaView(SeaView&&) noexcept;
    SeaView& operator=(SeaView&&) noexcept;

    /// \param tables  of an air over a ground that mirrors \param eye_height_m, source_elevation_rad  as
    /// SkyView::begin()
    void begin(const AirTables& tables, const SeaSurface& surface, double eye_height_m,
               double source_elevation_rad) noexcept;
    /// At most `max_rows` more rows; true when the table is complete.
    bool build_rows(int max_rows) noexcept;

    /// XYZ, Y in cd/m2, source as the Sun at 1 AU; finite, >= 0. \param elevation_rad  without refraction, at
    /// or below the horizon (clamped) \param azimuth_rad, source_azimuth_rad  clockwise from north
    [[nodiscard]] glm::vec3 xyz(double elevation_rad, double azimuth_rad,
                                double source_azimuth_rad) const noexcept;

    /// What waves that are seen one by one change of xyz(), for slopes of the water to the east and to the
    /// north, through the air before them.
    struct OfSlopes {
        // Hermite series of the reflected sky about the level, weighted by the slopes' density: XYZ a unit of
        // slope, and Y a unit of slope^2 east-east, north-north and east-north (which counts twice).
        glm::vec3 east_xyz{0.0F};
        glm::vec3 north_xyz{0.0F};
        glm::vec3 bend{0.0F};
        /// XYZ a unit of density of slopes at the one that mirrors the source.
        glm::vec3 glitter_xyz{0.0F};
        /// Of that slope, over all slopes: xyz() holds as many of `glitter_xyz`.
        float density = 0.0F;
    };
    /// As xyz(); linear between nodes.
    [[nodiscard]] OfSlopes of_slopes(double elevation_rad, double azimuth_rad,
                                     double source_azimuth_rad) const noexcept;

    [[nodiscard]] double horizon_elevation_rad() const noexcept;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Where an eye sees level water mirror a source, if it does; else at the horizon. Elevations without
/// refraction, the azimuth is the source's.
[[nodiscard]] double mirror_elevation_rad(double eye_height_m, double source_elevation_rad) noexcept;

}  // namespace skyig::render::sky
