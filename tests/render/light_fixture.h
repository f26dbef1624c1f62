// Pictures of light, for the tests that ask for cd/m2 and not for display codes.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/render/gl_fixture.h"

namespace skyig::render::tests {

/// One drawn channel: linear Rec.709, cd/m2, row 0 at the top.
struct LightPicture {
    Channel channel;
    Frustum frustum;
    std::vector<float> rgb;

    [[nodiscard]] glm::dvec3 at(int x, int y) const {
        const float* p = &rgb[(static_cast<std::size_t>(y) * static_cast<std::size_t>(channel.width_px) +
                               static_cast<std::size_t>(x)) *
                              3];
        return {p[0], p[1], p[2]};
    }
    [[nodiscard]] glm::dvec3 view_direction_at(int x, int y) const {
        return view_direction(channel, frustum, x + 0.5, channel.height_px - y - 0.5);
    }
    /// Of that pixel: (1 + x^2 + y^2)^-1.5 of the image plane's.
    [[nodiscard]] double solid_angle_sr(int x, int y) const {
        const ImagePlane p = image_plane(frustum);
        return (p.right - p.left) / channel.width_px * (p.top - p.bottom) / channel.height_px *
               std::pow(-view_direction_at(x, y).z, 3.0);
    }
};

/// All channels of a scene, by a renderer whose target is luminance.
inline std::vector<LightPicture> draw_light(Renderer& renderer, const Scene& scene) {
    renderer.prepare(scene);
    std::vector<LightPicture> pictures;
    for (std::size_t i = 0; i < renderer.channels().size(); ++i) {
        const Channel& channel = renderer.channels()[i];
        LightPicture picture{channel, scene.views[i].frustum, {}};
        picture.rgb.resize(static_cast<std::size_t>(channel.width_px) *
                           static_cast<std::size_t>(channel.height_px) * 3);
        renderer.draw(i);
        renderer.read_luminance(i, picture.rgb);
        pictures.push_back(std::move(picture));
    }
    EXPECT_EQ(renderer.prepare(scene).gl_errors, 0U);
    return pictures;
}

inline std::vector<LightPicture> draw_light(const std::vector<Channel>& channels, const Scene& scene,
                                            Target target = Target::kLuminance) {
    Renderer renderer(channels, {}, {}, target);
    return draw_light(renderer, scene);
}

/// What `with` has more than `without` within a few pixels of a point, lux: luminance times solid angle.
inline glm::dvec3 added_lux(const LightPicture& with, const LightPicture& without, const glm::dvec2& point_px,
                            int reach_px = 6) {
    glm::dvec3 sum{0.0};
    const auto first = [&](double at_px) {
        return std::max(0, static_cast<int>(std::floor(at_px)) - reach_px);
    };
    const auto end = [&](double at_px, int size) {
        return std::min(size, static_cast<int>(std::floor(at_px)) + reach_px + 1);
    };
    for (int y = first(point_px.y); y < end(point_px.y, with.channel.height_px); ++y) {
        for (int x = first(point_px.x); x < end(point_px.x, with.channel.width_px); ++x)
            sum += (with.at(x, y) - without.at(x, y)) * with.solid_angle_sr(x, y);
    }
    return sum;
}

}  // namespace skyig::render::tests
