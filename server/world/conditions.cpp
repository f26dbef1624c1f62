#include "server/world/conditions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace skyig::server::world {

using protocol::cigi::EnvRegionControl;
using protocol::cigi::MaritimeSurfaceControl;
using protocol::cigi::RegionState;
using protocol::cigi::TerrestrialSurfaceControl;
using protocol::cigi::WaveControl;
using protocol::cigi::WeatherControl;
using protocol::cigi::WeatherScope;

namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
/// That of a visibility of a millimetre: what is less counts as none.
constexpr double kDensest_1_m = 1000.0;

/// How a value of several that hold at one place is made of them.
enum class Together : std::uint8_t { kMean, kSum };

/// Values laid over each other in groups: within a group they are combined, a finished group covers what lies
/// below it by its largest weight.
template <std::size_t N>
class Blend {
  public:
    using Values = std::array<double, N>;

    Blend(const Values& base, const std::array<Together, N>& together) noexcept
        : below_(base), together_(together) {}

    void add(double weight, const Values& values) noexcept {
        for (std::size_t i = 0; i < N; ++i)
            sums_[i] += weight * values[i];
        weight_sum_ += weight;
        largest_ = std::max(largest_, weight);
    }

    /// What is added from here on covers what was.
    void cover() noexcept {
        if (weight_sum_ <= 0.0) return;
        for (std::size_t i = 0; i < N; ++i) {
            const double divisor = together_[i] == Together::kSum ? largest_ : weight_sum_;
            below_[i] += largest_ * (sums_[i] / divisor - below_[i]);
        }
        touched_ = true;
        sums_ = {};
        weight_sum_ = largest_ = 0.0;
    }

    /// Something was added, up to the last cover().
    [[nodiscard]] bool touched() const noexcept { return touched_; }
    [[nodiscard]] const Values& values() const noexcept { return below_; }

  private:
    Values below_;
    std::array<Together, N> together_;
    Values sums_{};
    double weight_sum_ = 0.0;
    double largest_ = 0.0;
    bool touched_ = false;
};

constexpr std::array kAirTogether{Together::kSum,  Together::kMean, Together::kMean, Together::kMean,
                                  Together::kMean, Together::kMean, Together::kMean};
using AirValues = std::array<double, kAirTogether.size()>;

AirValues air_values(double visibility_m, double temperature_c, double humidity_pct, double pressure_hpa,
                     double wind_m_s, double wind_from_deg, double wind_up_m_s) noexcept {
    const double from_rad = wind_from_deg * kRadPerDeg;
    return {1.0 / std::max(visibility_m, 1.0 / kDensest_1_m),
            temperature_c,
            humidity_pct,
            pressure_hpa,
            wind_m_s * std::sin(from_rad),
            wind_m_s * std::cos(from_rad),
            wind_up_m_s};
}

/// A layer that tells no wind along the ground has that of the base state.
AirValues air_values(const WeatherControl& layer, const AirState& base) noexcept {
    const bool own_wind = layer.wind_horizontal > 0.0F;
    return air_values(static_cast<double>(layer.visibility), static_cast<double>(layer.air_temperature),
                      static_cast<double>(layer.humidity), static_cast<double>(layer.pressure),
                      own_wind ? static_cast<double>(layer.wind_horizontal) : base.wind_horizontal_m_s,
                      own_wind ? static_cast<double>(layer.wind_direction) : base.wind_from_deg,
                      static_cast<double>(layer.wind_vertical));
}

AirState air_of(const AirState& base, const AirValues& values) noexcept {
    AirState air = base;
    air.visibility_m = values[0] >= kDensest_1_m ? 0.0 : 1.0 / values[0];
    air.temperature_c = values[1];
    air.humidity_pct = values[2];
    air.pressure_hpa = values[3];
    air.wind_horizontal_m_s = std::hypot(values[4], values[5]);
    const double from_deg = std::atan2(values[4], values[5]) / kRadPerDeg;
    air.wind_from_deg = from_deg < 0.0 ? from_deg + 360.0 : from_deg;
    air.wind_vertical_m_s = values[6];
    return air;
}

/// Calls `add(layer, weight)` for the enabled layers at the height. `cover()` comes before the first.
template <class Cover, class Add>
void each_layer(std::span<const WeatherControl> layers, double part, double height_m, Cover&& cover,
                Add&& add) noexcept {
    bool first = true;
    for (const WeatherControl& layer : layers) {
        if (!layer.weather_enable) continue;
        const double weight = part * layer_weight(layer, height_m);
        if (weight <= 0.0) continue;
        if (std::exchange(first, false)) cover();
        add(layer, weight);
    }
}

}  // namespace

