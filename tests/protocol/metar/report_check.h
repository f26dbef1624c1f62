// What every decoded report keeps, whatever the text was; for the mutation test and the fuzzing entry.
#pragma once

#include <optional>
#include <string>

#include "protocol/metar/report.h"

namespace skyig::tests {

template <class T>
[[nodiscard]] bool within(const std::optional<T>& value, double least, double most) {
    return !value || (*value >= least && *value <= most);
}

/// The first promise of protocol/metar/report.h that `report` breaks, or nothing.
[[nodiscard]] inline std::string broken_promise(const protocol::metar::Report& report) {
    if (!within(report.day, 1, 31) || !within(report.hour, 0, 23) || !within(report.minute, 0, 59))
        return "time";
    if (report.day.has_value() != report.minute.has_value()) return "half a time";
    if (!report.station.empty() && report.station.size() != 4) return "station";
    if (report.wind) {
        const auto& wind = *report.wind;
        if (!within(wind.direction_deg_true, 0, 360) || !within(wind.var_from_deg, 0, 360) ||
            !within(wind.var_to_deg, 0, 360) || !within(wind.speed, 0, 999) || !within(wind.gust, 0, 999))
            return "wind";
    }
    if (report.visibility) {
        const auto& visibility = *report.visibility;
        if (!within(visibility.prevailing_m, 0, 1.7e6) || !within(visibility.minimum_m, 1, 10'000) ||
            !within(visibility.minimum_direction_deg, 0, 315))
            return "visibility";
        if (visibility.minimum_m.has_value() != visibility.minimum_direction_deg.has_value())
            return "minimum";
        if (!visibility.prevailing_m && !visibility.minimum_m) return "empty visibility";
    }
    for (const auto& range : report.runway_ranges)
        if (range.runway.size() < 2 || !within(range.range_m, 0, 9999) || !within(range.maximum_m, 0, 9999))
            return "runway range";
    for (const auto* list : {&report.weather, &report.recent})
        for (const auto& weather : *list)
            if (weather.phenomenon_count == 0 && !weather.descriptor) return "empty weather";
    for (const auto& cloud : report.clouds)
        if (!within(cloud.base_ft_agl, 0, 99'900)) return "cloud";
    if (!within(report.temperature_c, -99, 99) || !within(report.dewpoint_c, -99, 99)) return "temperature";
    if (report.pressure && !(report.pressure->qnh_hpa >= 850.0 && report.pressure->qnh_hpa <= 1100.0))
        return "pressure";
    if (report.vertical_visibility_ft && !report.obscured) return "vertical visibility";
    for (const auto& problem : report.problems)
        if (protocol::metar::describe(problem).size() < protocol::metar::fault_text(problem.fault).size() ||
            protocol::metar::fault_text(problem.fault).empty())
            return "problem without words";
    return "";
}

}  // namespace skyig::tests
