// [rig], its [[rig.node]] tables, and which machine draws a [[channel]].
#include "config/rig.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/schema.h"

namespace skyig::config {
namespace {

constexpr std::string_view kNameForm = "a machine's name of [[rig.node]]";

void read_node(TableReader& table, Rig& rig) {
    RigNode node;
    const Value* name = table.text("name", node.name);
    table.require("name", "a short text such as \"left\"");
    if (name != nullptr && !is_short_name(node.name)) {
        table.error(*name, "name",
                    fmt::format("is \"{}\"; it must be 1..32 of letters, digits, '-' and '_'", node.name));
    }
    if (name != nullptr && rig.find(node.name) != nullptr) {
        table.error(*name, "name",
                    fmt::format("is \"{}\" like that of another machine; names must differ", node.name));
    }
    const Value* address = table.text("address", node.address);
    table.require("address", "the machine's IPv4 address such as \"192.168.7.11\"");
    if (address != nullptr && !is_ipv4(node.address)) {
        table.error(
            *address, "address",
            fmt::format("is \"{}\"; it must be an IPv4 address such as \"192.168.7.11\"", node.address));
    }
    const auto same = [&node](const RigNode& other) { return other.address == node.address; };
    if (address != nullptr && std::any_of(rig.nodes.begin(), rig.nodes.end(), same)) {
        table.error(
            *address, "address",
            fmt::format("is \"{}\" like that of another machine; addresses must differ", node.address));
    }
    table.text("interface", node.interface);
    rig.nodes.push_back(std::move(node));
}

void read_stand_ins(TableReader& table, Rig& rig) {
    const Value* value = table.any("stand_ins");
    if (value == nullptr) return;
    const auto* list = std::get_if<Array>(&value->data);
    if (list == nullptr) {
        table.error(*value, "stand_ins",
                    fmt::format("is {}; it must be a list of names such as [\"left\"]", type_name(*value)));
        return;
    }
    for (const Value& item : list->items) {
        const auto* name = std::get_if<std::string>(&item.data);
        if (name == nullptr || rig.find(*name) == nullptr) {
            table.error(item, "stand_ins",
                        fmt::format("holds {}; it must hold names of [[rig.node]] tables",
                                    name == nullptr ? std::string(type_name(item))
                                                    : fmt::format("\"{}\", which is none", *name)));
            continue;
        }
        const bool twice =
            std::find(rig.stand_ins.begin(), rig.stand_ins.end(), *name) != rig.stand_ins.end();
        if (twice || *name == rig.leader) {
            table.error(item, "stand_ins",
                        fmt::format("holds \"{}\", which {}", *name, twice ? "is there twice" : "leads"));
            continue;
        }
        rig.stand_ins.push_back(*name);
    }
}

}  // namespace

const RigNode* Rig::find(const std::string& name) const noexcept {
    const auto found =
        std::find_if(nodes.begin(), nodes.end(), [&name](const RigNode& node) { return node.name == name; });
    return found == nodes.end() ? nullptr : &*found;
}

void read_rig(TableReader& root, ErrorList& errors, std::optional<Rig>& out) {
    if (root.any("rig") == nullptr) return;
    TableReader table = root.table("rig");
    Rig rig;
    read_tables(table, errors, "node", "rig.node", 0, kMaxNodes,
                [&rig](TableReader& node) { read_node(node, rig); });
    const Value* leader = table.text("leader", rig.leader);
    table.require("leader", kNameForm);
    if (leader != nullptr && rig.find(rig.leader) == nullptr) {
        table.error(*leader, "leader", fmt::format("is \"{}\"; it must be {}", rig.leader, kNameForm));
    }
    read_stand_ins(table, rig);
    table.describe("stand_ins", "list of names", to_toml(rig.stand_ins));
    table.integer("domain", rig.domain, 0, 230);
    table.number("wait_ms", rig.wait_ms, {0.1, 1000.0, "ms"});
    const Value* key = table.text("key_file", rig.key_file);
    table.require("key_file", "the path of a file with the rig's key, 32 hexadecimal digits");
    if (key != nullptr && rig.key_file.empty())
        table.error(*key, "key_file", "is empty; it must name a file with the rig's key");
    rig.key_file = beside(errors.file(), rig.key_file);
    table.finish();
    out = std::move(rig);
}

void read_channel_node(TableReader& table, const std::optional<Rig>& rig, Channel& channel) {
    const Value* value = table.text("node", channel.node);
    if (value != nullptr && !rig) {
        table.error(*value, "node", "is of rigs of several machines, but there is no [rig]");
    } else if (value != nullptr && rig->find(channel.node) == nullptr) {
        table.error(*value, "node", fmt::format("is \"{}\"; it must be {}", channel.node, kNameForm));
    } else if (value == nullptr && rig) {
        table.require("node", kNameForm);
    }
}

void check_windows_of_nodes(ErrorList& errors, const Config& config, const Place& place) {
    for (std::size_t i = 0; config.rig && i < config.channels.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const Channel& one = config.channels[j];
            const Channel& other = config.channels[i];
            if (!one.viewport || !other.viewport || one.viewport->window != other.viewport->window ||
                one.node == other.node)
                continue;
            errors.add(place, fmt::format("channel[{}].viewport.window", i + 1),
                       fmt::format("is that of channel[{}], which another machine draws; a window is one "
                                   "machine's",
                                   j + 1));
            break;
        }
    }
}

}  // namespace skyig::config
