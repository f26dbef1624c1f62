#include "render/rig_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skyig::render {
namespace {

/// Corners of a convex polygon on the sphere, clockwise as seen from its middle.
using Polygon = std::vector<glm::dvec3>;

/// Nearer to a side than this counts as on it: an edge that two channels share is no overlap.
constexpr double kOnSide_rad = 1e-9;

double angle_rad(const glm::dvec3& a, const glm::dvec3& b) noexcept {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

Polygon outline(const ChannelView& view) {
    const ImagePlane plane = image_plane(view.frustum);
    const glm::dmat3 world_from_view = glm::transpose(view.view_from_enu);
    const auto corner = [&](double x, double y) {
        return world_from_view * glm::normalize(glm::dvec3{x, y, -1.0});
    };
    return {corner(plane.left, plane.bottom), corner(plane.left, plane.top), corner(plane.right, plane.top),
            corner(plane.right, plane.bottom)};
}

/// The inner normal of the side from corner i to the next.
glm::dvec3 side(const Polygon& polygon, std::size_t i) noexcept {
    return glm::normalize(glm::cross(polygon[i], polygon[(i + 1) % polygon.size()]));
}

/// Van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125, over a fan of triangles.
double solid_angle_sr(const Polygon& polygon) noexcept {
    double sum_sr = 0.0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
        const double volume = std::abs(glm::dot(a, glm::cross(b, c)));
        sum_sr += 2.0 * std::atan2(volume, 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
    }
    return sum_sr;
}

/// What of a polygon lies on the side of a great circle that its normal points to (Sutherland and Hodgman).
Polygon clipped(const Polygon& polygon, const glm::dvec3& normal) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double at_a = glm::dot(a, normal), at_b = glm::dot(b, normal);
        if (at_a >= -kOnSide_rad) kept.push_back(a);
        if ((at_a > kOnSide_rad && at_b < -kOnSide_rad) || (at_a < -kOnSide_rad && at_b > kOnSide_rad))
            kept.push_back(glm::normalize(a * std::abs(at_b) + b * std::abs(at_a)));
    }
    if (kept.size() < 3) kept.clear();
    return kept;
}

Polygon intersection(Polygon polygon, const Polygon& other) {
    for (std::size_t i = 0; i < other.size() && !polygon.empty(); ++i)
        polygon = clipped(polygon, side(other, i));
    return polygon;
}

/// What of a polygon lies outside another, in convex pieces.
void append_outside(Polygon rest, const Polygon& other, std::vector<Polygon>& pieces) {
    for (std::size_t i = 0; i < other.size() && !rest.empty(); ++i) {
        const glm::dvec3 normal = side(other, i);
        Polygon outside = clipped(rest, -normal);
        if (!outside.empty()) pieces.push_back(std::move(outside));
        rest = clipped(rest, normal);
    }
}

double union_sr(const std::vector<Polygon>& outlines) {
    double sum_sr = 0.0;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        std::vector<Polygon> pieces{outlines[i]};
        for (std::size_t j = 0; j < i; ++j) {
            std::vector<Polygon> left;
            for (const Polygon& piece : pieces)
                append_outside(piece, outlines[j], left);
            pieces = std::move(left);
        }
        for (const Polygon& piece : pieces)
            sum_sr += solid_angle_sr(piece);
    }
    return sum_sr;
}

bool between(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) noexcept {
    const glm::dvec3 normal = glm::cross(a, b);
    return glm::dot(glm::cross(normal, a), point) >= 0.0 && glm::dot(glm::cross(b, normal), point) >= 0.0;
}

/// How far a polygon reaches from a great circle, as a sine: an edge bulges beyond its ends.
double reach(const Polygon& polygon, const glm::dvec3& normal) noexcept {
    double farthest = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        farthest = std::max(farthest, glm::dot(a, normal));
        if (angle_rad(a, b) < kOnSide_rad) continue;
        const glm::dvec3 edge = glm::normalize(glm::cross(a, b));
        const glm::dvec3 bulge = normal - edge * glm::dot(normal, edge);
        if (glm::length(bulge) > kOnSide_rad && between(bulge, a, b))
            farthest = std::max(farthest, glm::length(bulge));
    }
    return std::min(1.0, farthest);
}

