#include "render/cloud_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/geometry.h"

namespace skyig::render {

namespace {

using cloud::kTile;
using cloud::MapGeometry;

// Where no cloud tells how far it is, the air is asked for this far.
constexpr double kUsual_m = 10e3;

cloud::ToneLaw law_of(const shaders64::ToneParameters& tone) noexcept {
    const auto f = [](double x) { return static_cast<float>(x); };
    return {f(tone.log2_gain), f(tone.exponent), f(tone.compression),
            f(tone.burn),      f(tone.photopic), f(tone.inv_display_max),
            f(tone.ambient),   f(tone.shoulder), f(tone.encode_power)};
}

// Whether some component of the light changes by more than an eighth from node to node.
bool steep(const glm::vec3 (&light)[25]) noexcept {
    constexpr float kStep = 0.125F;
    const auto apart = [&](int i, int k) {
        const glm::vec3 larger = glm::max(light[i], light[k]);
        return glm::any(glm::greaterThan(glm::abs(light[i] - light[k]), kStep * larger));
    };
    for (int i = 0; i < 25; ++i) {
        if ((i % 5 < 4 && apart(i, i + 1)) || (i < 20 && apart(i, i + 5))) return true;
    }
    return false;
}

// Cloud hardly absorbs: what weakens a flash on its way through is what escapes to all sides, as if some of
// the depth of a cumulonimbus, 0.03 per metre, were left out.
glm::vec3 flash_inside_cd_m2(const cloud::Flash& flash, const glm::dvec3& place_m) noexcept {
    constexpr double kForward = 0.85;
    constexpr double kEscape_per_m = 1.0 / 1500.0;
    const double depth = glm::distance(flash.place_m, place_m) * kEscape_per_m / (1.0 - kForward);
    return cloud::flash_on_cloud_cd_m2(flash, place_m, depth, kForward);
}

glm::dvec3 body_direction(const SkyLight& light, const glm::dvec3& airless_enu) {
    const Horizontal airless = horizontal_of(airless_enu);
    return direction_of({light.refraction.apparent_from_true(airless.elevation_rad), airless.azimuth_rad});
}

}  // namespace

// At a tile's nodes, for this frame.
struct CloudFrame::Nodes {
    std::array<std::array<float, kNodeCount>, 2> inverse_m{};  // of each part
    std::array<cloud::LightAndPassed, kNodeCount> near{};
};

// Codes of what stands behind a tile, at its nodes.
struct CloudFrame::Behind {
    static constexpr std::size_t kPadded = cloud::kToneRow;
    /// Of each component.
    float sky[3][kPadded];
    float ground[3][kPadded];
};

CloudFrame::CloudFrame(std::size_t screens) : laws_(screens), texels_(screens) {
    probes_.resize(eye::kProbeCount + 2);
}

void CloudFrame::stop() noexcept {
    if (!shown_) return;
    map_.stop();
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
    if (made_.size() != static_cast<std::size_t>(map_.geometry().tile_count())) resize();
    shown_ = true;
}

glm::dvec3 CloudFrame::composed(const cloud::CloudMap::Sight& sight, const DeferredAir& air,
                                const glm::dvec3& behind_cd_m2,
                                const glm::dvec3& direction_enu) const noexcept {
    glm::dvec3 sum = sight.near_light_cd_m2 + sight.transmittance * behind_cd_m2;
    if (sight.far_opacity > 0.0) {
        const auto between = air.between(direction_enu, sight.distance_m);
        glm::dvec3 light_cd_m2 = sight.far_light_cd_m2;
        for (const cloud::Flash& flash : flashes_.all()) {
            light_cd_m2 +=
                sight.far_opacity * glm::dvec3{flash_inside_cd_m2(flash, direction_enu * sight.distance_m)};
        }
        sum += between.passed_rgb * light_cd_m2 + sight.far_opacity * between.added_rgb;
    }
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
    return shown_ ? composed(map_.sight(direction_enu), air, behind_cd_m2, direction_enu) : behind_cd_m2;
}

glm::dvec3 CloudFrame::probed(const DeferredAir& air, const glm::dvec3& behind_cd_m2,
                              std::size_t probe) const noexcept {
    if (!shown_) return behind_cd_m2;
    return composed(map_.probe(probe), air, behind_cd_m2, glm::dvec3{probes_[probe]});
}

void CloudFrame::look_up(int tile, const SkyLight& light, const DeferredAir& air) noexcept {
    Backdrop& backdrop = backdrops_[static_cast<std::size_t>(tile)];
    const MapGeometry::Texel corner = map_.geometry().corner(tile);
    const cloud::Snapshot& latest = *map_.parts().back().snapshot;
    const cloud::Cone& cone = map_.cone(tile);
    const double reach_rad = std::atan2(cone.sine, cone.cosine);
    const double middle_rad = horizontal_of(cone.axis).elevation_rad - light.horizon_elevation_rad;
    for (int i = 0; i < kNodes * kNodes; ++i) {
        const auto node = static_cast<std::size_t>(i);
        const int column = corner.column + i % kNodes * cloud::Snapshot::kNodeStep;
        const int row = corner.row + i / kNodes * cloud::Snapshot::kNodeStep;
        const glm::dvec3 direction{map_.geometry().direction(column, row, corner.lower)};
        const double length = glm::length(direction);
        const Horizontal at = horizontal_of(direction);
        const auto rgb = [&](Side side) {
            return light.smooth_rgb_cd_m2(at.elevation_rad, at.azimuth_rad, side);
        };
        if (middle_rad + reach_rad > 0.0) backdrop.sky[i] = rgb(Side::kSky);
        if (middle_rad - reach_rad < 0.0) backdrop.ground[i] = rgb(Side::kGround);
        if (middle_rad + reach_rad <= 0.0) backdrop.sky[i] = backdrop.ground[i];
        const auto inverse_m = static_cast<double>(latest.inverse_distance(
            column / cloud::Snapshot::kNodeStep, row / cloud::Snapshot::kNodeStep, corner.lower));
        const double distance_m = inverse_m > 0.0 ? length / inverse_m : kUsual_m;
        const auto between = air.between(direction / length, distance_m);
        const glm::dvec3 kept = glm::max(glm::dvec3{1.0} - between.passed_rgb, glm::dvec3{1e-6});
        backdrop.extinction[node] =
            glm::vec3{-glm::log(glm::max(between.passed_rgb, glm::dvec3{1e-12})) / distance_m};
        backdrop.convergence[node] = glm::vec3{between.added_rgb / kept};
    }
    backdrop.horizon = std::abs(middle_rad) < reach_rad;
    backdrop.steep = steep(backdrop.sky) || (backdrop.horizon && steep(backdrop.ground));
}

void CloudFrame::refresh_backdrops(const SkyLight& light, const DeferredAir& air, std::uint64_t revision) {
    // All that have none; of the others some, in turn.
    for (const int tile : clouded_tiles_) {
        Made& made = made_[static_cast<std::size_t>(tile)];
        if (made.light != 0 && !jumped_) continue;
        look_up(tile, light, air);
        made.light = revision;
        made.map = 0;
    }
    const std::size_t count = clouded_tiles_.size();
    std::size_t refreshed = 0;
    for (std::size_t tried = 0; tried < count && refreshed < kBackdropsAFrame; ++tried) {
        const int tile = clouded_tiles_[next_backdrop_++ % count];
        Made& made = made_[static_cast<std::size_t>(tile)];
        if (made.light == revision) continue;
        look_up(tile, light, air);
        made.light = revision;
        made.map = 0;
        ++refreshed;
    }
}

void CloudFrame::fill_nodes(int tile, Nodes& nodes) const noexcept {
    const MapGeometry::Texel corner = map_.geometry().corner(tile);
    const auto parts = map_.parts();
    for (int i = 0; i < kNodes * kNodes; ++i) {
        const auto node = static_cast<std::size_t>(i);
        const int column = corner.column + i % kNodes * cloud::Snapshot::kNodeStep;
        const int row = corner.row + i / kNodes * cloud::Snapshot::kNodeStep;
        for (std::size_t part = 0; part < parts.size(); ++part) {
            nodes.inverse_m[part][node] = parts[part].snapshot->inverse_distance(
                column / cloud::Snapshot::kNodeStep, row / cloud::Snapshot::kNodeStep, corner.lower);
        }
        if (map_.near_map() == nullptr) {
            nodes.near[node].v = cloud::LightAndPassed::Lanes{0.0F, 0.0F, 0.0F, 1.0F};
            continue;
        }
        nodes.near[node].v = map_.near_map()->seen(map_.geometry().direction(column, row, corner.lower));
    }
}

namespace {

// Where the octahedron folds: along a diagonal of its square, which tiles on it have as theirs.
enum class Fold { kNone, kFalling, kRising };

Fold fold_of(const MapGeometry::Texel& corner, int size) noexcept {
    if (corner.column == corner.row) return Fold::kFalling;
    return corner.column + corner.row == size - kTile ? Fold::kRising : Fold::kNone;
}

// One row of texels from nodes, kNodeStep texels apart: linear both ways, but over two triangles in cells
// that the fold goes through.
template <class At>
void spread(Fold fold, int row, At at, float* out) noexcept {
    constexpr int kStep = cloud::Snapshot::kNodeStep;
    constexpr float kShare = 1.0F / kStep;
    const int high = row / kStep;
    const float down = static_cast<float>(row % kStep) * kShare;
    for (int cell = 0; cell < kTile / kStep; ++cell) {
        const auto node = static_cast<std::size_t>(high * 5 + cell);
        const float a = at(node), b = at(node + 1), c = at(node + 5), d = at(node + 6);
        const bool falling = fold == Fold::kFalling && cell == high;
        const bool rising = fold == Fold::kRising && cell + high == kTile / kStep - 1;
        float* texels = out + cell * kStep;
        if (!falling && !rising) {
            const float from = a + down * (c - a);
            const float step = (b + down * (d - b) - from) * kShare;
            for (int i = 0; i < kStep; ++i)
                texels[i] = from + step * static_cast<float>(i);
            continue;
        }
        for (int i = 0; i < kStep; ++i) {
            const float right = static_cast<float>(i) * kShare;
            if (falling)
                texels[i] = right > down ? a + right * (b - a) + down * (d - b)
                                         : a + down * (c - a) + right * (d - c);
            else
                texels[i] = right + down < 1.0F ? a + right * (b - a) + down * (c - a)
                                                : d + (1.0F - right) * (c - d) + (1.0F - down) * (b - d);
        }
    }
}

}  // namespace

void CloudFrame::gather_row(int tile, int row, const Nodes& nodes, cloud::ToneRow& out) const noexcept {
    const MapGeometry& geometry = map_.geometry();
    const MapGeometry::Texel corner = geometry.corner(tile);
    const auto parts = map_.parts();
    const Fold fold = fold_of(corner, geometry.size());
    float near_passed[kTile];
    spread(
        fold, row, [&](std::size_t i) { return nodes.near[i].v[3]; }, near_passed);
    float near_share = 0.0F;
    float inverse_m[2][kTile];
    for (std::size_t part = 0; part < parts.size(); ++part) {
        spread(
            fold, row, [&](std::size_t i) { return nodes.inverse_m[part][i]; }, inverse_m[part]);
        near_share += parts[part].beyond_near ? parts[part].weight : 0.0F;
    }
    for (int c = 0; c < 3; ++c) {
        spread(
            fold, row, [&](std::size_t i) { return near_share * nodes.near[i].v[c]; },
            out.smooth[cloud::kNearLight + c]);
    }
    const float scale = 2.0F / static_cast<float>(geometry.size() - 1);
    const float y = static_cast<float>(corner.row + row) * scale - 1.0F;
    for (int i = 0; i < kTile; ++i) {
        const float x = static_cast<float>(corner.column + i) * scale - 1.0F;
        glm::vec3 direction = shaders32::cloud_map_direction({x, y});
        if (corner.lower) direction.z = -direction.z;
        cloud::LightAndPassed::Lanes sum{};
        float opacity = 0.0F;
        float reach_m = 0.0F;
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const auto& part = parts[k];
            const cloud::Snapshot::Seen seen = part.snapshot->seen(direction, inverse_m[k][i], part.offset_m);
            const float factor = part.beyond_near ? part.weight * near_passed[i] : part.weight;
            sum += seen.light * factor;
            opacity += factor * (1.0F - seen.light[3]);
            reach_m += factor * seen.reach_m;
        }
        for (int c = 0; c < 3; ++c)
            out.light[c][i] = sum[c];
        out.passed[i] = sum[3];
        out.opacity[i] = opacity;
        out.reach_m[i] = reach_m;
    }
}

