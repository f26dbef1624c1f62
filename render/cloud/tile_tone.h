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
    kBehind = 0,       ///< luminance of what is behind the clouds
    kExtinction = 3,   ///< of the air between, per metre
    kConvergence = 6,  ///< of endless air like that between
    kNearLight = 9,    ///< of near clouds
    kToneChannels = 12
};

struct ToneRow {
    float light[3][kToneRow];  ///< of clouds, without the air between
    float opacity[kToneRow];   ///< of them; both of far clouds, dimmed by near ones
    float passed[kToneRow];    ///< of all light behind, by all clouds
    float reach_m[kToneRow];   ///< distance times opacity
    float smooth[kToneChannels][kToneRow];
    float near_passed[kToneRow];    ///< of it, by near clouds
    float inverse_per_m[kToneRow];  ///< over the distance of far ones, smooth where there are none
    float shade[3][kToneRow];       ///< what shadows and gaps add to what is behind, not told in kBehind
};

struct ToneKernel {
    const char* name;
    /// \param code  kBehind as it is shown, kToneRow times red, then green and blue; null: it is worked out
    /// \param out  kToneRow times red, green, blue and factor: a display code c behind becomes c * factor +
    /// colour
    void (*tone)(const ToneLaw& law, const ToneRow& row, const float* code, float* out);
    /// \param out  kToneRow times what is seen of the clouds, red, green, blue, and `passed`
    void (*seen)(const ToneRow& row, float* out);
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
