#include "render/milky_way_pass.h"

#include <cmath>

namespace skyig::render {

namespace {
using Map = night::MilkyWayMap;
}  // namespace

MilkyWayPass::Variant::Variant(std::string_view fragment, gl::Placement placement)
    : program("night/milky_way.vert", fragment, placement),
      clip(program.uniform("u_clip_from_galactic")),
      half_size(program.uniform("u_half_size_px")),
      up(program.uniform("u_up_galactic")),
      horizon_sine(program.uniform("u_horizon_sine")),
      dither(program.uniform("u_dither_codes")) {
    const glm::vec2 size{Map::kWidth, Map::kHeight};
    program.set(program.uniform("u_place_scale"), (size - 1.0F) / size);
    program.set(program.uniform("u_place_shift"), 0.5F / size);
}

MilkyWayPass::Clouded::Clouded(gl::Placement placement)
    : Variant("cloud/milky_way.frag", placement),
      fetch(program),
      enu(program.uniform("u_enu_from_galactic")) {}

MilkyWayPass::MilkyWayPass(std::size_t screens, gl::Placement placement)
    : placement_(placement), plain_("night/milky_way.frag", placement) {
    for (std::size_t screen = 0; screen < screens; ++screen)
        meshes_.emplace_back(std::initializer_list<int>{3, 2, 3, 1},
                             std::size_t{MilkyWay::kRows + 1} * (MilkyWay::kColumns + 1),
                             placement == gl::Placement::kWarped);
}

void MilkyWayPass::prepare(const MilkyWay& milky_way, const SkyLight& light, bool dither,
                           double longest_edge_rad) {
    if (map_revision_ != milky_way.map_revision()) {
        if (!map_) map_.emplace(gl::TexelFormat::kR32F, Map::kWidth, Map::kHeight);
        map_->update(milky_way.map().texels());
        map_revision_ = milky_way.map_revision();
    }
    for (std::size_t screen = 0; screen < meshes_.size(); ++screen) {
        const auto belt = milky_way.vertices(screen);
        const std::span<const float> vertices{reinterpret_cast<const float*>(belt.data()),
                                              belt.size_bytes() / sizeof(float)};
        if (longest_edge_rad_ != longest_edge_rad)
            meshes_[screen].set_triangles(milky_way.indices(), vertices, longest_edge_rad);
        else
            meshes_[screen].set_vertices(vertices);
    }
    longest_edge_rad_ = longest_edge_rad;
    enu_from_galactic_ = glm::transpose(light.milky_way.galactic_from_enu);
    up_galactic_ = glm::vec3{light.milky_way.galactic_from_enu * glm::dvec3{0.0, 0.0, 1.0}} /
                   static_cast<float>(SkyLight::kBeltEdge);
    horizon_sine_ = static_cast<float>(std::sin(light.horizon_elevation_rad) / SkyLight::kBeltEdge);
    dither_ = dither;
}

void MilkyWayPass::draw_ranges(const Variant& variant, const Channel& channel, std::size_t screen,
                               const glm::dmat4& clip_from_galactic,
                               std::span<const IndexRange> ranges) const {
    const gl::Program& program = variant.program;
    program.use();
    program.set(variant.up, up_galactic_);
    program.set(variant.horizon_sine, horizon_sine_);
    program.set(variant.dither, dither_ ? 1.0F : 0.0F);
    program.set(variant.clip, glm::mat4{clip_from_galactic});
    program.set(variant.half_size, 0.5F * glm::vec2{channel.width_px, channel.height_px});
    gl::bind_texture(0, map_->name());
    for (const IndexRange& range : ranges)
        meshes_[screen].draw(range);
}

void MilkyWayPass::draw(MilkyWay& milky_way, const Channel& channel, std::size_t screen,
                        const glm::dmat4& clip_from_enu, const glm::dmat4& shown_from_clip,
                        const CloudPass* clouds) {
    const glm::dmat4 clip_from_galactic = clip_from_enu * glm::dmat4{enu_from_galactic_};
    const auto ranges = milky_way.visible(shown_from_clip * clip_from_galactic);
    if (ranges.empty()) return;
    if (clouds == nullptr) {
        draw_ranges(plain_, channel, screen, clip_from_galactic, ranges);
        return;
    }
    if (!clouded_) clouded_.emplace(placement_);
    clouded_->fetch.set(clouded_->program, clouds->map_size());
    clouded_->program.set(clouded_->enu, glm::mat3{enu_from_galactic_});
    draw_ranges(*clouded_, channel, screen, clip_from_galactic, ranges);
}

}  // namespace skyig::render
