#include "render/sea_pass.h"

#include <initializer_list>

namespace skyig::render {

SeaPass::SeaPass(std::size_t screens, gl::Placement placement)
    : program_("sky/sea.vert", "sky/sea.frag", placement),
      tone_(program_, true),
      clip_(program_.uniform("u_clip_from_mesh")),
      enu_(program_.uniform("u_enu_from_mesh")),
      share_(program_.uniform("u_share")),
      half_size_(program_.uniform("u_half_size_px")),
      dither_(program_.uniform("u_dither_codes")),
      height_(program_.uniform("u_height_m")),
      curvature_(program_.uniform("u_curvature_m2")),
      pixel_(program_.uniform("u_pixel_rad")),
      source_(program_.uniform("u_source_enu")),
      variance_(program_.uniform("u_variance")),
      phases_(program_.uniform("u_wave_phase")),
      shapes_(program_.uniform("u_wave_shape")) {
    for (std::size_t i = 0; i < screens; ++i)
        meshes_.emplace_back(std::initializer_list<int>{3, 3, 3, 3, 3, 3, 3, 3, 3}, SeaMesh::kMaxVertices,
                             placement == gl::Placement::kWarped);
}

void SeaPass::prepare(const SkyFrame& frame, bool dither, double longest_edge_rad) {
    const bool triangles = triangles_revision_ != frame.triangles_revision() ||
                           longest_edge_rad_ != longest_edge_rad || rows_ != frame.sea_rows();
    for (std::size_t screen = 0; screen < meshes_.size(); ++screen) {
        const auto rows = frame.sea().vertices(screen);
        const std::span<const float> vertices{reinterpret_cast<const float*>(rows.data()),
                                              rows.size_bytes() / sizeof(float)};
        if (triangles)
            meshes_[screen].set_triangles(frame.dome().indices(), vertices, longest_edge_rad);
        else if (vertices_revision_ != frame.sea_revision())
            meshes_[screen].set_vertices(vertices);
    }
    vertices_revision_ = frame.sea_revision();
    triangles_revision_ = frame.triangles_revision();
    longest_edge_rad_ = longest_edge_rad;
    rows_ = frame.sea_rows();
    const SeaShading& shading = frame.sea_shading();
    program_.set(enu_, glm::mat4{frame.enu_from_mesh()});
    program_.set(share_, static_cast<float>(frame.dome().share()));
    program_.set(dither_, dither ? 1.0F : 0.0F);
    program_.set(height_, static_cast<float>(shading.height_m));
    program_.set(curvature_, static_cast<float>(shading.curvature_m2));
    program_.set(pixel_, static_cast<float>(shading.pixel_rad));
    program_.set(source_, glm::vec3{shading.source_enu});
    program_.set(variance_, glm::vec3{shading.variance});
    // Those beyond the count have no rise.
    int i = 0;  // elements of an array lie one location apart
    for (const shaders64::WaveTrain& train : frame.waves().trains) {
        program_.set(phases_ + i, glm::vec3{glm::dvec3{train.number_rad_m, train.phase_rad}});
        program_.set(shapes_ + i, glm::vec3{glm::dvec3{train.rise, train.skew}});
        ++i;
    }
}

void SeaPass::draw(const Channel& channel, std::size_t screen, const shaders32::ToneParameters& tone,
                   const glm::dmat4& clip_from_mesh, std::span<const IndexRange> ranges) const {
    program_.use();
    tone_.set(program_, tone);
    program_.set(clip_, glm::mat4{clip_from_mesh});
    program_.set(half_size_, 0.5F * glm::vec2{channel.width_px, channel.height_px});
    for (const IndexRange& range : ranges)
        meshes_[screen].draw(range);
}

}  // namespace skyig::render
