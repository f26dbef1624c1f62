#include "render/cloud/map_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace skyig::render::cloud {

MapGeometry::Texel MapGeometry::corner(int tile) const noexcept {
    const int across = tiles_across();
    const int in_square = tile % (across * across);
    return {in_square % across * kTile, in_square / across * kTile, tile >= across * across};
}

glm::vec3 MapGeometry::direction(double column, double row, bool lower) const noexcept {
    const double scale = 2.0 / (size_ - 1);
    const glm::dvec3 upper = shaders64::cloud_map_direction({column * scale - 1.0, row * scale - 1.0});
    return glm::vec3{upper.x, upper.y, lower ? -upper.z : upper.z};
}

Cone MapGeometry::cone(const Texel& at, int side) const noexcept {
    // One texel more on each side: what is interpolated, and the step to the next tile.
    const auto place = [&](int step) { return -1.0 + (side + 1) * 0.25 * step; };
    std::array<glm::dvec3, 25> around{};
    glm::dvec3 sum{0.0};
    for (int i = 0; i < 25; ++i) {
        around[static_cast<std::size_t>(i)] =
            glm::normalize(glm::dvec3{direction(at.column + place(i % 5), at.row + place(i / 5), at.lower)});
        sum += around[static_cast<std::size_t>(i)];
    }
    Cone cone{glm::normalize(sum), 1.0, 0.0};
    for (const glm::dvec3& direction : around)
        cone.cosine = std::min(cone.cosine, glm::dot(cone.axis, direction));
    // Between the nodes that were tried a tile may stand out by a little.
    const double angle_rad = 1.02 * std::acos(cone.cosine);
    cone.cosine = std::cos(angle_rad);
    cone.sine = std::sin(angle_rad);
    return cone;
}

Corners MapGeometry::corners(int tile) const noexcept {
    const Texel at = corner(tile);
    Corners corners;
    for (int i = 0; i < 4; ++i) {
        const double column = at.column + (i % 2 == 0 ? -1.0 : kTile + 0.0);
        const double row = at.row + (i / 2 == 0 ? -1.0 : kTile + 0.0);
        corners[static_cast<std::size_t>(i)] = glm::normalize(glm::dvec3{direction(column, row, at.lower)});
    }
    return corners;
}

int map_size_for(double pixel_rad, std::span<const ChannelView> views) noexcept {
    double seen_sr = 0.0;
    for (const ChannelView& view : views) {
        if (!has_area(view.frustum)) continue;
        const ImagePlane p = image_plane(view.frustum);
        const auto corner = [](double x, double y) {
            return std::atan2(x * y, std::sqrt(1.0 + x * x + y * y));
        };
        seen_sr += corner(p.right, p.top) - corner(p.left, p.top) - corner(p.right, p.bottom) +
                   corner(p.left, p.bottom);
    }
    const double share = std::min(seen_sr / (4.0 * std::numbers::pi), 1.0);
    int size = kLeastMap;
    // The least map is coarse to look at: edges of clouds are stairs in it sooner.
    while (size < kLargestMap &&
           MapGeometry(size).worst_texel_rad() > (size == kLeastMap ? 2.5 : 4.0) * pixel_rad)
        size *= 2;
    while (size > kLeastMap && share * static_cast<double>(MapGeometry(size).texel_count()) > kMostSeenTexels)
        size /= 2;
    return size;
}

namespace {

// Normals of a frustum's sides, into it.
std::array<glm::dvec3, 4> sides_of(const ImagePlane& p) noexcept {
    return {{{1.0, 0.0, p.left}, {-1.0, 0.0, -p.right}, {0.0, 1.0, p.bottom}, {0.0, -1.0, -p.top}}};
}

}  // namespace

bool sees(const ChannelView& view, const Cone& cone, double margin_rad) noexcept {
    if (!has_area(view.frustum)) return false;
    const ImagePlane p = image_plane(view.frustum);
    const glm::dvec3 axis = view.view_from_enu * cone.axis;
    const double angle_rad = std::atan2(cone.sine, cone.cosine) + margin_rad;
    if (angle_rad >= 0.5 * std::numbers::pi) return true;
    const double reach = std::sin(angle_rad);
    const auto sides = sides_of(p);
    return std::all_of(sides.begin(), sides.end(), [&](const glm::dvec3& side) {
        return glm::dot(axis, side) > -reach * glm::length(side);
    });
}

bool sees(std::span<const ChannelView> views, const Cone& cone, double margin_rad) noexcept {
    return std::any_of(views.begin(), views.end(),
                       [&](const ChannelView& view) { return sees(view, cone, margin_rad); });
}

bool sees(std::span<const ChannelView> views, const Corners& corners) noexcept {
    // Sides between corners bend outwards by less than this.
    constexpr double kBulge = 0.002;
    return std::any_of(views.begin(), views.end(), [&](const ChannelView& view) {
        if (!has_area(view.frustum)) return false;
        const auto sides = sides_of(image_plane(view.frustum));
        return std::all_of(sides.begin(), sides.end(), [&](const glm::dvec3& side) {
            const glm::dvec3 side_enu = glm::transpose(view.view_from_enu) * side;
            return std::any_of(corners.begin(), corners.end(), [&](const glm::dvec3& corner) {
                return glm::dot(corner, side_enu) > -kBulge * glm::length(side);
            });
        });
    });
}

}  // namespace skyig::render::cloud