// What may light the clouds of a tile: it lies near by one of the places where they are.
void CloudFrame::find_flashes(int tile) noexcept {
    on_tile_.count = 0;
    if (flashes_.count == 0) return;
    const cloud::Cone& cone = map_.cone(tile);
    for (const cloud::Flash& flash : flashes_.all()) {
        // As seen from the eye, a tile's clouds lie within its cone.
        const double away_m = glm::length(flash.place_m);
        const double along_m = glm::dot(flash.place_m, cone.axis);
        const double aside_m = std::sqrt(std::max(away_m * away_m - along_m * along_m, 0.0));
        const double outside_m =
            along_m > 0.0 ? aside_m * cone.cosine - along_m * cone.sine : away_m - cloud::kFlashReach_m;
        if (outside_m < cloud::kFlashReach_m) on_tile_.flashes[on_tile_.count++] = flash;
    }
}

void CloudFrame::add_flashes(int tile, int row, cloud::ToneRow& out) const noexcept {
    const MapGeometry& geometry = map_.geometry();
    const MapGeometry::Texel corner = geometry.corner(tile);
    for (int i = 0; i < kTile; ++i) {
        if (!(out.opacity[i] > 1e-3F)) continue;
        const glm::dvec3 direction =
            glm::normalize(glm::dvec3{geometry.direction(corner.column + i, corner.row + row, corner.lower)});
        const glm::dvec3 place_m = direction * static_cast<double>(out.reach_m[i] / out.opacity[i]);
        for (const cloud::Flash& flash : on_tile_.all()) {
            const glm::vec3 added = out.opacity[i] * flash_inside_cd_m2(flash, place_m);
            for (int c = 0; c < 3; ++c)
                out.light[c][i] += added[c];
        }
    }
}

