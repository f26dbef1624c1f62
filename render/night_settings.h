// What shines in a dark sky beside stars, planets and the Moon: plain values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace skyig::render {

enum class NightModel {
    kSources,  ///< each source by its own law
    kMean,     ///< airglow by its law; zodiacal light and starlight everywhere as at a dark zenith
    kSeed,     ///< four constants outside the air, no Milky Way
};

inline constexpr std::array<std::string_view, 3> kNightModelNames{"sources", "mean", "seed"};

/// A town whose light the air scatters.
struct City {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    /// Within it most of its light is sent up.
    double radius_m = 8000.0;
    /// What its light adds to the zenith over its centre in the scene's air; 0: from its population.
    double zenith_cd_m2 = 0.0;
    double population = 0.0;

    friend bool operator==(const City&, const City&) = default;
};

inline constexpr std::size_t kMaxCities = 8;

struct NightSettings {
    NightModel model = NightModel::kSources;
    bool airglow = true;
    bool zodiacal = true;
    /// Stars that are not drawn one by one.
    bool starlight = true;
    /// Starlight that the dust between the stars scatters.
    bool galactic_light = true;
    /// Clouds and dust lanes in the Milky Way, 0 as smooth as its mean .. 1 in full.
    double structure = 1.0;
    std::uint32_t seed = 1;
    /// 0 solar minimum .. 1 maximum.
    double solar_activity = 0.0;

    std::array<City, kMaxCities> cities{};
    std::size_t city_count = 0;

    [[nodiscard]] std::span<const City> all_cities() const noexcept { return {cities.data(), city_count}; }

    friend bool operator==(const NightSettings&, const NightSettings&) = default;
};

}  // namespace skyig::render
