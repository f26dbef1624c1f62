// A rig of several machines: [rig] and its [[rig.node]] tables.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace skyig::config {

inline constexpr std::size_t kMaxNodes = 64;

/// One machine.
struct RigNode {
    /// 1..32 of letters, digits, '-' and '_', unique.
    std::string name;
    /// IPv4, unique: where the others reach it.
    std::string address;
    /// Of that machine, "eth1": nothing of the rig goes over another. Empty: that with the address.
    std::string interface;
};

struct Rig {
    /// Name of the machine that the host speaks to.
    std::string leader;
    /// Who takes its place, in this order.
    std::vector<std::string> stand_ins;
    /// Of DDS, 0..230.
    int domain = 0;
    /// So long a frame waits for machines that have not drawn it, 0.1..1000.
    double wait_ms = 10.0;
    /// Of 32 hexadecimal digits, as a path from where the program runs (the file's is from where the settings
    /// are).
    std::string key_file;
    /// 1..kMaxNodes
    std::vector<RigNode> nodes;

    [[nodiscard]] const RigNode* find(const std::string& name) const noexcept;
};

}  // namespace skyig::config
