// What a daemon tells of itself as a page for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace skyig::clients::status {

/// \param now     what /status says
/// \param before  what it said a while ago, for what has changed since; null: nothing. Counters then show
/// their change in brackets. Throws nlohmann::json::exception when either is no such page.
[[nodiscard]] std::string page_text(const nlohmann::ordered_json& now, const nlohmann::ordered_json* before);

}  // namespace skyig::clients::status