RegionsAt::RegionsAt(const WeatherStore& weather, const GroundPoint& point) noexcept {
    const auto regions = weather.regions();
    for (std::size_t i = 0; i < regions.size(); ++i) {
        if (regions[i].region_state != RegionState::kActive) continue;
        const double weight = region_weight(regions[i], point);
        if (weight > 0.0) regions_[count_++] = {&regions[i], weather.regions_sent()[i], weight};
    }
    std::sort(regions_.begin(), regions_.begin() + static_cast<std::ptrdiff_t>(count_),
              [](const RegionAt& a, const RegionAt& b) { return a.sent < b.sent; });
}

double layer_weight(const WeatherControl& layer, double height_m) noexcept {
    const double base_m = static_cast<double>(layer.base_elevation);
    const double top_m = base_m + static_cast<double>(layer.thickness);
    if (height_m >= base_m && height_m <= top_m) return 1.0;
    const bool below = height_m < base_m;
    const double outside_m = below ? base_m - height_m : height_m - top_m;
    const double band_m = static_cast<double>(below ? layer.transition_band : layer.top_transition_band);
    return outside_m < band_m ? 1.0 - outside_m / band_m : 0.0;
}

void CarriedAt::add(const WeatherControl& weather, double distance_m) noexcept {
    const double radius_m = static_cast<double>(weather.transition_band);
    if (count_ < kMost && distance_m < radius_m) all_[count_++] = {&weather, 1.0 - distance_m / radius_m};
}

AirState air_at(const AirState& base, const WeatherStore& weather, const RegionsAt& regions, double height_m,
                std::span<const CarriedWeather> carried) noexcept {
    Blend<kAirTogether.size()> blend(
        air_values(base.visibility_m, base.temperature_c, base.humidity_pct, base.pressure_hpa,
                   base.wind_horizontal_m_s, base.wind_from_deg, base.wind_vertical_m_s),
        kAirTogether);
    const auto add = [&](const WeatherControl& layer, double weight) {
        blend.add(weight, air_values(layer, base));
    };
    each_layer(
        weather.layers_of(WeatherScope::kGlobal, 0), 1.0, height_m, [] {}, add);
    bool over_global = false;
    for (const RegionAt& at : regions) {
        const auto cover = [&] {
            if (!std::exchange(over_global, true) || !at.region->merge_weather) blend.cover();
        };
        each_layer(weather.layers_of(WeatherScope::kRegional, at.region->region_id), at.weight, height_m,
                   cover, add);
    }
    blend.cover();
    for (const CarriedWeather& on_entity : carried)
        add(*on_entity.weather, on_entity.weight);
    blend.cover();
    return blend.touched() ? air_of(base, blend.values()) : base;
}

Aerosols aerosols_at(const WeatherStore& weather, const RegionsAt& regions, double height_m) noexcept {
    struct OfLayer {
        Blend<1> blend{{0.0}, {Together::kMean}};
        bool over_global = false;
    };
    std::array<OfLayer, 256> of{};
    each_layer(
        weather.layers_of(WeatherScope::kGlobal, 0), 1.0, height_m, [] {},
        [&](const WeatherControl& layer, double weight) {
            of[layer.layer_id].blend.add(weight, {static_cast<double>(layer.aerosol)});
        });
    for (const RegionAt& at : regions) {
        each_layer(
            weather.layers_of(WeatherScope::kRegional, at.region->region_id), at.weight, height_m, [] {},
            [&](const WeatherControl& layer, double weight) {
                OfLayer& here = of[layer.layer_id];
                if (!std::exchange(here.over_global, true) || !at.region->merge_aerosol) here.blend.cover();
                here.blend.add(weight, {static_cast<double>(layer.aerosol)});
            });
    }
    Aerosols aerosols;
    for (std::size_t id = 0; id < of.size(); ++id) {
        of[id].blend.cover();
        aerosols.layers[id] = {of[id].blend.touched(), of[id].blend.values()[0]};
    }
    return aerosols;
}

SeaState sea_at(const SurfaceStore& surfaces, const RegionsAt& regions) noexcept {
    const SeaState calm;
    Blend<4> blend({calm.height_m, calm.temperature_c, calm.clarity_pct, calm.whitecaps},
                   {Together::kMean, Together::kMean, Together::kMean, Together::kMean});
    const auto add = [&blend](double weight, const MaritimeSurfaceControl& sea) {
        blend.add(weight,
                  {static_cast<double>(sea.sea_surface_height), static_cast<double>(sea.water_temperature),
                   static_cast<double>(sea.clarity), sea.whitecap_enable ? 1.0 : 0.0});
    };
    if (const MaritimeSurfaceControl* sea = surfaces.sea(WeatherScope::kGlobal, 0)) add(1.0, *sea);
    bool over_global = false;
    for (const RegionAt& at : regions) {
        const MaritimeSurfaceControl* sea = surfaces.sea(WeatherScope::kRegional, at.region->region_id);
        if (sea == nullptr) continue;
        if (!std::exchange(over_global, true) || !at.region->merge_maritime) blend.cover();
        add(at.weight, *sea);
    }
    blend.cover();
    return {blend.values()[0], blend.values()[1], blend.values()[2], blend.values()[3]};
}

