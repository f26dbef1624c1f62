#include "render/cloud/cloud_map.h"

#include <algorithm>
#include <cmath>

namespace skyig::render::cloud {

namespace {

// Beyond where density ends, what an eye that climbs may cover while a snapshot serves.
constexpr double kNearReserve_m = 100.0;

bool near_to(const glm::vec3& a, const glm::vec3& b) noexcept {
    constexpr float kStep = 5e-3F;
    return !glm::any(glm::greaterThan(glm::abs(a - b), kStep * glm::max(glm::abs(a), glm::abs(b))));
}

bool same_light(const CloudLight& a, const CloudLight& b) noexcept {
    for (std::size_t source = 0; source < CloudLight::kSources; ++source) {
        constexpr float kTurn = 1e-3F;
        if (a.beams[source].lit != b.beams[source].lit ||
            glm::length(a.beams[source].direction_enu - b.beams[source].direction_enu) > kTurn)
            return false;
    }
    for (std::size_t i = 0; i < CloudLight::kHeights; ++i) {
        for (std::size_t source = 0; source < CloudLight::kSources; ++source) {
            if (!near_to(a.beam_lx[source][i], b.beam_lx[source][i])) return false;
        }
        if (!near_to(a.above_cd_m2[i], b.above_cd_m2[i]) || !near_to(a.below_cd_m2[i], b.below_cd_m2[i]))
            return false;
    }
    return true;
}

bool same_weather(const Weather& a, const Weather& b) noexcept {
    return a.cloud_count == b.cloud_count && a.obscurant_count == b.obscurant_count &&
           a.lightning_count == b.lightning_count && a.clouds == b.clouds && a.obscurants == b.obscurants &&
           a.lightnings == b.lightnings;
}

/// Whether clouds come, go or grow, other than by drift, age and their place.
bool have_grown(const Weather& before, const Weather& now) noexcept {
    if (before.cloud_count != now.cloud_count) return true;
    for (std::size_t i = 0; i < now.cloud_count; ++i) {
        CloudLayer moved = before.clouds[i];
        moved.drift_m = now.clouds[i].drift_m;
        moved.age_s = now.clouds[i].age_s;
        moved.area = now.clouds[i].area;
        if (moved != now.clouds[i]) return true;
    }
    return false;
}

/// What the eye's displacement is measured against; null: there are no clouds.
const CloudLayer* measured_layer(const Weather& weather) noexcept {
    return weather.cloud_count > 0 ? &weather.clouds[0] : nullptr;
}

/// Null: it is not there any more.
const CloudLayer* layer_of(const Weather& weather, std::uint32_t seed) noexcept {
    const auto clouds = weather.all_clouds();
    const auto found = std::find_if(clouds.begin(), clouds.end(),
                                    [seed](const CloudLayer& layer) { return layer.seed == seed; });
    return found == clouds.end() ? nullptr : &*found;
}

/// Where the eye will be; those that come near a pole are not led, for latitude and longitude go on to
/// nowhere there.
Eye led(Eye eye, const Eye& motion_a_frame, double frames) noexcept {
    constexpr double kLast_deg = 89.98;
    if (std::abs(eye.latitude_deg + frames * motion_a_frame.latitude_deg) < kLast_deg) {
        eye.latitude_deg += frames * motion_a_frame.latitude_deg;
        eye.longitude_deg += frames * motion_a_frame.longitude_deg;
    }
    eye.height_m += frames * motion_a_frame.height_m;
    return eye;
}

}  // namespace

CloudMap::CloudMap() = default;

void CloudMap::stop() noexcept {
    worker_.wait();
    shown_ = marching_ = near_shown_ = false;
    part_count_ = 0;
    last_eye_.reset();
    ++revision_;
}

void CloudMap::resize(int size, std::size_t probes) {
    stop();
    geometry_ = MapGeometry(size);
    cones_.clear();
    corners_.clear();
    for (int tile = 0; tile < geometry_.tile_count(); ++tile) {
        cones_.push_back(geometry_.cone(tile));
        corners_.push_back(geometry_.corners(tile));
    }
    for (Snapshot& snapshot : snapshots_)
        snapshot.resize(geometry_, probes);
    for (auto* each : {&tiles_, &seen_})
        each->reserve(cones_.size());
}

void CloudMap::note_motion(const MapFrame& frame) noexcept {
    const Eye& now = frame.moment.eye;
    motion_a_frame_ = {};
    leapt_ = frame.jumped || (last_eye_ && has_leapt(*last_eye_, now));
    if (last_eye_ && !leapt_) {
        motion_a_frame_ = {now.latitude_deg - last_eye_->latitude_deg,
                           std::remainder(now.longitude_deg - last_eye_->longitude_deg, 360.0),
                           now.height_m - last_eye_->height_m};
    }
    last_eye_ = now;
}

bool CloudMap::stands_still(const MapFrame& frame) const noexcept {
    const glm::dvec3 away_m = eye_offset_m(frozen_eye_, frame.moment.eye);
    return glm::dot(away_m, away_m) < 1e-4 && same_weather(frame.moment.scene.weather, frozen_weather_) &&
           same_light(frame.moment.light, frozen_light_);
}

// Whether density lies so near that the eye may soon be in it.
bool CloudMap::near_wanted(const MapFrame& frame) const noexcept {
    const double climb_m = std::abs(motion_a_frame_.height_m) * 3.0 * period_frames_;
    const double reach_m = kNearRange_m + kNearReserve_m + climb_m;
    const double height_m = frame.moment.eye.height_m;
    const auto clouds = frame.moment.scene.weather.all_clouds();
    return std::any_of(clouds.begin(), clouds.end(), [&](const CloudLayer& layer) {
        return layer.coverage > 0.0 && height_m > layer.base_m - layer.bottom_band_m - reach_m &&
               height_m < layer.base_m + layer.thickness_m + layer.top_band_m + reach_m;
    });
}

Frozen CloudMap::frozen_at(const MapFrame& frame, const Eye& eye) const noexcept {
    Frozen frozen{.eye = eye,
                  .range = {},
                  .seen_horizon_rad = frame.seen_horizon_rad,
                  .straight_horizon_rad = frame.straight_horizon_rad};
    if (const CloudLayer* layer = measured_layer(frame.moment.scene.weather)) {
        frozen.drift_m = layer->drift_m;
        frozen.seed = layer->seed;
    }
    if (wanted_near_) frozen.range.from_m = static_cast<float>(kNearRange_m);
    return frozen;
}

void CloudMap::begin(CloudMaker& maker, const MapFrame& frame, double frames_ahead) {
    CloudMoment moment = frame.moment;
    moment.eye = led(moment.eye, motion_a_frame_, frames_ahead);
    next_grows_ = have_grown(frozen_weather_, frame.moment.scene.weather);
    march_frames_ = 0;
    frozen_eye_ = frame.moment.eye;
    frozen_weather_ = frame.moment.scene.weather;
    frozen_light_ = frame.moment.light;
    sources_[next_] = &maker.freeze(next_, moment);
    snapshots_[next_].begin(frozen_at(frame, moment.eye));
    drifted_m_[next_] = glm::dvec2{0.0};
    snapshots_[next_].march_probes(*sources_[next_], frame.probes, kProbe_rad);
    rays_ += static_cast<int>(frame.probes.size());
    list_tiles(frame.views, kMargin_rad, tiles_);
    tiles_done_ = tiles_asked_ = 0;
    frames_since_begin_ = 0;
    marching_ = true;
}

void CloudMap::list_tiles(std::span<const ChannelView> views, double margin_rad, std::vector<int>& tiles) {
    tiles.clear();
    for (int tile = 0; tile < geometry_.tile_count(); ++tile) {
        if (sees(views, cone(tile), margin_rad) &&
            (margin_rad > 0.0 || sees(views, corners_[static_cast<std::size_t>(tile)])))
            tiles.push_back(tile);
    }
}

void CloudMap::march_all(CloudMaker& maker, const MapFrame& frame) {
    begin(maker, frame, 0.0);
    // Half on the other thread.
    const auto half = tiles_.size() / 2;
    const std::span<const int> tiles{tiles_};
    worker_.request({sources_[next_], &snapshots_[next_], tiles.first(half), false});
    for (const int tile : tiles.subspan(half))
        snapshots_[next_].march(*sources_[next_], tile);
    worker_.wait();
    snapshots_[next_].lay_distances();
    rays_ += static_cast<int>(tiles_.size()) * kTileTexels;
    marching_ = false;
    std::swap(new_, next_);
    blend_ = blend_frames_;
    shown_ = true;
    ++revision_;
}

// The finished one takes over from now on.
void CloudMap::take_over() noexcept {
    const std::size_t free = old_;
    old_ = new_;
    new_ = next_;
    next_ = free;
    blend_ = 1;
    grows_ = next_grows_;
    blend_frames_ = grows_ ? std::max(kGrowthFrames, march_frames_) : kBlendFrames;
    period_frames_ = static_cast<double>(frames_since_begin_);
    marching_ = false;
    ++revision_;
}

void CloudMap::advance(CloudMaker& maker, const MapFrame& frame, int tiles_a_frame) {
    worker_.wait();
    maker.follow(frame.moment, static_cast<float>(geometry_.worst_texel_rad()), false);
    tiles_done_ = tiles_asked_;
    if (blend_ < blend_frames_) {
        ++blend_;
        ++revision_;
    }
    const bool done = marching_ && tiles_done_ == tiles_.size();
    if (done && march_frames_ == 0) march_frames_ = static_cast<int>(frames_since_begin_);
    if (done && blend_ >= blend_frames_) take_over();
    if (!marching_ && !stands_still(frame)) {
        // Its life begins when it is done and ends when the one after it has taken over: the middle of both.
        begin(maker, frame, (grows_ ? 2.0 : 1.5) * period_frames_);
    }
    if (!marching_ || tiles_asked_ == tiles_.size()) return;
    const auto count = std::min(static_cast<std::size_t>(tiles_a_frame), tiles_.size() - tiles_asked_);
    const auto batch = std::span<const int>{tiles_}.subspan(tiles_asked_, count);
    tiles_asked_ += count;
    rays_ += static_cast<int>(count) * kTileTexels;
    worker_.request({sources_[next_], &snapshots_[next_], batch, tiles_asked_ == tiles_.size()});
}

// Tiles that a turn of the rig has brought into view.
void CloudMap::fill_in() {
    bool any = false;
    for (const int tile : seen_) {
        for (const std::size_t part : {old_, new_}) {
            const bool shows = part == new_ || blend_ < blend_frames_;
            if (!shows || snapshots_[part].tile(tile) != Snapshot::Tile::kUnknown) continue;
            snapshots_[part].march(*sources_[part], tile);
            rays_ += kTileTexels;
            any = true;
        }
    }
    if (!any) return;
    for (const std::size_t part : {old_, new_})
        snapshots_[part].lay_distances();
    ++revision_;
}

void CloudMap::show_near(CloudMaker& maker, const MapFrame& frame) {
    const auto in_use = parts();
    const bool shown =
        std::any_of(in_use.begin(), in_use.end(), [](const Part& part) { return part.beyond_near; });
    if (shown != near_shown_) ++revision_;
    near_shown_ = shown;
    if (!near_shown_) return;
    Frozen frozen = frozen_at(frame, frame.moment.eye);
    frozen.range = {0.0F, static_cast<float>(kNearRange_m)};
    // All of a tile that is seen is asked for.
    const double margin_rad = 1.5 * kTile * geometry_.worst_texel_rad();
    near_rays_ =
        near_.march(maker.freeze(CloudMaker::kNearSlot, frame.moment), frame.views, margin_rad, frozen);
}

void CloudMap::tell_parts(const MapFrame& frame) noexcept {
    part_count_ = 0;
    const auto add = [&](std::size_t index, float weight) {
        const Frozen& frozen = snapshots_[index].frozen();
        // Layers come, go and change places; one that is gone stays where it was last.
        if (const CloudLayer* layer = layer_of(frame.moment.scene.weather, frozen.seed))
            drifted_m_[index] = layer->drift_m - frozen.drift_m;
        const glm::dvec3 offset_m =
            eye_offset_m(frozen.eye, frame.moment.eye) - glm::dvec3{drifted_m_[index], 0.0};
        parts_[part_count_++] = {&snapshots_[index], weight, glm::vec3{offset_m}, frozen.range.from_m > 0.0F};
    };
    const auto share = static_cast<float>(blend_) / static_cast<float>(blend_frames_);
    const float smooth = grows_ ? share : share * share * (3.0F - 2.0F * share);
    if (blend_ < blend_frames_) add(old_, 1.0F - smooth);
    add(new_, smooth);
}

void CloudMap::update(CloudMaker& maker, const MapFrame& frame, int size, int tiles_a_frame) {
    rays_ = near_rays_ = 0;
    ++frames_since_begin_;
    if (cones_.empty() || size != geometry_.size()) resize(size, frame.probes.size());
    note_motion(frame);
    wanted_near_ = near_wanted(frame);
    list_tiles(frame.views, 0.0, seen_);
    if (!shown_ || leapt_) {
        worker_.wait();
        maker.follow(frame.moment, static_cast<float>(geometry_.worst_texel_rad()), true);
        march_all(maker, frame);
    } else {
        advance(maker, frame, tiles_a_frame);
        fill_in();
    }
    tell_parts(frame);
    show_near(maker, frame);
}

bool CloudMap::is_clear() const noexcept {
    return blend_ >= blend_frames_ && !marching_ &&
           std::none_of(seen_.begin(), seen_.end(), [this](int tile) { return may_show(tile); });
}

bool CloudMap::may_show(int tile) const noexcept {
    if (near_shown_) return true;
    const MapGeometry::Texel corner = geometry_.corner(tile);
    const int across = geometry_.tiles_across();
    const int column = corner.column / kTile;
    const int row = corner.row / kTile;
    const int square = across * across;
    const auto clouded = [&](int index) {
        return std::any_of(
            parts_.begin(), parts_.begin() + static_cast<std::ptrdiff_t>(part_count_),
            [&](const Part& part) { return part.snapshot->tile(index) == Snapshot::Tile::kCloud; });
    };
    // What lies in a neighbour may be seen here from the present eye. On the rim both squares have it.
    const int own = corner.lower ? square : 0;
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, across - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, across - 1); ++c) {
            if (clouded(own + r * across + c)) return true;
            const bool rim = r == 0 || c == 0 || r == across - 1 || c == across - 1;
            if (rim && clouded(square - own + r * across + c)) return true;
        }
    }
    return false;
}

