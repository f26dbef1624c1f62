#include "render/warp_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "render/gl/draw.h"
#include "render/texture_units.h"
#include "render/warp/warp.h"

namespace skyig::render {

namespace {

// As in common/place.glsl.
constexpr unsigned kBinding = 0;

// Cells on a side of the mesh that a flat picture is resampled with.
constexpr std::uint32_t kCells = 64;
constexpr std::size_t kCellIndices = std::size_t{6} * kCells * kCells;

gl::Mesh screen_mesh(const warp::Warp& warp) {
    std::vector<glm::vec4> vertices;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t row = 0; row <= kCells; ++row) {
        for (std::uint32_t column = 0; column <= kCells; ++column) {
            const glm::dvec2 screen = glm::dvec2{column, row} / static_cast<double>(kCells);
            vertices.emplace_back(glm::vec2{2.0 * screen - 1.0}, glm::vec2{warp.picture_of(screen)});
            if (row == kCells || column == kCells) continue;
            const std::uint32_t low = row * (kCells + 1) + column;
            for (const std::uint32_t i : {0U, 1U, kCells + 1, kCells + 1, 1U, kCells + 2})
                indices.push_back(low + i);
        }
    }
    gl::Mesh mesh({2, 2}, vertices.size());
    mesh.set_indices(indices);
    mesh.update({&vertices.front().x, vertices.size() * 4});
    return mesh;
}

glm::dmat4 shown_from_clip_of(const warp::Warp& warp) {
    const glm::dvec2 low = 2.0 * glm::dvec2{warp.shown().x, warp.shown().y} - 1.0;
    const glm::dvec2 high = 2.0 * glm::dvec2{warp.shown().z, warp.shown().w} - 1.0;
    const glm::dvec2 scale = 2.0 / (1.04 * (high - low));
    const glm::dvec2 shift = -0.5 * scale * (high + low);
    return {glm::dvec4{scale.x, 0.0, 0.0, 0.0}, glm::dvec4{0.0, scale.y, 0.0, 0.0},
            glm::dvec4{0.0, 0.0, 1.0, 0.0}, glm::dvec4{shift, 0.0, 1.0}};
}

}  // namespace

Channel flat_picture_of(const Channel& channel) {
    const auto scaled = [&](int size_px) {
        return std::max(1, static_cast<int>(std::lround(channel.render_scale * size_px)));
    };
    return {channel.name, scaled(channel.width_px), scaled(channel.height_px)};
}

gl::Placement placement_of(std::span<const Channel> channels) noexcept {
    const bool warped =
        std::any_of(channels.begin(), channels.end(), [](const Channel& c) { return c.warp != nullptr; });
    return warped ? gl::Placement::kWarped : gl::Placement::kFlat;
}

WarpPass::WarpPass(std::span<const Channel> channels) : channels_(channels), warped_(channels.size()) {
    if (placement_of(channels) == gl::Placement::kFlat) return;
    const auto bound = [](int size, std::span<const glm::vec4> nodes, const glm::vec4& place) {
        const std::array<float, 4> values{place.x, place.y, place.z, place.w};
        Bound made{gl::Texture(gl::TexelFormat::kRgba32F, size, size), gl::UniformBlock(values)};
        made.nodes.update({&nodes.front().x, nodes.size() * 4});
        return made;
    };
    const std::array<glm::vec4, 4> unmoved{glm::vec4{0.0F, 0.0F, 1.0F, 0.0F},
                                           {0.0F, 0.0F, 1.0F, 0.0F},
                                           {0.0F, 0.0F, 1.0F, 0.0F},
                                           {0.0F, 0.0F, 1.0F, 0.0F}};
    flat_.emplace(bound(2, unmoved, {0.5F, 0.5F, 0.5F, 0.5F}));
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (const warp::Warp* warp = channels[i].warp.get(); warp != nullptr)
            warped_[i].emplace(bound(warp::Warp::kNodes, warp->nodes(), warp->node_place()));
    }
}

void WarpPass::bind(std::size_t channel) const {
    const std::optional<Bound>& bound = warped_[channel] ? warped_[channel] : flat_;
    if (!bound) return;
    gl::bind_texture(texture_unit::kWarp, bound->nodes.name());
    bound->block.bind(kBinding);
}

glm::dmat4 WarpPass::shown_from_clip(std::size_t channel) const noexcept {
    const warp::Warp* warp = channels_[channel].warp.get();
    return warp == nullptr ? glm::dmat4{1.0} : shown_from_clip_of(*warp);
}

void WarpPass::bind_flat() const {
    if (!flat_) return;
    gl::bind_texture(texture_unit::kWarp, flat_->nodes.name());
    flat_->block.bind(kBinding);
}

void WarpPass::make_resampling() {
    if (resampling_) return;
    Resampling made{.program = {"warp/resample.vert", "warp/resample.frag"}, .screens = {}};
    for (const Channel& channel : channels_) {
        std::optional<gl::Mesh>& screen = made.screens.emplace_back();
        if (channel.warp) screen.emplace(screen_mesh(*channel.warp));
    }
    resampling_.emplace(std::move(made));
}

void WarpPass::resample(std::size_t channel, const gl::Framebuffer& picture) {
    make_resampling();
    resampling_->program.use();
    gl::bind_texture(0, picture.texture());
    gl::set_blend(gl::Blend::kReplace);
    resampling_->screens[channel]->draw_triangles(0, kCellIndices);
}

}  // namespace skyig::render
