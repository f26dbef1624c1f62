// [night] and its [[night.city]] tables: what shines in a dark sky beside stars, planets and the Moon.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace skyig::config {

enum class NightModel { kSources, kMean, kSeed };

/// [[night.city]]
struct City {
    /// Degrees north and east.
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    /// 0.1..100
    double radius_km = 8.0;
    /// What its light adds to the zenith over its centre, above 0 .. 0.02; or how many people live there,
    /// above 0 .. 1e8, at most 8000 a km2 of its disc. Just one of the two is given, the other stays 0.
    double zenith_cd_m2 = 0.0;
    double population = 0.0;
};

inline constexpr std::size_t kMaxCities = 8;

struct Night {
    NightModel model = NightModel::kSources;
    bool airglow = true;
    bool zodiacal = true;
    bool starlight = true;
    bool galactic_light = true;
    /// 0..1
    double milky_way_structure = 1.0;
    /// 0..2147483647
    int seed = 1;
    /// 0 solar minimum .. 1 maximum.
    double solar_activity = 0.0;
    /// At most kMaxCities.
    std::vector<City> cities;
};

}  // namespace skyig::config
