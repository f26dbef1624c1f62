// The air between the eye and things at finite distances, for every direction and distance from one eye.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "render/shaders/shared.h"
#include "render/sky/air_data.h"
#include "render/sky/air_tables.h"
#include "render/sky/models/windlight_sky.h"
#include "render/sky/ray_light.h"
#include "render/sky_settings.h"

namespace skyig::render::sky::models {

/// What the air makes of a thing: colour * passed + added, linear Rec.709 in cd/m2, source as the Sun at 1
/// AU.
struct AirBetween {
    glm::dvec3 passed_rgb{1.0};
    glm::dvec3 added_rgb{0.0};
};

/// Directly, without a table: `windlight` by its closed form, all other models by the spectral march of the
/// orders that `tables` hold (about 15 us): `single` and `daycycle` of the first, `multi`, `cie` and
/// `preetham` of all. Any input is legal; the air before the ground goes no further than the ground.
[[nodiscard]] AirBetween air_between(const SkySettings& settings, const AirTables& tables,
                                     const RayQuery& query) noexcept;

/// Along rays (elevation by azimuth from the source, rows crowding at the horizon) two smooth numbers are
/// kept at distances that go with the square: the mean extinction up to there, and the convergence colour,
/// which is the light added over the light kept away. Both change little with distance, are finite at
/// distance 0, and give exact limits: nothing near by, the sky's own colour far away. Below the horizon the
/// ground is as glass: whatever stands there is the caller's. The ends of the table hold beyond them.
///
/// begin() and build_rows() as SkyView's. Nothing but the constructor allocates.
class AerialTable {
  public:
    static constexpr int kRows = 64;
    static constexpr int kColumns = 24;
    static constexpr int kSlices = 24;
    /// Extinction is kept at each step of the march.
    static constexpr int kStepsASlice = 4;
    static constexpr int kDepths = (kSlices - 1) * kStepsASlice + 1;
    static constexpr std::size_t kMaxLights = 2;

    using Texel = std::array<float, 4>;
    /// Per light, row by row within a slice, a column for each azimuth: what is independent of the direction
    /// of the aerosol's phase function, and what that is to be multiplied with. Linear Rec.709 in cd/m2.
    struct Colours {
        std::vector<Texel> rest;
        std::vector<Texel> haze;
    };

    AerialTable();
    ~AerialTable();
    AerialTable(const AerialTable&) = delete;
    AerialTable& operator=(const AerialTable&) = delete;
    AerialTable(AerialTable&&) noexcept;
    AerialTable& operator=(AerialTable&&) noexcept;

    /// \param settings, tables  as DaySky::begin(); \param source_elevations_rad  of up to kMaxLights lights
    /// \param eye_height_m, source_elevations_rad  as SkyView::begin()
    void begin(const SkySettings& settings, const AirTables& tables, double eye_height_m,
               std::span<const double> source_elevations_rad) noexcept;
    /// At most `max_rows` more of kRows; true when the table is complete.
    bool build_rows(int max_rows) noexcept;

    /// The look-up that shaders/sky/deferred.frag does. Angles that are not finite give no air at all.
    /// \param distance_m  >= 0, else 0; \param light  one that the table has not adds nothing
    [[nodiscard]] AirBetween between(double elevation_rad, double relative_azimuth_rad, double distance_m,
                                     std::size_t light = 0) const noexcept;

    // For the GPU.
    [[nodiscard]] const shaders64::AerialMap& map() const noexcept { return map_; }
    [[nodiscard]] double haze_g() const noexcept { return haze_g_; }
    [[nodiscard]] std::size_t light_count() const noexcept { return light_count_; }
    [[nodiscard]] double source_sine(std::size_t light) const noexcept { return lights_[light].sine; }
    /// kDepths by kRows, per metre.
    [[nodiscard]] const std::vector<Texel>& extinction() const noexcept { return extinction_; }
    /// kColumns by kRows by kSlices.
    [[nodiscard]] const Colours& colours(std::size_t light) const noexcept { return colours_[light]; }

  private:
    struct Light {
        double elevation_rad = 0.0;
        double sine = 0.0;
        double cosine = 1.0;
        WindlightSky windlight;
    };
    struct March;

    void lay_map() noexcept;
    /// Sine at the place where the ray enters the air, and that at the eye.
    [[nodiscard]] double row_sine(int row) const noexcept;
    [[nodiscard]] double eye_sine(double sine) const noexcept;
    void build_row(int row) noexcept;
    void march_row(int row, double near_m, double far_m, double view_sine) noexcept;
    void extinction_row(int row, double near_m) noexcept;
    /// Adds the light of these steps.
    void march_to(const Path& path, int first_step, int last_step,
                  const std::array<Source, kColumns>& sources) noexcept;
    void keep_slice(std::size_t light, int row, int slice, int depth) noexcept;
    void windlight_row(int row, double far_m, double view_sine) noexcept;
    void set_colour(std::size_t light, int row, int column, int slice, const glm::dvec3& rest_rgb,
                    const glm::dvec3& haze_rgb) noexcept;
    [[nodiscard]] const Texel& extinction_at(int row, int depth) const noexcept;

    std::shared_ptr<const AirData> air_;
    bool by_windlight_ = false;
    std::array<Light, kMaxLights> lights_{};
    std::size_t light_count_ = 0;
    double eye_height_m_ = 0.0;
    double haze_g_ = 0.0;
    shaders64::AerialMap map_{};
    std::vector<Texel> extinction_;
    std::array<Colours, kMaxLights> colours_;
    std::unique_ptr<March> march_;
    int rows_done_ = 0;
};

}  // namespace skyig::render::sky::models
