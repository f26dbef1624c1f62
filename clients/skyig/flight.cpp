#include "clients/skyig/flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <utility>

#include "clients/csv.h"

namespace skyig::clients {

namespace {

struct Column {
    std::string_view name;
    std::string_view other_name;
    double FlightPoint::*member;
    double lowest;
    double highest;
};

constexpr std::array<Column, 7> kColumns{{
    {"t_s", "t_s", &FlightPoint::time_s, -1e9, 1e9},
    {"lat_deg", "latitude_deg", &FlightPoint::latitude_deg, -90.0, 90.0},
    {"lon_deg", "longitude_deg", &FlightPoint::longitude_deg, -360.0, 360.0},
    {"alt_msl_m", "alt_m", &FlightPoint::altitude_m, -1000.0, 1e8},
    {"yaw_deg", "heading_deg", &FlightPoint::yaw_deg, -360.0, 360.0},
    {"pitch_deg", "pitch_deg", &FlightPoint::pitch_deg, -360.0, 360.0},
    {"roll_deg", "roll_deg", &FlightPoint::roll_deg, -360.0, 360.0},
}};

/// Where each of kColumns stands in the file's rows.
struct Header {
    std::array<std::size_t, kColumns.size()> field{};
    std::size_t field_count = 0;
};

std::optional<Header> read_header(const std::vector<std::string>& names, std::string& what) {
    Header header;
    header.field_count = names.size();
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
        const auto found = std::find_if(names.begin(), names.end(), [i](std::string_view name) {
            return name == kColumns[i].name || name == kColumns[i].other_name;
        });
        if (found == names.end()) {
            what = fmt::format("the header lacks the column '{}'", kColumns[i].name);
            return std::nullopt;
        }
        header.field[i] = static_cast<std::size_t>(found - names.begin());
    }
    return header;
}

std::optional<FlightPoint> read_row(const std::vector<std::string>& fields, const Header& header,
                                    std::string& what) {
    if (fields.size() != header.field_count) {
        what = fmt::format("{} fields where the header has {}", fields.size(), header.field_count);
        return std::nullopt;
    }
    FlightPoint point;
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
        const Column& column = kColumns[i];
        const std::string_view text = fields[header.field[i]];
        const std::optional<double> value = parse_number(text);
        if (!value) {
            what = fmt::format("{} is '{}', which is no number", column.name, text);
            return std::nullopt;
        }
        if (*value < column.lowest || *value > column.highest) {
            what = fmt::format("{} is {}, outside {:g} to {:g}", column.name, text, column.lowest,
                               column.highest);
            return std::nullopt;
        }
        point.*column.member = *value;
    }
    return point;
}

/// The short way round from a to b, in degrees; `centre` is the middle of the turn the result lies in.
double on_the_circle(double a_deg, double b_deg, double fraction, double centre_deg) {
    const double angle = a_deg + fraction * std::remainder(b_deg - a_deg, 360.0);
    return centre_deg + std::remainder(angle - centre_deg, 360.0);
}

double yaw_on_the_circle(double a_deg, double b_deg, double fraction) {
    const double yaw = on_the_circle(a_deg, b_deg, fraction, 180.0);
    return yaw >= 360.0 ? 0.0 : yaw;
}

FlightPoint between(const FlightPoint& a, const FlightPoint& b, double fraction) {
    const auto straight = [fraction](double from, double to) { return from + fraction * (to - from); };
    FlightPoint point;
    point.time_s = straight(a.time_s, b.time_s);
    point.latitude_deg = straight(a.latitude_deg, b.latitude_deg);
    point.longitude_deg = on_the_circle(a.longitude_deg, b.longitude_deg, fraction, 0.0);
    point.altitude_m = straight(a.altitude_m, b.altitude_m);
    point.yaw_deg = yaw_on_the_circle(a.yaw_deg, b.yaw_deg, fraction);
    point.pitch_deg = on_the_circle(a.pitch_deg, b.pitch_deg, fraction, 0.0);
    point.roll_deg = on_the_circle(a.roll_deg, b.roll_deg, fraction, 0.0);
    return point;
}

}  // namespace

Flight::Flight(std::vector<FlightPoint> points) : points_(std::move(points)) {}

FlightPoint Flight::at(double time_s) const noexcept {
    const auto after = std::upper_bound(points_.begin(), points_.end(), time_s,
                                        [](double t, const FlightPoint& point) { return t < point.time_s; });
    if (after == points_.begin()) return between(points_.front(), points_.front(), 0.0);
    const FlightPoint& a = *(after - 1);
    if (after == points_.end()) return between(a, a, 0.0);
    return between(a, *after, (time_s - a.time_s) / (after->time_s - a.time_s));
}

std::optional<Flight> read_flight(std::istream& text, std::string_view name, std::string& error) {
    CsvReader reader(text);
    std::string what;
    std::optional<Header> header;
    std::vector<FlightPoint> points;
    const auto refuse = [&] {
        error = fmt::format("{}:{}: {}", name, reader.line(), what);
        return std::nullopt;
    };
    while (const std::optional<CsvRecord> record = reader.next()) {
        if (record->too_long || !record->well_formed) {
            what = "the line is too long or a quote in it is not closed";
            return refuse();
        }
        if (!header) {
            header = read_header(record->fields, what);
            if (!header) return refuse();
            continue;
        }
        const std::optional<FlightPoint> point = read_row(record->fields, *header, what);
        if (!point) return refuse();
        if (!points.empty() && point->time_s <= points.back().time_s) {
            what = fmt::format("t_s is {}, not after the {} of the row before", point->time_s,
                               points.back().time_s);
            return refuse();
        }
        points.push_back(*point);
    }
    if (reader.failed()) {
        what = "cannot be read any further";
        return refuse();
    }
    if (points.empty()) {
        what = header ? "no rows under the header" : "no header line and no rows";
        return refuse();
    }
    return Flight(std::move(points));
}

std::optional<Flight> load_flight(const std::string& path, std::string& error) {
    std::ifstream file(path);
    if (!file) {
        error = fmt::format("{}: cannot be opened for reading", path);
        return std::nullopt;
    }
    return read_flight(file, path, error);
}

}  // namespace skyig::clients
