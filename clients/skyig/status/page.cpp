#include "clients/skyig/status/page.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "clients/skyig/status/rig_page.h"

namespace skyig::clients::status {

namespace {

using Json = nlohmann::ordered_json;

/// Lines under headings in one column.
class Page {
  public:
    template <typename... Args>
    void line(std::string_view heading, fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(text_), "{:<16}", heading);
        fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
        text_ += '\n';
    }
    [[nodiscard]] std::string take() && { return std::move(text_); }

  private:
    std::string text_;
};

const std::string& text_of(const Json& json) {
    return json.get_ref<const std::string&>();
}

/// What was told before; null where nothing was.
using Before = const Json*;

Before member(Before before, const std::string& name) {
    if (before == nullptr) return nullptr;
    const auto found = before->find(name);
    return found == before->end() ? nullptr : &*found;
}

/// "12 (+3)": a count and how much it has grown.
std::string grown(const Json& now, Before before) {
    const auto count = now.get<std::uint64_t>();
    const std::uint64_t old = before == nullptr ? count : before->get<std::uint64_t>();
    return count > old ? fmt::format("{} (+{})", count, count - old) : fmt::format("{}", count);
}

/// "ig_control 149 (+60), view_control 1"; zeros are left out.
std::string counts_text(const Json& now, Before before) {
    std::string text;
    for (const auto& [name, value] : now.items()) {
        if (value == 0) continue;
        fmt::format_to(std::back_inserter(text), "{}{} {}", text.empty() ? "" : ", ", name,
                       grown(value, member(before, name)));
    }
    return text.empty() ? "none" : text;
}

std::string duration_text(double seconds) {
    const auto whole = static_cast<long long>(seconds);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    if (whole < 86400) return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
    return fmt::format("{} d {} h", whole / 86400, whole % 86400 / 3600);
}

std::string names_text(const Json& names) {
    std::string text;
    for (const Json& name : names)
        fmt::format_to(std::back_inserter(text), "{}{}", text.empty() ? "" : ", ", text_of(name));
    return text.empty() ? "nothing" : text;
}

void add_program(Page& page, const Json& now) {
    const Json& health = now.at("health");
    page.line("skyigd", "{}, up {} since {}", text_of(now.at("version")),
              duration_text(now.at("uptime_s").get<double>()), text_of(now.at("started_utc")));
    page.line("health", "{}{}", health.at("ok").get<bool>() ? "" : "NOT GOOD: ", text_of(health.at("text")));
    page.line("OpenGL", "{}", text_of(now.at("renderer")));
    if (now.contains("rig") && !now.at("rig").is_null()) page.line("rig", "{}", rig_line(now.at("rig")));
}

void add_times(Page& page, const std::string& name, const Json& times) {
    page.line("  " + name, "{:>10.2f} {:>10.2f} {:>10.2f}", times.at("median_ms").get<double>(),
              times.at("p95_ms").get<double>(), times.at("largest_ms").get<double>());
}

void add_frames(Page& page, const Json& now, Before before) {
    const Json& recent = now.at("recent");
    page.line("frames", "{:.1f} a second of {:g}; {} since the start", recent.at("rate_hz").get<double>(),
              now.at("rate_hz").get<double>(), grown(now.at("frames"), member(before, "frames")));
    page.line("late", "{} of the last {}; {} since the start ({})", recent.at("late").get<std::uint64_t>(),
              recent.at("frames").get<std::uint64_t>(),
              grown(now.at("late_frames"), member(before, "late_frames")),
              counts_text(now.at("late_by_cause"), member(before, "late_by_cause")));
    const Json& overload = now.at("overload");
    if (!overload.at("order").empty() || !overload.at("thinned").empty()) {
        const std::string& reason = text_of(overload.at("reason"));
        page.line("left out", "{}{}{}", names_text(overload.at("thinned")), reason.empty() ? "" : "; ",
                  reason);
    }
    if (now.at("host_timeouts") != 0)
        page.line("host", "not in time for {} frames",
                  grown(now.at("host_timeouts"), member(before, "host_timeouts")));
    page.line("times in ms", "{:>10} {:>10} {:>10}", "median", "p95", "largest");
    add_times(page, "last frames", recent);
    for (const Json& times : now.at("times"))
        add_times(page, text_of(times.at("name")), times);
    bool headed = false;
    for (const Json& delay : now.at("delays")) {
        if (delay.at("count") == 0) continue;
        if (!headed) page.line("delays in ms", "{:>10} {:>10} {:>10}", "median", "p99", "largest");
        headed = true;
        page.line("  " + text_of(delay.at("name")), "{:>10.2f} {:>10.2f} {:>10.2f}",
                  delay.at("median_ms").get<double>(), delay.at("p99_ms").get<double>(),
                  delay.at("largest_ms").get<double>());
    }
}

void add_world(Page& page, const Json& now) {
    const Json& world = now.at("world");
    const Json& ownship = world.at("ownship");
    page.line("world", "{}, {}, clock {}", text_of(world.at("mode")), text_of(world.at("utc")),
              world.at("clock_running").get<bool>() ? "runs" : "stands");
    page.line("ownship",
              "latitude {:.5f}, longitude {:.5f}, {:.1f} m; yaw {:.1f}, pitch {:.1f}, roll {:.1f} deg",
              ownship.at("latitude_deg").get<double>(), ownship.at("longitude_deg").get<double>(),
              ownship.at("height_m").get<double>(), ownship.at("yaw_deg").get<double>(),
              ownship.at("pitch_deg").get<double>(), ownship.at("roll_deg").get<double>());
    page.line("sky", "Sun {:.1f} deg high, Moon {:.1f} deg; adapted to {:.4g} cd/m2; visibility {:.0f} m",
              world.at("sun").at("elevation_deg").get<double>(),
              world.at("moon").at("elevation_deg").get<double>(), world.at("adaptation_cd_m2").get<double>(),
              world.at("air").at("visibility_m").get<double>());
    std::string drawn;
    for (const Json& pass : now.at("plan")) {
        if (!pass.at("needed").get<bool>()) continue;
        fmt::format_to(std::back_inserter(drawn), "{}{}", drawn.empty() ? "" : ", ",
                       text_of(pass.at("pass")));
    }
    page.line("drawn", "{}", drawn.empty() ? "nothing" : drawn);
}

void add_source(Page& page, const Json& source, Before before) {
    const std::string& heard_at = text_of(source.at("heard_at"));
    const std::string& peer = text_of(source.at("peer"));
    const Json& silent = source.at("silent_s");
    page.line("source", "{} ({}{}): {}{}{}, {} arrivals, lost {} times; holds {}", text_of(source.at("name")),
              text_of(source.at("kind")), heard_at.empty() ? "" : " on " + heard_at,
              text_of(source.at("link")), peer.empty() ? "" : " from " + peer,
              silent.is_null() ? "" : fmt::format(", heard {:.1f} s ago", silent.get<double>()),
              grown(source.at("arrivals"), member(before, "arrivals")),
              source.at("losses").get<std::uint64_t>(), names_text(source.at("holds")));
    if (!source.at("counts").empty())
        page.line("", "{}", counts_text(source.at("counts"), member(before, "counts")));
}

void add_sources(Page& page, const Json& now, Before before) {
    const Json& sources = now.at("sources");
    const Before old = member(before, "sources");
    for (std::size_t i = 0; i < sources.size(); ++i)
        add_source(page, sources[i], old != nullptr && i < old->size() ? &(*old)[i] : nullptr);
    for (const auto& [aspect, state] : now.at("authority").items()) {
        if (state.at("overruled").empty()) continue;
        page.line("conflict", "{} is with {} ({}); overruled: {}", aspect, text_of(state.at("holder")),
                  text_of(state.at("rule")), counts_text(state.at("overruled"), nullptr));
    }
    for (const Json& bus : now.at("buses")) {
        page.line("bus", "{} on {}, {}: {}", text_of(bus.at("source")), text_of(bus.at("interface")),
                  text_of(bus.at("state")), counts_text(bus.at("counts"), nullptr));
    }
}

void add_channels(Page& page, const Json& now, Before before) {
    const Json& channels = now.at("channels");
    const Before old = member(before, "channels");
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (channels[i].value("hidden", false))
            page.line("channel", "{}: NOT SHOWN, its monitor is gone", text_of(channels[i].at("name")));
        if (channels[i].at("failures") == 0) continue;
        const Before was = old != nullptr && i < old->size() ? &(*old)[i] : nullptr;
        page.line("channel", "{}: {}, {} times not drawn, last: {}", text_of(channels[i].at("name")),
                  channels[i].at("failed").get<bool>() ? "FAILED" : "drawn again",
                  grown(channels[i].at("failures"), member(was, "failures")),
                  text_of(channels[i].at("last_failure")));
    }
}

