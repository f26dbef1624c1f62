// The shader sources, compiled in. Made from render/shaders/ at build time.
#pragma once

#include <optional>
#include <string_view>

namespace skyig::render::shaders {

/// \param path  file name relative to render/shaders, e.g. "sky/dome.frag"
[[nodiscard]] std::optional<std::string_view> shader_text(std::string_view path) noexcept;

}  // namespace skyig::render::shaders
