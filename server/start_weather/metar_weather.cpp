#include "server/start_weather/metar_weather.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "render/precipitation/extinction.h"
#include "server/start_weather/genus.h"
#include "server/start_weather/precipitation.h"

namespace skyig::server {
namespace {

using config::LayerType;
using config::WeatherLayer;
using Kind = render::Precipitation::Kind;
namespace metar = protocol::metar;
using metar::Descriptor;
using metar::Phenomenon;

/// -ln(0.05): reports use the meteorological optical range.
const double kMor = -std::log(0.05);
/// The most that layers take of what dims the view, where the air before was hazier than the report tells:
/// the rest is haze, so that its visibility stays a number.
constexpr double kMostOfLayer = 0.9;
constexpr double kTopWithoutCloud_m = 1500.0;

double optical_m(double extinction_per_m, const config::Air& air) {
    return -std::log(air.visibility_contrast) / extinction_per_m;
}

/// Magnus, relative humidity from temperature and dew point, degrees Celsius, %.
double humidity_pct(double temperature_c, double dewpoint_c) {
    const auto exponent = [](double t) { return 17.625 * t / (243.04 + t); };
    return std::clamp(100.0 * std::exp(exponent(dewpoint_c) - exponent(temperature_c)), 0.0, 100.0);
}

/// Those whose cloud groups tell the sum of all layers up to theirs.
bool tells_sums(std::string_view station) {
    return station.starts_with("K") || station.starts_with("PA") || station.starts_with("PH");
}

bool is_there(const metar::Weather& weather, Descriptor descriptor) {
    return weather.descriptor == descriptor;
}

class Reading {
  public:
    Reading(const metar::Report& report, const config::Air& before) : report_(report) { made_.air = before; }

    MetarWeather read() {
        read_air();
        read_clouds();
        read_extinction();
        read_vertical();
        for (const metar::Weather& weather : report_.weather)
            read_weather(weather);
        settle_air();
        return std::move(made_);
    }

  private:
    void read_air() {
        config::Air& air = made_.air;
        if (report_.wind && report_.wind->speed) {
            air.wind_m_s = std::min(metar::metres_per_second(*report_.wind->speed, report_.wind->unit), 60.0);
            if (report_.wind->direction_deg_true)
                air.wind_from_deg = static_cast<double>(*report_.wind->direction_deg_true);
        }
        if (report_.temperature_c) air.temperature_c = *report_.temperature_c;
        if (report_.temperature_c && report_.dewpoint_c)
            air.humidity_pct = humidity_pct(*report_.temperature_c, *report_.dewpoint_c);
        if (report_.pressure) air.pressure_hpa = report_.pressure->qnh_hpa;
    }

    void read_extinction() {
        const config::Air& air = made_.air;
        const double before = -std::log(air.visibility_contrast) / air.visibility_m;
        extinction_per_m_ = before;
        const auto visibility_m = [this]() -> std::optional<double> {
            if (report_.cavok) return 10'000.0;
            if (!report_.visibility) return std::nullopt;
            return report_.visibility->prevailing_m ? report_.visibility->prevailing_m
                                                    : report_.visibility->minimum_m;
        }();
        if (!visibility_m) return;
        const double told = kMor / std::max(*visibility_m, 10.0);
        const bool or_more =
            report_.cavok ||
            (report_.visibility && (report_.visibility->comparison == metar::Comparison::kAtLeast ||
                                    report_.visibility->comparison == metar::Comparison::kAbove));
        // Haze that was there before stays: what falls never clears the air.
        left_per_m_ = told > before ? told - before : kMostOfLayer * told;
        beside_air_ = or_more && told > before;
        if (!beside_air_) extinction_per_m_ = told;
    }

    void read_clouds() {
        double below = 0.0;
        for (const metar::Cloud& cloud : report_.clouds) {
            const double oktas = cloud.amount ? metar::coverage_percent(*cloud.amount) / 12.5 : 2.0;
            double own = oktas / 8.0;
            if (tells_sums(report_.station)) {
                own = below < 8.0 ? std::max(oktas - below, 0.0) / (8.0 - below) : 0.0;
                below = std::max(below, oktas);
            }
            const auto base_m = base_of(cloud);
            if (own > 0.0 && base_m) made_.layers.push_back(layer_of(cloud, *base_m, own));
        }
    }

