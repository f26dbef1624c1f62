// A ray through the shells of a veil, piece by piece from the eye: one text for float and double, as
// shaders/sky/deferred.frag walks too.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "render/shaders/shared.h"

namespace skyig::render::fog {

/// \param segments  from the lowest up, without gaps \param use  (segment, from_m, to_m), nearest first;
/// returns whether to go on
template <class Segment, class Ray, class Real, class Use>
void each_piece(std::span<const Segment> segments, const Ray& ray, Real end_m, Use use) noexcept {
    const auto from_eye = [end_m](Real along_m) { return std::clamp(along_m, Real(0), end_m); };
    if (segments.empty()) return;
    if (ray.sine < Real(0)) {
        Real from_m = from_eye(veil_below_m(segments.back().high_m, ray).x);
        for (std::size_t i = segments.size(); i-- > 0;) {
            const Real to_m = from_eye(veil_below_m(segments[i].low_m, ray).x);
            if (to_m > from_m && !use(segments[i], from_m, to_m)) return;
            from_m = to_m;
        }
    }
    Real from_m = from_eye(veil_below_m(segments.front().low_m, ray).y);
    for (const Segment& segment : segments) {
        const Real to_m = from_eye(veil_below_m(segment.high_m, ray).y);
        if (to_m > from_m && !use(segment, from_m, to_m)) return;
        from_m = to_m;
    }
}

/// The same in pieces short enough for a source that is linear along each: thick ones are cut where 1 and 3
/// of their cut depth lie before.
template <class Segment, class Ray, class Real, class Use>
void each_short_piece(std::span<const Segment> segments, const Ray& ray, Real end_m, Use use) noexcept {
    each_piece(segments, ray, end_m, [&](const Segment& segment, Real from_m, Real to_m) {
        const Real cut = segment.kept * veil_depth(segment, from_m, to_m, ray);
        const Real part_m = (to_m - from_m) / std::max(cut, Real(1e-30));
        for (const Real depth : {Real(1), Real(3)}) {
            if (!(cut > depth)) break;
            const Real at_m = std::min(from_m + (depth == Real(1) ? Real(1) : Real(2)) * part_m, to_m);
            if (!use(segment, from_m, at_m)) return false;
            from_m = at_m;
        }
        return use(segment, from_m, to_m);
    });
}

/// True optical depth. \param sine  of the ray's elevation; what is not finite meets nothing
template <class Segment, class Ray, class Real>
[[nodiscard]] Real depth_along(std::span<const Segment> segments, const Ray& ray, Real end_m) noexcept {
    Real depth = Real(0);
    if (!std::isfinite(ray.sine) || !(end_m > Real(0))) return depth;
    each_piece(segments, ray, end_m, [&](const Segment& segment, Real from_m, Real to_m) {
        depth += veil_depth(segment, from_m, to_m, ray);
        return true;
    });
    return depth;
}

}  // namespace skyig::render::fog
