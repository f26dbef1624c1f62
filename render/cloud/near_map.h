// Clouds round the eye, nearer than the map follows them: a coarse map of its own, marched from the present
// eye in every frame.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/cloud/snapshot.h"

namespace skyig::render::cloud {

/// Where the near map ends and the far one begins, while there is a near one.
inline constexpr double kNearRange_m = 400.0;

class NearMap {
  public:
    static constexpr int kSize = 64;

    NearMap();

    /// Follows the rays that the views see; others stay as they are. Allocates nothing.
    /// \param margin_rad  beside the views \return how many
    int march(const CloudSource& source, std::span<const ChannelView> views, double margin_rad,
              const Frozen& frozen) noexcept;

    /// \param direction  components whose sizes sum to 1
    [[nodiscard]] Snapshot::Seen seen(const glm::vec3& direction) const noexcept {
        return map_.seen(direction, 0.0F, glm::vec3{0.0F});
    }

  private:
    Snapshot map_;
    struct Part {
        MapGeometry::Texel corner;
        Cone cone;
    };
    std::vector<Part> parts_;
};

}  // namespace skyig::render::cloud
