// What each genus looks like: which noise in which proportions makes it, and how dense it is.
#pragma once

#include <array>
#include <cstdint>

#include "render/cloud/field/kernels.h"
#include "render/cloud/field/noise.h"
#include "render/weather.h"

namespace skyig::render::cloud::field {

/// All noise repeats after this way east or north, metres: drift and anchor wrap on it without a jump. A tile
/// is turned and scaled by whole numbers, times that it fits in.
inline constexpr double kWorld_m = 131072.0;

/// u = (xx * east + xy * north) / kWorld_m tiles, v alike.
struct Turn {
    int xx = 1;
    int xy = 0;
    int yx = 0;
    int yy = 1;
};

struct GenusFlat {
    Sheet sheet = Sheet::kSmooth;
    Turn turn;
    float weight = 0.0F;
};

struct GenusFine {
    Turn turn;
    /// Of the tile, upright, metres.
    float height_m = 1000.0F;
    float weight = 0.0F;
};

/// Mean cosines of scattering.
inline constexpr float kWaterG = 0.85F;
inline constexpr float kIceG = 0.78F;

struct Genus {
    std::array<GenusFlat, 3> flats{};
    /// How far the first pushes the second, in tiles of it, per unit of value.
    std::array<float, 2> push{};
    std::array<GenusFine, 2> fines{};
    /// Of the anvil.
    GenusFlat fibres{};
    std::array<float, 3> lift{};
    float edge = 0.2F;
    float reach_m = 200.0F;
    /// Shortest and longest steps through it.
    float step_m = 16.0F;
    float stride_m = 200.0F;
    /// A step is no longer than this part of the layer's thickness, where it is shortest.
    float step_part = 0.1F;
    float extinction_per_m = 0.05F;
    float usual_thickness_m = 500.0F;
    /// How far a beam goes along the ground, in the mean, before it meets the next cloud's side: by that the
    /// gaps close as a source goes down (cloud_shade.h). 0: they do not. Measured on the field.
    float apart_m = 0.0F;
    bool ice = false;
    /// Of a column, from where on it counts as covered; 0: where it hides what is behind it.
    float covered_part = 0.0F;
    /// Metres that its large shapes move against its small ones in a second, and that all rises.
    float change_m_s = 1.0F;
};

inline constexpr std::size_t kGenera = 12;
/// In the place that no CloudGenus has: a cumulonimbus before its anvil.
inline constexpr CloudGenus kTower{};
[[nodiscard]] const Genus& genus_of(CloudGenus genus) noexcept;

/// What the seed and the age of a layer and the eye's place do to the tiles.
struct ShapePlace {
    /// East and north of where the field's axes begin, metres (sky::sea_anchor less the layer's drift).
    double east_m = 0.0;
    double north_m = 0.0;
    double age_s = 0.0;
    std::uint32_t seed = 0;
};
[[nodiscard]] Shape shape_of(const Noise& noise, CloudGenus genus, const ShapePlace& place) noexcept;
/// The same of a layer that is told tile by tile.
[[nodiscard]] Shape shape_of(const Noise& noise, const CloudLook& look, const ShapePlace& place) noexcept;

}  // namespace skyig::render::cloud::field
