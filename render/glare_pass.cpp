#include "render/glare_pass.h"

#include <algorithm>
#include <cmath>

namespace skyig::render {

GlarePass::GlarePass(gl::Placement placement)
    : program_("eye/glare.vert", "eye/glare.frag", placement),
      rings_({2, 3, 3}, Glare::kVertices),
      clip_(program_.uniform("u_clip_from_enu")),
      source_(program_.uniform("u_enu_from_source")),
      horizon_sin_(program_.uniform("u_horizon_sin")),
      inv_softness_(program_.uniform("u_inv_softness")),
      dither_(program_.uniform("u_dither_codes")) {
    rings_.set_indices(Glare::indices());
}

void GlarePass::prepare(const Glare& glare, double pixel_rad, bool dither) {
    const auto vertices = glare.vertices();
    rings_.update({reinterpret_cast<const float*>(vertices.data()), vertices.size_bytes() / sizeof(float)});
    program_.set(source_, glare.enu_from_source());
    program_.set(horizon_sin_, std::sin(glare.horizon_rad()));
    const double softness = std::max(std::cos(static_cast<double>(glare.horizon_rad())), 1e-3) * pixel_rad;
    program_.set(inv_softness_, static_cast<float>(1.0 / softness));
    program_.set(dither_, dither ? 1.0F : 0.0F);
}

void GlarePass::draw(const glm::mat4& clip_from_enu) const {
    draw(clip_from_enu, 0);
}

void GlarePass::draw_around(const glm::mat4& clip_from_enu) const {
    draw(clip_from_enu, Glare::kOnDisc);
}

void GlarePass::draw(const glm::mat4& clip_from_enu, std::size_t first) const {
    program_.use();
    program_.set(clip_, clip_from_enu);
    rings_.draw_triangles(first, Glare::kIndices - first);
}

}  // namespace skyig::render
