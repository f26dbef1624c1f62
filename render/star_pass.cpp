#include "render/star_pass.h"

#include <numbers>

namespace skyig::render {

StarPass::StarPass(gl::Placement placement)
    : program_("night/star.vert", "night/star.frag", placement),
      mesh_({3, 3, 3}, field_.capacity()),
      tone_(program_, true),
      fetch_(program_),
      enu_(program_.uniform("u_enu_from_update")),
      clouds_shown_(program_.uniform("u_clouds_shown")),
      view_(program_.uniform("u_view_from_enu")),
      size_(program_.uniform("u_size_px")),
      plane_origin_(program_.uniform("u_plane_origin")),
      plane_step_(program_.uniform("u_plane_step")),
      peak_gain_(program_.uniform("u_peak_gain")) {}

void StarPass::prepare(const Scene& scene, const SkyFrame& frame, double pixel_rad) {
    const std::size_t changed = field_.update(scene, frame, pixel_rad);
    const auto stars = field_.stars().first(changed);
    mesh_.update({reinterpret_cast<const float*>(stars.data()), stars.size_bytes() / sizeof(float)});
}

void StarPass::draw(const Channel& channel, const ChannelView& view, const shaders32::ToneParameters& tone,
                    const CloudPass* clouds) const {
    const ImagePlane p = image_plane(view.frustum);
    const glm::dvec2 step{(p.right - p.left) / channel.width_px, (p.top - p.bottom) / channel.height_px};
    const double peak_per_sr =
        1.0 / (2.0 * std::numbers::pi * kStarSigma_px * kStarSigma_px * step.x * step.y);
    program_.use();
    tone_.set(program_, tone);
    program_.set(view_, glm::mat4{glm::dmat4{view.view_from_enu * field_.enu_from_update()}});
    program_.set(clouds_shown_, clouds != nullptr ? 1.0F : 0.0F);
    if (clouds != nullptr) {
        fetch_.set(program_, clouds->map_size());
        program_.set(enu_, glm::mat4{glm::dmat4{field_.enu_from_update()}});
    }
    program_.set(size_, glm::vec2{channel.width_px, channel.height_px});
    program_.set(plane_origin_, glm::vec2{glm::dvec2{p.left, p.bottom}});
    program_.set(plane_step_, glm::vec2{step});
    program_.set(peak_gain_, tone.point_gain * tone.inv_display_max * static_cast<float>(peak_per_sr));
    mesh_.draw_points(field_.stars().size());
}

}  // namespace skyig::render
