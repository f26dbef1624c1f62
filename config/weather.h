// [weather]: what the sky holds at start-up and after Standby, and how weather changes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/keyframes.h"

namespace skyig::config {

namespace warp {
struct GreyMap;
}

/// Key "type" of a layer.
enum class LayerType : std::uint8_t {
    kFog,
    kHaze,
    kSmoke,
    kSand,
    kDust,
    kDrizzle,
    kRain,
    kSnow,
    kSleet,
    kHail,
    kAltocumulus,
    kAltostratus,
    kCirrocumulus,
    kCirrostratus,
    kCirrus,
    kCumulonimbus,
    kCumulus,
    kNimbostratus,
    kStratocumulus,
    kStratus,
};
inline constexpr std::array<std::string_view, 20> kLayerTypeNames{
    "fog",    "haze",         "smoke",   "sand",         "dust",          "drizzle",      "rain",
    "snow",   "sleet",        "hail",    "altocumulus",  "altostratus",   "cirrocumulus", "cirrostratus",
    "cirrus", "cumulonimbus", "cumulus", "nimbostratus", "stratocumulus", "stratus"};

[[nodiscard]] constexpr bool is_cloud(LayerType type) noexcept {
    return type >= LayerType::kAltocumulus;
}
[[nodiscard]] constexpr bool falls(LayerType type) noexcept {
    return type >= LayerType::kDrizzle && type <= LayerType::kHail;
}

/// One [[weather.layer]].
struct WeatherLayer {
    LayerType type = LayerType::kCumulus;
    /// Of clouds, by which a host may address it, 1..3 or 14..255; not given: the next that is free. A later
    /// layer of the same id, or of the same type if it is no cloud, takes the place of an earlier one.
    std::optional<int> id;
    /// Above `Weather::elevation_m`. What lies on the ground or falls reaches below it by default.
    double base_m = -1000.0;
    /// > 0
    double thickness_m = 0.0;
    /// Over which it thins out, outside of base and top.
    double bottom_band_m = 0.0;
    double top_band_m = 0.0;
    /// 0..1
    double coverage = 1.0;
    /// Inside it, by the contrast of [air]; 0: what the type, or its rate, has.
    double visibility_m = 0.0;
    /// Of what falls, mm of liquid water an hour; 0: by its severity.
    double rate_mm_h = 0.0;
    /// 0..5
    int severity = 0;
    double bottom_scud_pct = 0.0;
    double top_scud_pct = 0.0;
    bool lightning = false;
    /// Not given: the air's, by height.
    std::optional<double> wind_m_s;
    double wind_from_deg = 0.0;

    friend bool operator==(const WeatherLayer&, const WeatherLayer&) = default;
};

inline constexpr std::size_t kMaxWeatherLayers = 32;

/// One [[weather.area]]: weather inside a rounded rectangle on the ground, fading to nothing over a perimeter
/// round it.
struct WeatherArea {
    /// By which a host may address it, 1..65535; not given: the next that is free.
    std::optional<int> id;
    double latitude_deg = 0.0;
    /// -180..180
    double longitude_deg = 0.0;
    /// Of its length, clockwise from true north.
    double rotation_deg = 0.0;
    /// From the middle to the edge, > 0.
    double half_length_m = 0.0;
    double half_width_m = 0.0;
    /// At most the lesser half size.
    double corner_radius_m = 0.0;
    double perimeter_m = 0.0;
    /// Lets areas told before it be seen through its own layers.
    bool merge = false;
    /// Ids count inside the area.
    std::vector<WeatherLayer> layers;

    friend bool operator==(const WeatherArea&, const WeatherArea&) = default;
};

inline constexpr std::size_t kMaxWeatherAreas = 32;

/// Key "noise" of a texture.
enum class CloudNoise : std::uint8_t { kPuffs, kSmooth, kCells, kFibres };

/// One [[weather.sheet.texture]]: something that repeats over the ground.
struct WeatherTexture {
    /// In place of noise: square, a power of two from 16 to 2048 pixels wide, without a seam.
    std::shared_ptr<const warp::GreyMap> image;
    CloudNoise noise = CloudNoise::kSmooth;
    /// After which it repeats; shown as the nearest whole part of kTexturesRepeat_m.
    double size_m = 16384.0;
    double weight = 1.0;
    /// In addition to the layer's wind.
    double scroll_m_s = 0.0;
    double scroll_from_deg = 0.0;
};

/// After so much all textures repeat.
inline constexpr double kTexturesRepeat_m = 131'072.0;
inline constexpr std::size_t kMaxWeatherTextures = 3;

/// One [[weather.sheet]]: how clouds of a type look that are drawn as sheets. A later one of the same type
/// takes the place of an earlier one.
struct WeatherSheet {
    LayerType type = LayerType::kCirrus;
    /// Added to the textures' sum, besides what the layer's coverage adds.
    double density_offset = 0.0;
    /// How strongly cloud towards the light dims it; 1 as measured on slabs.
    double self_shadow = 1.0;
    /// Times its light, linear Rec.709.
    std::array<double, 3> colour{1.0, 1.0, 1.0};
    /// 1..kMaxWeatherTextures
    std::vector<WeatherTexture> textures;
};

inline constexpr std::size_t kMaxWeatherSheets = 10;

/// How clouds are drawn: "auto" leaves it to the plan.
enum class CloudModel : std::uint8_t { kAuto, kLayer, kImpostor, kVolume };

/// What makes the weather of a frame: layers as told, or the day's keyframes over them.
enum class WeatherDriver : std::uint8_t { kLayers, kKeyframes };

struct Weather {
    /// Name of a preset or path of a file, as given; already applied. Empty: none.
    std::string preset;
    /// Text of a weather report; empty: none.
    std::string metar;
    /// Height above the ellipsoid that the layers' bases and the report count from, -500..9000.
    double elevation_m = 0.0;
    /// How long a change takes, 0..600; 0 = at once.
    double transition_s = 10.0;
    CloudModel clouds = CloudModel::kAuto;
    WeatherDriver driver = WeatherDriver::kLayers;
    Keyframes keyframes;
    /// At most kMaxWeatherLayers, those of the preset first.
    std::vector<WeatherLayer> layers;
    /// At most kMaxWeatherSheets, those of the preset first.
    std::vector<WeatherSheet> sheets;
    /// At most kMaxWeatherAreas, those of the preset first.
    std::vector<WeatherArea> areas;
};

}  // namespace skyig::config
