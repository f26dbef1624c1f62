#include "server/bus_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <stdexcept>
#include <string>

namespace skyig::server {

namespace can = protocol::canaerospace;
namespace cigi = protocol::cigi;
using can::Parameter;

namespace {

constexpr double kNsToSeconds = 1e-9;
constexpr double kZeroCelsius_k = 273.15;
constexpr double kDegPerRad = 180.0 / std::numbers::pi;

/// "proposed: cloud layer # base" is cloud_layer_base, "GPS latitude" is gps_latitude.
std::string settings_name(std::string_view name) {
    constexpr std::string_view kProposed = "proposed: ";
    if (name.substr(0, kProposed.size()) == kProposed) name.remove_prefix(kProposed.size());
    std::string text;
    for (const char c : name.substr(0, name.find(" ("))) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
            text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        } else if (!text.empty() && text.back() != '_') {
            text += '_';
        }
    }
    return text;
}

/// CIGI names three cloud layers; the others are the image generator's own.
std::uint8_t layer_id(std::size_t layer) noexcept {
    constexpr std::size_t kNamedLayers = 3;
    constexpr std::size_t kFirstOwn = 10;
    return static_cast<std::uint8_t>(layer < kNamedLayers ? layer + 1 : kFirstOwn + layer);
}

float as_float(double value) noexcept {
    return static_cast<float>(value);
}

}  // namespace

can::IdentifierMap identifier_map(const config::Source& source) {
    can::IdentifierMap map = can::default_identifier_map();
    map.conventions.bcd = source.bcd_time;
    map.conventions.month_base = static_cast<std::uint8_t>(source.month_base);
    for (const auto& [name, id] : source.identifiers) {
        const auto entry = std::find_if(map.entries.begin(), map.entries.end(),
                                        [&name](const auto& one) { return settings_name(one.name) == name; });
        if (entry == map.entries.end()) {
            throw std::runtime_error(
                fmt::format("source {}: identifiers.{}: no parameter has this name; names are such as "
                            "gps_latitude, true_heading, visibility (skyig decode --can shows them)",
                            source.name, name));
        }
        entry->id = static_cast<std::uint16_t>(id);
    }
    if (const std::string fault = can::check(map); !fault.empty())
        throw std::runtime_error(fmt::format("source {}: identifiers: {}", source.name, fault));
    return map;
}

