#include "server/status/from_snapshot.h"

#include <fmt/format.h>

#include <algorithm>

#include "server/endpoint_format.h"

namespace skyig::server::status {

namespace can = protocol::canaerospace;
namespace cigi = protocol::cigi;
namespace flightgear = protocol::flightgear;

namespace {

TimeRow row(std::string_view name, const Times& times) {
    return {std::string(name), times.median_ms, times.p95_ms, times.largest_ms};
}

DelayRow row(std::string_view name, const Delay& delay) {
    return {std::string(name), delay.count, delay.median_ms, delay.p99_ms, delay.largest_ms};
}

void add_pacing(const Facts& facts, const Snapshot& snapshot, RunReport& report) {
    for (std::size_t i = 0; i < kLateCauses; ++i) {
        report.late_by_cause.push_back(
            {std::string(kLateCauseNames[i]), snapshot.record.late(static_cast<LateCause>(i))});
    }
    for (std::size_t i = 0; i < facts.channels.size(); ++i)
        report.delays.push_back(row(facts.channels[i], snapshot.delays[i]));
    report.delays.push_back(row("shown", snapshot.delay_shown));
    report.delays.push_back(row("host interval", snapshot.host_interval));
    report.delays.push_back(row("host jitter", snapshot.host_jitter));
    report.host_timeouts = snapshot.host_timeouts;
    for (const config::ThinningName& each : config::kThinningNames) {
        if ((snapshot.thinning.thinned >> static_cast<unsigned>(each.thinning) & 1U) != 0)
            report.thinned.emplace_back(each.name);
    }
    report.times_thinned = snapshot.thinning.times_thinned;
    report.times_returned = snapshot.thinning.times_returned;
    report.gl_objects = snapshot.gl_objects;
}

void add_host(const Snapshot& snapshot, RunReport& report) {
    const world::Link& link = snapshot.sources[snapshot.control_source].link;
    if (link.state != world::LinkState::kWaiting) {
        report.host = fmt::to_string(link.host);
        report.host_protocol =
            fmt::format("{} {}-endian", snapshot.host_version == cigi::Version::k40 ? "4.0" : "3.3",
                        snapshot.host_order == cigi::ByteOrder::kBig ? "big" : "little");
    }
    report.host_losses = link.losses;
    report.host_frames_behind_median = snapshot.frames_behind_median;
    report.host_frames_behind_largest = snapshot.frames_behind_largest;
}

void add_counts(const Snapshot& snapshot, RunReport& report) {
    report.datagrams = snapshot.datagrams;
    for (std::size_t kind = 0; kind < cigi::kHostPacketKinds; ++kind)
        report.packets.push_back({std::string(cigi::packet_name(kind)), snapshot.cigi.packets[kind]});
    for (std::size_t i = 0; i < cigi::kCounts; ++i)
        report.rejects.push_back(
            {std::string(cigi::count_name(static_cast<cigi::Count>(i))), snapshot.cigi.counts[i]});
    for (const world::NamedCounter& counter : world::kCounterNames)
        report.rejects.push_back({std::string(counter.name), snapshot.refused.*counter.value});
    report.rejects.push_back({"not_allowed", snapshot.udp.not_allowed});
    report.rejects.push_back({"ring_full", snapshot.udp.ring_full});
    report.rejects.push_back({"queue_full", snapshot.udp.queue_full});
}

}  // namespace

std::string_view hold_rule(const Facts& facts, const Snapshot& snapshot, config::Aspect aspect,
                           world::HoldReason reason) noexcept {
    const auto owners =
        std::count_if(snapshot.sources.begin(),
                      snapshot.sources.begin() + static_cast<std::ptrdiff_t>(facts.sources.size()),
                      [aspect](const SourceState& source) {
                          return source.rights.owns.test(static_cast<std::size_t>(aspect));
                      });
    return owners < 2 ? "only_owner" : world::kHoldReasonNames[static_cast<std::size_t>(reason)];
}

RunReport make_report(const Facts& facts, const Snapshot& snapshot) {
    RunReport report;
    report.version = facts.version;
    report.renderer = facts.renderer;
    report.rate_hz = facts.rate_hz;
    report.elapsed_s = snapshot.elapsed_s;
    report.frames = snapshot.frames;
    report.late_frames = snapshot.late_frames;
    report.slots_left_out = snapshot.slots_left_out;
    report.frames_spaced = snapshot.frames_spaced;
    report.times.push_back(row("input", snapshot.input));
    report.times.push_back(row("shared", snapshot.shared));
    for (std::size_t i = 0; i < facts.channels.size(); ++i)
        report.times.push_back(row(facts.channels[i], snapshot.channels[i]));
    report.times.push_back(row("frame", snapshot.frame));
    report.start_of_frame_sent = snapshot.start_of_frame_sent;
    report.start_of_frame_failed = snapshot.start_of_frame_failed;
    report.images_written = snapshot.images_written;
    report.images_failed = snapshot.images_failed;
    report.image_frames_skipped = snapshot.image_frames_skipped;
    report.gl_errors = snapshot.gl_errors;
    report.gl_resets = snapshot.gl_resets;
    report.ephemeris = facts.ephemeris;
    report.earth_orientation = facts.earth_orientation;
    report.date_clamped = snapshot.date_clamped;
    report.leap_seconds_assumed = snapshot.leap_seconds_assumed;
    add_pacing(facts, snapshot, report);
    add_host(snapshot, report);
    add_counts(snapshot, report);
    return report;
}

std::vector<NamedCount> source_counts(const Facts& facts, const Snapshot& snapshot, std::size_t source) {
    std::vector<NamedCount> counts;
    if (facts.sources[source].kind == config::SourceKind::kCanAerospace) {
        const can::Counters& counters = snapshot.canaerospace[source];
        for (std::size_t i = 0; i < can::kEvents; ++i)
            counts.push_back({std::string(can::event_name(static_cast<can::Event>(i))), counters.events[i]});
        for (std::size_t i = 1; i < can::kReasons; ++i)
            counts.push_back({fmt::format("not_taken_{}", can::reason_name(static_cast<can::Reason>(i))),
                              counters.reasons[i]});
    } else if (facts.sources[source].kind == config::SourceKind::kFgNetFdm) {
        const FlightGearCounts& counters = snapshot.flightgear[source];
        counts.push_back({"packets", counters.packets});
        for (std::size_t i = 0; i < flightgear::kReasons; ++i)
            counts.push_back(
                {fmt::format("not_taken_{}", flightgear::reason_name(static_cast<flightgear::Reason>(i))),
                 counters.refused[i]});
    }
    return counts;
}

}  // namespace skyig::server::status
