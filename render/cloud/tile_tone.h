// The hot loops that make a tile of the map what is shown, compiled once per instruction set and chosen at
// run time. Plain data only: a type with inline functions would let the linker mix the instruction sets.
#pragma once

#include "render/cloud/shadow_cells.h"

namespace skyig::render::cloud {

inline constexpr int kToneRow = 32;
/// What is smooth over directions is known at nodes: so many on a tile's side, its neighbours' first with
/// them, kToneStep texels apart.
inline constexpr int kToneNodes = 5;
inline constexpr int kToneStep = 8;
/// Their rows follow each other; what fills up a register is not used.
inline constexpr int kNodeFloats = 32;

/// ToneParameters of shaders/eye/tone.glsl, for the fast form of shown() that the loop has: the same within
/// 0.02 display codes.
struct ToneLaw {
    float log2_gain;
    float exponent;
    float compression;
    float burn;
    float photopic;
    float inv_display_max;
    float ambient;
    float shoulder;
    float encode_power;
};

/// Smooth over directions. Linear Rec.709, but for codes.
enum ToneChannel {
    kBehind = 0,       ///< luminance of what is behind the clouds
    kExtinction = 3,   ///< of the air between, per metre
    kConvergence = 6,  ///< of endless air like that between
    kNearLight = 9,    ///< of near clouds, with the air before them
    kBehindCode = 12,  ///< kBehind as it is shown
    kToneChannels = 15
};

/// A snapshot of far clouds and how it is seen. \see Snapshot, which holds the texels
struct TonePart {
    const float* light;    ///< of the map, four floats a texel: linear Rec.709, transmittance
    const float* reach_m;  ///< distance times opacity
    float weight;
    float offset_m[3];  ///< of the present eye
    bool beyond_near;
    float inverse_m[kNodeFloats];  ///< Snapshot::inverse_distance()
};

/// Where the octahedron folds: along a diagonal of its square, which tiles on it have as theirs.
enum class Fold { kNone, kFalling, kRising };

struct ToneTile {
    int map_size;
    int column, row;  ///< of the first texel, in its square
    bool lower;
    Fold fold;
    /// Where the ground shows: below the horizon.
    bool horizon;
    float horizon_sine;
    bool near;                  ///< near clouds are there
    bool codes;                 ///< kBehindCode is told
    bool clear;                 ///< no clouds are seen: shadows alone
    const ShadowCells* shadow;  ///< null: no shadows on the ground
    bool depths;                ///< near_passed and inverse_per_m of rows are wanted
    float smooth[kToneChannels][kNodeFloats];
    float ground[3][kNodeFloats];       ///< in the place of kBehind
    float ground_code[3][kNodeFloats];  ///< of kBehindCode
    float sunlit[3][kNodeFloats];       ///< of the ground under all of the beam that casts shadows
    float near_passed[kNodeFloats];
    TonePart parts[2];
    int part_count;
};

struct ToneRow {
    float light[3][kToneRow];  ///< of clouds, without the air between
    float opacity[kToneRow];   ///< of them; both of far clouds, dimmed by near ones
    float passed[kToneRow];    ///< of all light behind, by all clouds
    float reach_m[kToneRow];   ///< distance times opacity
    float smooth[kToneChannels][kToneRow];
    float near_passed[kToneRow];    ///< of `passed`, by near clouds
    float inverse_per_m[kToneRow];  ///< over the distance of far ones, smooth where there are none
    /// What shadows and gaps add to what is behind, not told in kBehind.
    float shade[3][kToneRow];
};

struct ToneKernel {
    const char* name;
    /// What of its parts a tile's row is to show.
    void (*gather)(const ToneTile& tile, int row, ToneRow& out);
    /// \param codes  whether kBehindCode is told; else it is worked out
    /// \param out  kToneRow times red, green, blue and factor: a display code c behind becomes c * factor +
    /// colour
    void (*tone)(const ToneLaw& law, const ToneRow& row, bool codes, float* out);
    /// \param out  kToneRow times what is seen of the clouds with the air between, red, green, blue, and
    /// `passed`
    void (*seen)(const ToneRow& row, float* out);
    /// A row, as tone() has it, of what nothing is seen behind. \param codes  red, green, blue at nodes
    void (*cover)(const float (*codes)[kNodeFloats], Fold fold, int row, float* out);
    /// Largest step of a component from a texel to its neighbours. \param texels  kToneRow rows as tone() has
    /// them
    float (*largest_step)(const float* texels);
    /// shown() of linear Rec.709, kNodeFloats of each, in place.
    void (*show)(const ToneLaw& law, float* red, float* green, float* blue);
};

/// The fastest variant that this processor runs.
[[nodiscard]] const ToneKernel& tone_kernel() noexcept;

namespace portable {
[[nodiscard]] const ToneKernel& tone_kernel() noexcept;
}
namespace avx2 {
[[nodiscard]] const ToneKernel& tone_kernel() noexcept;
}
namespace avx512 {
[[nodiscard]] const ToneKernel& tone_kernel() noexcept;
}

}  // namespace skyig::render::cloud
