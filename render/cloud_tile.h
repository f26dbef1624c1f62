// What makes one tile of the cloud map what is shown: clouds far and near, what stands behind them, the air
// between, lightning. Free of GL.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/cloud/cloud_map.h"
#include "render/cloud/lightning.h"
#include "render/cloud/shadow_cells.h"
#include "render/cloud/tile_tone.h"
#include "render/deferred.h"
#include "render/ground_shadow.h"
#include "render/sky_light.h"

namespace skyig::render {

/// What stands behind a tile and between, at its nodes, by components. \see cloud::ToneTile
struct CloudBackdrop {
    using Nodes = float[3][cloud::kNodeFloats];
    Nodes sky{};
    Nodes ground{};
    Nodes extinction{};
    Nodes convergence{};
    /// Of the air before near clouds.
    Nodes near_extinction{};
    Nodes near_convergence{};
    /// Of the ground under all of the beam that casts shadows.
    Nodes sunlit{};
    /// Sky and ground both stand behind it.
    bool horizon = false;
    /// Light changes so much between nodes that its codes do not go straight.
    bool steep = false;
};

/// Looks it up for the frame's light: some 10 us. \param shadow  null: nothing casts any
void look_up(CloudBackdrop& backdrop, const cloud::CloudMap& map, int tile, const SkyLight& light,
             const DeferredAir& air, const GroundShadow* shadow) noexcept;

/// Near clouds at a tile's nodes, without the air before them.
struct NearNodes {
    CloudBackdrop::Nodes light{};
    float passed[cloud::kNodeFloats]{};
    float reach_m[cloud::kNodeFloats]{};
    /// Whether there are any.
    bool any = false;
};

/// Nothing of them while the map shows none.
void look_up(NearNodes& near, const cloud::CloudMap& map, int tile) noexcept;
/// Whether one does for the other: by a fifth of a code.
[[nodiscard]] bool still_serves(const NearNodes& made, const NearNodes& wanted) noexcept;

/// Those flashes that light clouds seen in a tile.
[[nodiscard]] cloud::Flashes flashes_on(const cloud::Cone& cone, const cloud::Flashes& flashes) noexcept;
/// Luminance that a flash gives to cloud, cd/m2. \param place_m  of the eye
[[nodiscard]] glm::vec3 flash_inside_cd_m2(const cloud::Flash& flash, const glm::dvec3& place_m) noexcept;

class CloudTile {
  public:
    /// Floats of what things of another renderer ask of a tile: the clouds' light with the air between and
    /// the transmittance of all, then over their distance, then the transmittance of near ones.
    static constexpr std::size_t kThingFloats = std::size_t{cloud::kTileTexels} * 6;

    /// \param tile  one that a view sees \param flashes  that light it
    void take(const cloud::CloudMap& map, int tile, const CloudBackdrop& backdrop, const NearNodes& near,
              const SkyLight& light, const cloud::Flashes& flashes) noexcept;
    /// After take(), if its ground lies in shadows of single clouds, which must live until tone().
    void shade(const cloud::ShadowCells& shadow, const CloudBackdrop& backdrop) noexcept;
    /// \param laws  of each screen \param out  of each screen; the tile's floats begin at first \param things
    /// kThingFloats, or none
    /// \return largest step of a code or a factor from texel to texel, 0..1
    float tone(std::span<const cloud::ToneLaw> laws, std::span<std::vector<float>> out, std::size_t first,
               std::span<float> things) noexcept;

  private:
    void take_parts(const cloud::CloudMap& map) noexcept;
    void take_near(const CloudBackdrop& backdrop, const NearNodes& near) noexcept;
    [[nodiscard]] bool hides_far(const cloud::CloudMap& map, const CloudBackdrop& backdrop) const noexcept;
    void gather(int row) noexcept;
    void add_flashes(int row) noexcept;
    void tell_things(int row, std::span<float> things) const noexcept;
    void cover(const cloud::ToneLaw& law, float* out) const noexcept;
    void tell_codes(const cloud::ToneLaw& law) noexcept;
    [[nodiscard]] glm::vec3 direction_of_node(int node) const noexcept;

    cloud::MapGeometry geometry_;
    cloud::ToneTile tile_{};
    cloud::ToneRow row_{};
    cloud::Flashes flashes_;
    float near_share_ = 0.0F;  // of the parts, what ends where near clouds begin
    bool covered_ = false;
    bool steep_ = false;
};

}  // namespace skyig::render
