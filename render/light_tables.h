// Owns the direction tables of sunlit and moonlit air and keeps them fresh: a new table is built in slices, a
// fixed number of rows a frame, beside the one in use; new air is computed on a thread of its own and taken
// over a fixed number of frames later. What a frame sees depends on the frames before it alone, never on
// measured time; should the machine need longer for new air than those frames last, that one frame waits.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "render/air_builder.h"
#include "render/cloud_shade.h"
#include "render/night/night_sky.h"
#include "render/plan.h"
#include "render/scene.h"
#include "render/sky/air_tables.h"
#include "render/sky/models/day_sky.h"
#include "render/sky/refraction.h"
#include "render/sky/sea_surface.h"
#include "render/sky/sea_view.h"
#include "render/sky_light.h"

namespace skyig::render {

/// Factors on X, Y, Z of sunlit air that make it moonlit. \param share  of the light that is drawn
[[nodiscard]] glm::vec3 moon_scale_xyz(const Scene& scene, const sky::AirModel& model, double share) noexcept;

class LightTables {
  public:
    /// Frames from the first sight of new air to its use, and rows of a direction table built in one frame.
    static constexpr std::uint64_t kAirLatencyFrames = 30;
    static constexpr int kRowsAFrame = 10;
    static constexpr int kSeaRowsAFrame = 4;
    /// Air that changes in every frame is asked for once in so many.
    static constexpr std::uint64_t kAirIntervalFrames = 120;

    /// \param size  of the direction tables
    explicit LightTables(const sky::SkyViewSize& size = {});
    LightTables(const LightTables&) = delete;
    LightTables& operator=(const LightTables&) = delete;

    /// What the tables are fit for, seen from this scene.
    [[nodiscard]] Held held(const Scene& scene) const noexcept;

    /// How the scene's air bends light on its way to the eye; not at all when the host has switched the air
    /// off.
    [[nodiscard]] sky::RefractionRow refraction(const Scene& scene) const noexcept;

    /// Follows the plan. The first call, and one that finds a source that matters or the eye somewhere else
    /// altogether, builds whole tables at once.
    void update(const Scene& scene, const Plan& plan);

    /// The frame's light, from the tables in use.
    [[nodiscard]] SkyLight light(const Scene& scene, const Plan& plan,
                                 const sky::RefractionRow& refraction) const noexcept;

    /// Rises by one whenever a table in use is replaced.
    [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }

    /// Whether Sun, Moon or eye have jumped since the last update(), needed or not: another scene altogether.
    [[nodiscard]] bool jumped() const noexcept { return jumped_; }

    /// Rises with every new air, once a table made of it is in use.
    [[nodiscard]] std::uint64_t air_in_use() const noexcept {
        return std::max(sun_.front_made.air, moon_.front_made.air);
    }

    /// Precondition: update() was called.
    [[nodiscard]] const sky::AirTables& air() const noexcept { return *air_; }

    /// Model and parameters that the air in use can serve: the scene's, or those before it until then.
    [[nodiscard]] const SkySettings& sky() const noexcept { return sky_; }

  private:
    /// What a table was asked to be made for.
    struct Made {
        std::uint64_t air = 0;  ///< revision of the air, 0: never made
        SkySettings sky;
        std::optional<sky::SlopeVariance> sea;  ///< none over land
        double elevation_rad = 0.0;
        double height_m = 0.0;
    };
    struct View {
        explicit View(const sky::SkyViewSize& size) : front(size), back(size) {}

        sky::models::DaySky front;
        sky::models::DaySky back;
        sky::SeaView front_sea;
        sky::SeaView back_sea;
        Made front_made;
        Made back_made;
        bool building = false;
    };
    /// How fast something moves, a frame: the smaller of its last two steps, 0 where they disagree.
    class Trend {
      public:
        void follow(double now) noexcept;
        /// What it will have gained when a table begun now is half used up. \param step  by which it is then
        /// off
        [[nodiscard]] double ahead(double step) const noexcept;

      private:
        bool started_ = false;
        double last_ = 0.0;
        double step_ = 0.0;
        double a_frame_ = 0.0;
    };
    /// What a view is to be made for.
    struct Wanted {
        bool needed = false;
        bool matters = false;
        bool by_sun = true;
        double elevation_rad = 0.0;
        double elevation_ahead_rad = 0.0;
        double height_m = 0.0;
        double height_ahead_m = 0.0;
    };
    [[nodiscard]] bool has_jumped(const Scene& scene) const noexcept;
    void update_air(const Scene& scene, const Plan& plan);
    void update_sea(const Scene& scene) noexcept;
    [[nodiscard]] bool same_sea(const Made& made, const Scene& scene) const noexcept;
    void update_view(View& view, const Wanted& wanted);
    /// Light of the sky on level ground at the eye, without clouds and with.
    struct Overhead {
        double clear_lux = 0.0;
        double covered_lux = 0.0;
    };
    void shade(const Scene& scene, const CloudShade& clouds, SkyLight& light, LitAir& lit,
               Overhead& overhead) const noexcept;
    [[nodiscard]] SkySettings fitting(const SkySettings& asked) const noexcept;

    sky::Refraction refraction_;
    std::optional<sky::AirTables> air_;
    std::optional<sky::SeaSurface> sea_;  // none as long as the air lies over land
    SkySettings sky_;  // the scene's, or those before it until the air for its model is there
    std::uint64_t air_revision_ = 0;
    AirBuilder builder_;
    std::optional<std::uint64_t> next_air_age_;     // frames since the request, if there is one
    std::uint64_t air_rests_ = kAirIntervalFrames;  // frames since air was last asked for
    std::optional<sky::AirModel> last_wanted_;      // while it is not the one in use
    Trend sun_trend_;
    Trend moon_trend_;
    Trend height_trend_;

    View sun_;
    View moon_;
    night::NightSky night_;
    std::uint64_t revision_ = 0;
    bool jumped_ = false;
    /// Of the frame before.
    struct Place {
        glm::dvec3 sun_enu{0.0};
        glm::dvec3 moon_enu{0.0};
        double height_m = 0.0;
    };
    std::optional<Place> last_;
};

}  // namespace skyig::render
