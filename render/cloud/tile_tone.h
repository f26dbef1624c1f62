// The hot loop that tones a row of a tile, compiled once per instruction set and chosen at run time. Plain
// data only: a type with inline functions would let the linker mix the instruction sets.
#pragma once

namespace skyig::render::cloud {

inline constexpr int kToneRow = 32;

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

/// Smooth over directions. Linear Rec.709.
enum ToneChannel {
    kSky = 0,           ///< luminance of the sky behind the clouds
    kGround = 3,        ///< of the ground behind them
    kExtinction = 6,    ///< of the air between, per metre
    kConvergence = 9,   ///< of endless air like that between
    kNearLight = 12,    ///< of near clouds
    kToneChannels = 15
};

struct ToneRow {
    float light[3][kToneRow];   ///< of clouds, without the air between
    float opacity[kToneRow];    ///< of them; both of far clouds, dimmed by near ones
    float passed[kToneRow];     ///< of all light behind, by all clouds
    float reach_m[kToneRow];    ///< distance times opacity
    float above[kToneRow];      ///< 1 before the sky, 0 before the ground
    float smooth[kToneChannels][kToneRow];
};

struct ToneKernel {
    const char* name;
    /// \param out  kToneRow times red, green, blue and factor: a display code c behind becomes c * factor +
    /// colour
    void (*tone)(const ToneLaw& law, const ToneRow& row, float* out);
    /// shown() of linear Rec.709, in place.
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

}  // namespace skyig::render::cloud
