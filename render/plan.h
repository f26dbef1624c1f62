// Which passes one frame needs, how fine, and why. Pure: no GL, no clock, no allocation.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <span>
#include <string_view>

#include "render/channel.h"
#include "render/quality.h"
#include "render/scene.h"
#include "render/sky/refraction.h"
#include "render/sky/sea_waves.h"
#include "render/sky/sky_view.h"

namespace skyig::render {

class DomeBend;
struct DomeSize;
namespace cloud {
class ShadowMap;
}

/// When a pass costs.
enum class Cost { kNewAir, kNewTable, kFrame, kChannel };
[[nodiscard]] std::string_view cost_name(Cost cost) noexcept;

/// Rows and columns of what a pass computes; 0 where it has none.
struct Resolution {
    int rows = 0;
    int columns = 0;
};

struct PlannedPass {
    Pass pass = Pass::kDome;
    bool needed = false;
    /// One plain sentence part: why it is drawn, or why it is dropped.
    std::string_view reason;
    Resolution resolution;
    /// Largest error by its resolution, display codes; for the dome as measured when it was laid out.
    double error_codes = 0.0;
    Cost cost = Cost::kChannel;
};

/// What the renderer already holds, so that the plan can say what is stale. A sky is valid if it was made of
/// the air that is held; elevation and height are those it was asked for.
struct Held {
    bool air_valid = false;
    bool air_fresh = false;
    bool sun_sky_valid = false;
    bool sun_sky_model = true;  ///< made by the scene's model with its parameters, over its sea
    double sun_sky_elevation_rad = 0.0;
    double sun_sky_height_m = 0.0;
    bool moon_sky_valid = false;
    bool moon_sky_model = true;
    double moon_sky_elevation_rad = 0.0;
    double moon_sky_height_m = 0.0;
};

/// The eye begins to see a point of light at this part of eye::threshold_lux().
inline constexpr double kFaintestSeen = 0.94;

/// What of the stars and planets is drawn.
struct StarPlan {
    /// V magnitude outside the air; fainter ones are left out.
    double limit_mag = 0.0;
    /// Each only as the eye sees it before the sky behind it. \see seen_share()
    bool seen_only = true;
    /// They flicker: those that are brighter than this outside the air, on others it would not show.
    bool twinkle = false;
    double twinkle_limit_mag = 0.0;
};

struct Plan {
    std::array<PlannedPass, kPassCount> passes{};
    /// Which model makes the sky of Sun and Moon.
    SkyModel sky_model = SkyModel::kMulti;
    /// How much of the light that Sun and Moon scatter in the air is drawn, 0..1: it fades out where it no
    /// longer counts.
    double sun_share = 0.0;
    double moon_share = 0.0;
    /// How much of the dark sky is drawn, 0..1.
    double night_share = 0.0;
    /// How much of the corona is drawn, 0..1: the last of the Sun's disc dazzles.
    double corona_share = 0.0;
    StarPlan stars;
    /// Nodes of the direction tables.
    sky::SkyViewSize table;
    std::bitset<kPassCount> forced;
    Thinned thinned;

    [[nodiscard]] const PlannedPass& operator[](Pass pass) const noexcept {
        return passes[static_cast<std::size_t>(pass)];
    }
    [[nodiscard]] bool needs(Pass pass) const noexcept { return (*this)[pass].needed; }
    [[nodiscard]] bool thins(Thin thin) const noexcept { return thinned[static_cast<std::size_t>(thin)]; }
};

/// What of Thin would make the next frame cheaper, this one being as it is; what it leaves out already does
/// not count.
[[nodiscard]] Thinned thinnable(const Plan& plan) noexcept;

/// Part of the streaks that are drawn when they are thinned.
inline constexpr double kThinnedPrecipitation = 0.5;

/// Nodes of the direction tables for a budget. \see direction_table_error_codes()
[[nodiscard]] sky::SkyViewSize direction_table_size(const Quality& quality) noexcept;

/// Largest error of the sky, against a table three times as fine each way, over the scenes of
/// light_tables_test; of the sizes that direction_table_size() knows.
[[nodiscard]] double direction_table_error_codes(const sky::SkyViewSize& size) noexcept;

/// \param scene  the frame; \param held  what is in the tables; \param refraction  of the frame's eye and
/// air. Deterministic: equal input gives an equal plan. Veil, dome, waves, stars, the Milky Way and glare are
/// left for plan_veil(), plan_dome(), plan_waves(), plan_stars(), plan_milky_way() and plan_glare(), which
/// need the light that this plan leads to.
[[nodiscard]] Plan make_plan(const Scene& scene, const Held& held, const sky::RefractionRow& refraction,
                             const Quality& quality = {}) noexcept;

/// Decides how fine the dome is laid out: the smallest size that keeps to the budget, but no smaller than
/// `held` while that is not clearly too fine. \param held  the dome in use
[[nodiscard]] DomeSize plan_dome(const DomeBend& bend, const DomeSize& held, const Quality& quality) noexcept;

/// Decides on what channels' screens need; make_plan() leaves it at a rig of flat screens without masks.
void plan_screens(Plan& plan, std::span<const Channel> channels) noexcept;

/// Decides on the veil of obscurants. \param segments  of fog::Veil
void plan_veil(Plan& plan, const Scene& scene, std::size_t segments) noexcept;

/// Decides on the cloud maps. \param map_size  texels on the side of a half; \param near_size  likewise
/// \param near_shown  whether clouds may stand round the eye
void plan_clouds(Plan& plan, const Scene& scene, int map_size, int near_size, bool near_shown) noexcept;

/// Decides on the clouds' shadows, after plan_clouds(). \param told  whether they differ from the mean
void plan_cloud_shadows(Plan& plan, const cloud::ShadowMap& map, bool told) noexcept;

/// Decides on the waves of the sea, drawn over `resolution` of the dome's quads. \param waves  that a pixel
/// resolves below the eye \param lit  whether Sun or Moon light the air over a sea
void plan_waves(Plan& plan, const Scene& scene, const sky::SeaWaves& waves, bool lit) noexcept;

/// The sky that points of light stand before, cd/m2.
struct PointBackgrounds {
    double darkest_cd_m2 = 0.0;
    std::array<double, kPlanetCount> planets_cd_m2{};

    [[nodiscard]] static PointBackgrounds even(double luminance_cd_m2) noexcept;
};

/// Decides on the stars and planets. \param half_code_mag  fainter ones change no picture
void plan_stars(Plan& plan, const Scene& scene, const PointBackgrounds& background,
                double half_code_mag) noexcept;

/// Decides on the Milky Way. \param most_codes  what its brightest part would add to the darkest sky, display
/// codes
void plan_milky_way(Plan& plan, const Scene& scene, double most_codes) noexcept;

/// Decides on the glare of Sun or Moon. \param reach_rad  Glare::reach_rad(). A pass without a reach has
/// nothing to draw even where it is forced.
void plan_glare(Plan& plan, Pass pass, bool enabled, double reach_rad) noexcept;

/// Stars where light is drawn without an eye: every star and planet that is switched on.
void plan_all_stars(Plan& plan, const Scene& scene) noexcept;

/// Faintest star that a practised eye sees before a background, V magnitude at the eye.
/// \see eye::threshold_lux()
[[nodiscard]] double faintest_visible_mag(double background_cd_m2) noexcept;

}  // namespace skyig::render
