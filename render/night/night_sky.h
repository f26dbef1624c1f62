// The smooth light of a dark sky as the eye sees it through the air: airglow, zodiacal light, even starlight
// and the glow of towns, in one table of directions that follows the turning sky. Free of GL.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "render/night/light_dome.h"
#include "render/scene.h"
#include "render/sky/air_tables.h"

namespace skyig::render::night {

/// How much of the dark sky is drawn, 0..1: it fades in at dusk. With a town in it it has up to 0.02 cd/m2;
/// twilight falls from 10 to 2 meanwhile.
[[nodiscard]] double night_share(double sun_elevation_rad) noexcept;

/// Extinction is AirTables::transmittance_rgb(), the stars' own: once, from outside the air to the eye. Of
/// what the air takes from a ray it gives 0.6 of the sky's mean light back (two thirds of the sphere's light,
/// less what the ground keeps); towns' light comes from within the air as it is.
///
/// Tables are built in slices beside the one in use, a fixed number of rows a frame: first those of the towns
/// whose light has changed, one town after another, then its own. New ones are due when the sky has turned by
/// 0.1 deg (half a code of the steepest zodiacal light), or eye, air or settings changed.
class NightSky {
  public:
    static constexpr int kSkyRows = 40;
    static constexpr int kGroundRows = 16;
    static constexpr int kColumns = 72;
    static constexpr int kRowsAFrame = 4;
    static constexpr int kTownRowsAFrame = 10;

    NightSky();

    /// Once a frame. What is altogether out of date is built at once if it counts: where night_share() of the
    /// scene's Sun is not 0. Allocates nothing. \return whether another table came into use
    bool update(const Scene& scene, const sky::AirTables& air) noexcept;

    /// Builds at once a table for that scene alone, whatever was there before.
    void build(const Scene& scene, const sky::AirTables& air) noexcept;

    /// Linear Rec.709, cd/m2. \param above_rad  straight elevation less that of the straight horizon, both of
    /// the frame's eye; below it the value at the edge
    [[nodiscard]] glm::vec3 sky_rgb(double above_rad, double azimuth_rad) const noexcept;

    /// Ground of that light, seen through the air before it. \param above_rad  <= 0
    [[nodiscard]] glm::vec3 before_ground(const glm::vec3& ground_rgb_cd_m2, double above_rad) const noexcept;

    /// On level ground, linear Rec.709, lux.
    [[nodiscard]] glm::vec3 ground_rgb_lux() const noexcept { return glm::vec3{front_.ground_lux}; }

    /// Of endless air: the horizon's mean all round.
    [[nodiscard]] glm::vec3 horizon_rgb() const noexcept;

    /// Part of the light from outside the air that reaches the eye, in the rows of the table in use.
    [[nodiscard]] glm::vec3 transmittance(double above_rad) const noexcept;

    /// What the air gives back to a ray of which it lets nothing pass.
    [[nodiscard]] glm::vec3 scattered_rgb() const noexcept { return glm::vec3{front_.scattered}; }

  private:
    struct GroundRow {
        glm::vec3 passes{1.0F};
        glm::vec3 added{0.0F};
    };
    /// What a table was made for.
    struct Made {
        std::shared_ptr<const sky::AirData> air;
        NightSettings settings;
        glm::dmat3 enu_from_gcrs{1.0};
        glm::dvec3 sun_gcrs{1.0, 0.0, 0.0};
        double height_m = 0.0;
        double latitude_deg = 0.0;
        double longitude_deg = 0.0;
    };
    struct TownAt {
        double azimuth_rad = 0.0;
        double distance_m = 0.0;
    };
    struct Table {
        Made made;
        std::vector<glm::vec3> sky;
        std::vector<GroundRow> ground;
        std::vector<glm::vec3> passes;  ///< of each row of the sky
        glm::dvec3 scattered{0.0};
        glm::dvec3 ground_lux{0.0};
        std::array<TownAt, kMaxCities> towns{};
        bool valid = false;
    };
    enum class Fit { kFresh, kStale, kLost };
    [[nodiscard]] static Made made_for(const Scene& scene, const sky::AirTables& air) noexcept;
    [[nodiscard]] static Fit fit(const Table& table, const Made& wanted) noexcept;
    void begin(const Made& wanted, const sky::AirTables& air) noexcept;
    void aim_at_towns(Table& table, const sky::AirTables& air) noexcept;
    void light_evenly(Table& table, const sky::AirTables& air) noexcept;
    void build_slice(const sky::AirTables& air) noexcept;
    void build_all(const sky::AirTables& air) noexcept;
    [[nodiscard]] bool complete() const noexcept { return next_row_ == kSkyRows + kGroundRows; }
    void take_over() noexcept;
    void build_row(int row, const sky::AirTables& air) noexcept;
    void build_sky_row(int row, const sky::AirTables& air) noexcept;
    void build_ground_row(int row, const sky::AirTables& air) noexcept;

    Table front_;
    Table back_;
    bool building_ = false;
    int next_row_ = 0;
    std::vector<LightDome> domes_;
};

}  // namespace skyig::render::night
