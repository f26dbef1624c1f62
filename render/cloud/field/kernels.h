// The march through the cloud field, compiled once per instruction set and chosen at run time. Plain data
// only: a type with inline functions would let the linker mix the instruction sets.
#pragma once

namespace skyig::render::cloud::field {

/// One look-up in a flat tile (noise.h, texture.h): texel places are turn * (east, north) + at. Values are
/// -0.5..0.5.
struct Flat {
    const unsigned* sheet;
    float turn[4];  // xx, xy, yx, yy; texels a metre
    float at[2];    // of the eye, texels
    float weight;
    float wave_m;            // its finest feature
    const unsigned* starts;  // of a Texture's levels; null: noise
    int side_log2;           // likewise
};

/// One look-up in the solid tile.
struct Fine {
    const unsigned* block;
    float turn[4];
    float at[2];
    float rise;       // texels a metre of height over the layer's base
    float at_height;  // texels
    float weight;
    float wave_m;
};

/// Where the air of a layer is cloudy: where the value flats + fines - lift(q) exceeds a threshold; q is the
/// height from base (0) to top (1).
struct Shape {
    Flat flats[3];  // the first is the largest, and pushes the others about
    float push[2];  // texels of flats[1] per value of flats[0]
    Fine fines[2];
    Flat fibres;    // added high in the layer: an anvil's
    float lift[3];  // of q, q^2, q^3
    float edge;     // the value over the threshold at which density is full
    float reach_m;  // how far from cloud a value of -1 lies at least, along the ground
};

/// A rounded rectangle (WeatherArea); inside == 1 everywhere if perimeter_m < 0.
struct Area {
    float centre_m[2];
    float axis[2];  // unit, east and north
    float half_m[2];
    float corner_m;
    float perimeter_m;
    float closing;  // of SeaAnchor: what the field's axes gain on true east
};

/// Light on a layer: at its base, and what is added up to its top.
struct Shine {
    float base[3];
    float gain[3];
};

struct LayerBeam {
    bool lit;
    float direction[3];  // towards the source
    float along[2];      // the same on the field's axes
    Shine lx;
};

inline constexpr int kBeams = 2;

/// InsideTable's axes (inside_light.h), the last one fastest; two entries a node.
inline constexpr int kSlabViews = 11;
inline constexpr int kSlabSources = 7;
inline constexpr int kSlabDepths = 10;
inline constexpr int kSlabPlaces = 9;
struct SlabNodes {
    const unsigned* entries;
    float low[4];
    float step[4];
};

struct Layer {
    Shape shape;
    bool sheet;         // seed 001: one look, no march
    bool slab_lit;      // a sheet in the light of the slab models, not of the seed
    float self_shadow;  // of a sheet
    float threshold;
    float dry;  // added to the threshold where the area ends
    float base_m;
    float thickness_m;
    float bottom_band_m;
    float top_band_m;
    float bottom_scud;
    float top_scud;
    float extinction_per_m;
    float lift_per_m;  // at most
    float look_m;      // first and shortest part of the way that is looked along towards a source
    Area area;
    float g;
    SlabNodes inside;
    LayerBeam beams[kBeams];
    Shine above_cd_m2;
    Shine below_cd_m2;
};

inline constexpr int kMostLayers = 16;

/// Lengths of the cells that the way from the eye is cut into: least_m up to near_m, where cell `near`
/// begins; from there rate times the way, up to far_m and cell `far`; then most_m.
struct Cells {
    float least_m, rate, most_m;
    float near_m, near;
    float far_m, far;
};

/// Layers that overlap in height, marched together: layers[first] .. layers[first + count - 1].
struct Deck {
    int first;
    int count;
    float low_m;
    float high_m;
    Cells cells;
};

struct Field {
    float eye_m;     // height
    float ground_m;  // height at which rays end
    float closing;   // of SeaAnchor
    Layer layers[kMostLayers];
    Deck decks[kMostLayers];  // by height
    int deck_count;
};

/// As many as one call follows.
inline constexpr int kRays = 64;
struct alignas(64) Rays {
    float direction[3][kRays];
    float light[3][kRays];
    float transmittance[kRays];
    float distance_m[kRays];
    int count;
    float from_m;
    float to_m;
    float ray_rad;
};

/// Places on the ground that a source's beam comes to, on the field's axes, and what is left of it.
struct alignas(64) Shade {
    float east_m[kRays];
    float north_m[kRays];
    float passed[kRays];
    int count;
    float direction[3];  // towards the source, which stands above the horizon
    float along[2];      // the same on the field's axes
    float grain_m;       // what is finer does not show
    float spread_rad;    // of the source's disc
};

/// The part of a ray between two heights, on its way down or up; empty if to <= from.
struct alignas(64) Parts {
    float sine[kRays];  // of the ray's elevation
    float from_m[kRays];
    float to_m[kRays];
};

struct alignas(64) Points {
    float east_m[kRays];
    float north_m[kRays];
    float height_m[kRays];  // over the layer's base
    float value[kRays];
};

/// What light at a point depends on (slab_light.h: CloudPoint and CloudScatter::Ray).
struct alignas(64) Sources {
    float towards[kRays];
    float above[kRays];
    float below[kRays];
    float sent[kRays];
};

struct Kernels {
    const char* name;
    /// Fills light, transmittance and distance of the first `count` rays.
    void (*march)(const Field& field, Rays& rays);
    /// Fills what is left of the beam at the first `count` places.
    void (*shade)(const Field& field, Shade& shade);
    void (*parts)(float eye_m, float low_m, float high_m, bool rising, Parts& parts);
    /// Fills the values of a shape whose layer is this thick, all octaves at full weight.
    void (*values)(const Shape& shape, float thickness_m, Points& points);
    /// CloudScatter::Ray::source of clouds of this g that do not absorb.
    void (*sources)(const SlabNodes& inside, float g, float mu0, float mu_view, float cos_scatter,
                    Sources& sources);
};

/// The fastest variant that this processor runs.
[[nodiscard]] const Kernels& kernels() noexcept;

namespace portable {
[[nodiscard]] const Kernels& kernels() noexcept;
}
namespace avx2 {
[[nodiscard]] const Kernels& kernels() noexcept;
}
namespace avx512 {
[[nodiscard]] const Kernels& kernels() noexcept;
}

}  // namespace skyig::render::cloud::field
