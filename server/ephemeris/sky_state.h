// Where Sun, Moon and planets stand for an eye near the Earth, and how the star sky is turned.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "server/ephemeris/angles.h"
#include "server/ephemeris/bodies.h"
#include "server/ephemeris/time.h"

namespace skyig::server::ephemeris {

/// A place on the WGS84 ellipsoid; longitude east positive, height above the ellipsoid.
struct Geodetic {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    double height_m = 0.0;

    friend bool operator==(const Geodetic&, const Geodetic&) = default;
};

inline constexpr double kMinEyeHeight_m = -12'000.0;
inline constexpr double kMaxEyeHeight_m = 100'000'000.0;

/// Finite, |latitude| <= 90, height in kMinEyeHeight_m .. kMaxEyeHeight_m. Any finite longitude will do.
[[nodiscard]] bool is_valid(const Geodetic& eye) noexcept;

/// Apparent place of the Sun: topocentric, airless, with light time and aberration.
struct SunState {
    glm::dvec3 direction_enu{0.0, 0.0, 1.0};
    double distance_au = 1.0;
    /// asin(R / distance), R = 695 700 km.
    double angular_radius_rad = 0.00465;
    /// Part of the disc's area that the Moon covers, 0..1 (limb darkening not weighed in).
    double obscured = 0.0;
};

/// Apparent place of the Moon: topocentric, airless, with light time and aberration.
struct MoonState {
    glm::dvec3 direction_enu{0.0, 0.0, -1.0};
    /// Along the light's path: eye now, Moon when the light left it.
    double distance_km = 384400.0;
    /// asin(R / distance), R = 1737.4 km.
    double angular_radius_rad = 0.00452;
    /// Unit vector from the Moon's centre to the Sun.
    glm::dvec3 to_sun_enu{0.0, 0.0, 1.0};
    /// Angle Sun-Moon-eye: 0 full, pi new.
    double phase_angle_rad = 0.0;
    /// (1 + cos phase angle) / 2.
    double lit_fraction = 1.0;
    /// Position angle of the bright limb's middle, from the celestial pole of date through east, -pi..pi.
    /// Finite, but without meaning where the Sun is exactly behind or opposite the Moon.
    double bright_limb_rad = 0.0;
    /// V magnitude outside the air, without opposition surge and Earth's shadow: moon_magnitude().
    double magnitude = -12.7;
    /// East-north-up from selenographic axes (x to the mean Earth point, z to the lunar north pole), optical
    /// libration: which side is seen and which way up it stands.
    glm::dmat3 enu_from_selenographic{1.0};
    /// The Earth's shadow where the Moon is, in units of the Moon's radius: from the Moon's centre to the
    /// shadow's axis (perpendicular to it), and how wide umbra and penumbra are there. A body of the Moon
    /// further from the axis than the penumbra is in full sunlight.
    glm::dvec3 shadow_axis_enu{1e3, 0.0, 0.0};
    double umbra_radius = 2.6;
    double penumbra_radius = 4.7;
    /// Part of the sunlight that the Earth leaves to the lit disc, 0..1: 1 outside the penumbra, 0 inside the
    /// umbra (what the Earth's air bends into it is for the one who draws it).
    double sunlit = 1.0;
};

/// Apparent place of a planet: topocentric, airless, with light time, deflection by the Sun and aberration.
struct PlanetState {
    glm::dvec3 direction_enu{0.0, 0.0, -1.0};
    double distance_km = 1e8;
    double angular_radius_rad = 0.0;
    /// Angle Sun-planet-eye.
    double phase_angle_rad = 0.0;
    double lit_fraction = 1.0;
    double bright_limb_rad = 0.0;
    /// V magnitude outside the air, the rings of Saturn included: planet_magnitude().
    double magnitude = 0.0;
};

struct SkyState {
    SunState sun;
    MoonState moon;
    /// kMercury .. kSaturn.
    std::array<PlanetState, kPlanetCount> planets;
    /// East-north-up at the eye (WGS84 vertical) from GCRS: precession, nutation, Earth rotation and site in
    /// one rotation.
    glm::dmat3 enu_from_gcrs{1.0};
    /// True equator and equinox of date from GCRS: right ascension and declination of date are read off
    /// there.
    glm::dmat3 true_of_date_from_gcrs{1.0};
    /// Barycentric velocity of the Earth's centre in units of c, GCRS axes: a star at p is seen at
    /// normalise(p + v).
    glm::dvec3 earth_velocity_c{0.0};
    /// The same with the eye's own turning with the Earth: diurnal aberration.
    glm::dvec3 eye_velocity_c{0.0};
    /// From the barycentre and from the Sun to the Earth's centre, GCRS axes: parallax of stars, bending of
    /// their light.
    glm::dvec3 earth_barycentric_au{1.0, 0.0, 0.0};
    glm::dvec3 earth_heliocentric_au{1.0, 0.0, 0.0};
    /// Julian years of TT since J2000.0.
    double years_since_j2000 = 0.0;
    /// False: the eye was not is_valid(). What was not finite counted as zero, the rest was clamped.
    bool eye_accepted = true;
};

/// The whole state from nothing. Always finite for a finite instant. At a pole east and north are those of
/// the meridian `eye.longitude_deg`.
///
/// Largest errors against topocentric places from DE441 and IAU 2006/2000A, 1900-2100 (tests/data/ephemeris):
/// kSeries: Sun 0.012 arcsec, Moon 0.24, planets 0.75 (Mars). kErfa: Sun 0.012, Moon 7, Mercury 1.2, Venus 8,
/// Mars 20, Jupiter 81, Saturn 95. kAlmanac: Sun 36, Moon 1040, Mercury 41, Venus 84, Mars 260, Jupiter 710,
/// Saturn 1330. Cost: see docs/accuracy.
/// The eye's speed over ground (0.2 arcsec) is left out. SkyClockwork gives the same for a fraction of it.
[[nodiscard]] SkyState compute_sky_state(const Instant& instant, const Geodetic& eye,
                                         Model model = Model::kSeries) noexcept;

}  // namespace skyig::server::ephemeris
