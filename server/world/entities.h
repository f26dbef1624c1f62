// Entities other than the ownship, as the host has placed them: nothing of them is drawn, but weather may
// ride on them and requests may ask for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "server/world/ownship_track.h"

namespace skyig::server::world {

/// What is placed by reports and moves on between them.
struct Mover {
    OwnshipTrack track;
    /// The entity's own smoothing bit: in 4.0 it comes in another packet than the position.
    bool smoothed = false;
    /// It follows the surface: its height is that of the sea below it.
    bool clamped = false;

    /// It is there and nowhere else, from an instant that the sender may tell; it is not clamped.
    void place(const Pose& pose, double arrival_s, std::optional<double> sender_s) noexcept;
};

struct Entity {
    std::uint16_t id = 0;
    /// False: it is kept in store, and no weather rides on it.
    bool active = true;
    /// Attached, its pose is told along its parent's axes: forward, right, down.
    bool attached = false;
    std::uint16_t parent_id = 0;
    glm::dvec3 offset_m{0.0};
    /// The angles alone.
    Pose on_parent;
    Mover mover;
    /// Who has placed it.
    std::size_t source = 0;
};

/// Sorted by id. Allocates at construction only.
class EntityStore {
  public:
    static constexpr std::size_t kMost = 512;
    /// Of parents above each other.
    static constexpr int kDeepest = 8;

    EntityStore();

    /// The one of that id, new if there was none; null when there is no room for another.
    [[nodiscard]] Entity* claim(std::uint16_t id) noexcept;
    [[nodiscard]] Entity* find(std::uint16_t id) noexcept;
    [[nodiscard]] const Entity* find(std::uint16_t id) const noexcept;
    void destroy(std::uint16_t id) noexcept;
    void clear() noexcept { entities_.clear(); }
    [[nodiscard]] std::span<Entity> all() noexcept { return entities_; }

    /// \param ownship  entity 0, which others may be attached to
    /// \return where it is at `now_s`; nothing when it or one of its parents is not there, or a parent is its
    /// own child. What is clamped stands at the height that it was told last.
    [[nodiscard]] std::optional<Pose> pose_of(std::uint16_t id, const Pose& ownship,
                                              double now_s) const noexcept;

  private:
    std::vector<Entity> entities_;
};

}  // namespace skyig::server::world
