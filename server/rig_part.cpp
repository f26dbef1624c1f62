#include "server/rig_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "server/rig/dds_link.h"
#include "server/weather/weather_builder.h"

namespace skyig::server {

namespace {

template <class Value>
Value value_or_throw(protocol::Result<Value, std::string> result) {
    if (!result) throw std::runtime_error(fmt::format("rig: {}", result.error()));
    return std::move(result).value();
}

std::vector<rig::FrameCoder::Picture> pictures_of(const config::Config& config) {
    std::vector<rig::FrameCoder::Picture> pictures;
    for (const auto& look : weather::weather_settings(config.weather).looks) {
        if (!look) continue;
        for (const auto& tile : look->tiles)
            if (tile.picture) pictures.push_back(tile.picture);
    }
    return pictures;
}

std::vector<std::string> leaders_of(const config::Rig& rig) {
    std::vector<std::string> names{rig.leader};
    names.insert(names.end(), rig.stand_ins.begin(), rig.stand_ins.end());
    return names;
}

std::unique_ptr<rig::Link> open_link(const config::Config& config, const std::string& node) {
    const config::Rig& rig = *config.rig;
    const config::RigNode& self = *rig.find(node);
    rig::DdsSettings settings{.domain = static_cast<std::uint32_t>(rig.domain),
                              .interface = self.interface.empty() ? self.address : self.interface,
                              .peers = {},
                              .period_ns = std::llround(config.daemon.period_s() * 1e9),
                              .may_lead = RigPart::may_lead(rig, node)};
    for (const config::RigNode& other : rig.nodes)
        if (other.name != node) settings.peers.push_back(other.address);
    return value_or_throw(rig::open_dds_link(settings));
}

rig::MachineSettings machine_settings(const config::Config& config, const std::string& node,
                                      std::uint64_t settings, const RigEnds& ends) {
    const config::Rig& rig = *config.rig;
    rig::MachineSettings made{
        .self = {node, static_cast<std::uint64_t>(ends.clock.utc_ns()), "skyigd " SKYIG_VERSION, settings},
        .leaders = leaders_of(rig),
        .nodes = {},
        .wait_ns = std::llround(rig.wait_ms * 1e6),
        .replays = ends.replays};
    for (const config::RigNode& one : rig.nodes)
        made.nodes.push_back(one.name);
    return made;
}

std::vector<bool> own_channels(const config::Config& config, const std::string& node) {
    std::vector<bool> own;
    for (const config::Channel& channel : config.channels)
        own.push_back(channel.node == node);
    return own;
}

}  // namespace

RigPart::RigPart(const config::Config& config, const std::string& node, std::uint64_t settings,
                 const RigEnds& ends)
    : key_(value_or_throw(rig::read_key(config.rig->key_file))),
      coder_(pictures_of(config)),
      link_(open_link(config, node)),
      machine_(machine_settings(config, node, settings, ends), key_, coder_, *link_, ends.clock, ends.log),
      pace_(machine_, ends.pace, ends.idle),
      wire_(machine_, ends.wire),
      painter_(machine_, ends.painter, pace_, ends.world, own_channels(config, node), ends.idle) {
    if (rig::is_open_to_all(config.rig->key_file)) {
        ends.log.warning("{}: every user of this machine can read the rig's key: chmod 640 takes that away",
                         config.rig->key_file);
    }
}

bool RigPart::may_lead(const config::Rig& rig, const std::string& node) {
    const std::vector<std::string> names = leaders_of(rig);
    return std::find(names.begin(), names.end(), node) != names.end();
}

std::string RigPart::fault(const config::Config& config, const std::string& node, bool replays) {
    if (node.empty()) return {};
    if (!config.rig) return fmt::format("--node {}: the settings have no [rig]", node);
    if (config.rig->find(node) == nullptr) {
        std::string names;
        for (const config::RigNode& one : config.rig->nodes)
            names += fmt::format("{}{}", names.empty() ? "" : ", ", one.name);
        return fmt::format("--node {}: the settings' rig has no such machine; it has {}", node, names);
    }
    if (replays && node != config.rig->leader)
        return fmt::format("--replay is for the leader, {}; {} draws what that says", config.rig->leader,
                           node);
    return {};
}

}  // namespace skyig::server