    /// Without a told base that of cumulus, where it is one: 125 m a degree of dew point spread (Espy).
    [[nodiscard]] std::optional<double> base_of(const metar::Cloud& cloud) const {
        if (cloud.base_ft_agl) return *cloud.base_ft_agl * metar::kMetresPerFoot;
        if (cloud.convective == metar::Convective::kNone || !report_.temperature_c || !report_.dewpoint_c)
            return std::nullopt;
        return std::max(125.0 * (*report_.temperature_c - *report_.dewpoint_c), 100.0);
    }

    static WeatherLayer layer_of(const metar::Cloud& cloud, double base_m, double coverage) {
        WeatherLayer layer;
        layer.base_m = base_m;
        layer.coverage = coverage;
        layer.bottom_band_m = layer.top_band_m = 30.0;
        layer.type = likely_genus(base_m, coverage);
        if (cloud.amount) layer.type = likely_genus(base_m, metar::coverage_percent(*cloud.amount) / 100.0);
        if (cloud.convective == metar::Convective::kCumulonimbus) layer.type = LayerType::kCumulonimbus;
        if (cloud.convective == metar::Convective::kToweringCumulus) layer.type = LayerType::kCumulus;
        layer.thickness_m =
            cloud.convective == metar::Convective::kToweringCumulus ? 3000.0 : usual_thickness_m(layer.type);
        if (layer.type == LayerType::kCumulonimbus) layer.severity = 2;
        return layer;
    }

    /// The sky is obscured: fog up to the vertical visibility, three optical depths deep.
    void read_vertical() {
        if (!report_.vertical_visibility_ft) return;
        const double height_m = std::max(*report_.vertical_visibility_ft, 50) * metar::kMetresPerFoot;
        WeatherLayer& fog = add_ground(LayerType::kFog, height_m);
        fog.visibility_m = optical_m(3.0 / height_m, made_.air);
    }

    void read_weather(const metar::Weather& weather) {
        if (is_there(weather, Descriptor::kThunderstorm)) add_lightning();
        if (weather.vicinity) return;
        for (const Phenomenon phenomenon : weather.phenomena())
            read_phenomenon(weather, phenomenon);
    }

    void read_phenomenon(const metar::Weather& weather, Phenomenon phenomenon) {
        // Snow that the wind has taken up from the ground does not fall.
        const bool lifted =
            is_there(weather, Descriptor::kBlowing) || is_there(weather, Descriptor::kDrifting);
        switch (phenomenon) {
            case Phenomenon::kDrizzle:
                return add_falling(LayerType::kDrizzle, Kind::kDrizzle, weather.intensity);
            case Phenomenon::kRain:
                return add_falling(LayerType::kRain, Kind::kRain, weather.intensity);
            case Phenomenon::kUnknownPrecipitation:
                return report_.temperature_c.value_or(10) <= 0
                           ? add_falling(LayerType::kSnow, Kind::kSnow, weather.intensity)
                           : add_falling(LayerType::kRain, Kind::kRain, weather.intensity);
            case Phenomenon::kSnow:
            case Phenomenon::kSnowGrains:
                if (!lifted) add_falling(LayerType::kSnow, Kind::kSnow, weather.intensity);
                return;
            case Phenomenon::kIcePellets:
                return add_falling(LayerType::kSleet, Kind::kSleet, weather.intensity);
            case Phenomenon::kHail:
            case Phenomenon::kSmallHail:
                return add_falling(LayerType::kHail, Kind::kHail, weather.intensity);
            case Phenomenon::kFog:
                return add_partial_fog(weather.descriptor);
            case Phenomenon::kSmoke:
            case Phenomenon::kVolcanicAsh:
                return add_lifted(LayerType::kSmoke);
            case Phenomenon::kDust:
            case Phenomenon::kDuststorm:
            case Phenomenon::kDustWhirls:
                return add_lifted(LayerType::kDust);
            case Phenomenon::kSand:
            case Phenomenon::kSandstorm:
                return add_lifted(LayerType::kSand);
            default:
                return;
        }
    }

