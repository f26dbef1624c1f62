// The clouds of a frame as all channels share them: the map in linear light, toned for each screen tile by
// tile, the air between laid over it; and what anything behind clouds asks. Free of GL.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/cloud/cloud_map.h"
#include "render/cloud/lightning.h"
#include "render/cloud/shadow_cells.h"
#include "render/cloud/tile_tone.h"
#include "render/cloud_tile.h"
#include "render/deferred.h"
#include "render/eye/adaptation.h"
#include "render/patch_columns.h"
#include "render/shaders/shared.h"
#include "render/sky_light.h"

namespace skyig::render {

/// One tile of a screen's map, made anew in this frame.
struct TonedTile {
    int tile = 0;
    /// Of CloudFrame::texels(), in floats; kClear: no cloud is seen there.
    std::size_t first = 0;
    static constexpr std::size_t kClear = static_cast<std::size_t>(-1);
};

class CloudFrame {
  public:
    /// Of the tiles whose sky has changed, what a frame looks up.
    static constexpr std::size_t kBackdropsAFrame = 16;
    /// Floats of a toned tile: colour and factor, row by row. \see cloud::ToneKernel
    static constexpr std::size_t kTileFloats = std::size_t{cloud::kTileTexels} * 4;

    explicit CloudFrame(std::size_t screens);

    /// No clouds: nothing is held or shown.
    void stop() noexcept;
    /// The frame's clouds in linear light; from then on seen_through() and its like may be asked.
    void follow(cloud::CloudMaker& maker, const Scene& scene, const cloud::CloudLight& on_clouds,
                const SkyLight& light, bool jumped, int size, int tiles_a_frame);
    /// Shadows of this frame's clouds, null for none; it must live until the next call.
    void shade_ground(const GroundShadow* shadow) noexcept { shadow_ = shadow; }
    /// From now on things stand among the clouds: tones all again.
    void serve_things() noexcept;
    /// Tiles that are shown are toned anew every so many frames at most, at least 1: not all in the same one.
    void tone_every(int frames) noexcept { tone_every_ = static_cast<std::uint64_t>(frames); }
    /// Tones what has changed. \param tones  one for each screen \param light_revision  rises when the light
    /// has changed by what may show \param tone_revision  likewise \param flashes  that light the clouds
    void tone(const SkyLight& light, const DeferredAir& air, std::span<const shaders64::ToneParameters> tones,
              std::uint64_t light_revision, std::uint64_t tone_revision, const cloud::Flashes& flashes);

    [[nodiscard]] bool shown() const noexcept { return shown_; }
    [[nodiscard]] const cloud::CloudMap& map() const noexcept { return map_; }
    /// Of fog, for things: from the frame after serve_things() on.
    [[nodiscard]] const PatchColumns& patches() const noexcept { return patches_; }
    /// The same for all screens.
    [[nodiscard]] std::span<const TonedTile> toned() const noexcept { return toned_; }
    [[nodiscard]] std::span<const float> texels(std::size_t screen) const noexcept { return texels_[screen]; }
    /// CloudTile::kThingFloats of a toned tile that shows clouds, once serve_things() was called.
    [[nodiscard]] std::span<const float> things(const TonedTile& toned) const noexcept {
        return std::span{things_}.subspan(toned.first / kTileFloats * CloudTile::kThingFloats,
                                          CloudTile::kThingFloats);
    }
    /// Rises when the map has got another size: all of it is clear until told otherwise.
    [[nodiscard]] std::uint64_t size_revision() const noexcept { return size_revision_; }
    /// Cones of the tiles that show clouds to a view.
    [[nodiscard]] std::span<const cloud::Cone> clouded() const noexcept { return clouded_; }

    /// Of all clouds in a direction that a view sees, 0..1; 1 without clouds.
    [[nodiscard]] double transmittance(const glm::dvec3& direction_enu) const noexcept;
    enum class Body : std::size_t { kSun, kMoon };
    /// Towards a body as it is seen, in view or not.
    [[nodiscard]] double transmittance(Body body) const noexcept;
    /// What is seen of light behind all clouds and air, with the clouds' own. \param direction_enu  in a view
    [[nodiscard]] glm::dvec3 seen_through(const DeferredAir& air, const glm::dvec3& behind_cd_m2,
                                          const glm::dvec3& direction_enu) const noexcept;
    /// What is seen of a thing in air, and of the clouds before it. \param thing_cd_m2  with the air before
    /// it
    [[nodiscard]] glm::dvec3 before_thing(const DeferredAir& air, const glm::dvec3& thing_cd_m2,
                                          const glm::dvec3& direction_enu, double distance_m) const noexcept;
    /// The same in the direction of one of eye::probe_directions().
    [[nodiscard]] glm::dvec3 probed(const DeferredAir& air, const glm::dvec3& behind_cd_m2,
                                    std::size_t probe) const noexcept;

  private:
    /// What a tile of the texture was made from.
    struct Made {
        std::uint64_t light = 0;  // 0: no backdrop
        std::uint64_t map = 0;
        std::uint64_t tone = 0;
        bool clouded = false;
        bool flashed = false;
        float step = 0.0F;                     // CloudTile::tone()
        std::array<glm::vec3, 2> offsets_m{};  // of the map's parts
        bool with_clouds = false;
        GroundShadow::Made shadow;
        std::uint64_t at_frame = 0;  // 0: must not rest
    };
    void resize();
    [[nodiscard]] glm::dvec3 composed(const cloud::CloudMap::Sight& sight, const DeferredAir& air,
                                      const glm::dvec3& behind_cd_m2,
                                      const glm::dvec3& direction_enu) const noexcept;
    void refresh_backdrops(const SkyLight& light, const DeferredAir& air, std::uint64_t revision);
    void refresh_tile(int tile, const SkyLight& light, std::uint64_t tone_revision) noexcept;
    [[nodiscard]] bool serves(int tile, std::uint64_t tone_revision) const noexcept;
    [[nodiscard]] bool rests(int tile) const noexcept;

    /// How far the nearest ground of a tile is that shadows are told of; 0: there is none.
    [[nodiscard]] double shaded_from_m(int tile) const noexcept;

    cloud::CloudMap map_;
    PatchColumns patches_;
    const GroundShadow* shadow_ = nullptr;
    cloud::ShadowCells shadow_cells_{};  // of this frame
    bool serves_things_ = false;
    std::vector<float> things_;
    bool shown_ = false;
    bool jumped_ = false;
    std::vector<glm::vec3> probes_;
    std::vector<CloudBackdrop> backdrops_;  // of each tile
    std::vector<Made> made_;
    std::vector<NearNodes> near_made_;  // likewise
    NearNodes near_;                    // of the tile in hand
    CloudTile tile_;
    std::vector<cloud::ToneLaw> laws_;
    cloud::Flashes flashes_;
    std::vector<TonedTile> toned_;
    std::size_t toned_count_ = 0;  // of those, what has texels
    std::vector<std::vector<float>> texels_;
    std::vector<cloud::Cone> clouded_;
    std::vector<int> clouded_tiles_;
    std::size_t next_backdrop_ = 0;
    std::uint64_t tone_every_ = 1;
    std::uint64_t frames_ = 0;
    std::uint64_t size_revision_ = 0;
};

}  // namespace skyig::render