void CloudFrame::show_behind(const Backdrop& backdrop, Behind& behind) const noexcept {
    const auto show = [&](const glm::vec3(&light)[kNodeCount], float(&codes)[3][Behind::kPadded]) {
        for (std::size_t i = 0; i < Behind::kPadded; ++i) {
            const glm::vec3& rgb = light[std::min(i, kNodeCount - 1)];
            for (int c = 0; c < 3; ++c)
                codes[c][i] = rgb[c];
        }
        cloud::tone_kernel().show(laws_.front(), codes[0], codes[1], codes[2]);
    };
    show(backdrop.sky, behind.sky);
    if (backdrop.horizon) show(backdrop.ground, behind.ground);
}

// One screen's rig has the codes behind at the nodes; where they bend, and for several screens, they are
// worked out.
void CloudFrame::tone_tile(int tile, const SkyLight& light, std::size_t first) noexcept {
    const Backdrop& backdrop = backdrops_[static_cast<std::size_t>(tile)];
    Nodes nodes;
    fill_nodes(tile, nodes);
    const MapGeometry& geometry = map_.geometry();
    const MapGeometry::Texel corner = geometry.corner(tile);
    const Fold fold = fold_of(corner, geometry.size());
    const bool by_nodes = laws_.size() == 1 && !backdrop.steep;
    Behind behind;
    if (by_nodes) show_behind(backdrop, behind);
    const double horizon_sine = std::sin(light.horizon_elevation_rad);
    cloud::ToneRow row;
    float codes[3][kTile];
    for (int y = 0; y < kTile; ++y) {
        gather_row(tile, y, nodes, row);
        if (on_tile_.count > 0) add_flashes(tile, y, row);
        const auto lay = [&](const auto& at, float* out) { spread(fold, y, at, out); };
        for (int c = 0; c < 3; ++c) {
            lay([&](std::size_t i) { return backdrop.sky[i][c]; }, row.smooth[cloud::kBehind + c]);
            lay([&](std::size_t i) { return backdrop.extinction[i][c]; }, row.smooth[cloud::kExtinction + c]);
            lay([&](std::size_t i) { return backdrop.convergence[i][c]; },
                row.smooth[cloud::kConvergence + c]);
            if (by_nodes) lay([&](std::size_t i) { return behind.sky[c][i]; }, codes[c]);
            if (!backdrop.horizon) continue;
            // The ground shows below the horizon.
            float ground[kTile];
            float ground_codes[kTile];
            lay([&](std::size_t i) { return backdrop.ground[i][c]; }, ground);
            if (by_nodes) lay([&](std::size_t i) { return behind.ground[c][i]; }, ground_codes);
            for (int i = 0; i < kTile; ++i) {
                const glm::dvec3 direction{
                    geometry.direction(corner.column + i, corner.row + y, corner.lower)};
                if (direction.z > horizon_sine * glm::length(direction)) continue;
                row.smooth[cloud::kBehind + c][i] = ground[i];
                if (by_nodes) codes[c][i] = ground_codes[i];
            }
        }
        for (std::size_t screen = 0; screen < laws_.size(); ++screen) {
            cloud::tone_kernel().tone(laws_[screen], row, by_nodes ? codes[0] : nullptr,
                                      &texels_[screen][first + static_cast<std::size_t>(y * kTile * 4)]);
        }
    }
}

