// A daemon with a host, a bus and FlightGear, caught at frame 600.
#pragma once

#include <vector>

#include "server/status/account.h"

namespace skyig::server::status::tests {

inline constexpr std::int64_t kMs = 1'000'000;
inline constexpr std::int64_t kSecond = 1000 * kMs;
inline constexpr std::int64_t kStart = 100 * kSecond;

inline Facts example_facts() {
    Facts facts;
    facts.version = "1.2.3";
    facts.renderer = "4.5 \"quoted\" \\ back";
    facts.rate_hz = 50.0;
    facts.channels = {"left", "right"};
    facts.sources.resize(3);
    facts.sources[0].name = "host";
    facts.sources[0].heard_at = "127.0.0.1:8004";
    facts.sources[1].name = "cockpit";
    facts.sources[1].kind = config::SourceKind::kCanAerospace;
    facts.sources[1].heard_at = "can0";
    facts.sources[2].name = "flightgear";
    facts.sources[2].kind = config::SourceKind::kFgNetFdm;
    facts.ephemeris = "series";
    facts.started_ns = kStart;
    facts.started_utc = "2026-06-21T12:00:00Z";
    return facts;
}

/// 600 frames of 5 ms at 50 Hz, the last 10 s after the start.
inline Snapshot example_snapshot() {
    Snapshot snapshot;
    snapshot.frames = 600;
    snapshot.late_frames = 1;
    for (std::int64_t i = 0; i < 600; ++i) {
        FrameParts parts;
        parts.start_ns = kStart + i * 20 * kMs;
        parts.channels_ns = i == 300 ? 30 * kMs : 5 * kMs;
        snapshot.record.add(parts, i == 301, 0.02);
    }
    snapshot.frame = {5.0, 5.0, 30.0};
    snapshot.health[1].failures = 2;
    snapshot.health[1].set_reason("OpenGL reported an error");
    snapshot.world.mode = protocol::cigi::IgMode::kOperate;
    snapshot.world.sun_elevation_deg = -5.25;
    snapshot.world.adaptation_cd_m2 = 3.5;
    snapshot.passes[0] = {"dome", true, "always"};
    snapshot.passes[1] = {"stars", false, "the sky is too bright"};
    snapshot.pass_count = 2;
    snapshot.sources[0].link = {world::LinkState::kLive, {0x7F000001, 8005}, 0.02, 1};
    snapshot.sources[0].arrivals = 599;
    snapshot.sources[1].link.state = world::LinkState::kStale;
    snapshot.sources[1].rights.owns = config::Aspects{0b00110};
    snapshot.sources[2].rights.owns = config::Aspects{0b00010};
    snapshot.sources[1].overruled[1] = 17;
    snapshot.aspects[0] = {0, world::HoldReason::kFirst};
    snapshot.aspects[1] = {0, world::HoldReason::kPriority};
    snapshot.cigi.packets[0] = 599;
    snapshot.cigi[protocol::cigi::Count::kTruncated] = 4;
    snapshot.refused.second_host = 7;
    snapshot.udp.not_allowed = 9;
    snapshot.canaerospace[1][protocol::canaerospace::Event::kFrames] = 1000;
    snapshot.canaerospace[1].reasons[static_cast<std::size_t>(protocol::canaerospace::Reason::kRange)] = 3;
    snapshot.flightgear[2].packets = 60;
    return snapshot;
}

/// The leader of two others, of which one has other settings.
inline RigState example_rig() {
    RigState rig;
    rig.role = RigRole::kLeads;
    rig.self.set("main");
    rig.leader.set("main");
    rig.frame = 600;
    rig.wait = {600, 0.4, 1.75, 10.0};
    rig[RigCount::kIncomplete] = 3;
    rig[RigCount::kUnsealed] = 12;
    rig.node_count = 2;
    RigNode& ready = rig.nodes[0];
    ready.name.set("side");
    ready.state = RigNodeState::kReady;
    ready.build.set("skyigd 1.2.3");
    ready.gl.set("4.5 llvmpipe");
    ready.frame = 599;
    ready.lag = 1;
    ready.frame_ms = 7.25;
    ready.waited_ms = 0.5;
    ready.left_out = 3;
    ready.silent_s = 0.02;
    RigNode& refused = rig.nodes[1];
    refused.name.set("rear");
    refused.state = RigNodeState::kRefused;
    refused.why.set("settings 1, the leader's are 2");
    refused.build.set("skyigd 1.2.3");
    refused.silent_s = 0.1;
    return rig;
}

/// Their channels: "left" is drawn by the leader, "right" by the node that is ready.
inline Facts rig_facts() {
    Facts facts = example_facts();
    facts.channel_nodes = {"main", "side"};
    return facts;
}

inline RunReport with_bus(RunReport report) {
    report.buses = {{"cockpit", "can0", "up", {{"received", 1000}, {"fd_frames", 2}}}};
    return report;
}

}  // namespace skyig::server::status::tests
