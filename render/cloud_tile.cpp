#include "render/cloud_tile.h"

#include <algorithm>
#include <cmath>

#include "render/geometry.h"

namespace skyig::render {

namespace {

using cloud::kToneNodes;
using cloud::kToneRow;
using cloud::MapGeometry;
using cloud::Snapshot;

constexpr int kNodeCount = kToneNodes * kToneNodes;
static_assert(cloud::kToneStep == Snapshot::kNodeStep && kToneRow == cloud::kTile);

// Where no cloud tells how far it is, the air is asked for this far.
constexpr double kUsual_m = 10e3;
constexpr double kNearUsual_m = 0.5 * cloud::kNearRange_m;

MapGeometry::Texel node_of(const MapGeometry::Texel& corner, int node) noexcept {
    return {corner.column + node % kToneNodes * cloud::kToneStep,
            corner.row + node / kToneNodes * cloud::kToneStep, corner.lower};
}

// Whether some component of the light changes by more than an eighth from node to node.
bool steep(const float (*light)[cloud::kNodeFloats]) noexcept {
    constexpr float kStep = 0.125F;
    const auto apart = [](float a, float b) { return std::abs(a - b) > kStep * std::max(a, b); };
    for (int c = 0; c < 3; ++c) {
        const float* nodes = light[c];
        for (int i = 0; i < kNodeCount; ++i) {
            if (i % kToneNodes < kToneNodes - 1 && apart(nodes[i], nodes[i + 1])) return true;
            if (i + kToneNodes < kNodeCount && apart(nodes[i], nodes[i + kToneNodes])) return true;
        }
    }
    return false;
}

void put(CloudBackdrop::Nodes& nodes, int node, const glm::dvec3& rgb) noexcept {
    for (int c = 0; c < 3; ++c)
        nodes[c][node] = static_cast<float>(rgb[c]);
}

// As if it were the same all along.
void put_air(const sky::models::AirBetween& between, double distance_m, int node,
             CloudBackdrop::Nodes& extinction, CloudBackdrop::Nodes& convergence) noexcept {
    const glm::dvec3 kept = glm::max(glm::dvec3{1.0} - between.passed_rgb, glm::dvec3{1e-6});
    put(extinction, node, -glm::log(glm::max(between.passed_rgb, glm::dvec3{1e-12})) / distance_m);
    put(convergence, node, between.added_rgb / kept);
}

cloud::Fold fold_of(const MapGeometry::Texel& corner, int size) noexcept {
    if (corner.column == corner.row) return cloud::Fold::kFalling;
    return corner.column + corner.row == size - cloud::kTile ? cloud::Fold::kRising : cloud::Fold::kNone;
}

template <class To, class From>
void copy(const From& from, To& to) noexcept {
    std::copy(std::begin(from), std::end(from), std::begin(to));
}

// Three components of a table from another one's.
void copy_rgb(const CloudBackdrop::Nodes& from, float (*to)[cloud::kNodeFloats]) noexcept {
    for (int c = 0; c < 3; ++c)
        copy(from[c], to[c]);
}

}  // namespace

void look_up(CloudBackdrop& backdrop, const cloud::CloudMap& map, int tile, const SkyLight& light,
             const DeferredAir& air, const GroundShadow* shadow) noexcept {
    const MapGeometry& geometry = map.geometry();
    const MapGeometry::Texel corner = geometry.corner(tile);
    const Snapshot& latest = *map.parts().back().snapshot;
    const cloud::Cone& cone = map.cone(tile);
    const double reach_rad = std::atan2(cone.sine, cone.cosine);
    const double middle_rad = horizontal_of(cone.axis).elevation_rad - light.horizon_elevation_rad;
    const bool sky = middle_rad + reach_rad > 0.0;
    backdrop.horizon = std::abs(middle_rad) < reach_rad;
    for (int i = 0; i < kNodeCount; ++i) {
        const MapGeometry::Texel at = node_of(corner, i);
        const glm::dvec3 direction{geometry.direction(at.column, at.row, at.lower)};
        const double length = glm::length(direction);
        const Horizontal to = horizontal_of(direction);
        const auto rgb = [&](Side side) {
            return glm::dvec3{light.smooth_rgb_cd_m2(to.elevation_rad, to.azimuth_rad, side)};
        };
        put(backdrop.sky, i, rgb(sky ? Side::kSky : Side::kGround));
        if (backdrop.horizon) put(backdrop.ground, i, rgb(Side::kGround));
        const auto inverse_m = static_cast<double>(
            latest.inverse_distance(at.column / Snapshot::kNodeStep, at.row / Snapshot::kNodeStep, at.lower));
        const double distance_m = inverse_m > 0.0 ? length / inverse_m : kUsual_m;
        put_air(air.between(direction / length, distance_m), distance_m, i, backdrop.extinction,
                backdrop.convergence);
        put(backdrop.sunlit, i,
            shadow != nullptr && at.lower ? shadow->seen_sunlit_cd_m2(air, direction) : glm::dvec3{0.0});
        if (map.near_map() == nullptr) continue;
        put_air(air.between(direction / length, kNearUsual_m), kNearUsual_m, i, backdrop.near_extinction,
                backdrop.near_convergence);
    }
    if (map.near_map() == nullptr) {
        copy_rgb(backdrop.extinction, backdrop.near_extinction);
        copy_rgb(backdrop.convergence, backdrop.near_convergence);
    }
    backdrop.steep = steep(backdrop.sky) || (backdrop.horizon && steep(backdrop.ground));
}

void look_up(NearNodes& near, const cloud::CloudMap& map, int tile) noexcept {
    near.any = false;
    if (map.near_map() == nullptr) return;
    const MapGeometry::Texel corner = map.geometry().corner(tile);
    for (int i = 0; i < kNodeCount; ++i) {
        const MapGeometry::Texel at = node_of(corner, i);
        const Snapshot::Seen seen =
            map.near_map()->seen(map.geometry().direction(at.column, at.row, at.lower));
        for (int c = 0; c < 3; ++c)
            near.light[c][i] = seen.light[c];
        near.passed[i] = seen.light[3];
        near.reach_m[i] = seen.reach_m;
        near.any = near.any || seen.light[3] < 1.0F;
    }
}

bool still_serves(const NearNodes& made, const NearNodes& wanted) noexcept {
    constexpr float kPassedStep = 1e-4F;
    constexpr float kLightStep = 1.5e-3F;
    if (made.any != wanted.any) return false;
    if (!made.any) return true;
    for (int i = 0; i < kNodeCount; ++i) {
        if (std::abs(made.passed[i] - wanted.passed[i]) > kPassedStep) return false;
        for (int c = 0; c < 3; ++c) {
            const float a = made.light[c][i], b = wanted.light[c][i];
            if (std::abs(a - b) > kLightStep * std::max(a, b)) return false;
        }
    }
    return true;
}

// Cloud hardly absorbs: what weakens a flash on its way through is what escapes to all sides, as if some of
// the depth of a cumulonimbus, 0.03 per metre, were left out.
glm::vec3 flash_inside_cd_m2(const cloud::Flash& flash, const glm::dvec3& place_m) noexcept {
    constexpr double kForward = 0.85;
    constexpr double kEscape_per_m = 1.0 / 1500.0;
    const double depth = glm::distance(flash.place_m, place_m) * kEscape_per_m / (1.0 - kForward);
    return cloud::flash_on_cloud_cd_m2(flash, place_m, depth, kForward);
}

cloud::Flashes flashes_on(const cloud::Cone& cone, const cloud::Flashes& flashes) noexcept {
    cloud::Flashes on;
    for (const cloud::Flash& flash : flashes.all()) {
        // As seen from the eye, a tile's clouds lie within its cone.
        const double away_m = glm::length(flash.place_m);
        const double along_m = glm::dot(flash.place_m, cone.axis);
        const double aside_m = std::sqrt(std::max(away_m * away_m - along_m * along_m, 0.0));
        const double outside_m =
            along_m > 0.0 ? aside_m * cone.cosine - along_m * cone.sine : away_m - cloud::kFlashReach_m;
        if (outside_m < cloud::kFlashReach_m) on.flashes[on.count++] = flash;
    }
    return on;
}

glm::vec3 CloudTile::direction_of_node(int node) const noexcept {
    const MapGeometry::Texel at = node_of({tile_.column, tile_.row, tile_.lower}, node);
    return geometry_.direction(at.column, at.row, at.lower);
}

void CloudTile::take(const cloud::CloudMap& map, int tile, const CloudBackdrop& backdrop,
                     const NearNodes& near, const SkyLight& light, const cloud::Flashes& flashes) noexcept {
    geometry_ = map.geometry();
    flashes_ = flashes;
    const MapGeometry::Texel corner = geometry_.corner(tile);
    tile_.map_size = geometry_.size();
    tile_.column = corner.column;
    tile_.row = corner.row;
    tile_.lower = corner.lower;
    tile_.fold = fold_of(corner, geometry_.size());
    tile_.horizon = backdrop.horizon;
    tile_.horizon_sine = static_cast<float>(std::sin(light.horizon_elevation_rad));
    steep_ = backdrop.steep;
    copy_rgb(backdrop.sky, tile_.smooth + cloud::kBehind);
    copy_rgb(backdrop.ground, tile_.ground);
    copy_rgb(backdrop.extinction, tile_.smooth + cloud::kExtinction);
    copy_rgb(backdrop.convergence, tile_.smooth + cloud::kConvergence);
    take_parts(map);
    tile_.near = near.any;
    if (near.any) take_near(backdrop, near);
    covered_ = near.any && hides_far(map, backdrop);
    tile_.clear = !map.may_show(tile);
    tile_.shadow = nullptr;
}

void CloudTile::shade(const cloud::ShadowCells& shadow, const CloudBackdrop& backdrop) noexcept {
    tile_.shadow = &shadow;
    copy_rgb(backdrop.sunlit, tile_.sunlit);
}

void CloudTile::gather(int row) noexcept {
    cloud::tone_kernel().gather(tile_, row, row_);
    if (flashes_.count > 0) add_flashes(row);
}

void CloudTile::tell_things(int row, std::span<float> things) const noexcept {
    const std::size_t place = static_cast<std::size_t>(row) * kToneRow;
    cloud::tone_kernel().seen(row_, &things[4 * place]);
    std::copy_n(row_.inverse_per_m, kToneRow, &things[std::size_t{4} * cloud::kTileTexels + place]);
    std::copy_n(row_.near_passed, kToneRow, &things[std::size_t{5} * cloud::kTileTexels + place]);
}

void CloudTile::take_parts(const cloud::CloudMap& map) noexcept {
    const MapGeometry::Texel corner{tile_.column, tile_.row, tile_.lower};
    near_share_ = 0.0F;
    tile_.part_count = 0;
    for (const cloud::CloudMap::Part& part : map.parts()) {
        cloud::TonePart& to = tile_.parts[tile_.part_count++];
        to.light = part.snapshot->light_and_passed();
        to.reach_m = part.snapshot->reach_m();
        to.weight = part.weight;
        for (int c = 0; c < 3; ++c)
            to.offset_m[c] = part.offset_m[c];
        to.beyond_near = part.beyond_near;
        near_share_ += part.beyond_near ? part.weight : 0.0F;
        for (int i = 0; i < kNodeCount; ++i) {
            const MapGeometry::Texel at = node_of(corner, i);
            to.inverse_m[i] = part.snapshot->inverse_distance(at.column / Snapshot::kNodeStep,
                                                              at.row / Snapshot::kNodeStep, at.lower);
        }
    }
}

void CloudTile::take_near(const CloudBackdrop& backdrop, const NearNodes& near) noexcept {
    copy(near.passed, tile_.near_passed);
    for (int i = 0; i < kNodeCount; ++i) {
        const float opacity = 1.0F - near.passed[i];
        const float distance_m = opacity > 1e-6F ? near.reach_m[i] / opacity : 0.0F;
        glm::vec3 added{0.0F};
        if (flashes_.count > 0 && opacity > 1e-3F) {
            const glm::dvec3 place_m =
                glm::normalize(glm::dvec3{direction_of_node(i)}) * static_cast<double>(distance_m);
            for (const cloud::Flash& flash : flashes_.all())
                added += opacity * flash_inside_cd_m2(flash, place_m);
        }
        for (int c = 0; c < 3; ++c) {
            const float clear = std::exp(-backdrop.near_extinction[c][i] * distance_m);
            tile_.smooth[cloud::kNearLight + c][i] =
                near_share_ * ((near.light[c][i] + added[c]) * clear +
                               opacity * (1.0F - clear) * backdrop.near_convergence[c][i]);
        }
    }
}

// Whether what shows past near clouds is less than half a code, as far as nodes tell: ground in a gap of
// shadows is brighter than the mean by no more than all of the beam.
bool CloudTile::hides_far(const cloud::CloudMap& map, const CloudBackdrop& backdrop) const noexcept {
    constexpr float kMostPassed = 0.02F;
    constexpr float kHidden = 0.004F;
    const auto* near_light = tile_.smooth + cloud::kNearLight;
    const float passed = *std::max_element(tile_.near_passed, tile_.near_passed + kNodeCount);
    const bool past = near_share_ < 0.999F;
    if (past || passed > kMostPassed || steep(near_light)) return false;
    glm::vec3 far{0.0F}, near{1e30F};
    for (int i = 0; i < kNodeCount; ++i) {
        const glm::vec3 direction = direction_of_node(i);
        glm::vec3 seen{0.0F};
        for (int k = 0; k < tile_.part_count; ++k) {
            const cloud::CloudMap::Part& part = map.parts()[static_cast<std::size_t>(k)];
            const auto light =
                part.snapshot->seen(direction, tile_.parts[k].inverse_m[i], part.offset_m).light;
            seen += part.weight * glm::vec3{light[0], light[1], light[2]};
        }
        for (int c = 0; c < 3; ++c) {
            far[c] = std::max(far[c], seen[c] +
                                          std::max(tile_.smooth[cloud::kBehind + c][i],
                                                   tile_.horizon ? tile_.ground[c][i] : 0.0F) +
                                          backdrop.sunlit[c][i]);
            near[c] = std::min(near[c], near_light[c][i]);
        }
    }
    return glm::all(glm::lessThanEqual(passed * far, kHidden * near));
}

void CloudTile::add_flashes(int row) noexcept {
    for (int i = 0; i < kToneRow; ++i) {
        if (!(row_.opacity[i] > 1e-3F)) continue;
        const glm::dvec3 direction =
            glm::normalize(glm::dvec3{geometry_.direction(tile_.column + i, tile_.row + row, tile_.lower)});
        const glm::dvec3 place_m = direction * static_cast<double>(row_.reach_m[i] / row_.opacity[i]);
        for (const cloud::Flash& flash : flashes_.all()) {
            const glm::vec3 added = row_.opacity[i] * flash_inside_cd_m2(flash, place_m);
            for (int c = 0; c < 3; ++c)
                row_.light[c][i] += added[c];
        }
    }
}

// Near clouds hide all else, and are smooth: their codes are.
void CloudTile::cover(const cloud::ToneLaw& law, float* out) const noexcept {
    float codes[3][cloud::kNodeFloats];
    for (int c = 0; c < 3; ++c)
        copy(tile_.smooth[cloud::kNearLight + c], codes[c]);
    cloud::tone_kernel().show(law, codes[0], codes[1], codes[2]);
    for (int y = 0; y < kToneRow; ++y)
        cloud::tone_kernel().cover(codes, tile_.fold, y, out + y * kToneRow * 4);
}

// One screen's rig has the codes behind at the nodes; where they bend, and for several screens, they are
// worked out.
void CloudTile::tell_codes(const cloud::ToneLaw& law) noexcept {
    for (int c = 0; c < 3; ++c) {
        copy(tile_.smooth[cloud::kBehind + c], tile_.smooth[cloud::kBehindCode + c]);
        copy(tile_.ground[c], tile_.ground_code[c]);
    }
    float(*codes)[cloud::kNodeFloats] = tile_.smooth + cloud::kBehindCode;
    cloud::tone_kernel().show(law, codes[0], codes[1], codes[2]);
    codes = tile_.ground_code;
    if (tile_.horizon) cloud::tone_kernel().show(law, codes[0], codes[1], codes[2]);
}

float CloudTile::tone(std::span<const cloud::ToneLaw> laws, std::span<std::vector<float>> out,
                      std::size_t first, std::span<float> things) noexcept {
    const cloud::ToneKernel& kernel = cloud::tone_kernel();
    tile_.depths = !things.empty();
    if (covered_) {
        tile_.codes = false;
        for (int y = 0; tile_.depths && y < kToneRow; ++y) {
            gather(y);
            tell_things(y, things);
        }
        for (std::size_t screen = 0; screen < laws.size(); ++screen)
            cover(laws[screen], &out[screen][first]);
        // The eye's way does not move it.
        return 0.0F;
    }
    tile_.codes = laws.size() == 1 && !steep_;
    if (tile_.codes) tell_codes(laws.front());
    for (int y = 0; y < kToneRow; ++y) {
        gather(y);
        if (tile_.depths) tell_things(y, things);
        for (std::size_t screen = 0; screen < laws.size(); ++screen)
            kernel.tone(laws[screen], row_, tile_.codes,
                        &out[screen][first + static_cast<std::size_t>(y * kToneRow * 4)]);
    }
    float largest = 0.0F;
    for (const std::vector<float>& texels : out)
        largest = std::max(largest, kernel.largest_step(&texels[first]));
    return largest;
}

}  // namespace skyig::render
