#include "clients/skyig/metar/page.h"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

namespace skyig::clients::metar {

using namespace protocol::metar;

namespace {

class Page {
  public:
    void line(std::string_view label, std::string_view text) {
        if (!text.empty()) fmt::format_to(std::back_inserter(text_), "  {:<12}{}\n", label, text);
    }
    void head(std::string_view text) { fmt::format_to(std::back_inserter(text_), "{}\n", text); }
    [[nodiscard]] std::string take() && { return std::move(text_); }

  private:
    std::string text_;
};

std::string joined(const std::vector<std::string>& words, std::string_view between) {
    return fmt::format("{}", fmt::join(words, between));
}

std::string head_text(const Report& report) {
    std::string text(report.type == ReportType::kSpeci ? "SPECI" : "METAR");
    text += " " + (report.station.empty() ? std::string("of no known station") : report.station);
    if (report.day)
        fmt::format_to(std::back_inserter(text), ", day {}, {:02}:{:02} UTC", *report.day, *report.hour,
                       *report.minute);
    if (report.automatic) text += ", automatic";
    if (report.corrected) text += ", corrected";
    if (report.nil) text += ", no report (NIL)";
    return text;
}

std::string speed_text(const std::optional<int>& speed, bool above, SpeedUnit unit) {
    if (!speed) return "of no known speed";
    return fmt::format("{}{} {} ({:.1f} m/s)", above ? "more than " : "", *speed, name(unit),
                       metres_per_second(*speed, unit));
}

std::string wind_text(const Wind& wind) {
    if (wind.speed == 0 && !wind.gust) return "calm";
    std::string text = wind.variable             ? "variable"
                       : wind.direction_deg_true ? fmt::format("from {} deg true", *wind.direction_deg_true)
                                                 : "of no known direction";
    text += ", " + speed_text(wind.speed, wind.speed_above, wind.unit);
    if (wind.gust) text += ", gusts " + speed_text(wind.gust, wind.gust_above, wind.unit);
    if (wind.var_from_deg)
        fmt::format_to(std::back_inserter(text), ", varying from {} to {} deg", *wind.var_from_deg,
                       *wind.var_to_deg);
    return text;
}

std::string metres_text(double metres, Comparison comparison) {
    constexpr std::array<std::string_view, 4> kForms{"{:.0f} m", "below {:.0f} m", "above {:.0f} m",
                                                     "{:.0f} m or more"};
    return fmt::format(fmt::runtime(kForms[static_cast<std::size_t>(comparison)]), metres);
}

std::string visibility_text(const Visibility& visibility) {
    std::string text;
    if (visibility.prevailing_m) text = metres_text(*visibility.prevailing_m, visibility.comparison);
    if (visibility.minimum_m)
        fmt::format_to(std::back_inserter(text), "{}{:.0f} m towards {}", text.empty() ? "" : ", least ",
                       *visibility.minimum_m, compass_name(*visibility.minimum_direction_deg));
    if (visibility.no_directions) text += ", directions not told apart";
    return text;
}

std::string range_text(const RunwayRange& range) {
    if (!range.range_m) return fmt::format("{}: not available", range.runway);
    std::string text = fmt::format("{}: {}", range.runway, metres_text(*range.range_m, range.comparison));
    if (range.maximum_m) text += " to " + metres_text(*range.maximum_m, range.maximum_comparison);
    if (range.trend == 'U') text += ", getting better";
    if (range.trend == 'D') text += ", getting worse";
    if (range.trend == 'N') text += ", without change";
    return text;
}

std::string_view words(Descriptor descriptor) {
    constexpr std::array<std::string_view, static_cast<std::size_t>(Descriptor::kEnd)> kWords{
        "shallow", "patches of", "partial",           "low drifting",
        "blowing", "showers of", "thunderstorm with", "freezing"};
    return kWords[static_cast<std::size_t>(descriptor)];
}

std::string_view words(Phenomenon phenomenon) {
    constexpr std::array<std::string_view, static_cast<std::size_t>(Phenomenon::kEnd)> kWords{
        "drizzle",      "rain",         "snow",
        "snow grains",  "ice crystals", "ice pellets",
        "hail",         "small hail",   "unknown precipitation",
        "mist",         "fog",          "smoke",
        "volcanic ash", "dust",         "sand",
        "haze",         "spray",        "dust whirls",
        "squalls",      "funnel cloud", "sandstorm",
        "duststorm"};
    return kWords[static_cast<std::size_t>(phenomenon)];
}

std::string weather_text(const Weather& weather) {
    std::string text;
    if (weather.intensity != Intensity::kModerate) text = fmt::format("{} ", name(weather.intensity));
    if (weather.phenomenon_count == 0) {
        text += weather.descriptor == Descriptor::kShower ? "showers" : "thunderstorm";
    } else if (weather.descriptor) {
        fmt::format_to(std::back_inserter(text), "{} ", words(*weather.descriptor));
    }
    for (std::size_t i = 0; i < weather.phenomenon_count; ++i)
        fmt::format_to(std::back_inserter(text), "{}{}", i == 0 ? "" : " and ", words(weather.phenomenon[i]));
    if (weather.vicinity) text += " in the vicinity";
    return text;
}

std::string weather_list(const std::vector<Weather>& list) {
    std::string text;
    for (const Weather& weather : list)
        fmt::format_to(std::back_inserter(text), "{}{}", text.empty() ? "" : "; ", weather_text(weather));
    return text;
}

std::string cloud_text(const Cloud& cloud) {
    std::string text("some");
    if (cloud.amount) {
        const auto [least, most] = oktas(*cloud.amount);
        text = least == most ? fmt::format("{} ({} oktas)", name(*cloud.amount), most)
                             : fmt::format("{} ({} to {} oktas)", name(*cloud.amount), least, most);
    }
    if (cloud.convective == Convective::kCumulonimbus) text += ", cumulonimbus";
    if (cloud.convective == Convective::kToweringCumulus) text += ", towering cumulus";
    if (!cloud.base_ft_agl) return text + ", base not known";
    return text + fmt::format(", base {} ft ({:.0f} m) above the aerodrome", *cloud.base_ft_agl,
                              *cloud.base_ft_agl * kMetresPerFoot);
}

std::string clear_text(ClearCode code) {
    constexpr std::array<std::string_view, static_cast<std::size_t>(ClearCode::kEnd)> kWords{
        "clear sky", "none found by the station", "none of significance", "none detected by the station"};
    return fmt::format("{} ({})", kWords[static_cast<std::size_t>(code)], name(code));
}

void add_sky(Page& page, const Report& report) {
    if (report.cavok) page.line("cloud", "none below 5000 ft, no weather (CAVOK)");
    if (report.clear_code) page.line("cloud", clear_text(*report.clear_code));
    for (const Cloud& cloud : report.clouds)
        page.line("cloud", cloud_text(cloud));
    if (!report.obscured) return;
    const auto& height_ft = report.vertical_visibility_ft;
    page.line("sky", height_ft ? fmt::format("hidden, vertical visibility {} ft ({:.0f} m)", *height_ft,
                                             *height_ft * kMetresPerFoot)
                               : "hidden");
}

void add_temperatures(Page& page, const Report& report) {
    if (report.temperature_c) page.line("temperature", fmt::format("{} C", *report.temperature_c));
    if (report.dewpoint_c) page.line("dew point", fmt::format("{} C", *report.dewpoint_c));
    if (report.pressure) page.line("QNH", fmt::format("{:.1f} hPa", report.pressure->qnh_hpa));
}

void add_sea(Page& page, const Sea& sea) {
    if (sea.temperature_c) page.line("sea", fmt::format("{} C", *sea.temperature_c));
    if (sea.state) page.line("sea", fmt::format("state {}", *sea.state));
    if (sea.wave_height_dm) page.line("sea", fmt::format("waves of {:.1f} m", *sea.wave_height_dm / 10.0));
}

}  // namespace

std::string to_text(const Report& report) {
    Page page;
    page.head(head_text(report));
    if (report.wind) page.line("wind", wind_text(*report.wind));
    if (report.visibility) page.line("visibility", visibility_text(*report.visibility));
    for (const RunwayRange& range : report.runway_ranges)
        page.line("runway", range_text(range));
    page.line("weather", weather_list(report.weather));
    page.line("recent", weather_list(report.recent));
    add_sky(page, report);
    add_temperatures(page, report);
    page.line("wind shear", joined(report.wind_shear, "; "));
    if (report.sea) add_sea(page, *report.sea);
    page.line("runways", joined(report.runway_states, " "));
    page.line("colour", joined(report.colour_states, " "));
    page.line("trend", report.trend);
    page.line("remarks", report.remarks);
    page.line("not read", joined(report.unparsed, " "));
    return std::move(page).take();
}

}  // namespace skyig::clients::metar
