#include "render/windscreen_pass.h"

#include <array>
#include <cmath>
#include <cstdint>

#include "render/gl/draw.h"
#include "render/gl/texture.h"

namespace skyig::render {

namespace {

using precipitation::Windscreen;

constexpr std::size_t kFloats = 6;
constexpr std::array<glm::dvec2, 4> kCorners{{{-1.0, -1.0}, {1.0, -1.0}, {-1.0, 1.0}, {1.0, 1.0}}};

std::vector<std::uint32_t> two_triangles_each() {
    std::vector<std::uint32_t> indices;
    indices.reserve(Windscreen::kMost * 6);
    for (std::uint32_t drop = 0; drop < Windscreen::kMost; ++drop) {
        for (const std::uint32_t corner : {0U, 1U, 2U, 2U, 1U, 3U})
            indices.push_back(4 * drop + corner);
    }
    return indices;
}

}  // namespace

WindscreenPass::Shader::Shader()
    : squares({2, 2, 2}, Windscreen::kMost * kCorners.size()),
      size(program.uniform("u_size_px")),
      focal(program.uniform("u_focal_px")) {
    squares.set_indices(two_triangles_each());
    program.set(program.uniform("u_contact_sine"), static_cast<float>(std::sin(precipitation::kContact_rad)));
}

WindscreenPass::WindscreenPass(std::size_t channels) {
    panes_.reserve(channels);
    for (std::size_t i = 0; i < channels; ++i)
        panes_.push_back({Windscreen(i), {}, 0, 0});
}

void WindscreenPass::prepare(const Scene& scene) {
    for (std::size_t i = 0; i < panes_.size() && i < scene.view_count; ++i) {
        const ChannelView& view = scene.views[i];
        if (view.windscreen_m > 0.0F && has_area(view.frustum)) panes_[i].drops.advance(scene, view);
    }
}

std::size_t WindscreenPass::lay_out(const Pane& pane, const ChannelView& view) {
    const ImagePlane p = image_plane(view.frustum);
    const glm::dvec2 size{p.right - p.left, p.top - p.bottom};
    const glm::dvec2 middle{0.5 * (p.left + p.right), 0.5 * (p.bottom + p.top)};
    const glm::dvec2 mirrored{view.showing.mirrored_across ? -1.0 : 1.0,
                              view.showing.mirrored_upright ? -1.0 : 1.0};
    const double focal_px = pane.height_px / size.y;
    const auto away_m = static_cast<double>(view.windscreen_m);
    std::size_t out = 0;
    for (const Windscreen::Drop& drop : pane.drops.drops()) {
        if (!(drop.there > 0.0)) continue;
        const glm::dvec2 at = drop.at_m / away_m;
        const double radius = drop.radius_m / away_m;
        // Half a pixel more for the rim.
        const double reach = 1.0 + 0.5 / (radius * focal_px);
        for (const glm::dvec2& corner : kCorners) {
            const glm::dvec2 clip = mirrored * (at + reach * radius * corner - middle) * 2.0 / size;
            const glm::dvec2 across = mirrored * reach * corner;
            for (const double value : {clip.x, clip.y, across.x, across.y, radius * focal_px, drop.there})
                vertices_[out++] = static_cast<float>(value);
        }
    }
    return out;
}

void WindscreenPass::draw(std::size_t channel, const ChannelView& view, const gl::Framebuffer& picture) {
    Pane& pane = panes_[channel];
    if (!(view.windscreen_m > 0.0F) || pane.drops.dry()) return;
    if (!shader_) {
        shader_.emplace();
        vertices_.resize(Windscreen::kMost * kCorners.size() * kFloats);
    }
    if (!pane.behind || pane.width_px != picture.width_px() || pane.height_px != picture.height_px()) {
        pane.behind.emplace(picture.width_px(), picture.height_px());
        pane.width_px = picture.width_px();
        pane.height_px = picture.height_px();
    }
    const std::size_t floats = lay_out(pane, view);
    shader_->squares.update({vertices_.data(), floats});
    pane.behind->take(picture);
    const ImagePlane p = image_plane(view.frustum);
    const glm::vec2 size_px{pane.width_px, pane.height_px};
    shader_->program.set(shader_->size, size_px);
    shader_->program.set(shader_->focal, size_px / glm::vec2{glm::dvec2{p.right - p.left, p.top - p.bottom}});
    shader_->program.use();
    gl::bind_texture(0, pane.behind->name());
    gl::set_blend(gl::Blend::kCoverage);
    shader_->squares.draw_triangles(0, floats / (kFloats * kCorners.size()) * 6);
}

}  // namespace skyig::render
