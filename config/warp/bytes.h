// A file as bytes.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "config/warp/maps.h"

namespace skyig::config::warp {

using Bytes = std::vector<std::byte>;

/// Larger files are refused.
inline constexpr std::size_t kMostFileBytes = std::size_t{256} << 20U;

[[nodiscard]] FileRead<Bytes> read_bytes(const std::string& path);

}  // namespace skyig::config::warp
