// The hot loops of impostors, compiled once per instruction set and chosen at run time. Plain data only: a
// type with inline functions would let the linker mix the instruction sets.
#pragma once

#include <cstdint>

namespace skyig::render::cloud::impostor {

/// What a texel of a picture holds, each laid one over the other along the view ray.
enum Channel : int {
    kSunlight,   ///< luminance per illuminance of a plane facing the Sun, 1/sr
    kMoonlight,  ///< the same of the Moon
    kFromAbove,  ///< luminance per luminance of the sky
    kFromBelow,  ///< luminance per luminance of the ground
    kOpacity,    ///< 0..1
    kDepth_m,    ///< beyond the picture's plane, times opacity
    /// Two are spare, so that a texel is one register.
    kChannels = 8,
};

struct alignas(32) Texel {
    float v[kChannels];
};

/// A particle on a picture's plane, in texels.
struct Disc {
    Texel colour;  ///< where it is opaque; its opacity 1
    float centre_x;
    float centre_y;
    float radius;
    float optical_depth;  ///< through the centre
};

inline constexpr int kStampSide = 16;

/// A particle on a light buffer.
struct Stamp {
    const std::uint16_t* mask;  ///< kStampSide^2, 65535 = full
    std::uint16_t opacity;      ///< what is full of it takes away, of 65536
    std::uint16_t gain;         ///< and adds
};

inline constexpr int kBatch = 16;

/// Particles from the eye, as many as make whole batches.
struct SphereTable {
    const float* x;
    const float* y;
    const float* z;
    const float* gap;  ///< squared distance less squared radius
    int batches;
};

struct Kernels {
    const char* name;
    /// \param corner  of the stamp in the buffer
    void (*dim)(std::uint16_t* corner, int stride, const Stamp& stamp);
    /// Over what is there. Texels outside the picture are left out.
    void (*splat)(const Disc& disc, Texel* picture, int width, int height);
    /// half2[i]: squared half of the way of a ray (three floats) through sphere i, below 0 where it misses.
    /// \param any  of each batch: the largest
    void (*halves)(const SphereTable& spheres, const float* ray, float* half2, float* any);
    /// Between four texels, at (x, y) in 0..1 from the first. \param weight  of the answer, added to `sum`
    void (*add)(const Texel* corner, int stride, float x, float y, float weight, Texel& sum);
};

/// The fastest variant that this processor runs.
[[nodiscard]] const Kernels& kernels() noexcept;

namespace portable {
[[nodiscard]] const Kernels& kernels() noexcept;
}
namespace avx2 {
[[nodiscard]] const Kernels& kernels() noexcept;
}

}  // namespace skyig::render::cloud::impostor
