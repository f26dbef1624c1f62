#include "server/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "server/report_json.h"

namespace skyig::server {

void FramesBehind::add(std::uint32_t frames) noexcept {
    ++bins_[std::min(frames, kLargest)];
    ++count_;
    largest_ = std::max(largest_, std::min(frames, kLargest));
}

std::uint32_t FramesBehind::quantile(double q) const noexcept {
    const double wanted = std::clamp(q, 0.0, 1.0) * static_cast<double>(count_);
    std::uint64_t seen = 0;
    for (std::uint32_t frames = 0; frames <= kLargest; ++frames) {
        seen += bins_[frames];
        if (seen > 0 && static_cast<double>(seen) >= wanted) return frames;
    }
    return 0;
}

namespace {

std::string counts_text(const std::vector<NamedCount>& counts) {
    std::string text;
    for (const NamedCount& count : counts) {
        if (count.count == 0) continue;
        fmt::format_to(std::back_inserter(text), "{}{} {}", text.empty() ? "" : ", ", count.name,
                       count.count);
    }
    return text.empty() ? "none" : text;
}

}  // namespace

nlohmann::ordered_json counts_json(const std::vector<NamedCount>& counts) {
    auto json = nlohmann::ordered_json::object();
    for (const NamedCount& count : counts)
        json[count.name] = count.count;
    return json;
}

double RunReport::cpu_pct() const noexcept {
    return elapsed_s > 0.0 ? 100.0 * cpu_s / elapsed_s : 0.0;
}

std::string RunReport::ephemeris_text() const {
    return earth_orientation.empty()
               ? fmt::format("{}, Earth orientation by the built-in tables", ephemeris)
               : fmt::format("{}, Earth orientation measured {}", ephemeris, earth_orientation);
}

std::string to_table(const RunReport& report) {
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "frames          {} in {:.1f} s at {:g} Hz: {} late, {} left out\n", report.frames,
                   report.elapsed_s, report.rate_hz, report.late_frames, report.slots_left_out);
    if (report.frames_spaced > 0)
        fmt::format_to(out, "display         did not pace {} frames: spaced by the clock\n",
                       report.frames_spaced);
    if (report.late_frames > 0)
        fmt::format_to(out, "late by         {}\n", counts_text(report.late_by_cause));
    if (report.host_timeouts > 0)
        fmt::format_to(out, "host            not in time for {} frames\n", report.host_timeouts);
    if (report.times_thinned > 0) {
        fmt::format_to(
            out, "thinned out     {} times, back {} times; at the end: {}\n", report.times_thinned,
            report.times_returned,
            report.thinned.empty() ? "nothing" : fmt::format("{}", fmt::join(report.thinned, ", ")));
    }
    fmt::format_to(out, "processor       {:.1f} s, {:.1f} % of one\n", report.cpu_s, report.cpu_pct());
    fmt::format_to(out, "{:<32} {:>10} {:>10} {:>10}\n", "times in ms", "median", "p95", "largest");
    for (const TimeRow& row : report.times) {
        fmt::format_to(out, "  {:<30} {:>10.2f} {:>10.2f} {:>10.2f}\n", row.name, row.median_ms, row.p95_ms,
                       row.largest_ms);
    }
    bool headed = false;
    for (const DelayRow& row : report.delays) {
        if (row.count == 0) continue;
        if (!headed)
            fmt::format_to(out, "{:<32} {:>10} {:>10} {:>10}\n", "delays in ms", "median", "p99", "largest");
        headed = true;
        fmt::format_to(out, "  {:<30} {:>10.2f} {:>10.2f} {:>10.2f}\n", row.name, row.median_ms, row.p99_ms,
                       row.largest_ms);
    }
    if (report.host.empty()) {
        fmt::format_to(out, "host            none heard\n");
    } else {
        fmt::format_to(out,
                       "host            {}, CIGI {}, {} frames behind (median; largest {}), lost {} times\n",
                       report.host, report.host_protocol, report.host_frames_behind_median,
                       report.host_frames_behind_largest, report.host_losses);
    }
    fmt::format_to(out, "datagrams       {}\n", report.datagrams);
    for (const BusRow& bus : report.buses) {
        fmt::format_to(out, "bus             {} on {}, {}: {}\n", bus.source, bus.interface, bus.state,
                       counts_text(bus.counts));
    }
    fmt::format_to(out, "packets         {}\n", counts_text(report.packets));
    fmt::format_to(out, "rejected        {}\n", counts_text(report.rejects));
    fmt::format_to(out, "Start of Frame  {} sent, {} failed\n", report.start_of_frame_sent,
                   report.start_of_frame_failed);
    fmt::format_to(out, "images          {} written, {} failed, {} frames skipped\n", report.images_written,
                   report.images_failed, report.image_frames_skipped);
    fmt::format_to(out, "ephemeris       {}{}{}\n", report.ephemeris_text(),
                   report.date_clamped ? "; the date is brought into 1900..2100" : "",
                   report.leap_seconds_assumed ? "; leap seconds are held at the last announced" : "");
    if (report.gl_errors > 0) fmt::format_to(out, "GL errors       {}\n", report.gl_errors);
    if (report.gl_resets > 0) fmt::format_to(out, "GL resets       {}\n", report.gl_resets);
    return text;
}

