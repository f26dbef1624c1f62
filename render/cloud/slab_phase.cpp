#include <algorithm>
#include <cmath>

#include "render/cloud/slab_light.h"

namespace skyig::render::cloud {

namespace {

// Henyey & Greenstein 1941, in the form that keeps its peak in single precision.
template <class Real>
Real henyey_greenstein(Real g, Real cosine) noexcept {
    const Real base = (Real(1) - g) * (Real(1) - g) + Real(2) * g * (Real(1) - cosine);
    return (Real(1) - g * g) / (base * std::sqrt(base));
}

// Two HG lobes, the backward one as bright as makes their mean cosine g.
template <class Real>
Real two_lobes(Real g, Real cosine) noexcept {
    constexpr Real kForward = Real(0.92);
    constexpr Real kBackward = Real(-0.20);
    const Real back = std::clamp((kForward - g) / (kForward - kBackward), Real(0), Real(1));
    return (Real(1) - back) * henyey_greenstein(kForward, cosine) +
           back * henyey_greenstein(kBackward, cosine);
}

// Jendersie & d'Eon, "An Approximate Mie Scattering Function for Fog and Cloud Rendering", 2023: its four
// constants for droplets of 12 um across. The mean cosine is 0.869 whatever g.
template <class Real>
Real droplets(Real cosine) noexcept {
    constexpr Real kHg = Real(0.990455);
    constexpr Real kDraine = Real(0.566864);
    constexpr Real kAlpha = Real(23.378);
    constexpr Real kDrainePart = Real(0.487418);
    const Real draine = henyey_greenstein(kDraine, cosine) * (Real(1) + kAlpha * cosine * cosine) /
                        (Real(1) + kAlpha * (Real(1) + Real(2) * kDraine * kDraine) / Real(3));
    return (Real(1) - kDrainePart) * henyey_greenstein(kHg, cosine) + kDrainePart * draine;
}

}  // namespace

template <class Real>
Real cloud_phase(CloudPhase phase, Real g, Real cos_scatter) noexcept {
    const Real cosine = std::clamp(cos_scatter, Real(-1), Real(1));
    switch (phase) {
        case CloudPhase::kHenyeyGreenstein:
            break;
        case CloudPhase::kTwoLobes:
            return two_lobes(g, cosine);
        case CloudPhase::kDroplets:
            return droplets(cosine);
    }
    return henyey_greenstein(g, cosine);
}

template float cloud_phase(CloudPhase, float, float) noexcept;
template double cloud_phase(CloudPhase, double, double) noexcept;

}  // namespace skyig::render::cloud
