// Places of bodies all alike, for tables, lists and people: out of a state of the sky, or from the Earth's
// centre.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "server/ephemeris/angles.h"
#include "server/ephemeris/bodies.h"
#include "server/ephemeris/moon_face.h"
#include "server/ephemeris/sky_state.h"
#include "server/ephemeris/time.h"

namespace skyig::server::ephemeris {

struct ApparentPlace {
    /// Unit vector; axes are those of the state or the places that it comes from.
    glm::dvec3 direction{0.0, 0.0, 1.0};
    /// Along the light's path.
    double distance_km = kKmPerAu;
    double angular_radius_rad = 0.0;
    /// The Sun has phase angle 0, is all lit and has no bright limb (0).
    double phase_angle_rad = 0.0;
    double lit_fraction = 1.0;
    double bright_limb_rad = 0.0;
    double magnitude = 0.0;
};

/// Direction east-north-up.
[[nodiscard]] ApparentPlace apparent_place(const SkyState& state, Body body) noexcept;

/// Right ascension and declination of date (true equator and equinox) of a direction in `state`.
[[nodiscard]] Equatorial equatorial_of_date(const SkyState& state, const glm::dvec3& direction_enu) noexcept;

/// The Moon's face for the state's eye.
[[nodiscard]] MoonFace moon_face(const SkyState& state) noexcept;

/// Apparent places for an eye in the Earth's centre.
struct GeocentricPlaces {
    /// Directions in the true equator and equinox of date; distances along the light's path.
    std::array<ApparentPlace, kBodyCount> bodies;
    MoonFace moon_face;
    glm::dmat3 true_of_date_from_gcrs{1.0};

    [[nodiscard]] const ApparentPlace& of(Body body) const noexcept { return bodies[index_of(body)]; }
};

/// Errors as compute_sky_state().
[[nodiscard]] GeocentricPlaces compute_geocentric(const JulianDate& tt,
                                                  Model model = Model::kSeries) noexcept;

}  // namespace skyig::server::ephemeris
