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
    void clear() noexcept;

    [[nodiscard]] std::span<const protocol::cigi::WeatherControl> layers() const noexcept { return layers_; }
    [[nodiscard]] std::span<const protocol::cigi::EnvRegionControl> regions() const noexcept {
        return regions_;
    }

  private:
    std::vector<protocol::cigi::WeatherControl> layers_;
    std::vector<protocol::cigi::EnvRegionControl> regions_;
};

}  // namespace skyig::server::world
