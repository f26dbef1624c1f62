#include "render/cloud/impostor/impostor_clouds.h"

#include <algorithm>
#include <cmath>

#include "render/sky/sea_waves.h"
#include "render/weather_area.h"

namespace skyig::render::cloud::impostor {

namespace {

constexpr double kEarthRadius_m = 6371000.0;
constexpr float kFadeFrom = 0.85F;  // of a layer's range
// A cloud is lit anew when the light comes from this far beside where it came from, made anew when its shape
// is older or its growth, height or density is other by more than these.
constexpr float kLightTurn_rad = 0.02F;
constexpr double kShapeAge_s = 10.0;
constexpr float kGrowth = 0.02F;
constexpr float kChange = 0.03F;
// Texels that are this much coarser or finer than needed are drawn anew.
constexpr float kCoarser = 1.25F;
constexpr float kFiner = 2.0F;
// Texels to the smallest particle's radius: finer ones show nothing more.
constexpr float kTexelsARadius = 5.0F;
constexpr float kAtOnce = 1e6F;
constexpr float kShrunk = 1.6F;
constexpr double kRetry_s = 0.5;
constexpr double kFastest_m_s = 1000.0;
constexpr double kLongestStep_s = 5.0;

float angle_between(const glm::vec3& a, const glm::vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

float relative(float now, float before) {
    return std::abs(now - before) / before;
}

}  // namespace

float shown_part(float distance_m, float range_m) noexcept {
    const float s = std::clamp((distance_m / range_m - kFadeFrom) / (1.0F - kFadeFrom), 0.0F, 1.0F);
    return 1.0F - s * s * (3.0F - 2.0F * s);
}

ImpostorClouds::ImpostorClouds(const ImpostorSettings& settings)
    : settings_(settings), atlas_(Atlas::make(settings.atlas)), shading_(settings.light, {}) {
    const auto count = static_cast<std::size_t>(settings.cells) * static_cast<std::size_t>(settings.cells);
    clouds_.resize(count);
    particles_.resize(count * kMostParticles);
    lit_.resize(count * kMostParticles);
    needs_.reserve(count);
    holders_.resize(static_cast<std::size_t>(settings.atlas.pictures));
    retired_.reserve(holders_.size());
    const auto side = static_cast<std::size_t>(settings.atlas.most_side);
    canvas_.resize(side * side);
    shaded_.resize(kMostParticles);
}

std::span<const Particle> ImpostorClouds::particles(const Cloud& cloud) const noexcept {
    return {particles_.data() + index(cloud) * kMostParticles, cloud.particles};
}

std::span<const Lit> ImpostorClouds::lit(const Cloud& cloud) const noexcept {
    return {lit_.data() + index(cloud) * kMostParticles, cloud.particles};
}

double ImpostorClouds::range_m() const noexcept {
    return (0.5 * settings_.cells - 1.0) * shape_.cell_m;
}

glm::dvec3 ImpostorClouds::middle_m(const Cloud& cloud, const Eye& eye) const noexcept {
    const sky::SeaAnchor anchor = sky::sea_anchor(eye);
    const glm::dvec2 cell{static_cast<double>(cloud.east), static_cast<double>(cloud.north)};
    const glm::dvec2 place = (cell + place_in_cell(cloud.key)) * shape_.cell_m + moment_.layer.drift_m;
    const glm::dvec2 offset = place - anchor.eye_m;
    const glm::dvec2 ground{offset.x - anchor.closing * offset.y, offset.y};
    const double drop_m = glm::dot(ground, ground) / (2.0 * kEarthRadius_m);
    const double up_m =
        moment_.layer.base_m + 0.5 * static_cast<double>(cloud.shape.height_m) - eye.height_m - drop_m;
    return {ground, up_m};
}

float ImpostorClouds::newest_part(const Cloud& cloud) const noexcept {
    const double part = (moment_.time_s - cloud.fade_from_s) / cloud.fade_s;
    return static_cast<float>(std::clamp(part, 0.0, 1.0));
}

float ImpostorClouds::growth_now(const Cloud& cloud) const noexcept {
    double coverage = moment_.layer.coverage;
    if (moment_.layer.area) {
        const glm::dvec3 middle = middle_m(cloud, moment_.eye);
        coverage *= area_weight(*moment_.layer.area, {middle.x, middle.y});
    }
    return growth(coverage, cloud.key);
}

void ImpostorClouds::update(const Moment& moment) noexcept {
    const double step_s = moment.time_s - moment_.time_s;
    const bool jumped = moment.jumped || !begun_ || step_s < 0.0 || step_s > kLongestStep_s;
    const CloudShape shape = shape_of(moment.layer);
    const bool other = begun_ && (shape.cell_m != shape_.cell_m || moment.layer.seed != moment_.layer.seed);
    moment_ = moment;
    moment_.jumped = jumped;
    begun_ = true;
    shape_ = shape;
    shading_ = Shading(settings_.light, moment.beams);
    work_ = {};
    if (moment.jumped) std::fill(holders_.begin(), holders_.end(), std::uint8_t{0});
    release_retired();
    if (other) {
        for (Cloud& cloud : clouds_)
            clear(cloud);
    }
    find_velocity(jumped ? 0.0 : step_s);
    find_cells();
    work_.packed = atlas_->tidy(moment.time_s);
    for (Cloud& cloud : clouds_)
        end_fade(cloud);
    renew_light();
    renew_pictures();
}

void ImpostorClouds::clear(Cloud& cloud) noexcept {
    for (const Picture& picture : cloud.pictures)
        retire(picture.id);
    cloud = {};
}

void ImpostorClouds::hold(std::size_t slot) noexcept {
    let_go(slot);
    for (const Cloud& cloud : clouds_) {
        for (const Picture& picture : cloud.pictures) {
            if (picture.id == Atlas::kNone) continue;
            std::uint8_t& holders = holders_[static_cast<std::size_t>(picture.id)];
            holders = static_cast<std::uint8_t>(holders | (1U << slot));
        }
    }
}

void ImpostorClouds::let_go(std::size_t slot) noexcept {
    for (std::uint8_t& holders : holders_)
        holders = static_cast<std::uint8_t>(holders & ~(1U << slot));
}

void ImpostorClouds::retire(Atlas::Id id) noexcept {
    if (id == Atlas::kNone) return;
    if (holders_[static_cast<std::size_t>(id)] == 0)
        atlas_->release(id);
    else
        retired_.push_back(id);
}

void ImpostorClouds::release_retired() noexcept {
    const auto kept = std::remove_if(retired_.begin(), retired_.end(), [this](Atlas::Id id) {
        const bool held = holders_[static_cast<std::size_t>(id)] != 0;
        if (!held) atlas_->release(id);
        return !held;
    });
    retired_.erase(kept, retired_.end());
}

void ImpostorClouds::find_velocity(double step_s) noexcept {
    const glm::dvec2 ground = sky::sea_anchor(moment_.eye).eye_m - moment_.layer.drift_m;
    const glm::dvec3 place{ground, moment_.eye.height_m};
    if (step_s > 0.0) velocity_m_s_ = (place - place_m_) / step_s;
    // A new eye, not a flight.
    if (step_s <= 0.0 || glm::length(velocity_m_s_) > kFastest_m_s) velocity_m_s_ = glm::dvec3{0.0};
    place_m_ = place;
}

void ImpostorClouds::find_cells() noexcept {
    const sky::SeaAnchor anchor = sky::sea_anchor(moment_.eye);
    const glm::dvec2 place = (anchor.eye_m - moment_.layer.drift_m) / shape_.cell_m;
    const std::int64_t side = settings_.cells;
    const auto first_east = static_cast<std::int64_t>(std::floor(place.x)) - side / 2;
    const auto first_north = static_cast<std::int64_t>(std::floor(place.y)) - side / 2;
    for (std::int64_t north = first_north; north < first_north + side; ++north) {
        for (std::int64_t east = first_east; east < first_east + side; ++east) {
            const auto at = static_cast<std::size_t>((north & (side - 1)) * side + (east & (side - 1)));
            Cloud& cloud = clouds_[at];
            if (cloud.alive && cloud.east == east && cloud.north == north) continue;
            clear(cloud);
            cloud.east = east;
            cloud.north = north;
            cloud.key = cell_key(east, north, moment_.layer.seed);
            cloud.shape = shape_;
            cloud.alive = true;
        }
    }
}

void ImpostorClouds::end_fade(Cloud& cloud) noexcept {
    if (cloud.pictures[1].id == Atlas::kNone || newest_part(cloud) < 1.0F) return;
    retire(cloud.pictures[1].id);
    cloud.pictures[1] = {};
}

float ImpostorClouds::light_urgency(const Cloud& cloud) const noexcept {
    const float grown = growth_now(cloud);
    if (!cloud.made) return grown > 0.0F ? kAtOnce : 0.0F;
    if (cloud.particles == 0 && grown <= 0.0F) return 0.0F;
    float urgency = std::abs(grown - cloud.grown) / kGrowth;
    // Few clouds end exactly at nothing.
    if (grown <= 0.0F) urgency = std::max(urgency, 1.0F);
    urgency =
        std::max(urgency, static_cast<float>(std::abs(moment_.layer.age_s - cloud.age_s) / kShapeAge_s));
    urgency = std::max(urgency, relative(shape_.height_m, cloud.shape.height_m) / kChange);
    urgency = std::max(urgency, relative(shape_.extinction_per_m, cloud.shape.extinction_per_m) / kChange);
    for (std::size_t i = 0; i < CloudLight::kSources; ++i) {
        const Beam& beam = moment_.beams[i];
        if (beam.lit != cloud.lit_by[i]) urgency = std::max(urgency, 2.0F);
        if (beam.lit && cloud.lit_by[i])
            urgency =
                std::max(urgency, angle_between(beam.direction_enu, cloud.lit_from[i]) / kLightTurn_rad);
    }
    return urgency;
}

float ImpostorClouds::picture_urgency(const Cloud& cloud) const noexcept {
    const Picture& newest = cloud.pictures[0];
    if (!cloud.made || (cloud.particles == 0 && newest.id == Atlas::kNone)) return 0.0F;
    if (!moment_.jumped && (newest_part(cloud) < 1.0F || moment_.time_s < cloud.wait_s)) return 0.0F;
    const glm::vec3 middle{middle_m(cloud, moment_.eye)};
    const float distance = glm::length(middle);
    if (cloud.particles > 0) {
        if (distance < kPictures * cloud.bound_m) return 0.0F;
        // The nearest first.
        if (newest.id == Atlas::kNone) return 10.0F + 1e4F * cloud.bound_m / distance;
    }
    float urgency = cloud.stale ? 1.0F : 0.0F;
    const Capture& capture = newest.capture;
    const float shift = capture.reach_m * angle_between(middle, capture.middle_m) / capture.texel_m;
    urgency = std::max(urgency, shift / settings_.most_shift);
    const float needed =
        std::max(distance * moment_.texel_rad, class_radius_m(cloud.shape, 0) / kTexelsARadius);
    urgency = std::max(urgency, newest.wanted_texel_m / (needed * kCoarser));
    return std::max(urgency, needed / (newest.wanted_texel_m * kFiner));
}

template <class Urgency>
std::span<const ImpostorClouds::Need> ImpostorClouds::most_urgent(int most, const Urgency& urgency) noexcept {
    needs_.clear();
    for (std::size_t i = 0; i < clouds_.size(); ++i) {
        const float how = clouds_[i].alive ? urgency(clouds_[i]) : 0.0F;
        if (how >= 1.0F) needs_.push_back({how, static_cast<std::uint32_t>(i)});
    }
    const std::size_t count =
        moment_.jumped ? needs_.size() : std::min(needs_.size(), static_cast<std::size_t>(most));
    std::partial_sort(needs_.begin(), needs_.begin() + static_cast<std::ptrdiff_t>(count), needs_.end(),
                      [](const Need& a, const Need& b) {
                          return a.urgency != b.urgency ? a.urgency > b.urgency : a.cloud < b.cloud;
                      });
    return {needs_.data(), count};
}

void ImpostorClouds::renew_light() noexcept {
    const auto due =
        most_urgent(settings_.lights_per_update, [this](const Cloud& cloud) { return light_urgency(cloud); });
    for (const Need& need : due) {
        Cloud& cloud = clouds_[need.cloud];
        make(cloud);
        light(cloud);
    }
    work_.lit = static_cast<int>(due.size());
}

void ImpostorClouds::make(Cloud& cloud) noexcept {
    cloud.shape = shape_;
    cloud.grown = growth_now(cloud);
    cloud.age_s = moment_.layer.age_s;
    const std::span<Particle> room{particles_.data() + index(cloud) * kMostParticles, kMostParticles};
    cloud.particles = make_particles(shape_, cloud.key, cloud.grown, cloud.age_s, room);
    cloud.bound_m = 0.0F;
    for (const Particle& particle : particles(cloud))
        cloud.bound_m = std::max(cloud.bound_m, glm::length(particle.centre_m) + particle.radius_m);
    cloud.made = true;
}

void ImpostorClouds::light(Cloud& cloud) noexcept {
    const std::span<Lit> lit{lit_.data() + index(cloud) * kMostParticles, cloud.particles};
    buffer_.light(cloud.shape, particles(cloud), shading_, lit);
    for (std::size_t i = 0; i < CloudLight::kSources; ++i) {
        cloud.lit_from[i] = moment_.beams[i].direction_enu;
        cloud.lit_by[i] = moment_.beams[i].lit;
    }
    cloud.stale = true;
}

void ImpostorClouds::renew_pictures() noexcept {
    const auto due = most_urgent(settings_.pictures_per_update,
                                 [this](const Cloud& cloud) { return picture_urgency(cloud); });
    for (const Need& need : due)
        take_picture(clouds_[need.cloud]);
    work_.drawn = static_cast<int>(due.size());
}

void ImpostorClouds::take_picture(Cloud& cloud) noexcept {
    glm::vec3 middle{middle_m(cloud, moment_.eye)};
    // As it will be seen when this picture has taken over.
    const glm::vec3 ahead = middle - glm::vec3{velocity_m_s_ * settings_.fade_s};
    if (!moment_.jumped && glm::length(ahead) > kPictures * cloud.bound_m) middle = ahead;
    const std::span<Shaded> shaded{shaded_.data(), cloud.particles};
    shade(particles(cloud), lit(cloud), shading_, middle, shaded);
    const float finest = class_radius_m(cloud.shape, 0) / (kTexelsARadius * glm::length(middle));
    Picture picture;
    picture.bound_m = cloud.bound_m;
    picture.capture =
        capture_of(shaded, middle, std::max(moment_.texel_rad, finest), settings_.atlas.most_side);
    if (picture.capture.size.x > 0) {
        picture.wanted_texel_m = std::max(moment_.texel_rad, finest) * glm::length(middle);
        picture.id = atlas_->allocate(picture.capture.size);
        if (picture.id == Atlas::kNone) {
            cloud.wait_s = moment_.time_s + kRetry_s;
            return;
        }
        const float best_m = picture.capture.texel_m;
        picture.capture = resized(picture.capture, atlas_->size(picture.id));
        // An old picture is better than one that is much coarser than it should be.
        if (cloud.pictures[0].id != Atlas::kNone && picture.capture.texel_m > kShrunk * best_m) {
            atlas_->release(picture.id);
            cloud.wait_s = moment_.time_s + kRetry_s;
            return;
        }
        draw(shaded, picture.capture, canvas_);
        atlas_->write(picture.id, canvas_.data());
    }
    retire(cloud.pictures[1].id);
    cloud.pictures[1] = cloud.pictures[0];
    cloud.pictures[0] = picture;
    const bool first = cloud.pictures[1].id == Atlas::kNone;
    cloud.fade_s = first ? settings_.first_fade_s : settings_.fade_s;
    cloud.fade_from_s = moment_.jumped ? moment_.time_s - cloud.fade_s : moment_.time_s;
    cloud.stale = false;
    end_fade(cloud);
}

}  // namespace skyig::render::cloud::impostor
