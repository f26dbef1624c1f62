#include "render/milky_way_pass.h"

#include <cmath>

namespace skyig::render {

namespace {
using Map = night::MilkyWayMap;
}  // namespace

MilkyWayPass::MilkyWayPass(std::size_t screens)
    : program_("night/milky_way.vert", "night/milky_way.frag"),
      clip_(program_.uniform("u_clip_from_galactic")),
      half_size_(program_.uniform("u_half_size_px")),
      up_(program_.uniform("u_up_galactic")),
      horizon_sine_(program_.uniform("u_horizon_sine")),
      place_scale_(program_.uniform("u_place_scale")),
      place_shift_(program_.uniform("u_place_shift")),
      dither_(program_.uniform("u_dither_codes")) {
    for (std::size_t screen = 0; screen < screens; ++screen)
        meshes_.emplace_back(std::initializer_list<int>{3, 2, 3, 1},
                             std::size_t{MilkyWay::kRows + 1} * (MilkyWay::kColumns + 1));
    const glm::vec2 size{Map::kWidth, Map::kHeight};
    program_.set(place_scale_, (size - 1.0F) / size);
    program_.set(place_shift_, 0.5F / size);
}

void MilkyWayPass::prepare(const MilkyWay& milky_way, const SkyLight& light, bool dither) {
    if (map_revision_ != milky_way.map_revision()) {
        if (!map_) {
            map_.emplace(gl::TexelFormat::kR32F, Map::kWidth, Map::kHeight);
            for (gl::Mesh& mesh : meshes_)
                mesh.set_indices(milky_way.indices());
        }
        map_->update(milky_way.map().texels());
        map_revision_ = milky_way.map_revision();
    }
    for (std::size_t screen = 0; screen < meshes_.size(); ++screen) {
        const auto vertices = milky_way.vertices(screen);
        meshes_[screen].update(
            {reinterpret_cast<const float*>(vertices.data()), vertices.size_bytes() / sizeof(float)});
    }
    enu_from_galactic_ = glm::transpose(light.milky_way.galactic_from_enu);
    program_.set(up_, glm::vec3{light.milky_way.galactic_from_enu * glm::dvec3{0.0, 0.0, 1.0}} /
                          static_cast<float>(SkyLight::kBeltEdge));
    program_.set(horizon_sine_,
                 static_cast<float>(std::sin(light.horizon_elevation_rad) / SkyLight::kBeltEdge));
    program_.set(dither_, dither ? 1.0F : 0.0F);
}

void MilkyWayPass::draw(MilkyWay& milky_way, const Channel& channel, std::size_t screen,
                        const glm::dmat4& clip_from_enu) const {
    const glm::dmat4 clip_from_galactic = clip_from_enu * glm::dmat4{enu_from_galactic_};
    const auto ranges = milky_way.visible(clip_from_galactic);
    if (ranges.empty()) return;
    program_.use();
    program_.set(clip_, glm::mat4{clip_from_galactic});
    program_.set(half_size_, 0.5F * glm::vec2{channel.width_px, channel.height_px});
    gl::bind_texture(0, map_->name());
    for (const IndexRange& range : ranges)
        meshes_[screen].draw_triangles(range.first, range.count);
}

}  // namespace skyig::render