SeaState sea_below(const WeatherStore& weather, const SurfaceStore& surfaces,
                   const ephemeris::Geodetic& point) noexcept {
    if (!surfaces.has_regional_sea()) return sea_at(surfaces, {});
    return sea_at(surfaces, {weather, GroundPoint(point.latitude_deg, point.longitude_deg)});
}

WavesAt::WavesAt(const SurfaceStore& surfaces, const RegionsAt& regions) noexcept {
    const auto enabled = [](const WaveControl& wave) { return wave.wave_enable; };
    for (const WaveControl& wave : surfaces.waves(WeatherScope::kGlobal, 0))
        if (wave.wave_enable) add(wave, 1.0);
    bool over_global = false;
    for (const RegionAt& at : regions) {
        const auto here = surfaces.waves(WeatherScope::kRegional, at.region->region_id);
        if (std::none_of(here.begin(), here.end(), enabled)) continue;
        if (!std::exchange(over_global, true) || !at.region->merge_maritime) cover(at.weight);
        for (const WaveControl& wave : here)
            if (wave.wave_enable) add(wave, at.weight);
    }
}

void WavesAt::cover(double weight) noexcept {
    for (std::size_t i = 0; i < count_; ++i)
        waves_[i].weight *= 1.0 - weight;
    const auto gone = std::remove_if(waves_.begin(), waves_.begin() + static_cast<std::ptrdiff_t>(count_),
                                     [](const WaveAt& at) { return at.weight <= 0.0; });
    count_ = static_cast<std::size_t>(gone - waves_.begin());
}

void WavesAt::add(const WaveControl& wave, double weight) noexcept {
    if (count_ < kMost) {
        waves_[count_++] = {&wave, weight};
        return;
    }
    const auto height_m = [](const WaveAt& at) { return static_cast<double>(at.wave->height) * at.weight; };
    const auto lowest =
        std::min_element(waves_.begin(), waves_.end(),
                         [&height_m](const WaveAt& a, const WaveAt& b) { return height_m(a) < height_m(b); });
    const WaveAt made{&wave, weight};
    if (height_m(*lowest) < height_m(made)) *lowest = made;
}

std::optional<double> condition_cover(const SurfaceStore& surfaces, const RegionsAt& regions,
                                      std::uint16_t condition_id) noexcept {
    const auto told = [&](WeatherScope scope, std::uint16_t region_id) -> std::optional<double> {
        std::optional<double> cover;
        for (const TerrestrialSurfaceControl& condition : surfaces.conditions(scope, region_id)) {
            if (!condition.enable) continue;
            if (condition.condition_id == condition_id)
                return static_cast<double>(condition.coverage) / 100.0;
            if (condition.condition_id == kDryCondition) cover = 0.0;
        }
        return cover;
    };
    std::optional<double> cover = told(WeatherScope::kGlobal, 0);
    for (const RegionAt& at : regions) {
        if (const auto here = told(WeatherScope::kRegional, at.region->region_id)) {
            const double before = cover.value_or(0.0);
            cover = before + at.weight * (*here - before);
        }
    }
    return cover;
}

GroundConditions::GroundConditions(const SurfaceStore& surfaces, const RegionsAt& regions) noexcept {
    const auto enabled = [](const TerrestrialSurfaceControl& condition) { return condition.enable; };
    bool over_global = false;
    for (const TerrestrialSurfaceControl& condition : surfaces.conditions(WeatherScope::kGlobal, 0))
        if (condition.enable) add(condition.condition_id);
    for (const RegionAt& at : regions) {
        const auto here = surfaces.conditions(WeatherScope::kRegional, at.region->region_id);
        if (std::none_of(here.begin(), here.end(), enabled)) continue;
        if (at.weight >= 1.0 && (!std::exchange(over_global, true) || !at.region->merge_terrestrial))
            count_ = 0;
        for (const TerrestrialSurfaceControl& condition : here)
            if (condition.enable) add(condition.condition_id);
    }
    if (count_ == 0) add(0);
}

void GroundConditions::add(std::uint16_t id) noexcept {
    if (count_ < kMost && std::find(begin(), end(), id) == end()) ids_[count_++] = id;
}

}  // namespace skyig::server::world
