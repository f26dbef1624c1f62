#include "render/cloud_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/geometry.h"

namespace skyig::render {

namespace {

cloud::ToneLaw law_of(const shaders64::ToneParameters& tone) noexcept {
    const auto f = [](double x) { return static_cast<float>(x); };
    return {f(tone.log2_gain), f(tone.exponent), f(tone.compression),
            f(tone.burn),      f(tone.photopic), f(tone.inv_display_max),
            f(tone.ambient),   f(tone.shoulder), f(tone.encode_power)};
}

glm::dvec3 body_direction(const SkyLight& light, const glm::dvec3& airless_enu) {
    const Horizontal airless = horizontal_of(airless_enu);
    return direction_of({light.refraction.apparent_from_true(airless.elevation_rad), airless.azimuth_rad});
}

}  // namespace

CloudFrame::CloudFrame(std::size_t screens) : laws_(screens), texels_(screens) {
    probes_.resize(eye::kProbeCount + 2);
}

void CloudFrame::stop() noexcept {
    if (!shown_) return;
    map_.stop();
    patches_.stop();
    shadow_ = nullptr;
    shown_ = false;
    toned_.clear();
    clouded_.clear();
    clouded_tiles_.clear();
    for (Made& made : made_)
        made.light = made.map = 0;
}

void CloudFrame::resize() {
    const auto tiles = static_cast<std::size_t>(map_.geometry().tile_count());
    backdrops_.resize(tiles);
    made_.assign(tiles, Made{});
    toned_.reserve(tiles);
    clouded_.reserve(tiles);
    clouded_tiles_.reserve(tiles);
    near_made_.resize(tiles);
    // Room for all, of which views see some; what is not used is never touched.
    for (auto& texels : texels_)
        texels.reserve(tiles * kTileFloats);
    if (serves_things_) things_.reserve(tiles * CloudTile::kThingFloats);
    ++size_revision_;
}

void CloudFrame::follow(cloud::CloudMaker& maker, const Scene& scene, const cloud::CloudLight& on_clouds,
                        const SkyLight& light, bool jumped, int size, int tiles_a_frame) {
    for (std::size_t i = 0; i < eye::kProbeCount; ++i) {
        const eye::ProbeDirection& probe = eye::probe_directions()[i];
        const double elevation_rad = light.horizon_elevation_rad + probe.above_horizon_rad;
        probes_[i] = glm::vec3{
            direction_of({std::min(elevation_rad, 0.5 * std::numbers::pi - 1e-4), probe.azimuth_rad})};
    }
    probes_[eye::kProbeCount] = glm::vec3{body_direction(light, scene.sun.direction_enu)};
    probes_[eye::kProbeCount + 1] = glm::vec3{body_direction(light, scene.moon.direction_enu)};
    jumped_ = jumped || !shown_;
    map_.update(maker,
                {.moment = {scene, scene.eye, on_clouds},
                 .views = scene.channel_views(),
                 .probes = probes_,
                 .seen_horizon_rad = light.horizon_elevation_rad,
                 .straight_horizon_rad = light.straight_horizon_rad,
                 .jumped = jumped_},
                size, tiles_a_frame);
    if (serves_things_) patches_.update(maker, {scene, scene.eye, on_clouds});
    if (made_.size() != static_cast<std::size_t>(map_.geometry().tile_count())) resize();
    shown_ = true;
}

glm::dvec3 CloudFrame::composed(const cloud::CloudMap::Sight& sight, const DeferredAir& air,
                                const glm::dvec3& behind_cd_m2,
                                const glm::dvec3& direction_enu) const noexcept {
    glm::dvec3 sum = sight.transmittance * behind_cd_m2;
    const auto add = [&](glm::dvec3 light_cd_m2, double opacity, double distance_m) {
        if (!(opacity > 0.0)) return;
        const auto between = air.between(direction_enu, distance_m);
        for (const cloud::Flash& flash : flashes_.all())
            light_cd_m2 += opacity * glm::dvec3{flash_inside_cd_m2(flash, direction_enu * distance_m)};
        sum += between.passed_rgb * light_cd_m2 + opacity * between.added_rgb;
    };
    add(sight.near_light_cd_m2, sight.near_opacity, sight.near_distance_m);
    add(sight.far_light_cd_m2, sight.far_opacity, sight.distance_m);
    return sum;
}

double CloudFrame::transmittance(const glm::dvec3& direction_enu) const noexcept {
    return shown_ ? map_.sight(direction_enu).transmittance : 1.0;
}

double CloudFrame::transmittance(Body body) const noexcept {
    if (!shown_) return 1.0;
    const std::size_t probe = eye::kProbeCount + static_cast<std::size_t>(body);
    return map_.sight_or_probe(glm::dvec3{probes_[probe]}, probe).transmittance;
}

glm::dvec3 CloudFrame::seen_through(const DeferredAir& air, const glm::dvec3& behind_cd_m2,
                                    const glm::dvec3& direction_enu) const noexcept {
    if (!shown_) return behind_cd_m2;
    const glm::dvec3 shade_cd_m2 =
        shadow_ != nullptr ? shadow_->change_cd_m2(air, direction_enu, map_.geometry().worst_texel_rad())
                           : glm::dvec3{0.0};
    return composed(map_.sight(direction_enu), air, behind_cd_m2 + shade_cd_m2, direction_enu);
}

glm::dvec3 CloudFrame::before_thing(const DeferredAir& air, const glm::dvec3& thing_cd_m2,
                                    const glm::dvec3& direction_enu, double distance_m) const noexcept {
    if (!shown_) return thing_cd_m2;
    const cloud::CloudMap::Sight sight = map_.sight(direction_enu);
    const double inverse_per_m = sight.distance_m > 0.0 ? 1.0 / sight.distance_m : 0.0;
    double all = sight.transmittance, near = 1.0 - sight.near_opacity, before = 1.0;
    if (patches_.shown()) {
        const auto passed = [&](double to_m) {
            return std::exp(-patches_.optical_depth(direction_enu, to_m));
        };
        before = passed(distance_m);
        near = shaders64::patch_others(near, passed(cloud::kNearRange_m));
        all = shaders64::patch_others(all, passed(fog::Veil::kEndless_m));
    }
    before *= shaders64::passed_before(all, near, distance_m, cloud::kNearRange_m, inverse_per_m);
    const glm::dvec3 all_cd_m2 = composed(sight, air, glm::dvec3{0.0}, direction_enu);
    return before * thing_cd_m2 + shaders64::light_before(sight.transmittance, before) * all_cd_m2;
}

void CloudFrame::serve_things() noexcept {
    if (serves_things_) return;
    serves_things_ = true;
    things_.reserve(made_.size() * CloudTile::kThingFloats);
    for (Made& made : made_)
        made.map = made.at_frame = 0;
}

glm::dvec3 CloudFrame::probed(const DeferredAir& air, const glm::dvec3& behind_cd_m2,
                              std::size_t probe) const noexcept {
    if (!shown_) return behind_cd_m2;
    return composed(map_.probe(probe), air, behind_cd_m2, glm::dvec3{probes_[probe]});
}

void CloudFrame::refresh_backdrops(const SkyLight& light, const DeferredAir& air, std::uint64_t revision) {
    // All that have none; of the others some, in turn.
    for (const int tile : clouded_tiles_) {
        Made& made = made_[static_cast<std::size_t>(tile)];
        if (made.light != 0 && !jumped_) continue;
        look_up(backdrops_[static_cast<std::size_t>(tile)], map_, tile, light, air, shadow_);
        made.light = revision;
        made.map = 0;
    }
    const std::size_t count = clouded_tiles_.size();
    std::size_t refreshed = 0;
    for (std::size_t tried = 0; tried < count && refreshed < kBackdropsAFrame; ++tried) {
        const int tile = clouded_tiles_[next_backdrop_++ % count];
        Made& made = made_[static_cast<std::size_t>(tile)];
        if (made.light == revision) continue;
        look_up(backdrops_[static_cast<std::size_t>(tile)], map_, tile, light, air, shadow_);
        made.light = revision;
        made.map = 0;
        ++refreshed;
    }
}

// Tiles of the upper half end at the level: all that shadows are told of is below it.
double CloudFrame::shaded_from_m(int tile) const noexcept {
    const bool below = map_.geometry().corner(tile).lower;
    return below && shadow_ != nullptr ? shadow_->nearest_m(map_.cone(tile)) : 0.0;
}

// Whether a tile of the texture still shows what it should: nothing has changed but the eye's place, and that
// by what moves no code by half a step. The bound is too wide by three: it takes the tile's largest step, its
// nearest cloud, and texels as narrow as they are anywhere.
bool CloudFrame::serves(int tile, std::uint64_t tone_revision) const noexcept {
    const Made& made = made_[static_cast<std::size_t>(tile)];
    if (!made.clouded || made.tone != tone_revision || made.map == 0) return false;
    constexpr float kStep = 3.0F * 0.5F / 255.0F;
    // Texels are 1.41 / size wide where they are narrowest; a way aslant goes over rows and columns.
    const float steps_a_rad = made.step * static_cast<float>(map_.geometry().size());
    const double shaded_m = shaded_from_m(tile);
    if (shaded_m > 0.0) {
        // A third of a texel at least: the step may be a cloud's edge, shadows are softer.
        const float still_rad = std::max(kStep / std::max(steps_a_rad, 1e-9F), 5e-4F);
        if (!shadow_->serves(made.shadow, shaded_m, tile, static_cast<double>(still_rad))) return false;
    } else if (made.shadow.shaded) {
        return false;
    }
    if (!map_.may_show(tile)) return !made.with_clouds;
    if (made.map != map_.revision() || !still_serves(near_made_[static_cast<std::size_t>(tile)], near_))
        return false;
    const glm::vec3 axis{map_.cone(tile).axis};
    const auto parts = map_.parts();
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const glm::vec3 moved_m = parts[k].offset_m - made.offsets_m[k];
        const float aside_m = glm::length(glm::cross(axis, moved_m));
        if (aside_m * parts[k].snapshot->nearest_inverse(tile) * steps_a_rad > kStep) return false;
    }
    return true;
}

