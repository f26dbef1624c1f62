// State of sea and ground as the host has set it: persistent, in storage of fixed size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/cigi/packets.h"

namespace skyig::server::world {

/// Keeps the last Maritime Surface Conditions Control of each scope and region, the last Wave Control of each
/// scope, region and wave, and the last Terrestrial Surface Conditions Control of each scope, region and
/// condition. Scopes are global and regional; what hangs
/// on an entity is the caller's to refuse. Allocates at construction only.
class SurfaceStore {
  public:
    static constexpr std::size_t kMaxSeas = 257;
    static constexpr std::size_t kMaxWaves = 1024;
    static constexpr std::size_t kMaxConditions = 1024;

    SurfaceStore();

    /// What is not enabled is kept as such. \return false when there is no room for another.
    bool set(const protocol::cigi::MaritimeSurfaceControl& sea) noexcept;
    bool set(const protocol::cigi::WaveControl& wave) noexcept;
    bool set(const protocol::cigi::TerrestrialSurfaceControl& condition) noexcept;
    void forget_region(std::uint16_t region_id) noexcept;
    void clear() noexcept;

    /// Null where none is set or it is not enabled.
    [[nodiscard]] const protocol::cigi::MaritimeSurfaceControl* sea(protocol::cigi::WeatherScope scope,
                                                                    std::uint16_t region_id) const noexcept;
    [[nodiscard]] bool has_regional_sea() const noexcept {
        return !seas_.empty() && seas_.back().scope == protocol::cigi::WeatherScope::kRegional;
    }
    /// Waves, a sea or ground conditions are set in some region.
    [[nodiscard]] bool is_regional() const noexcept {
        return has_regional_sea() ||
               (!conditions_.empty() &&
                conditions_.back().scope == protocol::cigi::WeatherScope::kRegional) ||
               (!waves_.empty() && waves_.back().scope == protocol::cigi::WeatherScope::kRegional);
    }
    /// Enabled or not, sorted by wave.
    [[nodiscard]] std::span<const protocol::cigi::WaveControl> waves(protocol::cigi::WeatherScope scope,
                                                                     std::uint16_t region_id) const noexcept;
    /// Enabled or not, sorted by condition.
    [[nodiscard]] std::span<const protocol::cigi::TerrestrialSurfaceControl> conditions(
        protocol::cigi::WeatherScope scope, std::uint16_t region_id) const noexcept;

  private:
    std::vector<protocol::cigi::MaritimeSurfaceControl> seas_;
    std::vector<protocol::cigi::WaveControl> waves_;
    std::vector<protocol::cigi::TerrestrialSurfaceControl> conditions_;
};

}  // namespace skyig::server::world
