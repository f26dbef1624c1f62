#include "server/status/rig_pages.h"

#include <nlohmann/json.hpp>
#include <span>

namespace skyig::server::status {

namespace {

using OrderedJson = nlohmann::ordered_json;

std::span<const RigNode> nodes_of(const RigState& rig) noexcept {
    return std::span(rig.nodes).first(rig.node_count);
}

std::string_view state_name(RigNodeState state) noexcept {
    return kRigNodeStateNames[static_cast<std::size_t>(state)];
}

OrderedJson channels_of(const Facts& facts, std::string_view node) {
    OrderedJson names = OrderedJson::array();
    for (std::size_t i = 0; i < facts.channel_nodes.size(); ++i)
        if (facts.channel_nodes[i] == node) names.push_back(facts.channels[i]);
    return names;
}

OrderedJson node_json(const Facts& facts, const RigNode& node) {
    const bool heard = node.state != RigNodeState::kUnheard;
    return {{"name", node.name.get()},
            {"channels", channels_of(facts, node.name.get())},
            {"state", state_name(node.state)},
            {"why", node.why.get()},
            {"frame", node.frame},
            {"lag", node.lag},
            {"frame_ms", node.frame_ms},
            {"waited_ms", node.waited_ms},
            {"repeats", node.repeats},
            {"late", node.late},
            {"left_out", node.left_out},
            {"losses", node.losses},
            {"silent_s", heard ? OrderedJson(node.silent_s) : OrderedJson(nullptr)},
            {"build", node.build.get()},
            {"gl", node.gl.get()},
            {"gl_errors", node.gl_errors}};
}

}  // namespace

nlohmann::ordered_json rig_json(const Facts& facts, const RigState& rig) {
    if (rig.role == RigRole::kAlone) return nullptr;
    OrderedJson counts = OrderedJson::object();
    for (std::size_t i = 0; i < rig.counts.size(); ++i)
        counts[std::string(kRigCountNames[i])] = rig.counts[i];
    OrderedJson nodes = OrderedJson::array();
    for (const RigNode& node : nodes_of(rig))
        nodes.push_back(node_json(facts, node));
    return {{"name", rig.self.get()},
            {"channels", channels_of(facts, rig.self.get())},
            {"role", kRigRoleNames[static_cast<std::size_t>(rig.role)]},
            {"leader", rig.leader.get()},
            {"frame", rig.frame},
            {"wait",
             {{"count", rig.wait.count},
              {"median_ms", rig.wait.median_ms},
              {"p99_ms", rig.wait.p99_ms},
              {"largest_ms", rig.wait.largest_ms}}},
            {"counts", std::move(counts)},
            {"nodes", std::move(nodes)}};
}

void add_rig(MetricsText& out, const RigState& rig) {
    if (rig.role == RigRole::kAlone) return;
    constexpr double kSecondsOfMs = 1e-3;
    const auto each = [&](std::string_view name, std::string_view help, auto value) {
        out.family(name, "gauge", help);
        for (const RigNode& node : nodes_of(rig))
            out.sample({{"node", node.name.get()}}, value(node));
    };
    out.family("skyig_rig_role", "gauge", "1 for this machine's part in the rig.");
    for (std::size_t i = 1; i < kRigRoleNames.size(); ++i)
        out.sample({{"role", kRigRoleNames[i]}}, static_cast<std::size_t>(rig.role) == i ? 1.0 : 0.0);
    out.family("skyig_rig_frame", "gauge", "Number of the rig's last frame.");
    out.sample(static_cast<double>(rig.frame));
    out.family("skyig_rig_wait_seconds", "gauge", "Wait of the leader for nodes that had not drawn.");
    out.sample({{"statistic", "median"}}, rig.wait.median_ms * kSecondsOfMs);
    out.sample({{"statistic", "p99"}}, rig.wait.p99_ms * kSecondsOfMs);
    out.sample({{"statistic", "largest"}}, rig.wait.largest_ms * kSecondsOfMs);
    out.family("skyig_rig_counts_total", "counter", "What this machine has counted of the rig.");
    for (std::size_t i = 0; i < rig.counts.size(); ++i)
        out.sample({{"count", kRigCountNames[i]}}, static_cast<double>(rig.counts[i]));
    out.family("skyig_rig_node_state", "gauge", "1 for the state that the node is in.");
    for (const RigNode& node : nodes_of(rig)) {
        for (std::size_t i = 0; i < kRigNodeStateNames.size(); ++i) {
            out.sample({{"node", node.name.get()}, {"state", kRigNodeStateNames[i]}},
                       static_cast<std::size_t>(node.state) == i ? 1.0 : 0.0);
        }
    }
    each("skyig_rig_node_lag_frames", "Frames by which the rig is further than the node.",
         [](const RigNode& node) { return static_cast<double>(node.lag); });
    each("skyig_rig_node_frame_seconds", "Of the last frame, from the leader's word to finished pixels.",
         [](const RigNode& node) { return node.frame_ms * kSecondsOfMs; });
    each("skyig_rig_node_waited_seconds", "How long the leader waited for the node's last frame.",
         [](const RigNode& node) { return node.waited_ms * kSecondsOfMs; });
    out.family("skyig_rig_node_counts_total", "counter", "What the node, and the leader of it, has counted.");
    for (const RigNode& node : nodes_of(rig)) {
        const auto count = [&](std::string_view name, std::uint64_t value) {
            out.sample({{"node", node.name.get()}, {"count", name}}, static_cast<double>(value));
        };
        count("repeats", node.repeats);
        count("late", node.late);
        count("left_out", node.left_out);
        count("losses", node.losses);
        count("gl_errors", node.gl_errors);
    }
}

}  // namespace skyig::server::status
