#include <fmt/format.h>

#include "server/status/account.h"
#include "server/status/from_snapshot.h"
#include "server/status/metrics_text.h"
#include "server/status/rig_pages.h"

namespace skyig::server::status {

namespace {

double number(std::uint64_t count) {
    return static_cast<double>(count);
}

constexpr double kMsToS = 1e-3;

void counter(MetricsText& out, std::string_view name, std::string_view help, std::uint64_t value) {
    out.family(name, "counter", help);
    out.sample(number(value));
}

void gauge(MetricsText& out, std::string_view name, std::string_view help, double value) {
    out.family(name, "gauge", help);
    out.sample(value);
}

void add_program(MetricsText& out, const Account& account) {
    out.family("skyig_build_info", "gauge", "Version of the program and what it draws with.");
    out.sample({{"version", account.facts.version}, {"renderer", account.facts.renderer}}, 1.0);
    gauge(out, "skyig_uptime_seconds", "Time since the program started.", account.uptime_s);
    gauge(out, "skyig_healthy", "What /healthz says: 1 good, 0 not.", account.health.good ? 1.0 : 0.0);
    out.family("skyig_settings_read_total", "counter", "Times that settings were read anew, by their fate.");
    out.sample({{"result", "taken"}}, number(account.snapshot.settings.times_taken));
    out.sample({{"result", "refused"}}, number(account.snapshot.settings.times_refused));
    gauge(out, "skyig_frame_rate_hertz", "Configured frame rate.", account.facts.rate_hz);
    gauge(out, "skyig_recent_frame_rate_hertz", "Frames a second over the last frames.",
          account.snapshot.record.recent().rate_hz);
}

void add_frames(MetricsText& out, const Account& account) {
    const Snapshot& snapshot = account.snapshot;
    const FrameRecord& record = snapshot.record;
    counter(out, "skyig_frames_total", "Frames drawn.", snapshot.frames);
    out.family("skyig_late_frames_total", "counter", "Frames that began late, by what held them up.");
    for (std::size_t i = 0; i < kLateCauses; ++i)
        out.sample({{"cause", kLateCauseNames[i]}}, number(record.late(static_cast<LateCause>(i))));
    counter(out, "skyig_host_timeouts_total", "Frames that went on without the host's answer.",
            snapshot.host_timeouts);
    out.family("skyig_thinned", "gauge", "1 for what frames leave out for the frame rate's sake.");
    for (const config::ThinningName& each : config::kThinningNames) {
        out.sample({{"what", each.name}},
                   number(snapshot.thinning.thinned >> static_cast<unsigned>(each.thinning) & 1U));
    }
    out.family("skyig_thinning_steps_total", "counter", "Times that something was left out, and came back.");
    out.sample({{"step", "thinned"}}, number(snapshot.thinning.times_thinned));
    out.sample({{"step", "returned"}}, number(snapshot.thinning.times_returned));
    counter(out, "skyig_slots_left_out_total", "Frame periods that passed without a frame.",
            snapshot.slots_left_out);
    counter(out, "skyig_frames_spaced_total",
            "Frames spaced by the clock, since the swap of the windows did not wait for a display.",
            snapshot.frames_spaced);
    out.family("skyig_frame_seconds", "histogram", "Work of one frame.");
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < FrameRecord::kClassEnds_s.size(); ++i) {
        below += record.classes()[i];
        out.sample_as("_bucket", {{"le", fmt::format("{}", FrameRecord::kClassEnds_s[i])}}, number(below));
    }
    out.sample_as("_bucket", {{"le", "+Inf"}}, number(record.count()));
    out.sample_as("_sum", {}, record.sum_s());
    out.sample_as("_count", {}, number(record.count()));
    out.family("skyig_stage_seconds", "gauge",
               "Times since the start of the shared work, of each channel and of whole frames.");
    for (const TimeRow& row : account.report.times) {
        out.sample({{"stage", row.name}, {"statistic", "median"}}, row.median_ms * kMsToS);
        out.sample({{"stage", row.name}, {"statistic", "p95"}}, row.p95_ms * kMsToS);
        out.sample({{"stage", row.name}, {"statistic", "largest"}}, row.largest_ms * kMsToS);
    }
    out.family("skyig_delay_seconds", "gauge",
               "From a message's arrival to its picture, and how evenly the host's messages come.");
    for (const DelayRow& row : account.report.delays) {
        out.sample({{"until", row.name}, {"statistic", "median"}}, row.median_ms * kMsToS);
        out.sample({{"until", row.name}, {"statistic", "p99"}}, row.p99_ms * kMsToS);
        out.sample({{"until", row.name}, {"statistic", "largest"}}, row.largest_ms * kMsToS);
    }
    gauge(out, "skyig_gl_objects", "OpenGL objects at the last count.", number(snapshot.gl_objects));
    out.family("skyig_pass_needed", "gauge", "Whether the last frame's plan needs the pass.");
    for (std::size_t i = 0; i < snapshot.pass_count; ++i)
        out.sample({{"pass", snapshot.passes[i].name}}, snapshot.passes[i].needed ? 1.0 : 0.0);
    const auto& channels = account.facts.channels;
    out.family("skyig_channel_failed", "gauge", "1 while the channel cannot be drawn.");
    for (std::size_t i = 0; i < channels.size(); ++i)
        out.sample({{"channel", channels[i]}}, snapshot.health[i].failed ? 1.0 : 0.0);
    out.family("skyig_channel_failures_total", "counter", "Times that the channel could not be drawn.");
    for (std::size_t i = 0; i < channels.size(); ++i)
        out.sample({{"channel", channels[i]}}, number(snapshot.health[i].failures));
    out.family("skyig_channel_hidden", "gauge", "1 while the monitor of the channel's window is gone.");
    for (std::size_t i = 0; i < channels.size(); ++i)
        out.sample({{"channel", channels[i]}}, snapshot.hidden[i] ? 1.0 : 0.0);
    counter(out, "skyig_gl_errors_total", "OpenGL errors.", snapshot.gl_errors);
    counter(out, "skyig_gl_resets_total", "Resets of the graphics device, all made anew after each.",
            snapshot.gl_resets);
}

void add_messages(MetricsText& out, const Account& account) {
    const Snapshot& snapshot = account.snapshot;
    counter(out, "skyig_datagrams_total", "UDP datagrams taken by the frame loop.", snapshot.datagrams);
    out.family("skyig_packets_total", "counter", "CIGI packets decoded and valid.");
    for (const NamedCount& count : account.report.packets)
        out.sample({{"packet", count.name}}, number(count.count));
    out.family("skyig_rejects_total", "counter", "What was dropped, refused or ignored, by reason.");
    for (const NamedCount& count : account.report.rejects)
        out.sample({{"reason", count.name}}, number(count.count));
    out.family("skyig_start_of_frame_total", "counter", "Start of Frame messages.");
    out.sample({{"outcome", "sent"}}, number(snapshot.start_of_frame_sent));
    out.sample({{"outcome", "failed"}}, number(snapshot.start_of_frame_failed));
    out.family("skyig_host_frames_behind", "gauge", "Frames by which the host's answers lag.");
    out.sample({{"statistic", "median"}}, snapshot.frames_behind_median);
    out.sample({{"statistic", "largest"}}, snapshot.frames_behind_largest);
}

void add_links(MetricsText& out, const Account& account) {
    const auto& sources = account.facts.sources;
    const auto& states = account.snapshot.sources;
    const auto each = [&](std::string_view name, std::string_view type, std::string_view help, auto value) {
        out.family(name, type, help);
        for (std::size_t i = 0; i < sources.size(); ++i)
            out.sample({{"source", sources[i].name}}, value(states[i]));
    };
    out.family("skyig_source_link", "gauge", "1 for the state that the source's link is in.");
    for (std::size_t i = 0; i < sources.size(); ++i) {
        for (std::size_t state = 0; state < world::kLinkStateNames.size(); ++state) {
            out.sample({{"source", sources[i].name}, {"state", world::kLinkStateNames[state]}},
                       static_cast<std::size_t>(states[i].link.state) == state ? 1.0 : 0.0);
        }
    }
    each("skyig_source_silent_seconds", "gauge", "Time since the source was last heard.",
         [](const SourceState& state) { return state.link.silent_s; });
    each("skyig_source_losses_total", "counter", "Times that the source was lost.",
         [](const SourceState& state) { return number(state.link.losses); });
    each("skyig_source_arrivals_total", "counter", "Datagrams or CAN frames of the source.",
         [](const SourceState& state) { return number(state.arrivals); });
    out.family("skyig_source_counts_total", "counter",
               "What a source that speaks no CIGI counts in its own protocol.");
    for (std::size_t i = 0; i < sources.size(); ++i) {
        for (const NamedCount& count : source_counts(account.facts, account.snapshot, i))
            out.sample({{"source", sources[i].name}, {"count", count.name}}, number(count.count));
    }
}

void add_authority(MetricsText& out, const Account& account) {
    const auto& sources = account.facts.sources;
    const auto each = [&](auto value) {
        for (std::size_t i = 0; i < sources.size(); ++i) {
            for (std::size_t aspect = 0; aspect < config::kAspectCount; ++aspect) {
                if (!account.snapshot.sources[i].rights.owns.test(aspect)) continue;
                out.sample({{"source", sources[i].name}, {"aspect", config::kAspectNames[aspect]}},
                           value(i, aspect));
            }
        }
    };
    out.family("skyig_source_holds", "gauge", "1 where the source has the say about the aspect now.");
    each([&](std::size_t source, std::size_t aspect) {
        return account.snapshot.aspects[aspect].holder == source ? 1.0 : 0.0;
    });
    out.family("skyig_source_overruled_total", "counter",
               "Times that the source spoke of an aspect of which another had the say.");
    each([&](std::size_t source, std::size_t aspect) {
        return number(account.snapshot.sources[source].overruled[aspect]);
    });
}

void add_edges(MetricsText& out, const Account& account) {
    out.family("skyig_bus_up", "gauge", "Whether the CAN interface is up.");
    for (const BusRow& bus : account.report.buses)
        out.sample({{"source", bus.source}, {"interface", bus.interface}}, bus.state == "up" ? 1.0 : 0.0);
    out.family("skyig_bus_counts_total", "counter", "What happened on the CAN interface.");
    for (const BusRow& bus : account.report.buses) {
        for (const NamedCount& count : bus.counts) {
            out.sample({{"source", bus.source}, {"interface", bus.interface}, {"count", count.name}},
                       number(count.count));
        }
    }
    out.family("skyig_images_total", "counter", "Pictures for files; frames that were skipped.");
    out.sample({{"outcome", "written"}}, number(account.report.images_written));
    out.sample({{"outcome", "failed"}}, number(account.report.images_failed));
    out.sample({{"outcome", "frame_skipped"}}, number(account.report.image_frames_skipped));
    const RecorderState recorder = account.recorder.value_or(RecorderState{});
    gauge(out, "skyig_recorder_active", "Whether input is being recorded.",
          account.recorder && !recorder.failed ? 1.0 : 0.0);
    out.family("skyig_recorder_packets_total", "counter", "Packets for the recording.");
    out.sample({{"outcome", "written"}}, number(recorder.written));
    out.sample({{"outcome", "lost"}}, number(recorder.lost));
    counter(out, "skyig_recorder_bytes_total", "Bytes written to the recording.", recorder.bytes);
    counter(out, "skyig_status_connections_total", "Connections to this port.", account.port.connections);
    out.family("skyig_status_requests_total", "counter", "Requests to this port.");
    out.sample({{"outcome", "answered"}}, number(account.port.answered));
    out.sample({{"outcome", "refused"}}, number(account.port.refused));
    out.sample({{"outcome", "timed_out"}}, number(account.port.timed_out));
}

void add_world(MetricsText& out, const Account& account) {
    const WorldState& world = account.snapshot.world;
    gauge(out, "skyig_scene_time_seconds", "Time of the scene since the start.", world.scene_time_s);
    gauge(out, "skyig_clock_running", "Whether the world's clock runs.", world.clock_running ? 1.0 : 0.0);
    gauge(out, "skyig_ownship_latitude_degrees", "WGS84 latitude of the aircraft.",
          world.ownship.position.latitude_deg);
    gauge(out, "skyig_ownship_longitude_degrees", "WGS84 longitude of the aircraft.",
          world.ownship.position.longitude_deg);
    gauge(out, "skyig_ownship_height_meters", "Height of the aircraft above the WGS84 ellipsoid.",
          world.ownship.position.height_m);
    gauge(out, "skyig_sun_elevation_degrees", "Elevation of the Sun without refraction.",
          world.sun_elevation_deg);
    gauge(out, "skyig_visibility_meters", "Visibility at the ground.", world.air.visibility_m);
    gauge(out, "skyig_adaptation_luminance", "Luminance that all channels are adapted to, cd/m2.",
          world.adaptation_cd_m2);
}

}  // namespace

std::string to_metrics(const Account& account) {
    MetricsText out;
    add_program(out, account);
    add_frames(out, account);
    add_messages(out, account);
    add_links(out, account);
    add_authority(out, account);
    add_edges(out, account);
    add_world(out, account);
    add_rig(out, account.snapshot.rig);
    return std::move(out).take();
}

}  // namespace skyig::server::status
