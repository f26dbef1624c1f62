// All layers of the world that can be seen from the eye, the nearest first.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "server/weather/told_layer.h"
#include "server/world/world.h"

namespace skyig::server::weather {

/// Works in storage of its own: allocates at construction only. Half a microsecond a region and its layer.
class Gatherer {
  public:
    /// Kept at most.
    static constexpr std::size_t kMost = 64;
    /// From where nothing of a layer is seen: the horizon of clouds 12 km high, from the ground, or from 1
    /// km.
    static constexpr double kReach_m = 500'000.0;

    Gatherer();

    /// Sorted by distance, then by key. Valid until the next call.
    std::span<const ToldLayer> gather(const world::World& world, const EyePlane& plane,
                                      const Meaning& meaning);

    /// Of the last call.
    [[nodiscard]] std::span<const ToldLayer> layers() const noexcept { return layers_; }
    /// Of the last call: layers in reach beyond kMost, the furthest.
    [[nodiscard]] std::size_t left_out() const noexcept { return left_out_; }

  private:
    struct Region {
        std::uint16_t id = 0;
        bool merges = false;
        std::uint64_t sent = 0;
        GroundArea area;
        double distance_m = 0.0;
        /// At the eye.
        double weight = 0.0;
        /// Its layers in `covers_`, where it counts at the eye.
        std::size_t first_cover = 0;
        std::size_t cover_count = 0;
    };
    struct Cover {
        Family family = Family::kCloud;
        double base_m = 0.0;
        double top_m = 0.0;
    };

    void find_regions(const world::World& world, const EyePlane& plane);
    void add_regional(const world::World& world, Region& region, const Meaning& meaning);
    void add_entities(const world::World& world, const EyePlane& plane, const Meaning& meaning);
    /// What regions sent later leave of a layer at the eye.
    [[nodiscard]] double uncovered(const ToldLayer& layer) const noexcept;
    void add(const ToldLayer& layer) noexcept;

    std::vector<Region> regions_;
    std::vector<Cover> covers_;
    std::vector<ToldLayer> layers_;
    std::size_t left_out_ = 0;
};

}  // namespace skyig::server::weather
