#include "render/cloud/field/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/cloud/field/texture.h"

namespace skyig::render::cloud::field {
namespace {

// A tile that fits in `times` times along the world, turned by the angle whose tangent is about a third.
constexpr Turn turned(int main, int side) {
    return {main, side, -side, main};
}
// The same, drawn out along its first axis.
constexpr Turn drawn(int main, int side, int factor) {
    return {main, side, -side * factor, main * factor};
}

// The tiles' features that matter are these parts of them.
constexpr double kFlatWave = 1.0 / 14.0;
constexpr double kFineWave = 1.0 / 8.0;

constexpr Genus cumulus() {
    Genus g;
    g.flats = {{{Sheet::kSmooth, turned(2, 1), 0.35F},
                {Sheet::kPuffs, turned(6, 2), 1.0F},
                {Sheet::kPuffs, turned(19, -5), 0.22F}}};
    g.push = {0.05F, 0.03F};
    g.fines = {{{turned(131, 62), 800.0F, 0.31F}, {turned(523, 286), 200.0F, 0.11F}}};
    g.lift = {0.05F, 0.75F, 0.0F};
    g.edge = 0.34F;
    g.reach_m = 300.0F;
    g.step_m = 16.0F;
    g.stride_m = 150.0F;
    g.extinction_per_m = 0.05F;
    g.usual_thickness_m = 2000.0F;
    g.apart_m = 3600.0F;
    return g;
}

constexpr Genus cumulonimbus() {
    Genus g;
    g.flats = {{{Sheet::kSmooth, turned(1, 1), 0.50F},
                {Sheet::kPuffs, turned(2, 1), 1.0F},
                {Sheet::kPuffs, turned(9, -4), 0.16F}}};
    g.push = {0.05F, 0.03F};
    g.fines = {{{turned(27, 11), 4200.0F, 0.25F}, {turned(107, 44), 1200.0F, 0.12F}}};
    // Along the same way as cirrus: streaks of 9 km by 700 m.
    g.fibres = {Sheet::kFibres, drawn(5, 1, 2), 0.40F};
    // Full grown: a trunk that is wide at its base, and the anvil that spreads over it.
    g.lift = {2.2F, -8.3F, 6.2F};
    g.edge = 0.30F;
    g.reach_m = 660.0F;
    g.step_m = 20.0F;
    g.stride_m = 300.0F;
    g.extinction_per_m = 0.06F;
    g.usual_thickness_m = 11000.0F;
    g.apart_m = 14000.0F;
    return g;
}

constexpr Genus stratocumulus() {
    Genus g;
    g.flats = {{{Sheet::kSmooth, turned(2, -1), 0.35F},
                {Sheet::kCells, {5, 2, -3, 8}, 1.0F},
                {Sheet::kPuffs, turned(13, 7), 0.45F}}};
    g.push = {0.10F, 0.06F};
    g.fines = {{{turned(163, 71), 400.0F, 0.34F}, {turned(547, 230), 160.0F, 0.12F}}};
    g.lift = {0.0F, 0.30F, 0.0F};
    g.edge = 0.45F;
    g.reach_m = 135.0F;
    g.step_m = 16.0F;
    g.stride_m = 150.0F;
    g.extinction_per_m = 0.045F;
    g.usual_thickness_m = 400.0F;
    g.apart_m = 1000.0F;
    return g;
}

constexpr Genus smooth_sheet(int main, float extinction_per_m, float thickness_m) {
    Genus g;
    g.flats = {{{Sheet::kSmooth, turned(2, 1), 0.30F},
                {Sheet::kSmooth, turned(main, main / 2), 1.0F},
                {Sheet::kPuffs, turned(4 * main - 1, -main), 0.12F}}};
    g.push = {0.05F, 0.05F};
    g.fines = {{{turned(89, 37), 700.0F, 0.12F}, {}}};
    g.lift = {0.0F, 0.0F, 0.0F};
    g.edge = 0.7F;
    g.reach_m = 2000.0F / static_cast<float>(main);
    g.step_m = 16.0F;
    g.stride_m = 250.0F;
    g.extinction_per_m = extinction_per_m;
    g.usual_thickness_m = thickness_m;
    g.apart_m = 12000.0F / static_cast<float>(main);
    return g;
}

constexpr Genus altocumulus() {
    Genus g;
    g.flats = {{{Sheet::kSmooth, turned(3, 1), 0.60F},
                {Sheet::kCells, {15, 5, -8, 24}, 1.0F},
                {Sheet::kSmooth, turned(37, -11), 0.15F}}};
    g.push = {0.35F, 0.20F};
    g.fines = {{{turned(353, 131), 250.0F, 0.20F}, {}}};
    g.lift = {0.0F, 0.30F, 0.0F};
    g.edge = 0.6F;
    g.reach_m = 44.0F;
    g.step_m = 14.0F;
    g.stride_m = 60.0F;
    g.extinction_per_m = 0.015F;
    g.usual_thickness_m = 350.0F;
    g.apart_m = 580.0F;
    return g;
}

constexpr Genus cirrus() {
    Genus g;
    g.flats = {{{Sheet::kSmooth, turned(3, 1), 0.80F},
                {Sheet::kFibres, turned(4, 1), 1.0F},
                {Sheet::kFibres, turned(15, 4), 0.8F}}};
    g.push = {0.10F, 0.16F};
    g.fines = {{{drawn(23, 7, 3), 1500.0F, 0.08F}, {}}};
    g.lift = {0.0F, 0.20F, 0.0F};
    g.edge = 1.0F;
    g.reach_m = 65.0F;
    g.step_m = 50.0F;
    g.stride_m = 250.0F;
    g.extinction_per_m = 0.0010F;
    g.usual_thickness_m = 1000.0F;
    g.ice = true;
    g.change_m_s = 2.0F;
    return g;
}

constexpr Genus cirrostratus() {
    Genus g = cirrus();
    g.flats[1] = {Sheet::kSmooth, turned(3, 1), 1.0F};
    g.flats[2].weight = 0.30F;
    g.extinction_per_m = 0.0006F;
    return g;
}

constexpr Genus cirrocumulus() {
    Genus g = altocumulus();
    g.flats[1] = {Sheet::kCells, {29, 11, -17, 45}, 1.0F};
    g.reach_m = 28.0F;
    g.stride_m = 40.0F;
    g.extinction_per_m = 0.003F;
    g.usual_thickness_m = 250.0F;
    g.apart_m = 0.0F;
    g.ice = true;
    return g;
}

// Patches some 300 m across, upright from the ground to the top: fog pools, it does not heap. Between full
// and nothing lie some 80 m.
constexpr Genus fog_patches() {
    Genus g;
    g.flats = {{{Sheet::kSmooth, turned(2, 1), 0.30F}, {Sheet::kSmooth, turned(34, 13), 1.0F}, {}}};
    g.push = {0.05F, 0.03F};
    g.edge = 0.3F;
    g.reach_m = 90.0F;
    g.step_m = 10.0F;
    g.stride_m = 40.0F;
    g.step_part = 0.5F;
    g.extinction_per_m = 0.01F;
    g.usual_thickness_m = 50.0F;
    g.covered_part = 0.5F;
    // A gap that a runway lies in is to stay where it is against the drift.
    g.change_m_s = 0.0F;
    g.apart_m = 240.0F;
    return g;
}

constexpr Genus tower() {
    Genus g = cumulonimbus();
    g.lift = {0.30F, 0.40F, 0.0F};
    return g;
}

constexpr std::array<Genus, kGenera> kGenus{tower(),
                                            altocumulus(),
                                            smooth_sheet(5, 0.012F, 1500.0F),
                                            cirrocumulus(),
                                            cirrostratus(),
                                            cirrus(),
                                            cumulonimbus(),
                                            cumulus(),
                                            smooth_sheet(5, 0.04F, 3000.0F),
                                            stratocumulus(),
                                            smooth_sheet(9, 0.05F, 300.0F),
                                            fog_patches()};

// 0..1, of a layer's seed and an octave.
double chance(std::uint32_t seed, std::uint32_t octave) {
    std::uint32_t h = seed * 0x9E3779B9U + octave * 0x85EBCA6BU + 0x27D4EB2FU;
    h = (h ^ (h >> 16)) * 0x7FEB352DU;
    h = (h ^ (h >> 15)) * 0x846CA68BU;
    return static_cast<double>(h ^ (h >> 16)) * 0x1p-32;
}

struct Laid {
    float turn[4];
    float at[2];
};

// In double, for the eye may be far from where the axes begin; only the place inside the tile is kept.
Laid lay(const Turn& turn, double size, double east_m, double north_m, std::uint32_t seed,
         std::uint32_t octave) {
    const double scale = size / kWorld_m;
    const auto place = [&](int x, int y, std::uint32_t axis) {
        const double tiles =
            (x * std::remainder(east_m, kWorld_m) + y * std::remainder(north_m, kWorld_m)) / kWorld_m +
            chance(seed, 2 * octave + axis);
        return static_cast<float>((tiles - std::floor(tiles)) * size);
    };
    return {{static_cast<float>(turn.xx * scale), static_cast<float>(turn.xy * scale),
             static_cast<float>(turn.yx * scale), static_cast<float>(turn.yy * scale)},
            {place(turn.xx, turn.xy, 0), place(turn.yx, turn.yy, 1)}};
}

double tile_m(const Turn& turn) {
    return kWorld_m / std::hypot(turn.yx, turn.yy);
}

Flat flat_of(const Noise& noise, const GenusFlat& told, const Laid& laid) {
    return {noise.sheet(told.sheet).data(),
            {laid.turn[0], laid.turn[1], laid.turn[2], laid.turn[3]},
            {laid.at[0], laid.at[1]},
            told.weight,
            static_cast<float>(tile_m(told.turn) * kFlatWave),
            nullptr,
            0};
}

Flat flat_of(const Texture& texture, const GenusFlat& told, const Laid& laid) {
    // Waves of two texels are gone at a grain of two: a level serves from 1.4 of its texels on.
    const double wave_m = std::numbers::sqrt2 * tile_m(told.turn) / texture.side();
    return {texture.entries().data(),   {laid.turn[0], laid.turn[1], laid.turn[2], laid.turn[3]},
            {laid.at[0], laid.at[1]},   told.weight,
            static_cast<float>(wave_m), texture.starts().data(),
            texture.side_log2()};
}

Fine fine_of(const Noise& noise, const GenusFine& told, const Laid& laid, double risen_m) {
    const double texels = Noise::kBlockSize;
    const double up = risen_m / told.height_m;
    return {noise.block().data(),
            {laid.turn[0], laid.turn[1], laid.turn[2], laid.turn[3]},
            {laid.at[0], laid.at[1]},
            static_cast<float>(texels / told.height_m),
            static_cast<float>((up - std::floor(up)) * texels),
            told.weight,
            static_cast<float>(tile_m(told.turn) * kFineWave)};
}

}  // namespace

const Genus& genus_of(CloudGenus genus) noexcept {
    const auto index = static_cast<std::size_t>(genus);
    return kGenus[index < kGenera ? index : 0];
}

Shape shape_of(const Noise& noise, CloudGenus which, const ShapePlace& place) noexcept {
    const Genus& genus = genus_of(which);
    Shape shape{};
    const std::uint32_t seed = place.seed * 16U + static_cast<std::uint32_t>(which);
    const double moved_m = place.age_s * static_cast<double>(genus.change_m_s);
    for (std::size_t k = 0; k < genus.flats.size(); ++k) {
        // The large shapes stay behind the small ones: that is how clouds grow and go.
        const double behind_m = k == 1 ? 0.0 : moved_m;
        shape.flats[k] = flat_of(noise, genus.flats[k],
                                 lay(genus.flats[k].turn, Noise::kSheetSize, place.east_m + behind_m,
                                     place.north_m + 0.5 * behind_m, seed, static_cast<std::uint32_t>(k)));
    }
    for (std::size_t k = 0; k < genus.fines.size(); ++k) {
        shape.fines[k] = fine_of(noise, genus.fines[k],
                                 lay(genus.fines[k].turn, Noise::kBlockSize, place.east_m, place.north_m,
                                     seed, static_cast<std::uint32_t>(8 + k)),
                                 moved_m);
    }
    shape.fibres = flat_of(noise, genus.fibres,
                           lay(genus.fibres.turn, Noise::kSheetSize, place.east_m, place.north_m, seed, 12));
    for (std::size_t i = 0; i < 2; ++i)
        shape.push[i] = genus.push[i] * static_cast<float>(Noise::kSheetSize);
    for (std::size_t i = 0; i < 3; ++i)
        shape.lift[i] = genus.lift[i];
    shape.edge = genus.edge;
    shape.reach_m = genus.reach_m;
    return shape;
}

Shape shape_of(const Noise& noise, const CloudLook& look, const ShapePlace& place) noexcept {
    Shape shape{};
    for (std::size_t k = 0; k < look.tiles.size(); ++k) {
        const CloudLook::Tile& tile = look.tiles[k];
        const int times = std::clamp(tile.times, 1, 4096);
        const GenusFlat flat{tile.noise, {times, 0, 0, times}, static_cast<float>(tile.weight)};
        const double size = tile.picture ? tile.picture->side() : Noise::kSheetSize;
        const Laid laid =
            lay(flat.turn, size, place.east_m - tile.scroll_m_s.x * place.age_s,
                place.north_m - tile.scroll_m_s.y * place.age_s, place.seed, static_cast<std::uint32_t>(k));
        shape.flats[k] = tile.picture ? flat_of(*tile.picture, flat, laid) : flat_of(noise, flat, laid);
    }
    shape.edge = 1.0F;
    shape.reach_m = 100.0F;
    return shape;
}

}  // namespace skyig::render::cloud::field
