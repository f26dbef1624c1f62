// What a daemon tells of its rig of several machines as a page for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace skyig::clients::status {

/// \param rig  the member "rig" of what /status says. Throws nlohmann::json::exception when it is none; that
/// of a machine alone, null, too.
[[nodiscard]] std::string rig_text(const nlohmann::ordered_json& rig);

/// The same in a few words: "leads, frame 1200; 3 nodes: 2 ready, 1 lost".
[[nodiscard]] std::string rig_line(const nlohmann::ordered_json& rig);

}  // namespace skyig::clients::status
