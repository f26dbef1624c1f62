// Runways, weather and cloud.
#include "protocol/metar/codes.h"
#include "protocol/metar/groups.h"
#include "protocol/metar/scan.h"

namespace skyig::protocol::metar {
namespace {

constexpr int kLastRunway = 36;
/// In a state's place of the number: all runways, and the last report once more.
constexpr int kAllRunways = 88;
constexpr int kRepeatedState = 99;

struct Runway {
    std::string_view designator;
    int number;
    std::string_view rest;
};

/// "R26L/..." ; two letters mark the outer of five parallel runways.
std::optional<Runway> read_runway(std::string_view group) noexcept {
    Scan scan(group);
    if (!scan.accept("R")) return std::nullopt;
    const std::string_view start = scan.rest();
    const auto number = scan.digits(2);
    if (!number) return std::nullopt;
    for (int letters = 0; letters < 2; ++letters)
        if (!scan.accept("L") && !scan.accept("C")) scan.accept("R");
    const std::size_t length = start.size() - scan.rest().size();
    if (!scan.accept("/")) return std::nullopt;
    return Runway{start.substr(0, length), *number, scan.rest()};
}

/// `count` digits or as many slashes, no mixture.
bool accept_number(Scan& scan, std::size_t count) noexcept {
    return scan.digits(count).has_value() || scan.accept(std::string_view("//").substr(0, count));
}

/// Deposit, extent, depth and friction: "450093".
bool accept_deposits(Scan& scan) noexcept {
    return accept_number(scan, 1) && accept_number(scan, 1) && accept_number(scan, 2) &&
           accept_number(scan, 2);
}

bool is_state(std::string_view text) noexcept {
    if (text == "SNOCLO") return true;
    Scan scan(text);
    return (scan.accept("CLRD") ? accept_number(scan, 2) : accept_deposits(scan)) && scan.done();
}

bool read_distance(Scan& scan, std::optional<double>& distance, Comparison& comparison) noexcept {
    if (scan.accept("P")) comparison = Comparison::kAbove;
    if (scan.accept("M")) comparison = Comparison::kBelow;
    const auto value = scan.digits(4);
    if (!value) return false;
    distance = *value;
    return true;
}

/// Hundreds of feet or ///. \return false if neither stands there
bool read_height(Scan& scan, std::optional<int>& height_ft) noexcept {
    if (scan.accept("///")) return true;
    const auto hundreds = scan.digits(3);
    if (!hundreds) return false;
    height_ft = *hundreds * 100;
    return true;
}

/// The end of a cloud group: its kind, /// for one that is not known, or nothing.
bool read_convective(std::string_view text, Convective& out) noexcept {
    if (text == "CB") out = Convective::kCumulonimbus;
    if (text == "TCU") out = Convective::kToweringCumulus;
    return out != Convective::kNone || text.empty() || text == "///";
}

}  // namespace

bool looks_like_runway(std::string_view group) noexcept {
    Scan scan(group);
    return group.starts_with("R/") || group == "SNOCLO" || (scan.accept("R") && scan.digits(1).has_value());
}

std::optional<std::string> read_runway_state(std::string_view group) {
    if (group == "SNOCLO" || group == "R/SNOCLO") return std::string(group);
    const auto runway = read_runway(group);
    if (runway && is_state(runway->rest)) {
        const int number = runway->number;
        if ((number < 1 || number > kLastRunway) && number != kAllRunways && number != kRepeatedState)
            return std::nullopt;
        return std::string(group.substr(1));
    }
    Scan old(group);
    if (old.digits(2) && accept_deposits(old) && old.done()) return std::string(group);
    return std::nullopt;
}

std::optional<RunwayRange> read_runway_range(std::string_view group) {
    const auto runway = read_runway(group);
    if (!runway || runway->number < 1 || runway->number > kLastRunway || runway->rest.empty())
        return std::nullopt;
    RunwayRange out;
    out.runway = runway->designator;
    if (all_slashes(runway->rest)) return out;
    Scan scan(runway->rest);
    if (!read_distance(scan, out.range_m, out.comparison)) return std::nullopt;
    if (scan.accept("V") && !read_distance(scan, out.maximum_m, out.maximum_comparison)) return std::nullopt;
    out.in_feet = scan.accept("FT");
    if (out.in_feet) {
        *out.range_m *= kMetresPerFoot;
        if (out.maximum_m) *out.maximum_m *= kMetresPerFoot;
    }
    while (scan.accept("/")) {
    }
    const std::string_view trend = scan.rest();
    if (trend.empty()) return out;
    if (trend != "U" && trend != "D" && trend != "N") return std::nullopt;
    out.trend = trend.front();
    return out;
}

bool looks_like_weather(std::string_view group) noexcept {
    return group.starts_with('+') || group.starts_with('-') || group.starts_with("VC");
}

std::optional<Weather> read_weather(std::string_view group) noexcept {
    Weather out;
    Scan scan(group);
    if (scan.accept("+")) {
        out.intensity = Intensity::kHeavy;
    } else if (scan.accept("-")) {
        out.intensity = Intensity::kLight;
    } else {
        out.vicinity = scan.accept("VC");
    }
    out.descriptor = find_code<Descriptor>(kDescriptorCodes, scan.rest().substr(0, 2));
    if (out.descriptor) scan.take(2);
    while (!scan.done()) {
        const auto phenomenon = find_code<Phenomenon>(kPhenomenonCodes, scan.take(2));
        if (!phenomenon || out.phenomenon_count == kMostPhenomena) return std::nullopt;
        out.phenomenon[out.phenomenon_count++] = *phenomenon;
    }
    // Only these two say something on their own.
    const bool alone = out.descriptor == Descriptor::kShower || out.descriptor == Descriptor::kThunderstorm;
    if (out.phenomenon_count == 0 && !alone) return std::nullopt;
    return out;
}

bool looks_like_cloud(std::string_view group) noexcept {
    return find_code<CloudAmount>(kAmountCodes, group.substr(0, 3)).has_value() || group.starts_with("///") ||
           read_cloud(group).has_value();
}

std::optional<Cloud> read_cloud(std::string_view group) noexcept {
    Cloud out;
    Scan scan(group);
    out.amount = find_code<CloudAmount>(kAmountCodes, group.substr(0, 3));
    if (out.amount || group.starts_with("///")) {
        scan.take(3);
        // ///CB: neither amount nor height.
        const bool no_height = !out.amount && (scan.rest() == "CB" || scan.rest() == "TCU");
        if (!no_height && !read_height(scan, out.base_ft_agl)) return std::nullopt;
        if (!read_convective(scan.rest(), out.convective)) return std::nullopt;
        return out;
    }
    // CB///, TCU///: the kind alone.
    if (!group.ends_with("///") || !read_convective(group.substr(0, group.size() - 3), out.convective) ||
        out.convective == Convective::kNone)
        return std::nullopt;
    return out;
}

bool looks_like_vertical_visibility(std::string_view group) noexcept {
    return group.starts_with("VV");
}

std::optional<VerticalVisibility> read_vertical_visibility(std::string_view group) noexcept {
    VerticalVisibility out;
    Scan scan(group);
    if (!scan.accept("VV") || !read_height(scan, out.height_ft) || !scan.done()) return std::nullopt;
    return out;
}

}  // namespace skyig::protocol::metar