// Whether it is another tile's turn. What was toned longer ago than a round has not been in view.
bool CloudFrame::rests(int tile) const noexcept {
    const Made& made = made_[static_cast<std::size_t>(tile)];
    const bool turn = (frames_ + static_cast<std::uint64_t>(tile)) % tone_every_ == 0;
    return made.clouded && made.at_frame != 0 && !jumped_ && !turn && frames_ < made.at_frame + tone_every_;
}

void CloudFrame::tone(const SkyLight& light, const DeferredAir& air,
                      std::span<const shaders64::ToneParameters> tones, std::uint64_t light_revision,
                      std::uint64_t tone_revision, const cloud::Flashes& flashes) {
    flashes_ = flashes;
    toned_.clear();
    toned_count_ = 0;
    clouded_.clear();
    clouded_tiles_.clear();
    ++frames_;
    if (!shown_) return;
    for (std::size_t screen = 0; screen < laws_.size(); ++screen)
        laws_[screen] = law_of(tones[screen]);
    for (const int tile : map_.seen_tiles()) {
        Made& made = made_[static_cast<std::size_t>(tile)];
        if (map_.may_show(tile) || shaded_from_m(tile) > 0.0) {
            clouded_tiles_.push_back(tile);
            clouded_.push_back(map_.cone(tile));
        } else if (made.clouded) {
            toned_.push_back({tile, TonedTile::kClear});
            made.clouded = false;
            made.map = 0;
        }
    }
    refresh_backdrops(light, air, light_revision + 1);
    if (shadow_ != nullptr)
        shadow_cells_ = shadow_->cells(static_cast<float>(map_.geometry().worst_texel_rad()));
    const std::size_t most = map_.seen_tiles().size() * kTileFloats;
    for (auto& texels : texels_) {
        if (texels.size() < most) texels.resize(most);
    }
    const std::size_t of_things = serves_things_ ? map_.seen_tiles().size() * CloudTile::kThingFloats : 0;
    if (things_.size() < of_things) things_.resize(of_things);
    for (const int tile : clouded_tiles_)
        refresh_tile(tile, light, tone_revision);
}

