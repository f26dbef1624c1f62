// Where weather stands as seen from the eye: the plane in which every point of the ground keeps its distance
// and its azimuth from the eye.
#pragma once

#include <glm/glm.hpp>

#include "render/scene.h"
#include "server/world/pose.h"

namespace skyig::server::weather {

/// An area on the ellipsoid; all else as in render::WeatherArea.
struct GroundArea {
    ephemeris::Geodetic centre;
    /// Of its x axis at its own centre, clockwise from true north.
    double rotation_rad = 0.0;
    glm::dvec2 half_size_m{0.0};
    double corner_radius_m = 0.0;
    double perimeter_m = 0.0;

    friend bool operator==(const GroundArea&, const GroundArea&) = default;
};

/// Part `t` of the way, 0..1: the centre along the chord, the axis the shorter way round, the rest member by
/// member. At 0 and 1 the one and the other to the last bit.
[[nodiscard]] GroundArea mix(const GroundArea& from, const GroundArea& to, double t) noexcept;

/// Below one eye. From chords: within 1 m of the geodesic up to 300 km, poles and antimeridian too. 0.1
/// microseconds a place.
class EyePlane {
  public:
    explicit EyePlane(const render::Eye& eye) noexcept;

    [[nodiscard]] render::WeatherArea place(const GroundArea& area) const noexcept;

  private:
    glm::dvec3 ecef_m_;
    glm::dvec3 east_;
    glm::dvec3 north_;
};

}  // namespace skyig::server::weather
