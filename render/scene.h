// All that the renderer knows of the world in one frame: immutable, complete, independent of dates and hosts.
// Directions are unit vectors in the scene frame: east-north-up at the eye (WGS84 vertical), airless (without
// refraction), topocentric.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "render/channel.h"
#include "render/night_settings.h"
#include "render/overlay/overlay.h"
#include "render/sky_settings.h"
#include "render/weather.h"

namespace skyig::render {

inline constexpr std::size_t kMaxChannels = 16;

struct Sun {
    bool enabled = true;
    glm::dvec3 direction_enu{0.0, 0.0, 1.0};
    double distance_au = 1.0;
    double angular_radius_rad = 0.004652;
    /// Part of the disc's light that the Moon leaves over, 0..1.
    double unobscured = 1.0;
};

struct Moon {
    bool enabled = true;
    glm::dvec3 direction_enu{0.0, 0.0, -1.0};
    double distance_km = 384400.0;
    double angular_radius_rad = 0.00452;
    /// Unit vector from the Moon's centre to the Sun: lights the disc, gives phase and bright limb.
    glm::dvec3 to_sun_enu{0.0, 0.0, 1.0};
    /// Angle Sun-Moon-eye: 0 full, pi new.
    double phase_angle_rad = 0.0;
    /// East-north-up from selenographic axes (x to the mean Earth point, z to the lunar north pole).
    glm::dmat3 enu_from_selenographic{1.0};
    /// The Earth's shadow at the Moon, in units of the Moon's radius: from the Moon's centre to the shadow's
    /// axis, and how far from the axis umbra and penumbra end.
    glm::dvec3 shadow_axis_enu{1e3, 0.0, 0.0};
    double umbra_radius = 2.6;
    double penumbra_radius = 4.7;
    /// Part of its sunlight that the Earth's shadow leaves to the whole disc, 0..1.
    double sunlit = 1.0;
};

/// A planet is a star that wanders.
struct Planet {
    glm::dvec3 direction_enu{0.0, 0.0, -1.0};
    /// Outside the air.
    double magnitude = 0.0;
    /// Johnson B-V.
    double bv = 0.8;
};

inline constexpr std::size_t kPlanetCount = 5;

struct Stars {
    bool enabled = true;
    /// Fraction of the full star field intensity, 0..1.
    double intensity = 1.0;
    /// One rotation for all stars: precession, nutation, Earth rotation, site.
    glm::dmat3 enu_from_gcrs{1.0};
    /// Barycentric velocity of the Earth in units of c, GCRS axes (annual aberration).
    glm::dvec3 earth_velocity_c{0.0};
    /// Julian years of TT since J2000.0 (proper motion).
    double years_since_j2000 = 0.0;
};

/// The base state of the air.
struct Air {
    /// False: the host has switched the atmospheric model off; the air is then clean (molecules only).
    bool model_enabled = true;
    /// Meteorological optical range at the ground, metres: extinction = -ln(visibility_contrast) /
    /// visibility_m.
    double visibility_m = 80000.0;
    double visibility_contrast = 0.05;
    double temperature_c = 15.0;
    double pressure_hpa = 1013.25;
    double humidity_pct = 50.0;

    friend bool operator==(const Air&, const Air&) = default;
};

/// What lies below the air: land as far as the eye reaches, or sea.
struct Ground {
    enum class Kind : std::uint8_t { kLand, kSea };
    Kind kind = Kind::kLand;
    /// Of bare land in daylight, 0..1; not given: grass and soil.
    std::optional<double> albedo;
    /// Part of the land that lies under snow, 0..1.
    double snow = 0.0;
    /// How wet the rest of the land is by rain, 0..1: darker, and with a film of water that mirrors the sky.
    double wet = 0.0;
    /// Roughens the sea; at about 10 m, where it blows from clockwise from true north.
    double wind_m_s = 0.0;
    double wind_from_rad = 0.0;

    friend bool operator==(const Ground&, const Ground&) = default;
};

/// One train of waves, as long as it is not broken: crests in parallel lines.
struct Wave {
    /// From trough to crest.
    double height_m = 0.0;
    double length_m = 1.0;
    double period_s = 1.0;
    /// Where it runs to, clockwise from true north.
    double direction_rad = 0.0;
    /// Added to the phase, which is 0 at a crest at scene time 0 where the equator meets the nearest meridian
    /// of whole five degrees (sky::sea_anchor).
    double phase_rad = 0.0;
    /// How far the crest leads the middle between its troughs, in phase: 0 is a symmetrical wave.
    double leading_rad = 0.0;
    enum class Breaker : std::uint8_t { kPlunging, kSpilling, kSurging };
    Breaker breaker = Breaker::kPlunging;

    friend bool operator==(const Wave&, const Wave&) = default;
};

inline constexpr std::size_t kMaxWaves = 16;

/// The sea below the eye.
struct Sea {
    /// Of its mean surface above the WGS84 ellipsoid.
    double height_m = 0.0;
    double temperature_c = 15.0;
    /// Of the water, 0 opaque .. 1 clear.
    double clarity = 1.0;
    /// 0 without whitecaps, 1 with.
    double whitecaps = 0.0;
    std::array<Wave, kMaxWaves> waves{};
    std::size_t wave_count = 0;

    [[nodiscard]] std::span<const Wave> all_waves() const noexcept { return {waves.data(), wave_count}; }
};

struct Eye {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    /// Height above the WGS84 ellipsoid, metres.
    double height_m = 0.0;
};

struct Scene {
    std::uint64_t frame_number = 0;
    /// Scene time in seconds, from the world's clock (never from measured time). It drives adaptation; a step
    /// backwards or by more than a few seconds is a jump of the clock.
    double time_s = 0.0;
    Eye eye;
    Sun sun;
    Moon moon;
    Stars stars;
    /// Mercury, Venus, Mars, Jupiter, Saturn; switched and faded with the stars.
    std::array<Planet, kPlanetCount> planets{};
    Air air;
    Ground ground;
    Sea sea;
    Weather weather;
    /// Which model draws the day sky.
    SkySettings sky;
    /// What shines in the dark one.
    NightSettings night;

    /// Texts over the pictures of the views that show them.
    Overlay overlay;

    std::array<ChannelView, kMaxChannels> views{};
    std::size_t view_count = 0;

    [[nodiscard]] std::span<const ChannelView> channel_views() const noexcept {
        return {views.data(), view_count};
    }
};

}  // namespace skyig::render
