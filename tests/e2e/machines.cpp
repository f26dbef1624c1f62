#include "tests/e2e/machines.h"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <stdexcept>

#include "tests/e2e/site.h"

namespace skyig::tests {

namespace {

std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

const std::vector<std::string> kIp{"/usr/bin/env", "PATH=/usr/sbin:/usr/bin:/sbin:/bin", "ip"};

}  // namespace

Machines::Machines(int count) : count_(count) {
    const std::string first = name(0);
    ip({"netns", "add", first});
    ip({"-n", first, "link", "set", "lo", "up"});
    ip({"-n", first, "link", "add", "br0", "type", "bridge"});
    ip({"-n", first, "addr", "add", address(0) + "/24", "dev", "br0"});
    ip({"-n", first, "link", "set", "br0", "up"});
    for (int i = 1; i < count; ++i) {
        const std::string cable = "cable" + std::to_string(i);
        ip({"netns", "add", name(i)});
        ip({"link", "add", cable, "netns", first, "type", "veth", "peer", "name", "eth0", "netns", name(i)});
        ip({"-n", first, "link", "set", cable, "master", "br0"});
        ip({"-n", first, "link", "set", cable, "up"});
        ip({"-n", name(i), "link", "set", "lo", "up"});
        ip({"-n", name(i), "addr", "add", address(i) + "/24", "dev", "eth0"});
        ip({"-n", name(i), "link", "set", "eth0", "up"});
    }
}

Machines::~Machines() {
    for (int i = 0; i < count_; ++i)
        (void)run(joined(kIp, {"netns", "del", name(i)}));
}

std::string Machines::name(int machine) const {
    return "skyig-" + std::to_string(getpid()) + "-" + std::to_string(machine);
}

void Machines::ip(const std::vector<std::string>& words) {
    if (!fault_.empty()) return;
    const Finished done = run(joined(kIp, words));
    if (done.status == 0) return;
    fault_ = "ip";
    for (const std::string& word : words)
        fault_ += " " + word;
    fault_ += ": " + done.err;
}

std::string Machines::address(int machine) {
    return "10.77.0." + std::to_string(machine + 1);
}

std::string Machines::interface(int machine) {
    return machine == 0 ? "br0" : "eth0";
}

std::vector<std::string> Machines::on(int machine, const std::vector<std::string>& command) const {
    return joined(joined(kIp, {"netns", "exec", name(machine)}), command);
}

void Machines::enter(int machine) const {
    const int place = open(("/run/netns/" + name(machine)).c_str(), O_RDONLY | O_CLOEXEC);
    if (place < 0 || setns(place, CLONE_NEWNET) != 0)
        throw std::runtime_error("no way into " + name(machine));
    close(place);
}

void Machines::plug(int machine, bool in) const {
    (void)run(
        joined(kIp, {"-n", name(0), "link", "set", "cable" + std::to_string(machine), in ? "up" : "down"}));
}

std::string rig_toml(const RigSettings& settings, const std::string& key_file) {
    std::string text = "version = 1\n" + settings.more +
                       "[daemon]\nrate_hz = " + std::to_string(settings.rate_hz) + "\n[start]\nutc = \"" +
                       settings.utc + "\"\n[rig]\nleader = \"lead\"\nstand_ins = " + settings.stand_ins +
                       "\nwait_ms = " + std::to_string(settings.wait_ms) + "\nkey_file = \"" + key_file +
                       "\"\n";
    for (int i = 0; i < settings.machines; ++i) {
        text += "[[rig.node]]\nname = \"" + std::string(kMachineNames[i]) + "\"\naddress = \"" +
                Machines::address(i) + "\"\ninterface = \"" + Machines::interface(i) + "\"\n";
    }
    for (int i = 0; i < settings.machines; ++i) {
        text += channel_toml(std::string("of-") + kMachineNames[i], settings.width_px, settings.height_px,
                             settings.yaw_deg * (i - 1));
        text += "node = \"" + std::string(kMachineNames[i]) + "\"\n";
    }
    return text;
}

}  // namespace skyig::tests