// Whether a tile of the texture still shows what it should: nothing has changed but the eye's place, and that
// by less than a quarter of a fine pixel.
bool CloudFrame::serves(int tile, std::uint64_t tone_revision) const noexcept {
    const Made& made = made_[static_cast<std::size_t>(tile)];
    if (!made.clouded || made.tone != tone_revision || made.map != map_.revision()) return false;
    constexpr float kStep_rad = 2.2e-4F;
    const glm::vec3 axis{map_.cone(tile).axis};
    const auto parts = map_.parts();
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const glm::vec3 moved_m = parts[k].offset_m - made.offsets_m[k];
        const float aside_m = glm::length(glm::cross(axis, moved_m));
        if (aside_m * parts[k].snapshot->nearest_inverse(tile) > steps_ * kStep_rad) return false;
    }
    return true;
}

void CloudFrame::tone(const SkyLight& light, const DeferredAir& air,
                      std::span<const shaders64::ToneParameters> tones, std::uint64_t light_revision,
                      std::uint64_t tone_revision, const cloud::Flashes& flashes) {
    flashes_ = flashes;
    toned_.clear();
    clouded_.clear();
    clouded_tiles_.clear();
    if (!shown_) return;
    for (std::size_t screen = 0; screen < laws_.size(); ++screen)
        laws_[screen] = law_of(tones[screen]);
    for (const int tile : map_.seen_tiles()) {
        Made& made = made_[static_cast<std::size_t>(tile)];
        if (map_.may_show(tile)) {
            clouded_tiles_.push_back(tile);
            clouded_.push_back(map_.cone(tile));
        } else if (made.clouded) {
            toned_.push_back({tile, TonedTile::kClear});
            made.clouded = false;
            made.map = 0;
        }
    }
    refresh_backdrops(light, air, light_revision + 1);
    // With room for a turn of the rig.
    const std::size_t most = map_.seen_tiles().size() * kTileFloats;
    for (auto& texels : texels_) {
        if (texels.size() < most) texels.resize(most + most / 2);
    }
    std::size_t first = 0;
    for (const int tile : clouded_tiles_) {
        Made& made = made_[static_cast<std::size_t>(tile)];
        find_flashes(tile);
        const bool flashed = on_tile_.count > 0;
        if (!flashed && !made.flashed && serves(tile, tone_revision)) continue;
        made.flashed = flashed;
        tone_tile(tile, light, first);
        toned_.push_back({tile, first});
        first += kTileFloats;
        made.clouded = true;
        made.map = map_.revision();
        made.tone = tone_revision;
        for (std::size_t k = 0; k < map_.parts().size(); ++k)
            made.offsets_m[k] = map_.parts()[k].offset_m;
    }
}

}  // namespace skyig::render
