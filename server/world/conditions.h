// Weather, sea and ground at one point: the global state, and what layers and regions make of it there.
//
// Within one region (or globally) all layers at a point count together: extinctions (1 / visibility) add up,
// wind is the vector mean, the rest is the mean, each weighed by how far the point is in the layer's
// transition band. What they leave over is what lies below: regional over global over the base state. Regions
// count in the order in which they were last sent: one with its merge flag joins those before it, one without
// covers them, in its perimeter by part. Weather that hangs on entities lies over all others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/cigi/packets.h"
#include "server/world/region_geometry.h"
#include "server/world/state.h"
#include "server/world/surface_store.h"
#include "server/world/weather_store.h"

namespace skyig::server::world {

struct RegionAt {
    const protocol::cigi::EnvRegionControl* region = nullptr;
    std::uint64_t sent = 0;
    /// > 0
    double weight = 0.0;
};

/// The active regions at a point, in the order in which they were sent.
class RegionsAt {
  public:
    RegionsAt() = default;
    RegionsAt(const WeatherStore& weather, const GroundPoint& point) noexcept;

    [[nodiscard]] const RegionAt* begin() const noexcept { return regions_.data(); }
    [[nodiscard]] const RegionAt* end() const noexcept { return regions_.data() + count_; }
    [[nodiscard]] std::size_t size() const noexcept { return count_; }

  private:
    std::array<RegionAt, WeatherStore::kMaxRegions> regions_{};
    std::size_t count_ = 0;
};

/// 1 from base to top of a layer, falling linearly to 0 over its transition bands. No coverage in it.
[[nodiscard]] double layer_weight(const protocol::cigi::WeatherControl& layer, double height_m) noexcept;

/// Weather of an entity, and how much of it counts at the point.
struct CarriedWeather {
    const protocol::cigi::WeatherControl* weather = nullptr;
    /// > 0
    double weight = 0.0;
};

/// What rides on the entities around a point; of more than kMost the first.
class CarriedAt {
  public:
    static constexpr std::size_t kMost = 64;

    /// 1 at the entity, falling linearly to 0 at the radius that the transition band tells; base, thickness
    /// and layer id mean nothing.
    void add(const protocol::cigi::WeatherControl& weather, double distance_m) noexcept;
    [[nodiscard]] std::span<const CarriedWeather> all() const noexcept { return {all_.data(), count_}; }

  private:
    std::array<CarriedWeather, kMost> all_{};
    std::size_t count_ = 0;
};

/// \param base  holds everywhere at every height; bit for bit the result where no layer is
[[nodiscard]] AirState air_at(const AirState& base, const WeatherStore& weather, const RegionsAt& regions,
                              double height_m, std::span<const CarriedWeather> carried = {}) noexcept;

struct Aerosols {
    struct Layer {
        bool present = false;
        /// g/m3
        double aerosol_g_m3 = 0.0;
    };
    /// By layer id.
    std::array<Layer, 256> layers{};
};

[[nodiscard]] Aerosols aerosols_at(const WeatherStore& weather, const RegionsAt& regions,
                                   double height_m) noexcept;

/// The sea, where nobody has said anything of it.
struct SeaState {
    double height_m = 0.0;
    double temperature_c = 15.0;
    double clarity_pct = 100.0;
    /// 0 without whitecaps, 1 with; between them in a region's perimeter.
    double whitecaps = 0.0;
};

[[nodiscard]] SeaState sea_at(const SurfaceStore& surfaces, const RegionsAt& regions) noexcept;
/// Looks for regions only where one has a sea of its own.
[[nodiscard]] SeaState sea_below(const WeatherStore& weather, const SurfaceStore& surfaces,
                                 const ephemeris::Geodetic& point) noexcept;

struct WaveAt {
    const protocol::cigi::WaveControl* wave = nullptr;
    /// Of its height, > 0.
    double weight = 0.0;
};

/// The enabled waves at a point. A region's take the place of the global ones, in its perimeter by part;
/// those of a region with the maritime merge flag come beside those of the regions before it. Beyond kMost
/// the lowest are left out.
class WavesAt {
  public:
    static constexpr std::size_t kMost = 16;

    WavesAt(const SurfaceStore& surfaces, const RegionsAt& regions) noexcept;

    [[nodiscard]] const WaveAt* begin() const noexcept { return waves_.data(); }
    [[nodiscard]] const WaveAt* end() const noexcept { return waves_.data() + count_; }
    [[nodiscard]] std::size_t size() const noexcept { return count_; }

  private:
    void cover(double weight) noexcept;
    void add(const protocol::cigi::WaveControl& wave, double weight) noexcept;

    std::array<WaveAt, kMost> waves_{};
    std::size_t count_ = 0;
};

/// Terrestrial conditions that are drawn, by id. Dry holds for those of the two that are not enabled beside
/// it.
inline constexpr std::uint16_t kDryCondition = 0;
inline constexpr std::uint16_t kSnowCondition = 1;
inline constexpr std::uint16_t kWetCondition = 2;

/// Part of the ground that such a condition covers, 0..1, if anybody has said so here. A region's takes the
/// place of the global one, in its perimeter by part.
[[nodiscard]] std::optional<double> condition_cover(const SurfaceStore& surfaces, const RegionsAt& regions,
                                                    std::uint16_t condition_id) noexcept;

/// The terrestrial conditions at a point. A region's take the place of the global ones, in its perimeter they
/// come beside them. Nothing set is condition 0: dry.
class GroundConditions {
  public:
    static constexpr std::size_t kMost = 64;

    GroundConditions(const SurfaceStore& surfaces, const RegionsAt& regions) noexcept;

    [[nodiscard]] const std::uint16_t* begin() const noexcept { return ids_.data(); }
    [[nodiscard]] const std::uint16_t* end() const noexcept { return ids_.data() + count_; }
    [[nodiscard]] std::size_t size() const noexcept { return count_; }

  private:
    void add(std::uint16_t id) noexcept;

    std::array<std::uint16_t, kMost> ids_{};
    std::size_t count_ = 0;
};

}  // namespace skyig::server::world
