#include "server/weather/told_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/cloud/field/shapes.h"
#include "render/precipitation/extinction.h"
#include "server/start_weather/genus.h"
#include "server/start_weather/layers.h"
#include "server/start_weather/precipitation.h"
#include "server/world/weather_limits.h"

namespace skyig::server::weather {
namespace {

using protocol::cigi::CloudType;
using protocol::cigi::WeatherControl;
using protocol::cigi::WeatherScope;
using render::CloudGenus;
using render::Obscurant;
using render::Precipitation;

/// The densest that is drawn: a visibility of 5 m at 5 % contrast.
constexpr double kDensest_per_m = 0.6;

static_assert(static_cast<int>(CloudType::kAltocumulus) == static_cast<int>(CloudGenus::kAltocumulus) &&
                  static_cast<int>(CloudType::kStratus) == static_cast<int>(CloudGenus::kStratus),
              "one order of genera in packets and scene");

struct Kind {
    Family family = Family::kCloud;
    std::uint8_t number = 0;
};

template <class E>
constexpr Kind kind(Family family, E value) noexcept {
    return {family, static_cast<std::uint8_t>(value)};
}

std::optional<Kind> cloud_kind(const WeatherControl& control, const Meaning& meaning) noexcept {
    const auto type = static_cast<int>(control.cloud_type);
    if (type >= static_cast<int>(CloudGenus::kAltocumulus) && type <= static_cast<int>(CloudGenus::kStratus))
        return kind(Family::kCloud, control.cloud_type);
    const double base_m = static_cast<double>(control.base_elevation) - meaning.elevation_m;
    return kind(Family::kCloud,
                genus_of(likely_genus(base_m, static_cast<double>(control.coverage) / 100.0)));
}

std::optional<Kind> kind_of(const WeatherControl& control, const Meaning& meaning) noexcept {
    const bool has_type = control.cloud_type != CloudType::kNone;
    if (control.scope == WeatherScope::kEntity)
        return has_type ? cloud_kind(control, meaning) : kind(Family::kObscurant, Obscurant::Kind::kFog);
    switch (static_cast<LayerId>(control.layer_id)) {
        case LayerId::kGroundFog:
            return kind(Family::kObscurant, Obscurant::Kind::kFog);
        case LayerId::kSand:
            return kind(Family::kObscurant, Obscurant::Kind::kSand);
        case LayerId::kDust:
            return kind(Family::kObscurant, Obscurant::Kind::kDust);
        case LayerId::kRain:
            return kind(Family::kFalling, Precipitation::Kind::kRain);
        case LayerId::kSnow:
            return kind(Family::kFalling, Precipitation::Kind::kSnow);
        case LayerId::kSleet:
            return kind(Family::kFalling, Precipitation::Kind::kSleet);
        case LayerId::kHail:
            return kind(Family::kFalling, Precipitation::Kind::kHail);
        case LayerId::kDrizzle:
            if (!has_type) return kind(Family::kFalling, Precipitation::Kind::kDrizzle);
            break;
        case LayerId::kSmoke:
            if (!has_type) return kind(Family::kObscurant, Obscurant::Kind::kSmoke);
            break;
        case LayerId::kHaze:
            if (!has_type) return kind(Family::kObscurant, Obscurant::Kind::kHaze);
            break;
        default:
            break;
    }
    // An own layer without a cloud type could be anything.
    if (!has_type && control.layer_id > static_cast<std::uint8_t>(LayerId::kCloud3)) return std::nullopt;
    return cloud_kind(control, meaning);
}

/// Mass extinction of what floats, m2/g, visible light: mineral dust of a few micrometres, blown sand of 100,
/// wood smoke, fog droplets of 7.
double extinction_m2_g(std::uint8_t obscurant) noexcept {
    switch (static_cast<Obscurant::Kind>(obscurant)) {
        case Obscurant::Kind::kDust:
        case Obscurant::Kind::kHaze:
            return 0.5;
        case Obscurant::Kind::kSand:
            return 0.01;
        case Obscurant::Kind::kSmoke:
            return 4.0;
        default:
            return 0.21;
    }
}

/// By what is told of visibility; without it by genus, by what hangs in the air, or falls.
double extinction_per_m(const WeatherControl& control, const Kind& kind, const Meaning& meaning,
                        double rate_mm_h) noexcept {
    const double visibility_m = static_cast<double>(control.visibility);
    const double told = visibility_m > 0.0 ? -std::log(meaning.contrast) / visibility_m : 0.0;
    if (kind.family == Family::kCloud) {
        const double own = static_cast<double>(
            render::cloud::field::genus_of(static_cast<CloudGenus>(kind.number)).extinction_per_m);
        return told > 0.0 ? std::min(told, kDensest_per_m) : own;
    }
    if (told > 0.0) return std::clamp(told - meaning.air_extinction_per_m, 0.0, kDensest_per_m);
    if (kind.family == Family::kFalling) {
        return render::precipitation::extinction_per_m(static_cast<Precipitation::Kind>(kind.number),
                                                       rate_mm_h, meaning.temperature_c);
    }
    const double hanging = static_cast<double>(control.aerosol) * extinction_m2_g(kind.number);
    return hanging > 0.0 ? std::min(hanging, kDensest_per_m) : kDensest_per_m;
}

LayerState state_of(const WeatherControl& control, const Kind& kind, const Meaning& meaning) noexcept {
    LayerState state;
    state.base_m = static_cast<double>(control.base_elevation);
    state.thickness_m = static_cast<double>(control.thickness);
    state.bottom_band_m = static_cast<double>(control.transition_band);
    state.top_band_m = static_cast<double>(control.top_transition_band);
    state.coverage = static_cast<double>(control.coverage) / 100.0;
    state.severity = std::min<double>(control.severity, 5.0) / 5.0;
    if (kind.family == Family::kFalling) {
        const double told = rate_of_water_mm_h(static_cast<double>(control.aerosol));
        const double rate = told > 0.0 ? told
                                       : rate_of_severity_mm_h(static_cast<Precipitation::Kind>(kind.number),
                                                               control.severity);
        state.rate_mm_h = rate * state.coverage;
    }
    state.extinction_per_m = extinction_per_m(control, kind, meaning, state.rate_mm_h);
    if (kind.family == Family::kCloud) {
        if (control.scud_enable) state.bottom_scud = static_cast<double>(control.scud_frequency) / 100.0;
        if (control.top_scud_enable) state.top_scud = static_cast<double>(control.top_scud_frequency) / 100.0;
        constexpr std::array<double, 6> kFlashes{1.0, 2.0, 4.0, 6.0, 10.0, 15.0};
        if (control.random_lightning)
            state.flashes_per_min = kFlashes[std::min<std::size_t>(control.severity, kFlashes.size() - 1)];
    }
    return state;
}

}  // namespace

render::CloudGenus genus_of(config::LayerType type) noexcept {
    return static_cast<CloudGenus>(static_cast<int>(type) -
                                   static_cast<int>(config::LayerType::kAltocumulus) +
                                   static_cast<int>(CloudGenus::kAltocumulus));
}

glm::dvec2 wind_towards_m_s(double speed_m_s, double from_deg) noexcept {
    const double from_rad = from_deg * std::numbers::pi / 180.0;
    return -speed_m_s * glm::dvec2{std::sin(from_rad), std::cos(from_rad)};
}

std::optional<ToldLayer> told_layer(const WeatherControl& control, const Meaning& meaning,
                                    std::optional<double> carrier_m) noexcept {
    const std::optional<Kind> kind = kind_of(control, meaning);
    if (!kind) return std::nullopt;
    ToldLayer told;
    told.state = state_of(control, *kind, meaning);
    if (carrier_m) {
        // Full at the entity, nothing at the radius, as far as a layer's shape can say so.
        const double radius_m =
            std::min(static_cast<double>(control.transition_band), world::kThickestLayer_m);
        told.state.base_m = *carrier_m - 0.5 * radius_m;
        told.state.thickness_m = radius_m;
        told.state.bottom_band_m = told.state.top_band_m = 0.5 * radius_m;
    }
    if (!(told.state.thickness_m > 0.0) || !(told.state.coverage > 0.0)) return std::nullopt;
    const bool global = control.scope == WeatherScope::kGlobal;
    const bool entity = control.scope == WeatherScope::kEntity;
    told.key = {(static_cast<std::uint32_t>(control.scope) << 24U) |
                    (static_cast<std::uint32_t>(global ? 0 : control.entity_region_id) << 8U) |
                    static_cast<std::uint32_t>(entity ? 0 : control.layer_id),
                kind->family, kind->number};
    if (control.wind_horizontal > 0.0F)
        told.wind_m_s = wind_towards_m_s(static_cast<double>(control.wind_horizontal),
                                         static_cast<double>(control.wind_direction));
    return told;
}

}  // namespace skyig::server::weather
