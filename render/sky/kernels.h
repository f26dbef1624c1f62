// The hot loops over sixteen wavelengths, compiled once per instruction set and chosen at run time. Plain
// data only: a type with inline functions would let the linker mix the instruction sets.
#pragma once

namespace skyig::render::sky {

inline constexpr int kLanes = 16;

/// Light scattered more than once is kept as moments up to this degree.
inline constexpr int kDegrees = 4;
inline constexpr int kMoments = 15;

/// Transfers below this (1/sr; 1e-8 cd/m2 of sunlight) count as darkness.
inline constexpr float kDarkness = 1e-13F;

struct alignas(64) Lanes {
    float v[kLanes];
};

/// Columns of molecules, aerosol and ozone towards a source, as equivalent metres at the reference density,
/// and a factor on its light.
struct Columns {
    float molecules_m;
    float aerosol_m;
    float ozone_m;
    float gain;
};

/// Logarithms of columns and gain over height (rows, quadratic) and over sin(elevation) + sin(dip)
/// (quadratic), four floats each. In a table for sources row 0 is of level ground: its gain makes irradiance.
struct ColumnTable {
    const float* log_m;
    int rows;
    int angles;
    float ground_dip_sine;
    float ground_dip_cosine;
};

/// Light of one or more orders over height (rows, cubic) and sine of the source's elevation (see
/// sine_place()): ln m0 and the other moments over m0, kMoments * kLanes floats a node; and the
/// irradiance of the ground, ln E.
struct MomentTable {
    const float* nodes;
    const float* log_ground;
    int rows;
    int sines;
};

/// Nodes of the moment table over the sine of the source's elevation, quadratic about 0 on both sides.
inline constexpr int kNightNodes = 20;
inline constexpr int kDayNodes = 14;
inline constexpr int kSineNodes = kNightNodes + 1 + kDayNodes;
inline constexpr float kLowestSine = 0.42F;

inline constexpr int kMaxSources = 64;

/// Coefficients per metre by wavelength.
struct Medium {
    Lanes rayleigh;
    Lanes aerosol_extinction;
    Lanes aerosol_scattering;
    // The same less the forward peak of the phase function, which leaves diffuse light nearly as it was.
    Lanes aerosol_diffuse_extinction;
    Lanes aerosol_diffuse_scattering;
    Lanes ozone;
    Lanes albedo_over_pi;
    float chi[kDegrees + 1];  // Legendre moments of the aerosol phase function without its peak
};

/// One step of a path through the air, at its centre of mass. Everything here is independent of the azimuth.
struct PathStep {
    Lanes weight_m;     // transmittance from the eye, integrated over the step
    double eye_part;    // eye radius / radius: sine of source elevation here =
    double along_part;  //   eye_part * (the same at the eye) + along_part * cos(view, source)
    float length_m;
    float molecules;  // mean densities over the step
    float aerosol;
    float ozone;
    float view_sine;   // of the view direction's elevation here
    float column_row;  // places in the tables
    float moment_row;
    float dip_sine;
    float dip_cosine;
};

struct Path {
    PathStep* steps;
    int count;
    bool meets_ground;
    double ground_eye_part;
    double ground_along_part;
    Lanes transmittance;  // over the whole path
};

struct Source {
    double eye_sine;     // of its elevation at the eye
    double view_cosine;  // between view ray and source
    float rayleigh_phase;
};

struct Kernels {
    const char* name;
    /// Fills weight_m and transmittance from lengths and densities.
    void (*weigh)(const Medium& medium, Path& path);
    /// Adds singly scattered light and directly lit ground to `light`, and the integral of what the aerosol
    /// scatters, without its phase function, to `aerosol`.
    void (*add_first_order)(const Medium& medium, const ColumnTable& columns, const Path& path,
                            const Source& source, Lanes& light, Lanes& aerosol);
    /// Adds what the light in `moments` becomes by one more scattering in air or ground, for each of up to
    /// kMaxSources sources around the same path.
    void (*add_higher_orders)(const Medium& medium, const MomentTable& moments, const Path& path,
                              const Source* sources, int count, Lanes* light);
    /// Transmittance towards a source; `above_sine` = sine of its elevation + sine of the dip, below 0 counts
    /// as 0.
    void (*transmit)(const Medium& medium, const ColumnTable& columns, float row, float above_sine,
                     float dip_sine, Lanes& transmittance);
    /// Adds `weight[k]` times the light to `moments[k]`, kMoments of each.
    void (*add_moments)(const float* weight, const Lanes& light, Lanes* moments);
    /// x -> exp(x), relative error < 2e-7 in [-87, 88], clamped outside.
    void (*exponential)(Lanes& x);
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

}  // namespace skyig::render::sky
