// Warps of known geometry, for the tests that draw through them.
#pragma once

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <memory>

#include "render/channel.h"
#include "render/warp/warp.h"
#include "tests/render/scenes.h"

namespace skyig::render::tests {

/// A mesh of what a function of the screen's place says.
inline warp::Mesh mesh_of(int columns, int rows, const std::function<glm::dvec2(glm::dvec2)>& picture_of) {
    warp::Mesh mesh{columns, rows, false, {}};
    for (int i = 0; i < columns * rows; ++i) {
        const glm::dvec2 screen{(i % columns + 0.5) / columns, (i / columns + 0.5) / rows};
        mesh.picture.emplace_back(picture_of(screen));
    }
    return mesh;
}

/// A cylinder about the eye, upright, whose rows are level circles and whose columns stand at even angles.
struct CurvedScreen {
    double half_azimuth_rad = 30.0 * kDegree;
    double half_height = 0.42;  // of its radius

    /// Of a place of the screen, in the view frame.
    [[nodiscard]] glm::dvec3 direction(const glm::dvec2& screen) const {
        const double azimuth = (2.0 * screen.x - 1.0) * half_azimuth_rad;
        return glm::normalize(
            glm::dvec3{std::sin(azimuth), (2.0 * screen.y - 1.0) * half_height, -std::cos(azimuth)});
    }
    /// The least that holds all of it.
    [[nodiscard]] Frustum frustum() const {
        const double top = std::atan(half_height / std::cos(half_azimuth_rad));
        return {-half_azimuth_rad, half_azimuth_rad, -top, top};
    }
    [[nodiscard]] glm::dvec2 picture_of(const glm::dvec2& screen) const {
        const ImagePlane plane = image_plane(frustum());
        const glm::dvec3 d = direction(screen);
        return {(d.x / -d.z - plane.left) / (plane.right - plane.left),
                (d.y / -d.z - plane.bottom) / (plane.top - plane.bottom)};
    }
    [[nodiscard]] std::shared_ptr<const warp::Warp> warp(int width_px, int height_px, int columns = 65,
                                                         int rows = 49) const {
        return std::make_shared<warp::Warp>(
            mesh_of(columns, rows, [&](const glm::dvec2& at) { return picture_of(at); }), width_px,
            height_px);
    }
};

inline std::shared_ptr<const warp::Warp> identity_warp(int width_px, int height_px) {
    return std::make_shared<warp::Warp>(mesh_of(33, 25, [](const glm::dvec2& at) { return at; }), width_px,
                                        height_px);
}

}  // namespace skyig::render::tests
