// The Milky Way's belt for all channels: a strip of directions that turns with the sky, its vertices carrying
// what a texel of the map adds to the display there. Free of GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/dome_patches.h"
#include "render/night/milky_way_map.h"
#include "render/scene.h"
#include "render/shaders/shared.h"
#include "render/sky_light.h"

namespace skyig::render {

/// As the vertex shader night/milky_way.vert takes it. Added display codes (0..1) of a texel t of the map:
/// colour t (1 + bend t), exact at one luminance, in the mean of the channels at two.
struct MilkyWayVertex {
    glm::vec3 direction;  ///< galactic axes
    glm::vec2 place;      ///< on the map, 0..1 through texel centres
    glm::vec3 colour;
    float bend;
};

class MilkyWay {
  public:
    static constexpr int kColumns = 120;
    static constexpr int kRows = 20;
    /// Frames over which the vertices are shaded anew, some in each.
    static constexpr std::size_t kFramesARound = 8;

    /// \param screens  vertices are shaded for each
    explicit MilkyWay(std::size_t screens = 1);

    /// Makes the map that the settings ask for, some rows a frame. Allocates nothing. \param at_once the
    /// whole map. \return whether it is there
    bool make_map(const NightSettings& settings, bool at_once) noexcept;

    /// Shades vertices for the frame's light, whose `milky_way` must be set. Allocates nothing. \param
    /// at_once all of them, not their turn alone
    void shade(const SkyLight& light, std::span<const shaders64::ToneParameters> tones,
               bool at_once) noexcept;

    [[nodiscard]] const night::MilkyWayMap& map() const noexcept { return map_; }
    [[nodiscard]] std::span<const MilkyWayVertex> vertices(std::size_t screen = 0) const noexcept {
        return vertices_[screen];
    }
    [[nodiscard]] std::size_t screens() const noexcept { return vertices_.size(); }
    [[nodiscard]] std::span<const std::uint32_t> indices() const noexcept { return patches_.indices(); }
    /// What of the indices a view needs; valid until the next call.
    [[nodiscard]] std::span<const IndexRange> visible(const glm::dmat4& clip_from_galactic) noexcept {
        return patches_.visible(clip_from_galactic);
    }
    /// Rises by one with each new map.
    [[nodiscard]] std::uint64_t map_revision() const noexcept { return map_revision_; }

  private:
    night::MilkyWayMap map_;
    double structure_ = -1.0;  // of the map; below 0: of none
    std::uint32_t seed_ = 0;
    std::uint64_t map_revision_ = 0;
    std::vector<std::vector<MilkyWayVertex>> vertices_;  // of each screen
    std::vector<double> brightest_;  // luminance at each vertex that the codes are exact for
    DomePatches patches_;
    std::size_t next_ = 0;
};

/// Display codes that the brightest part of the belt adds to a sky of this luminance, seen in clear air.
[[nodiscard]] double milky_way_most_codes(double background_cd_m2,
                                          const shaders64::ToneParameters& tone) noexcept;

}  // namespace skyig::render