std::string identifier_fault(const config::Config& config) {
    for (const config::Source& source : config.sources) {
        if (source.kind != config::SourceKind::kCanAerospace) continue;
        try {
            (void)identifier_map(source);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
    }
    return {};
}

BusInput::BusInput(std::size_t source, const can::IdentifierMap& map, world::World& world)
    : source_(source), world_(world), receiver_(map) {}

void BusInput::take(const protocol::CanFrame& frame) {
    const can::Reception reception = receiver_.receive(frame);
    // Frames that mean nothing to us still tell that the bus lives; its error frames do not.
    if (!frame.error) world_.heard(source_);
    if (!reception.published) return;
    keep(reception.update);
    const std::int64_t now_ns = reception.update.received_ns;
    switch (receiver_.map()[reception.update.parameter].group) {
        case can::Group::kPosition:
            report_place(now_ns);
            report_velocity(now_ns);
            break;
        case can::Group::kAttitude:
            report_attitude(now_ns);
            break;
        case can::Group::kTime:
            report_time(now_ns);
            break;
        case can::Group::kWeather:
            if (reception.update.parameter != Parameter::kCommit) break;
            report_air();
            report_layers();
            break;
        default:
            break;
    }
}

void BusInput::keep(const can::Update& update) {
    kept_[can::index_of(update.parameter)] = {update.value, update.received_ns, true, true};
}

std::optional<double> BusInput::fresh(Parameter parameter, std::int64_t now_ns) const {
    const Kept& kept = kept_[can::index_of(parameter)];
    if (!kept.known || receiver_.is_stale(parameter, now_ns)) return std::nullopt;
    return kept.value;
}

/// True once all of them have come anew; they are then old.
bool BusInput::take_new(std::initializer_list<Parameter> parameters) {
    const bool all = std::all_of(parameters.begin(), parameters.end(), [this](Parameter parameter) {
        return kept_[can::index_of(parameter)].is_new;
    });
    if (!all) return false;
    for (const Parameter parameter : parameters)
        kept_[can::index_of(parameter)].is_new = false;
    return true;
}

std::optional<double> BusInput::height_m(Parameter of_source, std::int64_t now_ns) const {
    for (const Parameter parameter : {of_source, Parameter::kTrueAltitude, Parameter::kBaroCorrectedAltitude,
                                      Parameter::kStandardAltitude}) {
        if (const auto height = fresh(parameter, now_ns)) return height;
    }
    return std::nullopt;
}

void BusInput::report_place(std::int64_t now_ns) {
    struct Fix {
        Parameter latitude;
        Parameter longitude;
        Parameter height;
    };
    constexpr std::array kFixes{
        Fix{Parameter::kInsLatitude, Parameter::kInsLongitude, Parameter::kInsHeight},
        Fix{Parameter::kGpsLatitude, Parameter::kGpsLongitude, Parameter::kGpsHeight},
        Fix{Parameter::kAuxiliaryLatitude, Parameter::kAuxiliaryLongitude, Parameter::kAuxiliaryHeight}};
    for (const Fix& fix : kFixes) {
        const auto latitude = fresh(fix.latitude, now_ns);
        const auto longitude = fresh(fix.longitude, now_ns);
        if (!latitude || !longitude) continue;
        if (!take_new({fix.latitude, fix.longitude})) return;
        const auto height = height_m(fix.height, now_ns);
        world::OwnshipReport report;
        report.position = {*latitude, std::remainder(*longitude, 360.0),
                           height.value_or(world_.ownship().position.height_m)};
        report.sender_s = static_cast<double>(now_ns) * kNsToSeconds;
        world_.report(source_, report);
        return;
    }
}

void BusInput::report_velocity(std::int64_t now_ns) {
    const auto east = fresh(Parameter::kTrueEastVelocity, now_ns);
    const auto north = fresh(Parameter::kTrueNorthVelocity, now_ns);
    if (!east || !north || !take_new({Parameter::kTrueEastVelocity, Parameter::kTrueNorthVelocity})) return;
    world::OwnshipReport report;
    report.velocity_enu_m_s = {*east, *north, fresh(Parameter::kTrueUpVelocity, now_ns).value_or(0.0)};
    world_.report(source_, report);
}

std::optional<double> BusInput::true_heading_deg(std::int64_t now_ns, Parameter& taken) const {
    for (const Parameter parameter : {Parameter::kTrueHeading, Parameter::kHeadingAngle}) {
        taken = parameter;
        if (const auto heading = fresh(parameter, now_ns)) return heading;
    }
    taken = Parameter::kMagneticHeading;
    const auto magnetic = fresh(Parameter::kMagneticHeading, now_ns);
    if (!magnetic) return std::nullopt;
    // East is positive; a bus that tells none has none.
    return *magnetic + fresh(Parameter::kMagneticVariation, now_ns).value_or(0.0);
}

void BusInput::report_attitude(std::int64_t now_ns) {
    const auto pitch = fresh(Parameter::kBodyPitchAngle, now_ns);
    const auto roll = fresh(Parameter::kBodyRollAngle, now_ns);
    Parameter heading_from{};
    const auto heading = true_heading_deg(now_ns, heading_from);
    if (!pitch || !roll || !heading ||
        !take_new({Parameter::kBodyPitchAngle, Parameter::kBodyRollAngle, heading_from})) {
        return;
    }
    world::OwnshipReport report;
    report.yaw_deg = heading;
    report.pitch_deg = pitch;
    report.roll_deg = roll;
    report.sender_s = static_cast<double>(now_ns) * kNsToSeconds;
    world_.report(source_, report);
}

void BusInput::report_time(std::int64_t now_ns) {
    const auto time = receiver_.clock().at(now_ns);
    if (!time) return;
    ephemeris::UtcClockTime utc = ephemeris::UtcClockTime::from_unix(time->day * 86400);
    utc.advance(time->second_of_day);
    world_.report_time(source_, utc, receiver_.clock().rate());
}

void BusInput::report_air() {
    const can::WeatherStage& weather = receiver_.weather();
    world::AirReport report;
    report.visibility_m = weather.applied(Parameter::kVisibility);
    report.humidity_pct = weather.applied(Parameter::kRelativeHumidity);
    report.pressure_hpa = weather.applied(Parameter::kSurfacePressure);
    if (const auto temperature_k = weather.applied(Parameter::kSurfaceTemperature))
        report.temperature_c = *temperature_k - kZeroCelsius_k;
    world_.report(source_, report);
}

void BusInput::report_layers() {
    const can::WeatherStage& weather = receiver_.weather();
    for (std::size_t i = 0; i < can::kCloudLayers; ++i) {
        const auto layer = static_cast<std::uint8_t>(i);
        const bool drawn = weather.is_drawable(layer);
        if (!drawn && !shown_[i]) continue;
        shown_[i] = drawn;
        const auto value = [&weather, layer](Parameter parameter, double otherwise) {
            return weather.applied(parameter, layer).value_or(otherwise);
        };
        cigi::WeatherControl control;
        control.layer_id = layer_id(i);
        control.weather_enable = drawn;
        control.cloud_type = static_cast<cigi::CloudType>(value(Parameter::kLayerType, 0.0));
        const double base_m = value(Parameter::kLayerBase, 0.0);
        control.base_elevation = as_float(base_m);
        control.thickness = as_float(std::max(value(Parameter::kLayerTop, base_m) - base_m, 0.0));
        control.coverage = as_float(100.0 * value(Parameter::kLayerCoverage, 0.0));
        control.transition_band = as_float(value(Parameter::kLayerTransition, 0.0));
        control.top_transition_band = control.transition_band;
        // The range at which as much of the contrast is left as the air's own visibility means.
        const double extinction_km = value(Parameter::kLayerDensity, 0.0);
        if (extinction_km > 0.0)
            control.visibility =
                as_float(-1000.0 * std::log(world_.air().visibility_contrast) / extinction_km);
        const double east = value(Parameter::kLayerWindEast, 0.0);
        const double north = value(Parameter::kLayerWindNorth, 0.0);
        control.wind_horizontal = as_float(std::hypot(east, north));
        if (east != 0.0 || north != 0.0)
            control.wind_direction = as_float(std::atan2(-east, -north) * kDegPerRad);
        world_.report(source_, control);
    }
}

}  // namespace skyig::server
