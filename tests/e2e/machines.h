// Machines of a rig without machines: network namespaces of this one, a cable from each to one switch.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/e2e/process.h"

namespace skyig::tests {

/// Needs root's rights over the network. Gone with everything in it at the end.
class Machines {
  public:
    /// \param count  of machines; the first has the switch
    explicit Machines(int count);
    ~Machines();
    Machines(const Machines&) = delete;
    Machines& operator=(const Machines&) = delete;

    /// Empty where the machines are there, else why they are not.
    [[nodiscard]] const std::string& fault() const noexcept { return fault_; }
    [[nodiscard]] static std::string address(int machine);
    [[nodiscard]] static std::string interface(int machine);
    /// A program on that machine.
    [[nodiscard]] std::vector<std::string> on(int machine, const std::vector<std::string>& command) const;
    /// This thread's sockets are that machine's from now on.
    void enter(int machine) const;
    /// Pulls the cable of a machine, or puts it in again.
    void plug(int machine, bool in) const;

  private:
    [[nodiscard]] std::string name(int machine) const;
    void ip(const std::vector<std::string>& words);

    int count_;
    std::string fault_;
};

/// Settings of a rig of so many machines, "lead", "left", "right", ..., one channel each.
struct RigSettings {
    int machines = 3;
    std::string utc = "2026-06-21T12:00:00Z";
    /// Further lines, tables' first.
    std::string more;
    std::string stand_ins = "[]";
    double rate_hz = 60.0;
    double wait_ms = 10.0;
    int width_px = 160;
    int height_px = 128;
    /// Between the channels' view axes.
    int yaw_deg = 60;
};
inline constexpr const char* kMachineNames[] = {"lead", "left", "right"};
[[nodiscard]] std::string rig_toml(const RigSettings& settings, const std::string& key_file);

}  // namespace skyig::tests