nlohmann::ordered_json report_json(const RunReport& report) {
    nlohmann::ordered_json json;
    json["version"] = report.version;
    json["renderer"] = report.renderer;
    json["rate_hz"] = report.rate_hz;
    json["elapsed_s"] = report.elapsed_s;
    json["cpu_s"] = report.cpu_s;
    json["frames"] = report.frames;
    json["late_frames"] = report.late_frames;
    json["slots_left_out"] = report.slots_left_out;
    json["frames_spaced"] = report.frames_spaced;
    json["late_by_cause"] = counts_json(report.late_by_cause);
    json["host_timeouts"] = report.host_timeouts;
    json["delays"] = nlohmann::ordered_json::array();
    for (const DelayRow& row : report.delays) {
        json["delays"].push_back({{"name", row.name},
                                  {"count", row.count},
                                  {"median_ms", row.median_ms},
                                  {"p99_ms", row.p99_ms},
                                  {"largest_ms", row.largest_ms}});
    }
    json["thinning"] = {{"thinned", report.thinned},
                        {"times_thinned", report.times_thinned},
                        {"times_returned", report.times_returned}};
    json["gl_objects"] = report.gl_objects;
    json["times"] = nlohmann::ordered_json::array();
    for (const TimeRow& row : report.times) {
        json["times"].push_back({{"name", row.name},
                                 {"median_ms", row.median_ms},
                                 {"p95_ms", row.p95_ms},
                                 {"largest_ms", row.largest_ms}});
    }
    json["host"] = {{"address", report.host},
                    {"protocol", report.host_protocol},
                    {"losses", report.host_losses},
                    {"frames_behind_median", report.host_frames_behind_median},
                    {"frames_behind_largest", report.host_frames_behind_largest}};
    json["datagrams"] = report.datagrams;
    json["buses"] = nlohmann::ordered_json::array();
    for (const BusRow& bus : report.buses) {
        json["buses"].push_back({{"source", bus.source},
                                 {"interface", bus.interface},
                                 {"state", bus.state},
                                 {"counts", counts_json(bus.counts)}});
    }
    json["packets"] = counts_json(report.packets);
    json["rejects"] = counts_json(report.rejects);
    json["start_of_frame"] = {{"sent", report.start_of_frame_sent}, {"failed", report.start_of_frame_failed}};
    json["images"] = {{"written", report.images_written},
                      {"failed", report.images_failed},
                      {"frames_skipped", report.image_frames_skipped}};
    json["gl_errors"] = report.gl_errors;
    json["gl_resets"] = report.gl_resets;
    json["ephemeris"] = {{"model", report.ephemeris},
                         {"earth_orientation", report.earth_orientation},
                         {"date_clamped", report.date_clamped},
                         {"leap_seconds_assumed", report.leap_seconds_assumed}};
    return json;
}

std::string to_json(const RunReport& report) {
    return report_json(report).dump(2) + '\n';
}

}  // namespace skyig::server
