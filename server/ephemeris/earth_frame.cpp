#include "server/ephemeris/earth_frame.h"

#include <erfa.h>
#include <erfam.h>

#include <cmath>

namespace skyig::server::ephemeris {
namespace {

using RowMajor = double[3][3];

glm::dmat3 matrix_of(const RowMajor& rows) noexcept {
    glm::dmat3 matrix(0.0);
    for (glm::length_t row = 0; row < 3; ++row) {
        for (glm::length_t column = 0; column < 3; ++column)
            matrix[column][row] = rows[row][column];
    }
    return matrix;
}

/// From the equinox based matrix to both frames: `locator_rad` is the CIO locator s.
EarthFrame frame_of(const RowMajor& true_of_date_from_gcrs, double locator_rad) noexcept {
    RowMajor cirs_from_gcrs{};
    eraC2ixys(true_of_date_from_gcrs[2][0], true_of_date_from_gcrs[2][1], locator_rad, cirs_from_gcrs);
    EarthFrame frame;
    frame.cirs_from_gcrs = matrix_of(cirs_from_gcrs);
    frame.true_of_date_from_gcrs = matrix_of(true_of_date_from_gcrs);
    return frame;
}

EarthFrame almanac_frame(const JulianDate& tt) noexcept {
    const double centuries = ((tt.day - ERFA_DJ00) + tt.fraction) / ERFA_DJC;
    const auto angle = [centuries](double degrees, double degrees_per_century) {
        return std::fmod(degrees + degrees_per_century * centuries, 360.0) * ERFA_DD2R;
    };
    const double node = angle(125.04452, -1934.136261);
    const double sun = angle(280.4665, 36000.7698);
    const double moon = angle(218.3165, 481267.8813);
    const double longitude_rad = ERFA_DAS2R * (-17.20 * std::sin(node) - 1.32 * std::sin(2.0 * sun) -
                                               0.23 * std::sin(2.0 * moon) + 0.21 * std::sin(2.0 * node));
    const double obliquity_rad = ERFA_DAS2R * (9.20 * std::cos(node) + 0.57 * std::cos(2.0 * sun) +
                                               0.10 * std::cos(2.0 * moon) - 0.09 * std::cos(2.0 * node));
    double gamma = 0.0;
    double phi = 0.0;
    double psi = 0.0;
    double mean_obliquity = 0.0;
    eraPfw06(tt.day, tt.fraction, &gamma, &phi, &psi, &mean_obliquity);
    RowMajor matrix{};
    eraFw2m(gamma, phi, psi + longitude_rad, mean_obliquity + obliquity_rad, matrix);
    // The CIO locator's polynomial and its one term above a milliarcsecond (IAU 2006).
    const double locator_arcsec =
        9.4e-5 + centuries * (3.80865e-3 + centuries * (-1.2268e-4 - 7.257411e-2 * centuries)) -
        2.64073e-3 * std::sin(node);
    EarthFrame frame = frame_of(matrix, locator_arcsec * ERFA_DAS2R - 0.5 * matrix[2][0] * matrix[2][1]);
    frame.nutation_in_longitude_rad = longitude_rad;
    frame.true_obliquity_rad = mean_obliquity + obliquity_rad;
    return frame;
}

EarthFrame erfa_frame(const JulianDate& tt) noexcept {
    double longitude_rad = 0.0;
    double obliquity_rad = 0.0;
    double mean_obliquity = 0.0;
    RowMajor bias{};
    RowMajor precession{};
    RowMajor both{};
    RowMajor nutation{};
    RowMajor matrix{};
    eraPn00b(tt.day, tt.fraction, &longitude_rad, &obliquity_rad, &mean_obliquity, bias, precession, both,
             nutation, matrix);
    EarthFrame frame = frame_of(matrix, eraS00(tt.day, tt.fraction, matrix[2][0], matrix[2][1]));
    frame.nutation_in_longitude_rad = longitude_rad;
    frame.true_obliquity_rad = mean_obliquity + obliquity_rad;
    return frame;
}

EarthFrame series_frame(const JulianDate& tt) noexcept {
    double longitude_rad = 0.0;
    double obliquity_rad = 0.0;
    eraNut00b(tt.day, tt.fraction, &longitude_rad, &obliquity_rad);
    double gamma = 0.0;
    double phi = 0.0;
    double psi = 0.0;
    double mean_obliquity = 0.0;
    eraPfw06(tt.day, tt.fraction, &gamma, &phi, &psi, &mean_obliquity);
    RowMajor matrix{};
    eraFw2m(gamma, phi, psi + longitude_rad, mean_obliquity + obliquity_rad, matrix);
    EarthFrame frame = frame_of(matrix, eraS06(tt.day, tt.fraction, matrix[2][0], matrix[2][1]));
    frame.nutation_in_longitude_rad = longitude_rad;
    frame.true_obliquity_rad = mean_obliquity + obliquity_rad;
    return frame;
}

}  // namespace

EarthFrame earth_frame(const JulianDate& tt, Model model) noexcept {
    switch (model) {
        case Model::kAlmanac:
            return almanac_frame(tt);
        case Model::kErfa:
            return erfa_frame(tt);
        case Model::kSeries:
            break;
    }
    return series_frame(tt);
}

}  // namespace skyig::server::ephemeris