/// Of all the sides that it may be laid against, the one that it reaches least from.
double breadth_rad(const Polygon& polygon) noexcept {
    double narrowest_rad = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        // A cut through a corner leaves an edge without a length, which has no direction.
        if (angle_rad(polygon[i], polygon[(i + 1) % polygon.size()]) < kOnSide_rad) continue;
        narrowest_rad = std::min(narrowest_rad, std::asin(reach(polygon, side(polygon, i))));
    }
    return std::isfinite(narrowest_rad) ? narrowest_rad : 0.0;
}

double distance_rad(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) noexcept {
    const glm::dvec3 normal = glm::normalize(glm::cross(a, b));
    if (between(point, a, b)) return std::abs(std::asin(glm::clamp(glm::dot(normal, point), -1.0, 1.0)));
    return std::min(angle_rad(point, a), angle_rad(point, b));
}

/// Of two that have nothing in common.
double gap_rad(const Polygon& a, const Polygon& b) noexcept {
    double smallest_rad = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j) {
            smallest_rad = std::min(smallest_rad, distance_rad(a[i], b[j], b[(j + 1) % b.size()]));
            smallest_rad = std::min(smallest_rad, distance_rad(b[j], a[i], a[(i + 1) % a.size()]));
        }
    }
    return smallest_rad;
}

double pixel_rad(const Channel& channel, const Frustum& frustum, const glm::dvec2& at_px) noexcept {
    const auto looking = [&](double dx, double dy) {
        return view_direction(channel, frustum, at_px.x + dx, at_px.y + dy);
    };
    return std::max(angle_rad(looking(-0.5, 0.0), looking(0.5, 0.0)),
                    angle_rad(looking(0.0, -0.5), looking(0.0, 0.5)));
}

ChannelField field_of(const Channel& channel, const Frustum& frustum, const Polygon& outline) {
    ChannelField field;
    field.across_rad = frustum.right_rad - frustum.left_rad;
    field.upright_rad = frustum.top_rad - frustum.bottom_rad;
    field.solid_angle_sr = solid_angle_sr(outline);
    const double right_px = channel.width_px - 0.5, top_px = channel.height_px - 0.5;
    field.centre_pixel_rad = pixel_rad(channel, frustum, {0.5 * channel.width_px, 0.5 * channel.height_px});
    field.corner_pixel_rad = {
        pixel_rad(channel, frustum, {0.5, 0.5}), pixel_rad(channel, frustum, {right_px, 0.5}),
        pixel_rad(channel, frustum, {0.5, top_px}), pixel_rad(channel, frustum, {right_px, top_px})};
    return field;
}

ChannelPair pair_of(const std::vector<Polygon>& outlines, std::size_t first, std::size_t second) {
    ChannelPair pair{.first = first, .second = second};
    const Polygon both = intersection(outlines[first], outlines[second]);
    if (!both.empty()) {
        pair.overlap_sr = solid_angle_sr(both);
        pair.overlap_rad = breadth_rad(both);
    } else {
        pair.gap_rad = gap_rad(outlines[first], outlines[second]);
    }
    return pair;
}

}  // namespace

RigField rig_field(std::span<const Channel> channels, std::span<const ChannelView> views) {
    RigField rig;
    std::vector<Polygon> outlines;
    for (const ChannelView& view : views)
        outlines.push_back(outline(view));
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        rig.channels.push_back(field_of(channels[i], views[i].frustum, outlines[i]));
        for (std::size_t j = i + 1; j < outlines.size(); ++j)
            rig.pairs.push_back(pair_of(outlines, i, j));
    }
    rig.solid_angle_sr = union_sr(outlines);
    return rig;
}

}  // namespace skyig::render
