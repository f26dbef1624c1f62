// Weather layers and regions as the host has set them: persistent, in storage of fixed size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/cigi/packets.h"

namespace skyig::server::world {

/// Keeps the last Weather Control of each (scope, region or entity, layer id), sorted by that key, and the
/// last Environmental Region Control of each region id. Allocates at construction only.
class WeatherStore {
  public:
    static constexpr std::size_t kMaxLayers = 2048;
    static constexpr std::size_t kMaxRegions = 256;

    WeatherStore();

    /// A layer that is not enabled is kept as such: the host may address it again.
    /// \return false when there is no room for another layer.
    bool set(const protocol::cigi::WeatherControl& layer) noexcept;
    /// A destroyed region is forgotten with all its layers. \return false when there is no room for another
    /// region.
    bool set(const protocol::cigi::EnvRegionControl& region) noexcept;
    /// The weather that hangs on it.
    void forget_entity(std::uint16_t entity_id) noexcept;
    void clear() noexcept;

    /// Switches what is there and leaves all else as it was set. \return false when it is not there.
    bool enable_layer(protocol::cigi::WeatherScope scope, std::uint16_t region_id, std::uint8_t layer_id,
                      bool enable) noexcept;
    bool enable_region(std::uint16_t region_id, bool enable) noexcept;

    [[nodiscard]] std::span<const protocol::cigi::WeatherControl> layers() const noexcept { return layers_; }
    /// Those of one region or entity; of the global scope with any id.
    [[nodiscard]] std::span<const protocol::cigi::WeatherControl> layers_of(
        protocol::cigi::WeatherScope scope, std::uint16_t region_id) const noexcept;
    /// Those of all entities.
    [[nodiscard]] std::span<const protocol::cigi::WeatherControl> carried() const noexcept;
    [[nodiscard]] std::span<const protocol::cigi::EnvRegionControl> regions() const noexcept {
        return regions_;
    }
    /// For each of regions(), a number that is the larger the later its last Environmental Region Control
    /// came.
    [[nodiscard]] std::span<const std::uint64_t> regions_sent() const noexcept { return regions_sent_; }

  private:
    /// All layers of one region or entity.
    void forget(protocol::cigi::WeatherScope scope, std::uint16_t id) noexcept;

    std::vector<protocol::cigi::WeatherControl> layers_;
    std::vector<protocol::cigi::EnvRegionControl> regions_;
    std::vector<std::uint64_t> regions_sent_;
    std::uint64_t sent_ = 0;
};

}  // namespace skyig::server::world
