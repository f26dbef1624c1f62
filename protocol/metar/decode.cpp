#include "protocol/metar/decode.h"

#include <utility>

#include "protocol/metar/codes.h"
#include "protocol/metar/groups.h"
#include "protocol/metar/scan.h"

namespace skyig::protocol::metar {
namespace {

bool is_blank(char c) noexcept {
    return static_cast<unsigned char>(c) <= ' ';
}

std::string_view trimmed(std::string_view text) noexcept {
    while (!text.empty() && is_blank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back()))
        text.remove_suffix(1);
    return text;
}

std::string in_capitals(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return out;
}

std::vector<std::string_view> groups_of(std::string_view text) {
    std::vector<std::string_view> groups;
    while (!(text = trimmed(text)).empty()) {
        const auto* const end = std::find_if(text.begin(), text.end(), is_blank);
        groups.push_back(text.substr(0, static_cast<std::size_t>(end - text.begin())));
        text.remove_prefix(groups.back().size());
    }
    return groups;
}

bool is_station(std::string_view group) noexcept {
    return group.size() == 4 && is_letter(group.front()) &&
           std::all_of(group.begin(), group.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

/// COR, and Canada's CCA for the first correction to CCZ.
bool is_correction(std::string_view group) noexcept {
    return group == "COR" || (group.size() == 3 && group.starts_with("CC") && is_letter(group.back()));
}

/// What comes from here on is a forecast: ICAO's three, Australia's others.
bool begins_trend(std::string_view group) noexcept {
    constexpr std::array<std::string_view, 6> kWords{"NOSIG", "BECMG", "TEMPO", "INTER", "PROB30", "PROB40"};
    if (is_one_of(kWords, group)) return true;
    Scan scan(group);
    return scan.accept("FM") && scan.digits(4) && scan.done();
}

class Decoder {
  public:
    explicit Decoder(std::string_view capitals) : groups_(groups_of(capitals)) {}

    Report run() {
        read_header();
        while (at_ < groups_.size() && !begins_trend(peek()) && peek() != "RMK") {
            group_ = take();
            if (!read_flag() && !read_air() && !read_sky() && !read_rest()) pass_over();
        }
        report_.trend = join_until("RMK");
        if (at_ < groups_.size()) ++at_;
        report_.remarks = join_until("");
        return std::move(report_);
    }

  private:
    [[nodiscard]] std::string_view peek() const noexcept {
        return at_ < groups_.size() ? groups_[at_] : std::string_view();
    }
    std::string_view take() noexcept { return groups_[at_++]; }

    /// True, as readers say of a group that is theirs.
    bool wrong(Fault fault) {
        report_.problems.push_back({fault, std::string(group_)});
        return pass_over();
    }
    bool pass_over() {
        report_.unparsed.emplace_back(group_);
        return true;
    }
    template <class T>
    bool keep(std::optional<T>& place, std::optional<T> value, Fault fault) {
        if (!value) return wrong(fault);
        if (place) return wrong(Fault::kTwice);
        place = std::move(value);
        return true;
    }

    void read_header() {
        if (peek() == "METAR") report_.type = ReportType::kMetar;
        if (peek() == "SPECI") report_.type = ReportType::kSpeci;
        if (report_.type != ReportType::kNone) ++at_;
        while (is_correction(peek()))
            read_correction();
        if (is_station(peek())) {
            report_.station = take();
        } else {
            refuse_header(Fault::kStation, !looks_like_time(peek()));
        }
        if (peek() == "NIL") return;
        if (const auto time = read_time(peek())) {
            report_.day = time->day;
            report_.hour = time->hour;
            report_.minute = time->minute;
            ++at_;
        } else {
            refuse_header(Fault::kTime, looks_like_time(peek()));
        }
    }
    void read_correction() noexcept {
        report_.corrected = true;
        ++at_;
    }
    /// \param stands  what stands there is meant as what is asked for, and not the next group
    void refuse_header(Fault fault, bool stands) {
        report_.problems.push_back({fault, std::string(peek())});
        if (stands && at_ < groups_.size()) ++at_;
    }

    bool read_flag() {
        if (group_ == "AUTO") report_.automatic = true;
        if (group_ == "NIL") report_.nil = true;
        if (is_correction(group_)) report_.corrected = true;
        // NSW: the weather has ended.
        return group_ == "AUTO" || group_ == "NIL" || group_ == "NSW" || is_correction(group_) ||
               is_missing(group_) || is_missing_pressure(group_);
    }

    bool read_air() {
        if (looks_like_wind(group_)) return read_wind_group();
        if (looks_like_variation(group_)) return read_sector();
        if (looks_like_pressure(group_)) return read_pressure_group();
        if (looks_like_sea(group_)) return keep(report_.sea, read_sea(group_), Fault::kSea);
        if (looks_like_miles(group_)) return keep_visibility(read_miles(group_, 0));
        if (const auto whole = read_whole_miles(group_); whole && looks_like_miles(peek())) {
            const auto miles = read_miles(peek(), *whole);
            if (!miles) return wrong(Fault::kVisibility);
            ++at_;
            return keep_visibility(miles);
        }
        return false;
    }
    bool read_wind_group() {
        const auto wind = read_wind(group_);
        if (wind && !wind->variable && !wind->direction_deg_true && !wind->speed) return true;
        return keep(report_.wind, wind, Fault::kWind);
    }
    bool read_pressure_group() {
        const auto pressure = read_pressure(group_);
        // Some countries tell it in both units.
        if (pressure && report_.pressure && pressure->in_inches != report_.pressure->in_inches) return true;
        return keep(report_.pressure, pressure, Fault::kPressure);
    }
    bool read_sector() {
        const auto sector = read_variation(group_);
        if (!sector || !report_.wind) return wrong(Fault::kVariation);
        report_.wind->var_from_deg = sector->from_deg;
        report_.wind->var_to_deg = sector->to_deg;
        return true;
    }
    bool keep_visibility(const std::optional<Visibility>& value) {
        if (!value) return wrong(Fault::kVisibility);
        if (!report_.visibility) {
            report_.visibility = value;
            return true;
        }
        Visibility& kept = *report_.visibility;
        if (value->minimum_m) {
            if (!kept.minimum_m || *value->minimum_m < *kept.minimum_m) {
                kept.minimum_m = value->minimum_m;
                kept.minimum_direction_deg = value->minimum_direction_deg;
            }
            return true;
        }
        if (kept.prevailing_m) return wrong(Fault::kTwice);
        const Visibility minimum = std::exchange(kept, *value);
        kept.minimum_m = minimum.minimum_m;
        kept.minimum_direction_deg = minimum.minimum_direction_deg;
        return true;
    }

    bool read_sky() {
        if (group_ == "CAVOK") {
            report_.cavok = !report_.visibility;
            return keep_visibility(read_visibility("9999"));
        }
        if (const auto code = find_code<ClearCode>(kClearCodes, group_)) {
            report_.clear_code = code;
            return true;
        }
        if (auto state = read_runway_state(group_)) {
            report_.runway_states.push_back(std::move(*state));
            return true;
        }
        if (looks_like_runway(group_))
            return append(report_.runway_ranges, read_runway_range(group_), Fault::kRunway);
        if (looks_like_temperature(group_)) return read_temperatures();
        if (looks_like_vertical_visibility(group_)) {
            const auto vertical = read_vertical_visibility(group_);
            if (!vertical) return wrong(Fault::kCloud);
            report_.vertical_visibility_ft = vertical->height_ft;
            report_.obscured = true;
            return true;
        }
        if (looks_like_cloud(group_)) return append(report_.clouds, read_cloud(group_), Fault::kCloud);
        return false;
    }
    template <class T>
    bool append(std::vector<T>& list, std::optional<T> value, Fault fault) {
        if (!value) return wrong(fault);
        list.push_back(std::move(*value));
        return true;
    }
    bool read_temperatures() {
        const auto temperatures = read_temperature(group_);
        if (!temperatures) return wrong(Fault::kTemperature);
        if (report_.temperature_c || report_.dewpoint_c) return wrong(Fault::kTwice);
        report_.temperature_c = temperatures->air_c;
        report_.dewpoint_c = temperatures->dewpoint_c;
        return true;
    }

    bool read_rest() {
        constexpr std::string_view kRecent = "RE";
        if (const auto weather = read_weather(group_); weather || looks_like_weather(group_))
            return append(report_.weather, weather, Fault::kWeather);
        if (group_.starts_with(kRecent)) {
            const std::string_view kind = group_.substr(kRecent.size());
            if (is_missing(kind)) return true;
            if (const auto weather = read_weather(kind); weather || looks_like_weather(kind))
                return append(report_.recent, weather, Fault::kWeather);
        }
        if (group_ == "WS") return read_shear();
        if (is_colour_state(group_)) {
            report_.colour_states.emplace_back(group_);
            return true;
        }
        return looks_like_visibility(group_) && keep_visibility(read_visibility(group_));
    }
    bool read_shear() {
        std::string place;
        while (is_shear_place(peek())) {
            if (!place.empty()) place += ' ';
            place += take();
        }
        if (place.empty()) return wrong(Fault::kShear);
        report_.wind_shear.push_back(std::move(place));
        return true;
    }

    /// Without `word`, which stays; an empty one: to the end.
    std::string join_until(std::string_view word) {
        std::string joined;
        while (at_ < groups_.size() && peek() != word) {
            if (!joined.empty()) joined += ' ';
            joined += take();
        }
        return joined;
    }

    std::vector<std::string_view> groups_;
    std::size_t at_ = 0;
    std::string_view group_;
    Report report_;
};

}  // namespace

std::optional<std::string_view> next_report(std::string_view& text) noexcept {
    text = trimmed(text);
    if (text.empty()) return std::nullopt;
    const std::size_t end = std::min(text.find('='), text.size() - 1) + 1;
    const std::string_view report = trimmed(text.substr(0, end));
    text.remove_prefix(end);
    return report;
}

Report decode(std::string_view text) {
    const std::string capitals = in_capitals(text.substr(0, text.find('=')));
    Report report = Decoder(capitals).run();
    report.raw = trimmed(text);
    return report;
}

}  // namespace skyig::protocol::metar