namespace {

void add_part(CloudMap::Sight& sight, const CloudMap::Part& part, const Snapshot::Seen& far,
              const Snapshot::Seen& near) noexcept {
    const auto rgb = [](const LightAndPassed::Lanes& light) {
        return glm::dvec3{light[0], light[1], light[2]};
    };
    const auto weight = static_cast<double>(part.weight);
    const double factor = part.beyond_near ? weight * static_cast<double>(near.light[3]) : weight;
    sight.far_light_cd_m2 += factor * rgb(far.light);
    sight.far_opacity += factor * (1.0 - static_cast<double>(far.light[3]));
    sight.distance_m += factor * static_cast<double>(far.reach_m);
    sight.transmittance += factor * static_cast<double>(far.light[3]);
    if (!part.beyond_near) return;
    sight.near_light_cd_m2 += weight * rgb(near.light);
    sight.near_opacity += weight * (1.0 - static_cast<double>(near.light[3]));
    sight.near_distance_m += weight * static_cast<double>(near.reach_m);
}

// From sums of distances by their opacity.
void mean_distances(CloudMap::Sight& sight) noexcept {
    sight.distance_m = sight.far_opacity > 0.0 ? sight.distance_m / sight.far_opacity : 0.0;
    sight.near_distance_m = sight.near_opacity > 0.0 ? sight.near_distance_m / sight.near_opacity : 0.0;
}

}  // namespace

