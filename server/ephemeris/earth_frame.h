// How the Earth's axis and equinox stand at a date: bias, precession and nutation, as slow matrices.
#pragma once

#include <glm/glm.hpp>

#include "server/ephemeris/bodies.h"
#include "server/ephemeris/time.h"

namespace skyig::server::ephemeris {

struct EarthFrame {
    /// Celestial intermediate frame from GCRS: the Earth rotation angle counts from its x axis.
    glm::dmat3 cirs_from_gcrs{1.0};
    /// True equator and equinox of date from GCRS: right ascension counts from its x axis.
    glm::dmat3 true_of_date_from_gcrs{1.0};
    double nutation_in_longitude_rad = 0.0;
    double true_obliquity_rad = 0.40909;
};

/// kAlmanac: IAU 2006 precession (Fukushima-Williams angles) with the four largest terms of nutation. kErfa:
/// IAU 2000B. kSeries: IAU 2006 precession with the 77 terms of nutation 2000B.
/// Largest error against the whole IAU 2006/2000A, 1900-2100, of the first and the second matrix: 0.14 and
/// 0.34 arcsec, 0.003 and 0.008, 0.0011 and 0.0023. The last two cost a tenth of IAU 2006/2000A
/// itself.
[[nodiscard]] EarthFrame earth_frame(const JulianDate& tt, Model model) noexcept;

}  // namespace skyig::server::ephemeris
