// What clouds make of each direction that the rig sees, once for all channels: snapshots from frozen eyes are
// marched tile by tile over frames on a thread of their own; a finished one takes the place of the one before
// it over some frames. Both are seen from the present eye. What a frame sees depends on the frames before it
// alone, never on measured time: a batch of tiles asked for in one frame is taken in the next one, which
// waits if it must. Free of GL and of tone.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "render/cloud/cloud_maker.h"
#include "render/cloud/march_worker.h"
#include "render/cloud/near_map.h"
#include "render/cloud/snapshot.h"

namespace skyig::render::cloud {

/// What the map asks of a frame.
struct MapFrame {
    CloudMoment moment;
    std::span<const ChannelView> views;
    /// Adaptation looks there, as seen; the same number in all frames.
    std::span<const glm::vec3> probes;
    double seen_horizon_rad = 0.0;
    double straight_horizon_rad = 0.0;
    /// Another scene altogether: everything is marched at once, as when the eye has leapt.
    bool jumped = false;
};

class CloudMap {
  public:
    /// Beside the views, so that a turn finds the clouds there.
    static constexpr double kMargin_rad = 0.25;
    /// Frames over which a snapshot takes the place of another.
    static constexpr int kBlendFrames = 12;
    /// The same of clouds that come, go or grow, if the next one's making takes no longer: one blend goes
    /// over into the next, so that they change by as much in every frame.
    static constexpr int kGrowthFrames = 60;
    static constexpr float kProbe_rad = 0.03F;

    CloudMap();

    /// \param size  texels on a square's side \param tiles_a_frame  >= 1. Allocates when the size is another
    /// than before.
    void update(CloudMaker& maker, const MapFrame& frame, int size, int tiles_a_frame);
    /// Forgets all; the next update() begins at once.
    void stop() noexcept;

    [[nodiscard]] const MapGeometry& geometry() const noexcept { return geometry_; }
    [[nodiscard]] const Cone& cone(int tile) const noexcept { return cones_[static_cast<std::size_t>(tile)]; }

    /// A snapshot that takes part in what is seen.
    struct Part {
        const Snapshot* snapshot = nullptr;
        float weight = 1.0F;
        /// Of the present eye from the snapshot's, against the clouds.
        glm::vec3 offset_m{0.0F};
        /// Clouds nearer than kNearRange_m are not in it.
        bool beyond_near = false;
    };
    /// One or two, whose weights sum to 1.
    [[nodiscard]] std::span<const Part> parts() const noexcept { return {parts_.data(), part_count_}; }
    [[nodiscard]] const NearMap* near_map() const noexcept { return near_shown_ ? &near_ : nullptr; }
    /// Rises whenever what is seen of far clouds has changed by anything but the eye's motion, which
    /// Part::offset_m tells.
    [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }

    /// Tiles that a view sees: all of them are known.
    [[nodiscard]] std::span<const int> seen_tiles() const noexcept { return seen_; }
    /// Whether no view sees a cloud, nor will while there are none.
    [[nodiscard]] bool is_clear() const noexcept;
    /// Whether a tile may show clouds.
    [[nodiscard]] bool may_show(int tile) const noexcept;

    /// Of all clouds together, without air, in one direction.
    struct Sight {
        glm::dvec3 far_light_cd_m2{0.0};  ///< behind the near clouds, dimmed by them
        double far_opacity = 0.0;         ///< likewise
        double distance_m = 0.0;          ///< of that part
        glm::dvec3 near_light_cd_m2{0.0};
        double near_opacity = 0.0;
        double near_distance_m = 0.0;
        double transmittance = 1.0;  ///< of all
    };
    /// \param direction_enu  unit vector, in a view
    [[nodiscard]] Sight sight(const glm::dvec3& direction_enu) const noexcept;
    /// In one of the frame's probes, wherever it is.
    [[nodiscard]] Sight probe(std::size_t index) const noexcept;
    /// sight() where a view's clouds are known, else that of the probe.
    [[nodiscard]] Sight sight_or_probe(const glm::dvec3& direction_enu, std::size_t probe) const noexcept;

    // What the last update() did.
    [[nodiscard]] int rays_marched() const noexcept { return rays_; }
    [[nodiscard]] int near_rays() const noexcept { return near_rays_; }

  private:
    void resize(int size, std::size_t probes);
    void note_motion(const MapFrame& frame) noexcept;
    [[nodiscard]] bool stands_still(const MapFrame& frame) const noexcept;
    [[nodiscard]] Frozen frozen_at(const MapFrame& frame, const Eye& eye) const noexcept;
    void begin(CloudMaker& maker, const MapFrame& frame, double frames_ahead);
    void list_tiles(std::span<const ChannelView> views, double margin_rad, std::vector<int>& tiles);
    void march_all(CloudMaker& maker, const MapFrame& frame);
    void advance(CloudMaker& maker, const MapFrame& frame, int tiles_a_frame);
    void take_over() noexcept;
    void fill_in();
    void show_near(CloudMaker& maker, const MapFrame& frame);
    void tell_parts(const MapFrame& frame) noexcept;
    [[nodiscard]] bool near_wanted(const MapFrame& frame) const noexcept;

    MapGeometry geometry_;
    std::vector<Cone> cones_;
    std::vector<Corners> corners_;
    std::array<Snapshot, 3> snapshots_;
    std::array<const CloudSource*, 3> sources_{};
    std::array<glm::dvec2, 3> drifted_m_{};  // since each was frozen
    std::size_t old_ = 0;
    std::size_t new_ = 1;
    std::size_t next_ = 2;
    int blend_ = kBlendFrames;  // frames of the blend that are over
    int blend_frames_ = kBlendFrames;
    bool grows_ = false;       // the clouds between the two that are blended
    bool next_grows_ = false;  // between the last and the one in the making
    int march_frames_ = 0;     // that the one in the making has taken
    bool shown_ = false;
    bool marching_ = false;
    bool wanted_near_ = false;
    bool leapt_ = false;
    std::vector<int> seen_;
    std::vector<int> tiles_;  // that the next snapshot is to have
    std::size_t tiles_done_ = 0;
    std::size_t tiles_asked_ = 0;
    double period_frames_ = 2.0 * kBlendFrames;
    std::uint64_t frames_since_begin_ = 0;

    NearMap near_;
    bool near_shown_ = false;

    // Of the frame before, and what it was frozen from last.
    std::optional<Eye> last_eye_;
    Eye motion_a_frame_;
    Weather last_weather_;
    Weather frozen_weather_;
    CloudLight frozen_light_;
    Eye frozen_eye_;

    std::array<Part, 2> parts_{};
    std::size_t part_count_ = 0;
    std::uint64_t revision_ = 0;
    int rays_ = 0;
    int near_rays_ = 0;
    MarchWorker worker_;  // the last: it uses what is above
};

}  // namespace skyig::render::cloud
