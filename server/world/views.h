// The views of all channels and the view groups, as configured and as the host has changed them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "config/config.h"
#include "protocol/cigi/packets.h"
#include "server/world/state.h"

namespace skyig::server::world {

/// What became of a View Control or View Definition.
enum class ViewResult : std::uint8_t {
    kDone,
    kUnknownView,
    kOtherEntity,
    kFarAway,  ///< an enabled offset beyond config::kMaxOffset_m
    kBadFrustum,
    kReplication,  ///< a pixel replication of 4..7, which the standard leaves to each image generator
};

class Views {
  public:
    explicit Views(const std::vector<config::Channel>& channels);

    /// Every view as configured, every group where the ownship is.
    void reset() noexcept;

    /// Enabled parts replace what the view (or, with a group id, the group) had; the others stay.
    ViewResult apply(const protocol::cigi::ViewControl& control) noexcept;
    /// Group membership, mirror, pixel replication and projection always; half angles where enabled, all or
    /// none, and only if they leave a picture together with those that stay. Near and far planes mean nothing
    /// to a sky, and it has one type of view. Nothing of a refused packet is taken.
    ViewResult apply(const protocol::cigi::ViewDefinition& definition) noexcept;

    /// \return false when there is no such view
    bool show_pattern(std::uint16_t view_id, config::Pattern pattern) noexcept;
    /// In all views of a group, 0: in all views. \return false when there are none
    bool show_pattern_in_group(std::uint8_t group_id, config::Pattern pattern) noexcept;

    /// In the order of the configured channels.
    [[nodiscard]] std::span<const View> all() const noexcept { return views_; }
    /// Group 0 is no group and stays where the ownship is.
    [[nodiscard]] const ViewPose& group(std::uint8_t group_id) const noexcept { return groups_[group_id]; }

  private:
    View* find(std::uint16_t view_id) noexcept;

    std::vector<View> configured_;
    std::vector<View> views_;
    std::array<ViewPose, 256> groups_{};
};

}  // namespace skyig::server::world
