// The ownship and other entities: where a host places them and how it lets them move.
#include <algorithm>
#include <cmath>

#include "server/world/conditions.h"
#include "server/world/world.h"

namespace skyig::server::world {

namespace cigi = protocol::cigi;

namespace {

constexpr double kRadPerDeg = 0.017453292519943295;
/// Offsets from a parent beyond this are none.
constexpr double kLongestOffset_m = 1e7;

template <class Packet>
Pose pose_of(const Packet& packet) noexcept {
    return {{packet.lat_x, packet.lon_y, packet.alt_z},
            static_cast<double>(packet.yaw),
            static_cast<double>(packet.pitch),
            static_cast<double>(packet.roll)};
}

Rates rates(float x, float y, float z, float roll_deg, float pitch_deg, float yaw_deg) noexcept {
    return {glm::dvec3(x, y, z), glm::dvec3(roll_deg, pitch_deg, yaw_deg) * kRadPerDeg};
}

RateAxes axes(bool own) noexcept {
    return own ? RateAxes::kOwn : RateAxes::kGround;
}

}  // namespace

std::optional<Pose> World::entity_pose(std::uint16_t entity_id) const noexcept {
    if (entity_id == 0) return ownship_.exists ? std::optional<Pose>(ownship_) : std::nullopt;
    const Entity* entity = entities_.find(entity_id);
    if (entity == nullptr || !entity->active) return std::nullopt;
    return entities_.pose_of(entity_id, ownship_, drawn_s_);
}

Entity* World::claim_entity(std::uint16_t entity_id) {
    Entity* entity = entities_.claim(entity_id);
    if (entity == nullptr) {
        ++counters_.entity_full;
        outbox_.messages.add(Matter::kPacketIgnored, "entity {}: at most {} are kept besides the ownship",
                             entity_id, EntityStore::kMost);
        return nullptr;
    }
    take_entity(*entity);
    return entity;
}

void World::take_entity(Entity& entity) noexcept {
    if (entity.source == source_) return;
    const std::optional<Pose> before = entities_.pose_of(entity.id, ownship_, elapsed_s_);
    entity.mover.track.reset(before.value_or(Pose{}));
    entity.source = source_;
    carry(entity);
}

void World::operator()(const cigi::EntityControl& packet, const cigi::PacketInfo& info) {
    if (!obeys(config::Aspect::kOwnship)) return;
    const bool destroyed = packet.entity_state == cigi::EntityState::kDestroyed;
    // In 4.0 the position is a packet of its own; a destroyed entity has none.
    const bool places = info.version == cigi::Version::k33 && !destroyed;
    if (packet.entity_id == 0) {
        ownship_.exists = !destroyed;
        if (destroyed) {
            own_ = {};
            own_.track.reset(ownship_);
            return;
        }
        own_.smoothed = packet.extrapolation_enable;
        if (places) place_ownship(packet.attach_state, pose_of(packet));
        carry_ownship();
        return;
    }
    if (destroyed) {
        entities_.destroy(packet.entity_id);
        weather_.forget_entity(packet.entity_id);
        return;
    }
    Entity* entity = claim_entity(packet.entity_id);
    if (entity == nullptr) return;
    entity->active = packet.entity_state == cigi::EntityState::kActive;
    entity->mover.smoothed = packet.extrapolation_enable;
    if (places) place_entity(*entity, packet.attach_state, packet.parent_id, pose_of(packet));
    carry(*entity);
}

void World::operator()(const cigi::EntityPosition& packet) {
    if (!obeys(config::Aspect::kOwnship)) return;
    if (packet.entity_id == 0) {
        // The position may come before, or without, the packet that creates the ownship.
        ownship_.exists = true;
        place_ownship(packet.attach_state, pose_of(packet));
    } else if (Entity* entity = claim_entity(packet.entity_id)) {
        place_entity(*entity, packet.attach_state, packet.parent_id, pose_of(packet));
    }
}

Pose World::on_the_sea(const cigi::ConformalClamped& packet) const noexcept {
    Pose pose{{packet.latitude, packet.longitude, 0.0}, static_cast<double>(packet.yaw)};
    pose.position.height_m = sea_height_m(pose.position);
    return pose;
}

double World::sea_height_m(const ephemeris::Geodetic& position) const noexcept {
    return std::clamp<double>(sea_below(weather_, surfaces_, position).height_m, ephemeris::kMinEyeHeight_m,
                              ephemeris::kMaxEyeHeight_m);
}

void World::operator()(const cigi::ConformalClamped& packet) {
    if (!obeys(config::Aspect::kOwnship)) return;
    if (packet.entity_id == 0) {
        ownship_.exists = true;
        if (place_ownship(false, on_the_sea(packet))) own_.clamped = true;
    } else if (Entity* entity = claim_entity(packet.entity_id)) {
        if (place_entity(*entity, false, 0, on_the_sea(packet))) entity->mover.clamped = true;
    }
}

bool World::is_drawn(const ephemeris::Geodetic& position, std::uint16_t entity_id) {
    if (ephemeris::is_valid(position)) return true;
    ++counters_.position_refused;
    const char* const what = entity_id == 0 ? "ownship" : "entity";
    outbox_.messages.add(Matter::kPacketIgnored, "{} at {:g} m: heights from {:g} to {:g} m are drawn", what,
                         position.height_m, ephemeris::kMinEyeHeight_m, ephemeris::kMaxEyeHeight_m);
    log_.limited("position refused", kRepeatAfter_s, Severity::kWarning,
                 "{} at {} m ignored: heights from {} to {} m can be drawn", what, position.height_m,
                 ephemeris::kMinEyeHeight_m, ephemeris::kMaxEyeHeight_m);
    return false;
}

void World::take_track(std::size_t source) noexcept {
    if (track_source_ == source) return;
    own_.track.reset(ownship_);
    own_.clamped = false;
    track_source_ = source;
    carry_ownship();
}

bool World::place_ownship(bool attached, const Pose& pose) {
    if (attached) {
        ++counters_.ownship_attached;
        outbox_.messages.add(Matter::kPacketIgnored, "the ownship is attached to an entity: not supported");
        log_.limited("ownship attached", kRepeatAfter_s, Severity::kWarning,
                     "the ownship is attached to another entity: not supported, its last place is held");
        return false;
    }
    if (!is_drawn(pose.position)) return false;
    take_track(source_);
    own_.place(pose, elapsed_s_, own_.smoothed ? stamp_s_ : std::nullopt);
    static_cast<Pose&>(ownship_) = pose;
    ownship_.placed_by_host = true;
    return true;
}

bool World::place_entity(Entity& entity, bool attached, std::uint16_t parent_id, const Pose& pose) {
    if (attached) {
        const auto& [x_m, y_m, z_m] = pose.position;
        const glm::dvec3 offset_m{x_m, y_m, z_m};
        if (glm::length(offset_m) > kLongestOffset_m) {
            ++counters_.position_refused;
            return false;
        }
        entity.offset_m = offset_m;
        entity.on_parent = pose;
        entity.parent_id = parent_id;
        entity.attached = true;
        return true;
    }
    if (!is_drawn(pose.position, entity.id)) return false;
    entity.attached = false;
    entity.mover.place(pose, elapsed_s_, entity.mover.smoothed ? stamp_s_ : std::nullopt);
    return true;
}

void World::note_smoothing(std::size_t source, bool smoothing) noexcept {
    Peer& peer = peers_[source];
    if (peer.smoothing == smoothing) return;
    peer.smoothing = smoothing;
    if (track_source_ == source) carry_ownship();
    for (Entity& entity : entities_.all())
        if (entity.source == source) carry(entity);
}

void World::carry_ownship() noexcept {
    own_.track.carry_told(track_source_ && peers_[*track_source_].smoothing && own_.smoothed, elapsed_s_);
}

void World::carry(Entity& entity) noexcept {
    entity.mover.track.carry_told(peers_[entity.source].smoothing && entity.mover.smoothed, elapsed_s_);
}

template <class Packet, class Tell>
void World::tell_rates(const Packet& packet, Tell&& tell) {
    if (!obeys(config::Aspect::kOwnship)) return;
    Entity* entity = packet.entity_id == 0 ? nullptr : entities_.find(packet.entity_id);
    if (packet.entity_id == 0 ? !ownship_.exists : entity == nullptr) {
        ++counters_.entity_unknown;
        return;
    }
    if (packet.entity_id == 0) {
        take_track(source_);
    } else {
        take_entity(*entity);
    }
    Mover& mover = entity == nullptr ? own_ : entity->mover;
    const std::optional<double> stamp_s = mover.smoothed ? stamp_s_ : std::nullopt;
    if (!packet.apply_to_part && tell(mover.track, stamp_s)) return;
    ++counters_.rate_refused;
    outbox_.messages.add(Matter::kPacketIgnored, "rates of entity {}: {}", packet.entity_id,
                         packet.apply_to_part ? "parts are not supported" : "no craft moves like that");
}

void World::operator()(const cigi::RateControl& packet) {
    const Rates told = rates(packet.x_rate, packet.y_rate, packet.z_rate, packet.roll_rate, packet.pitch_rate,
                             packet.yaw_rate);
    tell_rates(packet, [&](OwnshipTrack& track, std::optional<double> stamp_s) {
        return track.tell_velocity(axes(packet.coordinate_system), told, elapsed_s_, stamp_s);
    });
}

void World::operator()(const cigi::AccelerationControl& packet) {
    const Rates told = rates(packet.x_acceleration, packet.y_acceleration, packet.z_acceleration,
                             packet.roll_acceleration, packet.pitch_acceleration, packet.yaw_acceleration);
    tell_rates(packet, [&](OwnshipTrack& track, std::optional<double> stamp_s) {
        return track.tell_acceleration(axes(packet.coordinate_system), told, elapsed_s_, stamp_s);
    });
}

void World::operator()(const cigi::EarthModelDefinition& packet) {
    if (!obeys(config::Aspect::kOwnship)) return;
    if (!packet.custom_enable) {
        earth_ = {};
        return;
    }
    const double beyond = std::abs(packet.equatorial_radius / EarthModel{}.equatorial_radius_m - 1.0);
    if (beyond <= EarthModel::kFurthest && packet.flattening <= EarthModel::kFlattest) {
        earth_ = {true, packet.equatorial_radius, packet.flattening};
        return;
    }
    ++counters_.earth_refused;
    log_.limited(
        "earth refused", kRepeatAfter_s, Severity::kWarning,
        "Earth model with radius {} m, flattening {} ignored: at most {} % from WGS84 and {} can be drawn",
        packet.equatorial_radius, packet.flattening, 100.0 * EarthModel::kFurthest, EarthModel::kFlattest);
    outbox_.messages.add(Matter::kPacketIgnored, "Earth model with radius {:g} m: too far from WGS84",
                         packet.equatorial_radius);
}

}  // namespace skyig::server::world
