// A headless context, a renderer and its pixels, for the tests that draw.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <glm/glm.hpp>
#include <vector>

#include "render/gl/headless_context.h"
#include "render/renderer.h"
#include "tests/render/scenes.h"

namespace skyig::render::tests {

struct Rgb {
    int r = 0, g = 0, b = 0;
};

/// One drawn channel: row 0 at the top.
struct Picture {
    int width_px = 0;
    int height_px = 0;
    std::vector<std::byte> rgba;

    [[nodiscard]] Rgb at(int x, int y) const {
        const auto i =
            (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x)) *
            4;
        return {std::to_integer<int>(rgba[i]), std::to_integer<int>(rgba[i + 1]),
                std::to_integer<int>(rgba[i + 2])};
    }
};

inline int difference(const Rgb& a, const Rgb& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// Where a direction in front of the view lies in its picture, pixels from the upper left corner.
inline glm::dvec2 picture_point(const Channel& channel, const ChannelView& view,
                                const glm::dvec3& direction_enu) {
    const glm::dvec3 d = view.view_from_enu * direction_enu;
    const ImagePlane p = image_plane(view.frustum);
    return {(d.x / -d.z - p.left) / (p.right - p.left) * channel.width_px,
            (p.top - d.y / -d.z) / (p.top - p.bottom) * channel.height_px};
}

/// The shortest rotation that takes one unit vector to another, not opposite one.
inline glm::dmat3 rotation_between(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 axis = glm::cross(from, to);
    const glm::dmat3 cross{0.0, axis.z, -axis.y, -axis.z, 0.0, axis.x, axis.y, -axis.x, 0.0};
    return glm::dmat3{1.0} + cross + cross * cross * (1.0 / (1.0 + glm::dot(from, to)));
}

class GlTest : public ::testing::Test {
  protected:
    [[nodiscard]] static DisplaySettings undithered() {
        DisplaySettings display;
        display.dither = false;
        return display;
    }

    [[nodiscard]] static DisplaySettings without_glare() {
        DisplaySettings display = undithered();
        display.glare = false;
        return display;
    }

    /// Draws all channels of a scene with a renderer that has seen nothing before.
    std::vector<Picture> draw(const std::vector<Channel>& channels, const Scene& scene,
                              const DisplaySettings& display) {
        Renderer renderer(channels, display);
        return draw(renderer, scene);
    }

    std::vector<Picture> draw(Renderer& renderer, const Scene& scene) {
        const FrameReport& report = renderer.prepare(scene);
        std::vector<Picture> pictures;
        for (std::size_t i = 0; i < renderer.channels().size(); ++i) {
            const Channel& channel = renderer.channels()[i];
            Picture picture{channel.width_px, channel.height_px, {}};
            picture.rgba.resize(static_cast<std::size_t>(channel.width_px) *
                                static_cast<std::size_t>(channel.height_px) * 4);
            renderer.draw(i);
            renderer.read_back(i, picture.rgba);
            pictures.push_back(std::move(picture));
        }
        EXPECT_EQ(renderer.prepare(scene).gl_errors, 0U);
        EXPECT_GT(report.adaptation_cd_m2, 0.0);
        return pictures;
    }

    gl::HeadlessContext context_ = gl::HeadlessContext::create(true);
};

}  // namespace skyig::render::tests