void add_counts(Page& page, const Json& now, Before before) {
    page.line("packets", "{}", counts_text(now.at("packets"), member(before, "packets")));
    page.line("rejected", "{}", counts_text(now.at("rejects"), member(before, "rejects")));
    page.line("Start of Frame", "{}",
              counts_text(now.at("start_of_frame"), member(before, "start_of_frame")));
    const Json& recorder = now.at("recorder");
    if (!recorder.is_null()) {
        page.line("recording", "{}: {} packets, {} bytes, {} lost{}", text_of(recorder.at("file")),
                  recorder.at("written").get<std::uint64_t>(), recorder.at("bytes").get<std::uint64_t>(),
                  recorder.at("lost").get<std::uint64_t>(),
                  recorder.at("failed").get<bool>() ? "; WRITING FAILED" : "");
    }
    if (now.at("gl_errors") != 0) page.line("GL errors", "{}", now.at("gl_errors").get<std::uint64_t>());
    if (now.value("gl_resets", 0U) != 0)
        page.line("GL resets", "{}", now.at("gl_resets").get<std::uint64_t>());
}

}  // namespace

std::string page_text(const Json& now, const Json* before) {
    Page page;
    add_program(page, now);
    add_frames(page, now, before);
    add_world(page, now);
    add_sources(page, now, before);
    add_channels(page, now, before);
    add_counts(page, now, before);
    return std::move(page).take();
}

}  // namespace skyig::clients::status
