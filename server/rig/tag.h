// The key of a rig, and the tag that proves that who wrote something has it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "protocol/result.h"

namespace skyig::server::rig {

/// 128 bits.
using Key = std::array<std::uint64_t, 2>;

/// 32 hexadecimal digits, white space round them. The error is a line that says what would be right.
[[nodiscard]] protocol::Result<Key, std::string> parse_key(std::string_view text);
/// Of a file that holds nothing else. Its error names the file.
[[nodiscard]] protocol::Result<Key, std::string> read_key(const std::string& path);
/// Whether users of this machine can read it who neither own it nor are of its group.
[[nodiscard]] bool is_open_to_all(const std::string& path) noexcept;

/// SipHash-2-4 (Aumasson and Bernstein, "SipHash: a fast short-input PRF", 2012).
[[nodiscard]] std::uint64_t siphash(const Key& key, std::span<const std::byte> bytes) noexcept;

}  // namespace skyig::server::rig