CloudMap::Sight CloudMap::sight(const glm::dvec3& direction_enu) const noexcept {
    if (part_count_ == 0) return {};
    const glm::vec3 direction{
        direction_enu / (std::abs(direction_enu.x) + std::abs(direction_enu.y) + std::abs(direction_enu.z))};
    Sight sight;
    sight.transmittance = 0.0;
    const Snapshot::Seen near =
        near_shown_ ? near_.seen(direction) : Snapshot::Seen{{0.0F, 0.0F, 0.0F, 1.0F}, 0.0F};
    for (const Part& part : parts())
        add_part(sight, part,
                 part.snapshot->seen(direction, part.snapshot->inverse_distance(direction), part.offset_m),
                 near);
    mean_distances(sight);
    return sight;
}

CloudMap::Sight CloudMap::probe(std::size_t index) const noexcept {
    if (part_count_ == 0) return {};
    Sight sight;
    sight.transmittance = 0.0;
    for (const Part& part : parts()) {
        const CloudSample& sample = part.snapshot->probes()[index];
        const Snapshot::Seen seen{
            {sample.light_cd_m2.x, sample.light_cd_m2.y, sample.light_cd_m2.z, sample.transmittance},
            (1.0F - sample.transmittance) * sample.distance_m};
        add_part(sight, {part.snapshot, part.weight, {}, false}, seen, seen);
    }
    mean_distances(sight);
    return sight;
}

CloudMap::Sight CloudMap::sight_or_probe(const glm::dvec3& direction_enu,
                                         std::size_t probe_index) const noexcept {
    if (part_count_ == 0) return {};
    const glm::vec2 place = shaders32::cloud_map_place(glm::vec3{direction_enu});
    const auto at = [&](float p) {
        return std::clamp(static_cast<int>((p + 1.0F) * 0.5F * static_cast<float>(geometry_.size())), 0,
                          geometry_.size() - 1) /
               kTile;
    };
    const int across = geometry_.tiles_across();
    const int tile = (direction_enu.z < 0.0 ? across * across : 0) + at(place.y) * across + at(place.x);
    const bool known =
        std::all_of(parts_.begin(), parts_.begin() + static_cast<std::ptrdiff_t>(part_count_),
                    [&](const Part& part) { return part.snapshot->tile(tile) != Snapshot::Tile::kUnknown; });
    return known ? sight(direction_enu) : probe(probe_index);
}

}  // namespace skyig::render::cloud