    /// On the storm clouds; without any, on the lowest that covers most; on a cumulonimbus of four oktas at
    /// 1000 m where no cloud is told.
    void add_lightning() {
        bool struck = false;
        for (WeatherLayer& layer : made_.layers) {
            if (layer.type != LayerType::kCumulonimbus) continue;
            layer.lightning = struck = true;
        }
        if (struck) return;
        WeatherLayer* most = nullptr;
        for (WeatherLayer& layer : made_.layers)
            if (config::is_cloud(layer.type) && (most == nullptr || layer.coverage > most->coverage))
                most = &layer;
        if (most == nullptr) {
            most = &made_.layers.emplace_back();
            most->type = LayerType::kCumulonimbus;
            most->base_m = 1000.0;
            most->thickness_m = usual_thickness_m(LayerType::kCumulonimbus);
            most->bottom_band_m = most->top_band_m = 30.0;
            most->coverage = 0.5;
            most->severity = 2;
        }
        most->lightning = true;
    }

    void add_falling(LayerType type, Kind kind, metar::Intensity intensity) {
        WeatherLayer& layer = add_ground(type, falls_from_m());
        layer.severity = 1 + static_cast<int>(intensity);
        layer.rate_mm_h = rate_of_severity_mm_h(kind, layer.severity);
        // Nothing limits it: left to the rate.
        if (!left_per_m_) return;
        dim_by_last_layer(
            render::precipitation::extinction_per_m(kind, layer.rate_mm_h, made_.air.temperature_c));
    }

    /// Fog without MI, BC, PR is the reported visibility itself.
    void add_partial_fog(std::optional<Descriptor> descriptor) {
        const bool shallow = descriptor == Descriptor::kShallow;
        const bool patches = descriptor == Descriptor::kPatches;
        if (!shallow && !patches && descriptor != Descriptor::kPartial) return;
        WeatherLayer& fog = add_ground(LayerType::kFog, shallow ? 2.0 : 10.0);
        fog.coverage = patches ? 0.4 : shallow ? 1.0 : 0.5;
        fog.visibility_m = optical_m(kMor / 500.0, made_.air);
    }

    void add_lifted(LayerType type) {
        add_ground(type, kTopWithoutCloud_m);
        dim_by_last_layer(kMostOfLayer *
                          (beside_air_ ? extinction_per_m_ + *left_per_m_ : extinction_per_m_));
    }

    WeatherLayer& add_ground(LayerType type, double top_m) {
        WeatherLayer& layer = made_.layers.emplace_back();
        layer.type = type;
        layer.thickness_m = top_m - layer.base_m;
        return layer;
    }

    /// Leaves the sum at the ground as it was reported; without a report of it the air as it was.
    void dim_by_last_layer(double wanted_per_m) {
        const double taken = std::min(wanted_per_m, left_per_m_.value_or(0.0));
        if (left_per_m_) *left_per_m_ -= taken;
        if (!beside_air_) taken_per_m_ += taken;
        dimming_.push_back({made_.layers.size() - 1, taken});
    }

    /// From the lowest cloud that covers more than half of the sky, or a storm's.
    [[nodiscard]] double falls_from_m() const {
        double from_m = kTopWithoutCloud_m;
        for (const WeatherLayer& layer : made_.layers) {
            if (!config::is_cloud(layer.type)) continue;
            if (layer.coverage > 0.5 || layer.type == LayerType::kCumulonimbus)
                from_m = std::min(from_m, layer.base_m);
        }
        return from_m;
    }

    /// The air has what the layers leave over; inside one of them its own part comes on top.
    void settle_air() {
        const double air_per_m = extinction_per_m_ - taken_per_m_;
        made_.air.visibility_m = std::clamp(optical_m(air_per_m, made_.air), 10.0, 400'000.0);
        for (const auto& [index, own_per_m] : dimming_)
            made_.layers[index].visibility_m = optical_m(air_per_m + own_per_m, made_.air);
    }

    struct Dimming {
        std::size_t layer;
        double extinction_per_m;
    };

    const metar::Report& report_;
    MetarWeather made_;
    /// At the ground: in all, or of the air alone if layers come beside it.
    double extinction_per_m_ = 0.0;
    /// For layers; none where no visibility is reported.
    std::optional<double> left_per_m_;
    /// From the air by layers.
    double taken_per_m_ = 0.0;
    /// The report allows more than the air has: "10 km or more".
    bool beside_air_ = false;
    std::vector<Dimming> dimming_;
};

}  // namespace

MetarWeather metar_weather(const metar::Report& report, const config::Air& before) {
    return Reading(report, before).read();
}

}  // namespace skyig::server
