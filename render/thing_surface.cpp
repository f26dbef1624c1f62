#include "render/thing_surface.h"

#include "render/gl/texture.h"

namespace skyig::render {

using precipitation::ExposureView;

ThingSurface::ThingSurface(const gl::Program& program)
    : centre_(program.uniform("u_far_centre")),
      right_(program.uniform("u_far_right")),
      up_(program.uniform("u_far_up")),
      size_(program.uniform("u_size_px")),
      exposure_(program.uniform("u_exposure_from_enu_m")),
      exposure_px_(program.uniform("u_exposure_px")),
      bias_(program.uniform("u_exposure_bias")) {}

void ThingSurface::bind(const gl::Program& program, const Channel& channel, const ChannelView& view,
                        const DeferredInput& input, const ExposureView& exposure) const {
    const ImagePlane p = image_plane(view.frustum);
    const glm::dmat3 enu_from_view = glm::transpose(view.view_from_enu) * input.far_m;
    program.set(centre_, glm::vec3{enu_from_view *
                                   glm::dvec3{0.5 * (p.left + p.right), 0.5 * (p.bottom + p.top), -1.0}});
    program.set(right_, glm::vec3{enu_from_view * glm::dvec3{0.5 * (p.right - p.left), 0.0, 0.0}});
    program.set(up_, glm::vec3{enu_from_view * glm::dvec3{0.0, 0.5 * (p.top - p.bottom), 0.0}});
    program.set(size_, glm::vec2{channel.width_px, channel.height_px});
    glm::dmat4 map_from_clip{0.5};
    map_from_clip[3] = {0.5, 0.5, 0.5, 1.0};
    program.set(exposure_, glm::mat4{map_from_clip * exposure.clip_from_enu_m});
    program.set(exposure_px_,
                input.exposure_texture != 0 ? static_cast<float>(ExposureView::kSize_px) : 0.0F);
    program.set(bias_, static_cast<float>(exposure.bias_m / ExposureView::kDepth_m));
    gl::bind_texture(0, input.depth_texture);
    gl::bind_texture(3, input.exposure_texture != 0 ? input.exposure_texture : input.depth_texture);
}

}  // namespace skyig::render
