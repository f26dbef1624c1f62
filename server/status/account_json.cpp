#include <nlohmann/json.hpp>

#include "protocol/cigi/session.h"
#include "server/endpoint_format.h"
#include "server/report_json.h"
#include "server/status/account.h"
#include "server/status/from_snapshot.h"
#include "server/status/rig_pages.h"

namespace skyig::server::status {

namespace {

using Json = nlohmann::ordered_json;

Json recent_json(const RecentFrames& recent) {
    return {{"frames", recent.frames},       {"late", recent.late},     {"rate_hz", recent.rate_hz},
            {"median_ms", recent.median_ms}, {"p95_ms", recent.p95_ms}, {"largest_ms", recent.largest_ms}};
}

Json settings_json(const SettingsState& settings) {
    constexpr std::int64_t kSecondNs = 1'000'000'000;
    const std::int64_t taken_ns = settings.last_taken_utc_ns;
    return {
        {"times_taken", settings.times_taken},
        {"times_refused", settings.times_refused},
        {"last_taken_utc",
         taken_ns == 0 ? Json(nullptr)
                       : Json(ephemeris::to_iso(ephemeris::UtcClockTime::from_unix(taken_ns / kSecondNs)))}};
}

Json overload_json(const Account& account) {
    const Thinning& thinning = account.snapshot.thinning;
    return {{"order", account.facts.thinning_order},   {"thinned", account.report.thinned},
            {"times_thinned", thinning.times_thinned}, {"times_returned", thinning.times_returned},
            {"exhausted", thinning.exhausted},         {"reason", thinning_reason(thinning)}};
}

/// Heights above the ellipsoid. Zeros of visibility, aerosol and wind: told none.
Json layer_json(const protocol::cigi::WeatherControl& layer) {
    return {{"id", layer.layer_id},
            {"enabled", layer.weather_enable},
            {"cloud_type", static_cast<int>(layer.cloud_type)},
            {"severity", layer.severity},
            {"lightning", layer.random_lightning},
            {"base_m", layer.base_elevation},
            {"top_m", layer.base_elevation + layer.thickness},
            {"bottom_band_m", layer.transition_band},
            {"top_band_m", layer.top_transition_band},
            {"coverage_pct", layer.coverage},
            {"visibility_m", layer.visibility},
            {"aerosol_g_m3", layer.aerosol},
            {"wind_m_s", layer.wind_horizontal},
            {"wind_from_deg", layer.wind_direction}};
}

Json weather_json(const Facts& facts, const WorldState& world) {
    Json layers = Json::array();
    for (std::size_t i = 0; i < world.layer_count; ++i)
        layers.push_back(layer_json(world.layers[i]));
    return {{"elevation_m", facts.elevation_m},
            {"transition_s", facts.transition_s},
            {"layers", layers},
            {"layers_left_out", world.layers_left_out}};
}

Json world_json(const Facts& facts, const WorldState& world) {
    const world::Ownship& ownship = world.ownship;
    return {{"mode", protocol::cigi::mode_name(world.mode)},
            {"utc", ephemeris::to_iso(world.utc, 3)},
            {"clock_running", world.clock_running},
            {"scene_time_s", world.scene_time_s},
            {"ownship",
             {{"latitude_deg", ownship.position.latitude_deg},
              {"longitude_deg", ownship.position.longitude_deg},
              {"height_m", ownship.position.height_m},
              {"yaw_deg", ownship.yaw_deg},
              {"pitch_deg", ownship.pitch_deg},
              {"roll_deg", ownship.roll_deg},
              {"exists", ownship.exists},
              {"placed_by_host", ownship.placed_by_host}}},
            {"air",
             {{"visibility_m", world.air.visibility_m},
              {"temperature_c", world.air.temperature_c},
              {"pressure_hpa", world.air.pressure_hpa},
              {"humidity_pct", world.air.humidity_pct},
              {"wind_horizontal_m_s", world.air.wind_horizontal_m_s},
              {"wind_from_deg", world.air.wind_from_deg}}},
            {"weather", weather_json(facts, world)},
            {"sun", {{"elevation_deg", world.sun_elevation_deg}, {"azimuth_deg", world.sun_azimuth_deg}}},
            {"moon",
             {{"elevation_deg", world.moon_elevation_deg},
              {"azimuth_deg", world.moon_azimuth_deg},
              {"lit_fraction", world.moon_lit_fraction}}},
            {"adaptation_cd_m2", world.adaptation_cd_m2}};
}

/// Names of aspects for which `holds` says yes.
template <class Holds>
Json aspects_json(Holds holds) {
    Json json = Json::array();
    for (std::size_t aspect = 0; aspect < config::kAspectCount; ++aspect) {
        if (holds(aspect)) json.push_back(config::kAspectNames[aspect]);
    }
    return json;
}

Json source_json(const Account& account, std::size_t index) {
    const SourceFacts& facts = account.facts.sources[index];
    const SourceState& state = account.snapshot.sources[index];
    const bool heard = state.link.state != world::LinkState::kWaiting;
    const bool udp = facts.kind != config::SourceKind::kCanAerospace;
    return {{"name", facts.name},
            {"kind", config::kSourceKindNames[static_cast<std::size_t>(facts.kind)]},
            {"heard_at", facts.heard_at},
            {"peer", heard && udp ? fmt::to_string(state.link.host) : std::string()},
            {"link", world::kLinkStateNames[static_cast<std::size_t>(state.link.state)]},
            {"silent_s", heard ? Json(state.link.silent_s) : Json(nullptr)},
            {"losses", state.link.losses},
            {"arrivals", state.arrivals},
            {"priority", state.rights.priority},
            {"owns", aspects_json([&state](std::size_t aspect) { return state.rights.owns.test(aspect); })},
            {"holds", aspects_json([&account, index](std::size_t aspect) {
                 return account.snapshot.aspects[aspect].holder == index;
             })},
            {"counts", counts_json(source_counts(account.facts, account.snapshot, index))}};
}

/// Who has the say about what, by which rule, and whose word does not count though it might.
Json authority_json(const Account& account) {
    Json json = Json::object();
    for (std::size_t aspect = 0; aspect < config::kAspectCount; ++aspect) {
        const AspectState& state = account.snapshot.aspects[aspect];
        Json overruled = Json::object();
        for (std::size_t source = 0; source < account.facts.sources.size(); ++source) {
            const std::uint64_t times = account.snapshot.sources[source].overruled[aspect];
            if (times > 0) overruled[account.facts.sources[source].name] = times;
        }
        json[std::string(config::kAspectNames[aspect])] = {
            {"holder", state.holder ? Json(account.facts.sources[*state.holder].name) : Json(nullptr)},
            {"rule", state.holder ? Json(hold_rule(account.facts, account.snapshot,
                                                   static_cast<config::Aspect>(aspect), state.reason))
                                  : Json(nullptr)},
            {"overruled", overruled}};
    }
    return json;
}

Json channels_json(const Account& account) {
    Json json = Json::array();
    for (std::size_t i = 0; i < account.facts.channels.size(); ++i) {
        const ChannelHealth& health = account.snapshot.health[i];
        json.push_back({{"name", account.facts.channels[i]},
                        {"failed", health.failed},
                        {"failures", health.failures},
                        {"last_failure", health.reason()},
                        {"hidden", account.snapshot.hidden[i]}});
    }
    return json;
}

Json plan_json(const Snapshot& snapshot) {
    Json json = Json::array();
    for (std::size_t i = 0; i < snapshot.pass_count; ++i) {
        const PassState& pass = snapshot.passes[i];
        json.push_back({{"pass", pass.name}, {"needed", pass.needed}, {"reason", pass.reason}});
    }
    return json;
}

Json recorder_json(const std::optional<RecorderState>& recorder) {
    if (!recorder) return nullptr;
    return {{"file", recorder->file},
            {"written", recorder->written},
            {"lost", recorder->lost},
            {"bytes", recorder->bytes},
            {"failed", recorder->failed}};
}

}  // namespace

std::string to_json(const Account& account) {
    Json json = report_json(account.report);
    json["started_utc"] = account.facts.started_utc;
    json["uptime_s"] = account.uptime_s;
    json["age_s"] = account.age_s;
    json["health"] = {{"ok", account.health.good}, {"text", account.health.text}};
    json["recent"] = recent_json(account.snapshot.record.recent());
    json["settings"] = settings_json(account.snapshot.settings);
    json["pace"] = account.facts.pace;
    json["overload"] = overload_json(account);
    json["world"] = world_json(account.facts, account.snapshot.world);
    json["sources"] = Json::array();
    for (std::size_t i = 0; i < account.facts.sources.size(); ++i)
        json["sources"].push_back(source_json(account, i));
    json["authority"] = authority_json(account);
    json["channels"] = channels_json(account);
    json["plan"] = plan_json(account.snapshot);
    json["rig"] = rig_json(account.facts, account.snapshot.rig);
    json["recorder"] = recorder_json(account.recorder);
    json["status_port"] = {{"connections", account.port.connections},
                           {"answered", account.port.answered},
                           {"refused", account.port.refused},
                           {"timed_out", account.port.timed_out}};
    // Paths need not be UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace skyig::server::status
