// Light in a cloud: what a plane, homogeneous slab sends up and down, by every model we have, and the same
// light at a point inside, for who marches through cloud of any shape. Facts and errors:
// docs/accuracy/cloud.md.
//
// mu is the cosine of a direction's angle with the vertical, cos_scatter that of the scattering angle: 1
// where light goes straight on; towards the Sun it is dot(view ray, direction to the Sun). Optical depths are
// true ones. Every function takes any finite argument, and gives finite values >= 0.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace skyig::render::cloud {

enum class SlabModel : std::uint8_t {
    kLayer,           ///< seed 001: opacity and self-shadow exponential, no direction
    kLayerQuadratic,  ///< the same with its cheap powers
    kOneSample,       ///< seed 004: density differs towards the light
    kParticles,       ///< seed 003: light handed on from particle to particle
    kSingle,          ///< light scattered once
    kOctaves,         ///< Wrenninge 2013, 8 octaves
    kEddington,       ///< fluxes spread evenly
    kTms,             ///< light scattered once past a cut forward peak, and Eddington's remainder
    kTable,           ///< the same with the remainder from an adding-doubling solution: the default
    kMarch,           ///< CloudScatter integrated along the view ray: what volumes draw
};
inline constexpr std::size_t kSlabModels = 10;
/// By SlabModel.
inline constexpr std::array<std::string_view, kSlabModels> kSlabModelNames{
    "layer",   "layer-quadratic", "one-sample", "particles", "single",
    "octaves", "eddington",       "tms",        "table",     "march"};

template <class Real>
struct BasicSlab {
    /// >= 0
    Real optical_depth = Real(0);
    /// Mean cosine of scattering, 0.7..0.9.
    Real g = Real(0.85);
    /// For one scattering, 0.99..1.
    Real albedo = Real(1);
};
using Slab = BasicSlab<float>;
using Slab64 = BasicSlab<double>;

/// How light is scattered once; mean cosine g whatever the shape.
enum class CloudPhase : std::uint8_t {
    kHenyeyGreenstein,
    kTwoLobes,  ///< HG 0.92 and -0.20, mixed for the mean: brighter rims and backs
    kDroplets,  ///< HG and Draine, Jendersie & d'Eon 2023, droplets of 12 um: silver lining
};

/// pi L / (mu0 F0) of the light that leaves the slab's top (`above`) or its base, over black ground; the
/// source's own beam left out. \param mu0  of the source, > 0 \param mu  of the view ray, > 0
template <class Real>
[[nodiscard]] Real slab_brf(SlabModel model, const BasicSlab<Real>& slab, bool above, Real mu0, Real mu,
                            Real cos_scatter) noexcept;

/// Parts of the flux mu0 F0 that falls on the slab, over black ground.
template <class Real>
struct SlabFluxes {
    Real transmitted{};  ///< scattered and direct
    Real reflected{};
    Real direct{};
};
template <class Real>
[[nodiscard]] SlabFluxes<Real> slab_fluxes(const BasicSlab<Real>& slab, Real mu0) noexcept;
/// The same of light that comes evenly from all directions of one side; `direct` went past all droplets.
template <class Real>
[[nodiscard]] SlabFluxes<Real> slab_fluxes_diffuse(const BasicSlab<Real>& slab) noexcept;

/// Of all the cloud in the scene.
struct CloudOptics {
    float g = 0.85F;
    float albedo = 1.0F;
    CloudPhase phase = CloudPhase::kHenyeyGreenstein;
};

/// How much cloud a point has round it, true optical depths >= 0. In a plane slab `towards_source` is above /
/// mu0; elsewhere whatever the cloud's shape makes of it.
struct CloudPoint {
    float towards_source = 0.0F;
    float above = 0.0F;
    float below = 0.0F;
};

/// Parts of even light from above and from below that reach a point, 0..1; their sum is 1 without
/// absorption. Times those luminances: light that the point sends to everywhere.
struct CloudAmbient {
    float from_above = 0.5F;
    float from_below = 0.5F;
};

/// One parallel source on cloud of one kind; made once a frame.
///
/// A marcher's step of optical depth d (front to back, `seen` begins as 1):
///     const float opacity = 1 - std::exp(-d);
///     light += seen * opacity * (beam_lx * ray.source(point) +
///                                ambient.from_above * above_cd_m2 + ambient.from_below * below_cd_m2);
///     seen *= 1 - opacity;
/// and `seen` is what is left of anything behind.
class CloudScatter {
  public:
    /// \param mu0  of the direction to the source, -1..1: below 0 it lights the clouds from below.
    explicit CloudScatter(float mu0 = 1.0F, const CloudOptics& optics = {}) noexcept;

    /// What is the same along one view ray.
    class Ray {
      public:
        /// Radiance sent towards the eye, of optically thick cloud of this sort, per illuminance of a plane
        /// that faces the source, 1/sr.
        [[nodiscard]] float source(const CloudPoint& point) const noexcept;

      private:
        friend class CloudScatter;
        const CloudScatter* scatter_ = nullptr;
        float once_ = 0.0F;
        float twice_ = 0.0F;
        float peak_ = 0.0F;
        float mu_ = 0.0F;
        std::array<float, 2> by_g_{};  // shares of the tables, and where in them the view lies
        std::size_t view_ = 0;
        float view_part_ = 0.0F;
        float cosine_ = 1.0F;
    };
    /// \param mu_view  of the direction in which the light travels, -1..1: > 0 when the eye is above, that
    /// is minus the view ray's z \param cos_scatter  dot(view ray, direction to the source). Refers to this.
    [[nodiscard]] Ray ray(float mu_view, float cos_scatter) const noexcept;

    [[nodiscard]] CloudAmbient ambient(const CloudPoint& point) const noexcept;

  private:
    CloudOptics optics_;
    float mu0_ = 1.0F;
    bool from_below_ = false;
    float transport_ = 0.15F;
    float absorption_ = 0.0F;
};

/// Source function of a slab's point under `depth_above`, pi S / (mu0 F0), as CloudScatter has it: integrated
/// over the optical depth along the view ray it gives slab_brf. \param mu_view  > 0 where the light goes up
[[nodiscard]] float slab_source(const Slab& whole, float depth_above, float mu0, float mu_view,
                                float cos_scatter) noexcept;

/// Mean 1 over the sphere.
template <class Real>
[[nodiscard]] Real cloud_phase(CloudPhase phase, Real g, Real cos_scatter) noexcept;

}  // namespace skyig::render::cloud
