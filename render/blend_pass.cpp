#include "render/blend_pass.h"

#include "render/gl/draw.h"
#include "render/warp/blend.h"

namespace skyig::render {

BlendPass::Shader::Shader()
    : encode_power(program.uniform("u_encode_power")), dither(program.uniform("u_dither_codes")) {}

BlendPass::BlendPass(std::span<const Channel> channels, bool dither) : masks_(channels.size()) {
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (!channels[i].blend) continue;
        const warp::Blend& blend = *channels[i].blend;
        const warp::BlendTiles tiles = changed_tiles(blend);
        if (tiles.indices.empty()) continue;
        const bool even = blend.lift.size() == 1;
        Mask& mask = masks_[i].emplace(
            Mask{gl::Texture(gl::TexelFormat::kR32F, blend.width_px, blend.height_px),
                 gl::Texture(gl::TexelFormat::kR32F, even ? 1 : blend.width_px, even ? 1 : blend.height_px),
                 gl::Mesh({2}, tiles.corners.size()), tiles.indices.size()});
        mask.weight.update(blend.weight);
        mask.lift.update(blend.lift);
        mask.tiles.set_indices(tiles.indices);
        mask.tiles.update({&tiles.corners.front().x, tiles.corners.size() * 2});
        if (!shader_) shader_.emplace();
    }
    if (shader_) shader_->program.set(shader_->dither, dither ? 1.0F : 0.0F);
}

void BlendPass::draw(std::size_t channel, const gl::Framebuffer& picture, float encode_power) const {
    const std::optional<Mask>& mask = masks_[channel];
    if (!mask) return;
    shader_->program.use();
    shader_->program.set(shader_->encode_power, encode_power);
    gl::bind_texture(0, picture.texture());
    gl::bind_texture(1, mask->weight.name());
    gl::bind_texture(2, mask->lift.name());
    gl::set_blend(gl::Blend::kReplace);
    gl::see_what_is_drawn();
    mask->tiles.draw_triangles(0, mask->index_count);
}

}  // namespace skyig::render
