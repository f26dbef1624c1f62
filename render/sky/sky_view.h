// Luminance of every direction from one eye height under one light source: sky above the horizon, lit ground
// and the air before it below. A small spectral march per table node, then smooth interpolation in XYZ.
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "render/sky/air_tables.h"
#include "render/sky/sky_radiance.h"

namespace skyig::render::sky {

/// Nodes of the table. Rows crowd at the geometric horizon, on both sides of it; columns are even over half a
/// circle, which the mirror symmetry about the source's azimuth makes enough.
struct SkyViewSize {
    int sky_rows = 40;
    int ground_rows = 20;
    int columns = 33;
    int steps = 48;  // of the longest rays

    friend bool operator==(const SkyViewSize&, const SkyViewSize&) = default;
};

/// Light of one direction: what the aerosol has scattered once, per unit of its phase function, and the rest.
struct SkyParts {
    glm::vec3 rest{0.0F};
    glm::vec3 haze{0.0F};
};

/// Of the orders that the tables hold: `multi` with all of them, `single` with the first. A ray that misses
/// the air is exactly black.
///
/// begin() and build_rows() spread one build over frames; a view answers look-ups once build_rows() has
/// returned true, and its answers do not depend on how the build was sliced. Double buffering is the
/// caller's. Nothing but the constructor allocates (begin() keeps a shared pointer to the tables).
class SkyView final : public SkyRadiance {
  public:
    explicit SkyView(const SkyViewSize& size = {});
    ~SkyView() override;
    SkyView(const SkyView&) = delete;
    SkyView& operator=(const SkyView&) = delete;
    SkyView(SkyView&&) noexcept;
    SkyView& operator=(SkyView&&) noexcept;

    /// \param eye_height_m  above the model's ground; below 0 counts as the ground, above the lid the march
    /// starts there \param source_elevation_rad  geometric elevation of the source at the eye, -pi/2..pi/2
    void begin(const AirTables& tables, double eye_height_m, double source_elevation_rad) noexcept;
    /// Builds at most `max_rows` more rows (sky_rows + ground_rows in all); true when the table is complete.
    bool build_rows(int max_rows) noexcept;
    void build_all() noexcept;
    [[nodiscard]] bool complete() const noexcept;

    [[nodiscard]] glm::vec3 xyz_above(float elevation_rad,
                                      float relative_azimuth_rad) const noexcept override;
    [[nodiscard]] glm::vec3 xyz_below(float elevation_rad,
                                      float relative_azimuth_rad) const noexcept override;
    /// The same in two parts, so that what stands between two views can be made of both.
    [[nodiscard]] SkyParts parts_above(float elevation_rad, float relative_azimuth_rad) const noexcept;
    [[nodiscard]] SkyParts parts_below(float elevation_rad, float relative_azimuth_rad) const noexcept;

    [[nodiscard]] double horizon_elevation_rad() const noexcept override;
    [[nodiscard]] double eye_height_m() const noexcept;
    [[nodiscard]] double source_elevation_rad() const noexcept;
    [[nodiscard]] const SkyViewSize& size() const noexcept;

    /// The table's own nodes, for meshes that want their rows where the sky bends. Row 0 lies at the horizon.
    [[nodiscard]] double sky_row_elevation_rad(int row) const noexcept;
    [[nodiscard]] double ground_row_elevation_rad(int row) const noexcept;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace skyig::render::sky
