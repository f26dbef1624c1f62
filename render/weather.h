// The weather of one frame as the renderer takes it: what floats, falls and flashes round the eye. Plain
// values, complete and checked: finite, inside the stated ranges. Heights are metres above the WGS84
// ellipsoid, like the eye's; directions and places are east, north, up at the eye.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>

namespace skyig::render {

/// CIGI's cloud types by their numbers, and what is drawn like a cloud without being one.
enum class CloudGenus : std::uint8_t {
    kAltocumulus = 1,
    kAltostratus,
    kCirrocumulus,
    kCirrostratus,
    kCirrus,
    kCumulonimbus,
    kCumulus,
    kNimbostratus,
    kStratocumulus,
    kStratus,
    kFogPatches,  ///< fog on the ground with gaps: coverage is the part where it is half as dense or more
};

/// How a layer is drawn. kAuto: the plan takes the cheapest that keeps to the error budget.
enum class CloudModel : std::uint8_t { kAuto, kLayer, kImpostor, kVolume };

/// Where weather holds: a rounded rectangle with a perimeter over which it fades to nothing, its middle seen
/// from the eye. A storm's circle is one with half sizes of 0.
struct WeatherArea {
    /// East and north of the eye, along the ground, metres.
    glm::dvec2 centre_m{0.0};
    /// Of the rectangle's own x axis, clockwise from true north.
    double axis_rad = 0.0;
    /// Inside the rounded corners' centres, >= 0.
    glm::dvec2 half_size_m{0.0};
    double corner_radius_m = 0.0;
    double perimeter_m = 0.0;

    friend bool operator==(const WeatherArea&, const WeatherArea&) = default;
};

namespace cloud::field {
class Texture;
}

/// What a tile of noise looks like from above.
enum class CloudNoise : std::uint8_t {
    kPuffs,   ///< heaps of several sizes
    kSmooth,  ///< Perlin noise, five octaves
    kCells,   ///< cells of one size, near a grid
    kFibres,  ///< long threads that wind (domain warp)
};

/// How a sheet (kLayer, or kAuto) draws a layer, in the terms of its seed: density is the sum of scrolled
/// tiles of noise or of pictures.
struct CloudLook {
    struct Tile {
        /// In place of noise.
        std::shared_ptr<const cloud::field::Texture> picture{};
        CloudNoise noise = CloudNoise::kSmooth;
        /// How many fit along 131,072 m, east; 1..4096. At 1 smooth noise's finest feature is 3 km, at 32
        /// 100 m.
        int times = 8;
        /// In addition to the layer's drift, by its age, east and north.
        glm::dvec2 scroll_m_s{0.0};
        /// Of its values about their mean, -0.5..0.5: a picture's grey less a half.
        double weight = 1.0;

        friend bool operator==(const Tile&, const Tile&) = default;
    };
    std::array<Tile, 3> tiles{{{.times = 2, .weight = 0.5}, {.times = 8}, {.times = 32, .weight = 0.4}}};
    /// Added to the sum, besides what the layer's coverage adds; full extinction is reached at a sum of 1. A
    /// picture alone, of weight 1 and under full coverage, is the density.
    double density_offset = 0.0;
    /// How strongly cloud towards the light dims it; 1 as measured on slabs.
    double self_shadow = 1.0;
    /// Times its light, linear Rec.709.
    glm::dvec3 colour{1.0};

