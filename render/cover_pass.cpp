#include "render/cover_pass.h"

#include <algorithm>

#include "render/gl/texture.h"
#include "render/sky/ground_albedo.h"

namespace skyig::render {

CoverPass::CoverPass(std::size_t channels)
    : program_("sky/deferred.vert", "precipitation/cover.frag"),
      triangle_({}, 3),
      surface_(program_),
      white_(program_.uniform("u_white_cd_m2")),
      snow_(program_.uniform("u_snow")),
      wet_(program_.uniform("u_wet")),
      pictures_(channels) {
    // At the wavelengths of rgb_of().
    program_.set(
        program_.uniform("u_snow_albedo"),
        glm::vec3{glm::dvec3{sky::snow_albedo(621.0), sky::snow_albedo(558.0), sky::snow_albedo(474.0)}});
}

void CoverPass::prepare(const Scene& scene, const glm::dvec3& white_cd_m2,
                        const precipitation::ExposureView& exposure) {
    const auto unit = [](double share) { return static_cast<float>(std::clamp(share, 0.0, 1.0)); };
    program_.set(white_, glm::vec3{white_cd_m2});
    program_.set(snow_, unit(scene.ground.snow));
    program_.set(wet_, unit(scene.ground.wet));
    exposure_ = exposure;
}

DeferredInput CoverPass::draw(std::size_t index, const Channel& channel, const ChannelView& view,
                              const DeferredInput& input) {
    std::optional<gl::Framebuffer>& picture = pictures_[index];
    if (!picture || picture->width_px() != channel.width_px || picture->height_px() != channel.height_px)
        picture.emplace(channel.width_px, channel.height_px, gl::PixelFormat::kRgba32F);
    picture->bind();
    surface_.bind(program_, channel, view, input, exposure_);
    gl::bind_texture(1, input.colour_texture);
    program_.use();
    triangle_.draw_strip(3);
    DeferredInput covered = input;
    covered.colour_texture = picture->texture();
    return covered;
}

}  // namespace skyig::render
