#include "clients/skyig/metar/json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace skyig::clients::metar {

using namespace protocol::metar;

namespace {

using Json = nlohmann::ordered_json;

double rounded(double value, int decimals) {
    const double scale = std::pow(10.0, decimals);
    return std::round(value * scale) / scale;
}

template <class T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json();
}

Json or_null(const std::string& text) {
    return text.empty() ? Json() : Json(text);
}

/// Whole metres where the report has them; rounded where it has feet or miles.
Json metres(const std::optional<double>& value, bool converted) {
    if (!value) return nullptr;
    return converted ? Json(rounded(*value, 1)) : Json(std::llround(*value));
}

Json comparison(const std::optional<double>& value, Comparison kind) {
    if (!value) return nullptr;
    switch (kind) {
        case Comparison::kEqual:
            return "eq";
        case Comparison::kBelow:
            return "lt";
        case Comparison::kAbove:
            return "gt";
        case Comparison::kAtLeast:
            break;
    }
    return "ge";
}

Json speed_mps(const std::optional<int>& speed, SpeedUnit unit) {
    return speed ? Json(rounded(metres_per_second(*speed, unit), 3)) : Json();
}

Json json_of(const Wind& wind) {
    return {{"direction_deg_true", or_null(wind.direction_deg_true)},
            {"variable", wind.variable},
            {"speed", or_null(wind.speed)},
            {"gust", or_null(wind.gust)},
            {"unit", name(wind.unit)},
            {"speed_mps", speed_mps(wind.speed, wind.unit)},
            {"gust_mps", speed_mps(wind.gust, wind.unit)},
            {"var_from_deg", or_null(wind.var_from_deg)},
            {"var_to_deg", or_null(wind.var_to_deg)}};
}

Json json_of(const Visibility& visibility) {
    const auto& direction = visibility.minimum_direction_deg;
    return {{"meters", metres(visibility.prevailing_m, visibility.in_miles)},
            {"comparison", comparison(visibility.prevailing_m, visibility.comparison)},
            {"unit", visibility.in_miles ? "SM" : "m"},
            {"minimum_m", metres(visibility.minimum_m, false)},
            {"minimum_direction", direction ? Json(compass_name(*direction)) : Json()},
            {"ndv", visibility.no_directions}};
}

Json json_of(const RunwayRange& range) {
    return {{"runway", range.runway},
            {"meters", metres(range.range_m, range.in_feet)},
            {"comparison", comparison(range.range_m, range.comparison)},
            {"meters_max", metres(range.maximum_m, range.in_feet)},
            {"comparison_max", comparison(range.maximum_m, range.maximum_comparison)},
            {"trend", range.trend == 0 ? Json() : Json(std::string(1, range.trend))}};
}

Json json_of(const Weather& weather) {
    Json phenomena = Json::array();
    for (const Phenomenon phenomenon : weather.phenomena())
        phenomena.push_back(name(phenomenon));
    return {{"intensity", name(weather.intensity)},
            {"vicinity", weather.vicinity},
            {"descriptor", weather.descriptor ? Json(name(*weather.descriptor)) : Json()},
            {"phenomena", std::move(phenomena)}};
}

Json json_of(const Cloud& cloud) {
    const auto base_m = [&]() -> Json {
        if (!cloud.base_ft_agl) return nullptr;
        return rounded(*cloud.base_ft_agl * kMetresPerFoot, 2);
    };
    const auto convective = [&]() -> Json {
        if (cloud.convective == Convective::kNone) return nullptr;
        return cloud.convective == Convective::kCumulonimbus ? "CB" : "TCU";
    };
    Json json{
        {"amount", nullptr}, {"okta_min", nullptr}, {"okta_max", nullptr}, {"coverage_percent", nullptr}};
    if (cloud.amount) {
        const auto [least, most] = oktas(*cloud.amount);
        json["amount"] = name(*cloud.amount);
        json["okta_min"] = least;
        json["okta_max"] = most;
        json["coverage_percent"] = coverage_percent(*cloud.amount);
    }
    json["base_ft_agl"] = or_null(cloud.base_ft_agl);
    json["base_m_agl"] = base_m();
    json["convective"] = convective();
    return json;
}

template <class T>
Json list_of(const std::vector<T>& values) {
    Json list = Json::array();
    for (const T& value : values)
        list.push_back(json_of(value));
    return list;
}

Json type_name(ReportType type) {
    if (type == ReportType::kNone) return nullptr;
    return type == ReportType::kMetar ? "METAR" : "SPECI";
}

Json qnh(const std::optional<Pressure>& pressure) {
    if (!pressure) return nullptr;
    return pressure->in_inches ? Json(rounded(pressure->qnh_hpa, 2)) : Json(std::llround(pressure->qnh_hpa));
}

void add_header(Json& json, const Report& report) {
    json["raw"] = report.raw;
    json["valid"] = report.valid();
    json["type"] = type_name(report.type);
    json["station"] = or_null(report.station);
    json["day"] = or_null(report.day);
    json["hour"] = or_null(report.hour);
    json["minute"] = or_null(report.minute);
    json["auto"] = report.automatic;
    json["corrected"] = report.corrected;
    json["nil"] = report.nil;
}

}  // namespace

std::string problems_text(const Report& report) {
    std::string text;
    for (const Problem& problem : report.problems) {
        if (!text.empty()) text += "; ";
        text += describe(problem);
    }
    return text;
}

std::string to_json(const Report& report) {
    Json json;
    add_header(json, report);
    json["wind"] = report.wind ? json_of(*report.wind) : Json();
    json["cavok"] = report.cavok;
    json["visibility"] = report.visibility ? json_of(*report.visibility) : Json();
    json["rvr"] = list_of(report.runway_ranges);
    json["weather"] = list_of(report.weather);
    json["recent"] = list_of(report.recent);
    json["clouds"] = list_of(report.clouds);
    json["clear_code"] = report.clear_code ? Json(name(*report.clear_code)) : Json();
    json["vertical_visibility_ft"] = or_null(report.vertical_visibility_ft);
    json["sky_obscured"] = report.obscured;
    json["error"] = or_null(problems_text(report));
    json["temperature_c"] = or_null(report.temperature_c);
    json["dewpoint_c"] = or_null(report.dewpoint_c);
    json["qnh_hpa"] = qnh(report.pressure);
    json["trend"] = or_null(report.trend);
    json["remarks"] = or_null(report.remarks);
    json["unparsed"] = report.unparsed;
    // A report is octets; what is no UTF-8 among them becomes U+FFFD.
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace skyig::clients::metar
