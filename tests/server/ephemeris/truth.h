// What the ephemeris tests share: truth rows as instants, places and directions, and errors in arcseconds.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>

#include "server/ephemeris/sky_state.h"
#include "tests/csv.h"
#include "tests/server/ephemeris/largest.h"

namespace skyig::tests {

inline constexpr double kArcsecPerRad = 180.0 * 3600.0 / std::numbers::pi;
inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;
inline constexpr double kSecondsPerDay = 86400.0;

inline double separation_arcsec(const glm::dvec3& a, const glm::dvec3& b) {
    return server::ephemeris::angle_between_rad(a, b) * kArcsecPerRad;
}

/// North 0, east 90.
inline glm::dvec3 direction_of(double azimuth_deg, double elevation_deg) {
    const double azimuth = azimuth_deg * kRadPerDeg;
    const double elevation = elevation_deg * kRadPerDeg;
    return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
            std::sin(elevation)};
}

/// "2016-12-31T23:59:60.5Z" taken apart without asking whether it exists.
inline server::ephemeris::CivilTime civil_of(const std::string& utc) {
    return {.year = std::stoi(utc.substr(0, 4)),
            .month = std::stoi(utc.substr(5, 2)),
            .day = std::stoi(utc.substr(8, 2)),
            .hour = std::stoi(utc.substr(11, 2)),
            .minute = std::stoi(utc.substr(14, 2)),
            .second = std::stod(utc.substr(17))};
}

/// TT and UT1 from a row's own offsets, independent of the library's time scales.
inline server::ephemeris::Instant instant_of(const std::string& utc, double tt_minus_utc_s,
                                             double ut1_minus_utc_s) {
    const server::ephemeris::CivilTime civil = civil_of(utc);
    // Days since 2000-01-01 by counting: slow, but nothing of what is tested.
    int days = 0;
    const auto leap = [](int year) { return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0); };
    for (int year = 2000; year < civil.year; ++year)
        days += leap(year) ? 366 : 365;
    for (int year = civil.year; year < 2000; ++year)
        days -= leap(year) ? 366 : 365;
    constexpr std::array kMonthDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    for (std::size_t month = 1; month < static_cast<std::size_t>(civil.month); ++month)
        days += kMonthDays[month - 1] + (month == 2 && leap(civil.year) ? 1 : 0);
    days += civil.day - 1;
    const double second = 3600.0 * civil.hour + 60.0 * civil.minute + civil.second;
    const double jd = 2451544.5 + days;
    server::ephemeris::Instant instant;
    instant.tt = {jd, (second + tt_minus_utc_s) / kSecondsPerDay};
    instant.ut1 = {jd, (second + ut1_minus_utc_s) / kSecondsPerDay};
    return instant;
}

inline server::ephemeris::Geodetic place_of(const CsvRow& row) {
    return {.latitude_deg = row.number("lat_deg"),
            .longitude_deg = row.number("lon_deg"),
            .height_m = row.number("h_m")};
}

/// By the row's column `body`; throws on a name that is none.
inline server::ephemeris::Body body_of(const CsvRow& row) {
    const std::string& name = row.text("body");
    for (const server::ephemeris::Body body : server::ephemeris::kBodies) {
        if (server::ephemeris::name_of(body) == name) return body;
    }
    throw std::runtime_error("no body: " + name);
}

/// Largest and root mean square of what is added. An error that is not finite makes the largest infinite.
struct ErrorStatistics {
    double max = 0.0;
    double sum_of_squares = 0.0;
    std::size_t count = 0;

    void add(double error) {
        raise(max, error);
        sum_of_squares += error * error;
        ++count;
    }
    [[nodiscard]] double rms() const {
        return count == 0 ? 0.0 : std::sqrt(sum_of_squares / static_cast<double>(count));
    }
};

}  // namespace skyig::tests
