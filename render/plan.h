// Which passes one frame needs, and why. Pure: no GL, no clock, no allocation; printed by `skyig plan`.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "render/scene.h"

namespace skyig::render {

enum class Pass {
    kAirTables,  ///< optical columns and multiple scattering of a new air
    kSunSky,     ///< direction table of sunlit air
    kMoonSky,    ///< direction table of moonlit air
    kDome,       ///< smooth light of all directions, toned at the vertices
    kStars,
    kSunDisc,
    kMoonDisc,
};
inline constexpr std::size_t kPassCount = 7;

[[nodiscard]] std::string_view pass_name(Pass pass) noexcept;

struct PlannedPass {
    Pass pass = Pass::kDome;
    bool needed = false;
    /// One plain sentence part: why it is drawn, or why it is dropped.
    std::string_view reason;
};

/// What the renderer already holds, so that the plan can say what is stale. A sky is valid if it was made of
/// the air that is held.
struct Held {
    bool air_valid = false;
    Air air;
    double sun_sky_elevation_rad = 0.0;
    double sun_sky_height_m = 0.0;
    bool sun_sky_valid = false;
    double moon_sky_elevation_rad = 0.0;
    double moon_sky_height_m = 0.0;
    bool moon_sky_valid = false;
    /// Luminance of the sky that stars compete with, cd/m2 (of the last frame).
    double background_cd_m2 = 0.0;
};

struct Plan {
    std::array<PlannedPass, kPassCount> passes{};
    /// Stars fainter than this (V magnitude) cannot be seen and are left out.
    double star_limit_mag = 0.0;
    /// True when the frame's light may be drawn from tables: light of the Sun, of the Moon.
    bool sun_lights_air = false;
    bool moon_lights_air = false;

    [[nodiscard]] const PlannedPass& operator[](Pass pass) const noexcept {
        return passes[static_cast<std::size_t>(pass)];
    }
    [[nodiscard]] bool needs(Pass pass) const noexcept { return (*this)[pass].needed; }
};

/// \param scene  the frame; \param held  what is in the tables. Deterministic: equal input gives an equal
/// plan.
[[nodiscard]] Plan make_plan(const Scene& scene, const Held& held) noexcept;

}  // namespace skyig::render
