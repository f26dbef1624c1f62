#include "protocol/metar/groups.h"

#include "protocol/metar/codes.h"
#include "protocol/metar/scan.h"

namespace skyig::protocol::metar {
namespace {

/// Digits, or as many slashes. \return false if neither stands there
bool read_or_missing(Scan& scan, std::size_t least, std::size_t most, std::string_view missing,
                     std::optional<int>& out) noexcept {
    if (scan.accept(missing)) return true;
    out = scan.digits(least, most);
    return out.has_value();
}

bool read_speed(Scan& scan, std::optional<int>& speed, bool& above) noexcept {
    above = scan.accept("P");
    return read_or_missing(scan, 2, 3, "//", speed);
}

/// "M02", "15", "//"; nothing at the end counts as missing, too.
bool read_celsius(Scan& scan, std::optional<int>& out) noexcept {
    if (scan.done() || scan.accept("//")) return true;
    const bool minus = scan.accept("M");
    out = scan.digits(2);
    if (out && minus) out = -*out;
    return out.has_value();
}

bool starts_with_digit(std::string_view group) noexcept {
    return !group.empty() && is_digit(group.front());
}

}  // namespace

bool is_missing(std::string_view group) noexcept {
    for (const std::string_view suffix : {"SM", "NDV"})
        if (group.ends_with(suffix)) group.remove_suffix(suffix.size());
    return !group.empty() && all_slashes(group);
}

bool looks_like_time(std::string_view group) noexcept {
    return starts_with_digit(group) && (group.ends_with('Z') || Scan(group).digits(6).has_value());
}

std::optional<DayTime> read_time(std::string_view group) noexcept {
    Scan scan(group);
    const auto day = scan.digits(2);
    const auto hour = scan.digits(2);
    const auto minute = scan.digits(2);
    if (!day || !hour || !minute || scan.rest() != "Z") return std::nullopt;
    if (*day < 1 || *day > 31 || *hour > 23 || *minute > 59) return std::nullopt;
    return DayTime{*day, *hour, *minute};
}

bool looks_like_wind(std::string_view group) noexcept {
    if (!starts_with_digit(group) && !group.starts_with("VRB") && !group.starts_with("//")) return false;
    return std::any_of(kSpeedUnits.begin(), kSpeedUnits.end(),
                       [group](std::string_view unit) { return group.ends_with(unit); });
}

std::optional<Wind> read_wind(std::string_view group) noexcept {
    Wind wind;
    Scan scan(group);
    wind.variable = scan.accept("VRB");
    if (!wind.variable && !read_or_missing(scan, 3, 3, "///", wind.direction_deg_true)) return std::nullopt;
    if (wind.direction_deg_true.value_or(0) > 360) return std::nullopt;
    if (!read_speed(scan, wind.speed, wind.speed_above)) return std::nullopt;
    if (scan.accept("G") && !read_speed(scan, wind.gust, wind.gust_above)) return std::nullopt;
    const auto unit = find_code<SpeedUnit>(kSpeedUnits, scan.rest());
    if (!unit) return std::nullopt;
    wind.unit = *unit;
    return wind;
}

bool looks_like_variation(std::string_view group) noexcept {
    const std::size_t letter = group.find_first_not_of("0123456789");
    return letter != 0 && letter < group.size() && group[letter] == 'V';
}

std::optional<Sector> read_variation(std::string_view group) noexcept {
    Scan scan(group);
    const auto from = scan.digits(3);
    if (!from || !scan.accept("V")) return std::nullopt;
    const auto to = scan.digits(3);
    if (!to || !scan.done() || *from > 360 || *to > 360) return std::nullopt;
    return Sector{*from, *to};
}

bool looks_like_visibility(std::string_view group) noexcept {
    return starts_with_digit(group);
}

std::optional<Visibility> read_visibility(std::string_view group) noexcept {
    constexpr double kFarthest_m = 10'000.0;
    constexpr double kNearest_m = 50.0;
    Visibility out;
    Scan kilometres(group);
    if (const auto value = kilometres.digits(1, 3); value && kilometres.rest() == "KM") {
        out.prevailing_m = *value * 1000.0;
        return out;
    }
    Scan scan(group);
    const auto value = scan.digits(4);
    if (!value) return std::nullopt;
    const double metres = *value == 9999 ? kFarthest_m : *value == 0 ? kNearest_m : *value;
    out.no_directions = scan.accept("NDV");
    if (const auto octant = find_code<int>(kCompass, scan.rest()); octant && !out.no_directions) {
        out.minimum_m = metres;
        out.minimum_direction_deg = *octant * 45;
        return out;
    }
    if (!scan.done()) return std::nullopt;
    out.prevailing_m = metres;
    if (*value == 9999) out.comparison = Comparison::kAtLeast;
    if (*value == 0) out.comparison = Comparison::kBelow;
    return out;
}

bool looks_like_miles(std::string_view group) noexcept {
    if (!group.ends_with("SM") || group.size() < 3) return false;
    return is_digit(group[0]) || ((group[0] == 'P' || group[0] == 'M') && is_digit(group[1]));
}

std::optional<int> read_whole_miles(std::string_view group) noexcept {
    Scan scan(group);
    const auto value = scan.digits(1, 2);
    return scan.done() ? value : std::nullopt;
}

std::optional<Visibility> read_miles(std::string_view group, int whole) noexcept {
    Visibility out;
    out.in_miles = true;
    Scan scan(group);
    if (scan.accept("P")) out.comparison = Comparison::kAbove;
    if (scan.accept("M")) out.comparison = Comparison::kBelow;
    const auto value = scan.digits(1, 3);
    if (!value) return std::nullopt;
    double miles = *value;
    if (scan.accept("/")) {
        const auto parts = scan.digits(1, 2);
        // 11/2SM is as likely 1 1/2 as a slip; neither is guessed.
        if (!parts || *value >= *parts) return std::nullopt;
        miles = whole + miles / *parts;
    } else if (whole != 0) {
        return std::nullopt;
    }
    if (scan.rest() != "SM") return std::nullopt;
    out.prevailing_m = miles * kMetresPerMile;
    return out;
}

bool looks_like_temperature(std::string_view group) noexcept {
    if (group.find('/') == std::string_view::npos) return false;
    const std::string_view number = group.substr(group.front() == 'M' ? 1 : 0);
    return starts_with_digit(number) || read_temperature(group).has_value();
}

std::optional<Temperatures> read_temperature(std::string_view group) noexcept {
    Temperatures out;
    Scan scan(group);
    if (!read_celsius(scan, out.air_c) || !scan.accept("/")) return std::nullopt;
    if (!read_celsius(scan, out.dewpoint_c) || !scan.done()) return std::nullopt;
    return out;
}

bool is_missing_pressure(std::string_view group) noexcept {
    Scan scan(group);
    return (scan.accept("QNH") || scan.accept("Q") || scan.accept("A")) && !scan.done() &&
           all_slashes(scan.rest());
}

bool looks_like_pressure(std::string_view group) noexcept {
    Scan scan(group);
    return (scan.accept("QNH") || scan.accept("Q") || scan.accept("A")) && scan.digits(1).has_value();
}

std::optional<Pressure> read_pressure(std::string_view group) noexcept {
    constexpr double kLowest_hpa = 850.0;
    constexpr double kHighest_hpa = 1100.0;
    Pressure out;
    Scan scan(group);
    const bool inches = scan.accept("A");
    if (!inches && !scan.accept("QNH")) scan.accept("Q");
    const auto value = scan.digits(4);
    if (!value) return std::nullopt;
    out.in_inches = inches || scan.accept("INS");
    if (!out.in_inches && !scan.accept("HPA") && scan.accept("/")) {
        // The same in inches behind it: Q1013/29.92.
        const bool whole = scan.digits(2).has_value();
        scan.accept(".");
        if (!whole || !scan.digits(2)) return std::nullopt;
    }
    out.qnh_hpa = out.in_inches ? *value * kHpaPerInch / 100.0 : *value;
    if (!scan.done() || out.qnh_hpa < kLowest_hpa || out.qnh_hpa > kHighest_hpa) return std::nullopt;
    return out;
}

bool looks_like_sea(std::string_view group) noexcept {
    Scan scan(group);
    if (!scan.accept("W")) return false;
    scan.accept("M");
    return scan.digits(1).has_value() || scan.accept("/");
}

std::optional<Sea> read_sea(std::string_view group) noexcept {
    Sea out;
    Scan scan(group);
    if (!scan.accept("W") || !read_celsius(scan, out.temperature_c) || !scan.accept("/")) return std::nullopt;
    const bool state = scan.accept("S");
    if (state ? !read_or_missing(scan, 1, 1, "/", out.state)
              : !scan.accept("H") || !read_or_missing(scan, 1, 3, "///", out.wave_height_dm))
        return std::nullopt;
    if (!scan.done()) return std::nullopt;
    return out;
}

bool is_shear_place(std::string_view group) noexcept {
    constexpr std::array<std::string_view, 6> kWords{"ALL", "RWY", "RWYS", "TKOF", "LDG", "TKOF/LDG"};
    if (is_one_of(kWords, group)) return true;
    Scan scan(group);
    if (!scan.accept("RWY")) scan.accept("R");
    if (!scan.digits(2)) return false;
    return scan.done() || scan.rest() == "L" || scan.rest() == "C" || scan.rest() == "R";
}

bool is_colour_state(std::string_view group) noexcept {
    constexpr std::string_view kClosed = "BLACK";
    if (group == kClosed) return true;
    if (group.starts_with(kClosed)) group.remove_prefix(kClosed.size());
    return is_one_of(kColourStates, group);
}

}  // namespace skyig::protocol::metar
