#include "render/cloud_pass.h"

#include <array>

namespace skyig::render {

namespace {
// As in cloud/fetch.glsl.
constexpr int kUnit = 7;
constexpr std::array<float, 4> kClear{0.0F, 0.0F, 0.0F, 1.0F};
}  // namespace

glm::vec4 CloudFetch::place(int map_size, bool lower) noexcept {
    // Places -1 and 1 are the middles of the outermost texels.
    const float across = static_cast<float>(map_size - 1) / (2.0F * static_cast<float>(map_size));
    return {across, 0.5F, 0.5F * across, lower ? 0.75F : 0.25F};
}

void CloudFetch::set(const gl::Program& program, int map_size) const {
    program.set(place_, place(map_size, false));
}

Octant octant_of(int index, const glm::dmat4& enu_from_mesh) noexcept {
    Octant octant;
    const glm::dmat4 rows = glm::transpose(enu_from_mesh);
    for (int i = 0; i < 3; ++i) {
        const double sign = (index >> i & 1) != 0 ? -1.0 : 1.0;
        octant.signs[i] = static_cast<float>(sign);
        octant.sides[static_cast<std::size_t>(i)] = sign * rows[i];
    }
    return octant;
}

CloudPass::CloudPass(std::size_t screens, gl::Placement placement)
    : program_("cloud/dome.vert", "cloud/dome.frag", placement),
      clip_(program_.uniform("u_clip_from_mesh")),
      enu_(program_.uniform("u_enu_from_mesh")),
      share_(program_.uniform("u_share")),
      half_size_(program_.uniform("u_half_size_px")),
      dither_(program_.uniform("u_dither_codes")),
      place_(program_.uniform("u_cloud_place")),
      octant_(program_.uniform("u_octant")),
      over_("sky/dome.vert", "cloud/over.frag", placement),
      over_fetch_(over_),
      over_clip_(over_.uniform("u_clip_from_mesh")),
      over_enu_(over_.uniform("u_enu_from_mesh")),
      screens_(screens) {
    maps_.reserve(screens);
}

void CloudPass::prepare(const CloudFrame& clouds, bool dither) {
    const cloud::MapGeometry& geometry = clouds.map().geometry();
    if (size_revision_ != clouds.size_revision()) {
        maps_.clear();
        size_ = geometry.size();
        for (std::size_t screen = 0; screen < screens_; ++screen) {
            maps_.emplace_back(gl::TexelFormat::kRgba32F, size_, 2 * size_);
            maps_.back().fill(kClear);
        }
        size_revision_ = clouds.size_revision();
        over_fetch_.set(over_, size_);
    }
    program_.set(dither_, dither ? 1.0F : 0.0F);
    for (const TonedTile& toned : clouds.toned()) {
        const cloud::MapGeometry::Texel corner = geometry.corner(toned.tile);
        const int row = corner.row + (corner.lower ? size_ : 0);
        for (std::size_t screen = 0; screen < screens_; ++screen) {
            if (toned.first == TonedTile::kClear)
                maps_[screen].fill_part(corner.column, row, cloud::kTile, cloud::kTile, kClear);
            else
                maps_[screen].update_part(
                    corner.column, row, cloud::kTile, cloud::kTile,
                    clouds.texels(screen).subspan(toned.first, CloudFrame::kTileFloats));
        }
    }
}

void CloudPass::bind(std::size_t screen) const {
    gl::bind_texture(kUnit, maps_[screen].name());
}

void CloudPass::use_dome(const Channel& channel, const glm::dmat4& clip_from_mesh,
                         const glm::dmat4& enu_from_mesh, double share) const {
    program_.use();
    program_.set(clip_, glm::mat4{clip_from_mesh});
    program_.set(enu_, glm::mat4{enu_from_mesh});
    program_.set(share_, static_cast<float>(share));
    program_.set(half_size_, 0.5F * glm::vec2{channel.width_px, channel.height_px});
}

void CloudPass::take(const Octant& octant) const {
    program_.set(place_, CloudFetch::place(size_, octant.signs.z < 0.0F));
    program_.set(octant_, octant.signs);
}

void CloudPass::use_over(const glm::dmat4& clip_from_mesh, const glm::dmat4& enu_from_mesh) const {
    over_.use();
    over_.set(over_clip_, glm::mat4{clip_from_mesh});
    over_.set(over_enu_, glm::mat4{enu_from_mesh});
}

}  // namespace skyig::render
