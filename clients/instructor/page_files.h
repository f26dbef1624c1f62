// The page's files, compiled in: what the tools of page/ have made of its sources (page/README.md).
#pragma once

#include <optional>
#include <string_view>

#include "server/status/http.h"

namespace skyig::clients::instructor {

/// \param path  "app.js", as in built/
[[nodiscard]] std::optional<std::string_view> page_file(std::string_view path) noexcept;

/// A page by the path that a browser asks for; status 404 for none.
[[nodiscard]] server::status::HttpAnswer page_answer(std::string_view path);

}  // namespace skyig::clients::instructor
