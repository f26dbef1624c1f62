// What the dome's mesh shows of a direction, without GL.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>

#include "render/dome.h"

namespace skyig::render::tests {

/// Colour of the flat triangle that a direction pierces, as the rasteriser interpolates it; false if none is
/// hit.
inline bool drawn_colour(const Dome& dome, const glm::dvec3& direction, glm::dvec3& colour) {
    const auto vertices = dome.vertices();
    const auto indices = dome.indices();
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const glm::dvec3 a{vertices[indices[i]].direction};
        const glm::dvec3 b{vertices[indices[i + 1]].direction};
        const glm::dvec3 c{vertices[indices[i + 2]].direction};
        const glm::dmat3 corners{a, b, c};
        const double determinant = glm::determinant(corners);
        if (std::abs(determinant) < 1e-14) continue;
        const glm::dvec3 w = glm::inverse(corners) * direction;
        if (w.x < -1e-9 || w.y < -1e-9 || w.z < -1e-9) continue;
        const double sum = w.x + w.y + w.z;
        colour = (glm::dvec3{vertices[indices[i]].encoded} * w.x +
                  glm::dvec3{vertices[indices[i + 1]].encoded} * w.y +
                  glm::dvec3{vertices[indices[i + 2]].encoded} * w.z) /
                 sum;
        return true;
    }
    return false;
}

}  // namespace skyig::render::tests