void CloudFrame::refresh_tile(int tile, const SkyLight& light, std::uint64_t tone_revision) noexcept {
    const auto index = static_cast<std::size_t>(tile);
    Made& made = made_[index];
    look_up(near_, map_, tile);
    const cloud::Flashes flashes = flashes_on(map_.cone(tile), flashes_);
    const bool flashed = flashes.count > 0;
    if (!flashed && !made.flashed && (rests(tile) || serves(tile, tone_revision))) return;
    const std::size_t count = toned_count_++;
    const std::size_t first = count * kTileFloats;
    const bool shaded = shaded_from_m(tile) > 0.0;
    tile_.take(map_, tile, backdrops_[index], near_, light, flashes);
    if (shaded) tile_.shade(shadow_cells_, backdrops_[index]);
    const std::span<float> things =
        serves_things_ ? std::span{things_}.subspan(count * CloudTile::kThingFloats, CloudTile::kThingFloats)
                       : std::span<float>{};
    made.step = tile_.tone(laws_, texels_, first, things);
    toned_.push_back({tile, first});
    made.flashed = flashed;
    made.clouded = true;
    made.with_clouds = map_.may_show(tile);
    made.shadow = shaded ? shadow_->as_made() : GroundShadow::Made{};
    made.map = map_.revision();
    made.tone = tone_revision;
    made.at_frame = frames_;
    for (std::size_t k = 0; k < map_.parts().size(); ++k)
        made.offsets_m[k] = map_.parts()[k].offset_m;
    near_made_[index] = near_;
}

}  // namespace skyig::render
