#include "server/world/entities.h"

#include <algorithm>
#include <array>

namespace skyig::server::world {
namespace {

bool before(const Entity& entity, std::uint16_t id) noexcept {
    return entity.id < id;
}

}  // namespace

void Mover::place(const Pose& pose, double arrival_s, std::optional<double> sender_s) noexcept {
    clamped = false;
    track.report_position(pose.position, arrival_s, sender_s);
    track.report_attitude(pose.yaw_deg, pose.pitch_deg, pose.roll_deg, arrival_s, sender_s);
}

EntityStore::EntityStore() {
    entities_.reserve(kMost);
}

Entity* EntityStore::claim(std::uint16_t id) noexcept {
    const auto place = std::lower_bound(entities_.begin(), entities_.end(), id, before);
    if (place != entities_.end() && place->id == id) return &*place;
    if (entities_.size() == kMost) return nullptr;
    const auto made = entities_.insert(place, Entity{});
    made->id = id;
    return &*made;
}

Entity* EntityStore::find(std::uint16_t id) noexcept {
    const auto place = std::lower_bound(entities_.begin(), entities_.end(), id, before);
    return place != entities_.end() && place->id == id ? &*place : nullptr;
}

const Entity* EntityStore::find(std::uint16_t id) const noexcept {
    const auto place = std::lower_bound(entities_.begin(), entities_.end(), id, before);
    return place != entities_.end() && place->id == id ? &*place : nullptr;
}

void EntityStore::destroy(std::uint16_t id) noexcept {
    std::erase_if(entities_, [id](const Entity& entity) { return entity.id == id; });
}

std::optional<Pose> EntityStore::pose_of(std::uint16_t id, const Pose& ownship, double now_s) const noexcept {
    // From the entity up to what is attached to nothing, then down again.
    std::array<const Entity*, kDeepest> chain{};
    std::size_t links = 0;
    Pose pose = ownship;
    while (id != 0) {
        const Entity* entity = find(id);
        if (entity == nullptr) return std::nullopt;
        if (!entity->attached) {
            pose = entity->mover.track.at(now_s);
            break;
        }
        if (links == chain.size()) return std::nullopt;
        chain[links++] = entity;
        id = entity->parent_id;
    }
    while (links > 0) {
        const Entity& entity = *chain[--links];
        const Pose& angles = entity.on_parent;
        pose =
            pose_on(pose, entity.offset_m, ned_from_body(angles.yaw_deg, angles.pitch_deg, angles.roll_deg));
    }
    return pose;
}

}  // namespace skyig::server::world
