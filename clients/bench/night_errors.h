// The light of the night sky as it is drawn against what is known of it by number, source by source.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/scene.h"

namespace skyig::clients::bench {

/// One row of a truth table.
struct NightRow {
    std::string model;
    std::string cases;
    /// Which one; empty in long tables.
    std::string row;
    std::string unit;
    double known = 0.0;
    double ours = 0.0;
    /// What we have beyond what is known, magnitudes: > 0 is too dark.
    double off_mag = 0.0;
};

/// In the order of the tables. \param truth  its folder "night" holds natural_night.csv,
/// twilight_sky_luminance.csv, moonlit_zenith_sky.csv, sun_ground_illuminance.csv,
/// moon_ground_illuminance.csv, zodiacal_s10.csv and limiting_magnitude.csv, "moon" moon_magnitude_phase.csv.
/// \param reference  its folder "night" may hold starlight_pioneer_s10.csv. Throws std::runtime_error naming
/// what is missing.
[[nodiscard]] std::vector<NightRow> night_rows(const std::filesystem::path& truth,
                                               const std::filesystem::path& reference);

/// A moonless sky at sea level, so many hours after midnight. \param sun_longitude_rad  ecliptic
[[nodiscard]] render::Scene dark_hour(double latitude_rad, double sun_longitude_rad, double from_midnight_h);

}  // namespace skyig::clients::bench