    friend bool operator==(const CloudLook&, const CloudLook&) = default;
};

/// One layer of cloud. Density is full from base to top and falls linearly to nothing over the bands outside.
struct CloudLayer {
    CloudGenus genus = CloudGenus::kCumulus;
    CloudModel model = CloudModel::kAuto;
    double base_m = 1000.0;
    /// > 0
    double thickness_m = 500.0;
    double bottom_band_m = 0.0;
    double top_band_m = 0.0;
    /// Part of the sky that it covers, seen straight from below, 0..1.
    double coverage = 0.5;
    /// Of visible light at full density; 0: what the genus has.
    double extinction_per_m = 0.0;
    /// How far the wind has carried the layer since scene time 0, east and north, metres. Any size; in
    /// double.
    glm::dvec2 drift_m{0.0};
    /// Age of its shapes: they change with it. Seconds.
    double age_s = 0.0;
    /// How often fragments hang below the base and over the top, 0..1.
    double bottom_scud = 0.0;
    double top_scud = 0.0;
    /// How grown a storm is, 0..1.
    double severity = 0.0;
    /// Layers of unlike seeds have unlike clouds.
    std::uint32_t seed = 0;
    /// Everywhere, if none.
    std::optional<WeatherArea> area{};
    /// Of a sheet; as its genus, if none. With one kAuto is a sheet.
    std::optional<CloudLook> look;

    friend bool operator==(const CloudLayer&, const CloudLayer&) = default;
};

/// What dims the view without having a shape: fog, dust, rain as a whole.
struct Obscurant {
    enum class Kind : std::uint8_t { kFog, kHaze, kDust, kSand, kSmoke, kRain, kSnow };
    Kind kind = Kind::kFog;
    double base_m = -1000.0;
    double top_m = 100.0;
    /// Density falls linearly to nothing over these bands outside base and top.
    double bottom_band_m = 0.0;
    double top_band_m = 0.0;
    /// Of visible light at full density, in addition to that of the air's own visibility. >= 0
    double extinction_per_m = 0.0;
    /// Part of the ground that it covers: below 1 it lies in patches.
    double coverage = 1.0;
    glm::dvec2 drift_m{0.0};
    std::uint32_t seed = 0;
    std::optional<WeatherArea> area{};

    friend bool operator==(const Obscurant&, const Obscurant&) = default;
};

/// What falls where the eye is. Its extinction is an Obscurant's.
struct Precipitation {
    enum class Kind : std::uint8_t { kRain, kDrizzle, kSnow, kSleet, kHail };
    Kind kind = Kind::kRain;
    /// Of liquid water, mm/h, >= 0.
    double rate_mm_h = 0.0;
    /// It falls below this height.
    double top_m = 1500.0;

    friend bool operator==(const Precipitation&, const Precipitation&) = default;
};

/// Lightning inside one cloud layer.
struct Lightning {
    /// Index of CloudLayer.
    std::size_t layer = 0;
    double flashes_per_min = 0.0;
    std::uint32_t seed = 0;

    friend bool operator==(const Lightning&, const Lightning&) = default;
};

struct Weather {
    static constexpr std::size_t kMaxClouds = 16;
    static constexpr std::size_t kMaxObscurants = 16;
    static constexpr std::size_t kMaxPrecipitations = 5;
    static constexpr std::size_t kMaxLightnings = 8;

    std::array<CloudLayer, kMaxClouds> clouds{};
    std::size_t cloud_count = 0;
    std::array<Obscurant, kMaxObscurants> obscurants{};
    std::size_t obscurant_count = 0;
    std::array<Precipitation, kMaxPrecipitations> precipitations{};
    std::size_t precipitation_count = 0;
    std::array<Lightning, kMaxLightnings> lightnings{};
    std::size_t lightning_count = 0;
    /// Of the air at the eye, east, north, up.
    glm::dvec3 wind_m_s{0.0};
    /// Of the eye over the ground.
    glm::dvec3 eye_velocity_m_s{0.0};

    [[nodiscard]] std::span<const CloudLayer> all_clouds() const noexcept {
        return {clouds.data(), cloud_count};
    }
    [[nodiscard]] std::span<const Obscurant> all_obscurants() const noexcept {
        return {obscurants.data(), obscurant_count};
    }
    [[nodiscard]] std::span<const Precipitation> all_precipitations() const noexcept {
        return {precipitations.data(), precipitation_count};
    }
    [[nodiscard]] std::span<const Lightning> all_lightnings() const noexcept {
        return {lightnings.data(), lightning_count};
    }
};

}  // namespace skyig::render
