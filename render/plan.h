// Which passes one frame needs, and why. Pure: no GL, no clock, no allocation.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "render/scene.h"
#include "render/sky/refraction.h"

namespace skyig::render {

enum class Pass {
    kAirTables,  ///< optical columns and multiple scattering of a new air
    kSunSky,     ///< direction table of sunlit air
    kMoonSky,    ///< direction table of moonlit air
    kDome,       ///< smooth light of all directions, toned at the vertices
    kStars,
    kCorona,  ///< what is left of the Sun in a total eclipse
    kSunDisc,
    kMoonDisc,
};
inline constexpr std::size_t kPassCount = 8;

[[nodiscard]] std::string_view pass_name(Pass pass) noexcept;

struct PlannedPass {
    Pass pass = Pass::kDome;
    bool needed = false;
    /// One plain sentence part: why it is drawn, or why it is dropped.
    std::string_view reason;
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

struct Plan {
    std::array<PlannedPass, kPassCount> passes{};
    /// Which model makes the sky of Sun and Moon.
    SkyModel sky_model = SkyModel::kMulti;
    /// How much of the light that Sun and Moon scatter in the air is drawn, 0..1: it fades out where it no
    /// longer counts.
    double sun_share = 0.0;
    double moon_share = 0.0;
    /// How much of the corona is drawn, 0..1: the last of the Sun's disc dazzles.
    double corona_share = 0.0;
    /// Stars of this V magnitude are gone, those 0.8 mag brighter are drawn in full.
    double star_limit_mag = 0.0;

    [[nodiscard]] const PlannedPass& operator[](Pass pass) const noexcept {
        return passes[static_cast<std::size_t>(pass)];
    }
    [[nodiscard]] bool needs(Pass pass) const noexcept { return (*this)[pass].needed; }
};

/// \param scene  the frame; \param held  what is in the tables; \param refraction  of the frame's eye and
/// air. Deterministic: equal input gives an equal plan. Stars are left for plan_stars(), which needs the
/// light that this plan leads to.
[[nodiscard]] Plan make_plan(const Scene& scene, const Held& held,
                             const sky::RefractionRow& refraction) noexcept;

/// Decides on the stars and planets. \param background_cd_m2  the darkest sky that they stand before
void plan_stars(Plan& plan, const Scene& scene, double background_cd_m2) noexcept;

/// Faintest star that a practised eye sees before a background, V magnitude (Schaefer 1990, after Knoll et
/// al. 1946).
[[nodiscard]] double faintest_visible_mag(double background_cd_m2) noexcept;

}  // namespace skyig::render
