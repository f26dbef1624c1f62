#include "render/thing_clouds.h"

#include "render/cloud_pass.h"
#include "render/texture_units.h"

namespace skyig::render {

namespace {

constexpr std::array<float, 4> kClear{0.0F, 0.0F, 0.0F, 1.0F};

using cloud::ShadowMap;

}  // namespace

ThingClouds::ThingClouds(const gl::Program& program)
    : place_(program.uniform("u_cloud_place")),
      shown_(program.uniform("u_clouds_shown")),
      shaded_(program.uniform("u_shaded")),
      near_range_(program.uniform("u_near_range_m")),
      eye_height_(program.uniform("u_eye_height_m")),
      source_(program.uniform("u_shadow_source")),
      beam_(program.uniform("u_beam_over_mean")),
      heights_(program.uniform("u_shadow_heights_m")),
      mean_(program.uniform("u_shadow_mean")),
      patch_heights_(program.uniform("u_patch_heights_m")),
      patch_fog_(program.uniform("u_patch_fog")),
      corners_{program.uniform("u_shadow_corner_m[0]"), program.uniform("u_shadow_corner_m[1]"),
               program.uniform("u_shadow_corner_m[2]")},
      shadow_(gl::TexelFormat::kR32F, ShadowMap::kCells, ShadowMap::kLevels * ShadowMap::kCells),
      patches_(gl::TexelFormat::kR32F, PatchColumns::kColumns, PatchColumns::kRings + 1) {
    const auto& cell_m = ShadowMap::kCell_m;
    program.set(program.uniform("u_shadow_cell_m"), glm::vec3{cell_m[0], cell_m[1], cell_m[2]});
    program.set(program.uniform("u_shadow_cells"), static_cast<float>(ShadowMap::kCells));
    program.set(near_range_, static_cast<float>(cloud::kNearRange_m));
    program.set(program.uniform("u_patch_size"),
                glm::vec2{glm::ivec2{PatchColumns::kAzimuths, PatchColumns::kRings}});
    maps_.reserve(3);
}

void ThingClouds::upload(const CloudFrame& clouds) {
    const cloud::MapGeometry& geometry = clouds.map().geometry();
    if (size_revision_ != clouds.size_revision()) {
        maps_.clear();
        size_ = geometry.size();
        for (const auto format : {gl::TexelFormat::kRgba32F, gl::TexelFormat::kR32F, gl::TexelFormat::kR32F})
            maps_.emplace_back(format, size_, 2 * size_);
        maps_[0].fill(kClear);
        maps_[1].fill({kClear.data(), 1});
        maps_[2].fill({&kClear[3], 1});
        size_revision_ = clouds.size_revision();
    }
    constexpr int kSide = cloud::kTile;
    constexpr std::size_t kTexels = cloud::kTileTexels;
    for (const TonedTile& toned : clouds.toned()) {
        const cloud::MapGeometry::Texel corner = geometry.corner(toned.tile);
        const int row = corner.row + (corner.lower ? size_ : 0);
        if (toned.first == TonedTile::kClear) {
            maps_[0].fill_part(corner.column, row, kSide, kSide, kClear);
            maps_[1].fill_part(corner.column, row, kSide, kSide, {kClear.data(), 1});
            maps_[2].fill_part(corner.column, row, kSide, kSide, {&kClear[3], 1});
            continue;
        }
        const std::span<const float> things = clouds.things(toned);
        maps_[0].update_part(corner.column, row, kSide, kSide, things.first(4 * kTexels));
        maps_[1].update_part(corner.column, row, kSide, kSide, things.subspan(4 * kTexels, kTexels));
        maps_[2].update_part(corner.column, row, kSide, kSide, things.subspan(5 * kTexels, kTexels));
    }
}

void ThingClouds::tell_patches(const gl::Program& program, const PatchColumns& patches) {
    program.set(patch_fog_, glm::vec3{glm::dvec3{patches.shown() ? patches.extinction_per_m() : 0.0,
                                                 patches.mean(), patches.eye_radius_m()}});
    if (!patches.shown()) return;
    if (patches_revision_ != patches.revision()) patches_.update(patches.texels());
    patches_revision_ = patches.revision();
    const shaders64::PatchHeights& heights = patches.heights_m();
    program.set(patch_heights_,
                glm::vec4{glm::dvec4{heights.begin_m, heights.base_m, heights.top_m, heights.end_m}});
}

void ThingClouds::tell_shadow(const gl::Program& program, const GroundShadow& shadow) {
    const ShadowMap& map = shadow.map();
    if (shadow_revision_ != map.revision()) shadow_.update(map.cells());
    shadow_revision_ = map.revision();
    for (std::size_t k = 0; k < corners_.size(); ++k)
        program.set(corners_[k], map.corner_m(static_cast<int>(k)));
    program.set(eye_height_, static_cast<float>(shadow.eye_height_m()));
    program.set(source_, glm::vec3{shadow.source_enu()});
    program.set(beam_, glm::vec3{shadow.beam_over_mean()});
    program.set(heights_, glm::vec2{shadow.heights_m()});
    program.set(mean_, map.mean());
}

void ThingClouds::prepare(const gl::Program& program, const CloudFrame& clouds, const GroundShadow& shadow) {
    clouds_told_ = clouds.shown();
    if (clouds_told_) {
        upload(clouds);
        program.set(place_, CloudFetch::place(size_, false));
        tell_patches(program, clouds.patches());
    }
    program.set(shown_, clouds_told_ ? 1.0F : 0.0F);
    shadow_told_ = shadow.shown();
    if (shadow_told_) tell_shadow(program, shadow);
}

void ThingClouds::bind(const gl::Program& program, bool shaded) const {
    program.set(shaded_, shaded && shadow_told_ ? 1.0F : 0.0F);
    for (std::size_t i = 0; clouds_told_ && i < maps_.size(); ++i)
        gl::bind_texture(texture_unit::kThingClouds + static_cast<int>(i), maps_[i].name());
    gl::bind_texture(texture_unit::kThingShadow, shadow_.name());
    gl::bind_texture(texture_unit::kThingPatches, patches_.name());
}

}  // namespace skyig::render
