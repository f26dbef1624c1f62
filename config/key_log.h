// What a reading of settings asked for: every key with its range and the value that holds after it. The
// readers tell it as they go, so that the reference of keys and the effective settings cannot differ from
// what is read.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "config/config.h"

namespace skyig::config {

struct KeyUse {
    /// As errors name it: "channel[1].display"; empty for the root.
    std::string table;
    std::string key;
    /// As a person would write it, without its unit: "-90..90", "true, false". Empty for a key that is only
    /// known: a table, or one that has no place beside others.
    std::string range;
    std::string unit;
    /// As TOML. Nothing: not given, and there is no default.
    std::optional<std::string> value;
    bool given = false;
    bool required = false;

    [[nodiscard]] bool is_value() const noexcept { return !range.empty(); }
};

class KeyLog {
  public:
    /// What of a key is known by now; the first call for it makes it.
    KeyUse& at(const std::string& table, std::string_view key);
    /// In the order in which they were first asked for.
    [[nodiscard]] const std::vector<KeyUse>& uses() const noexcept { return uses_; }

  private:
    std::vector<KeyUse> uses_;
    /// By their dotted path.
    std::unordered_map<std::string, std::size_t> places_;
};

/// Values as a settings file holds them; what is read back is the same.
[[nodiscard]] std::string to_toml(double value);
[[nodiscard]] std::string to_toml(int value);
[[nodiscard]] std::string to_toml(bool value);
[[nodiscard]] std::string to_toml(std::string_view text);
/// A literal would count as a truth value.
[[nodiscard]] inline std::string to_toml(const char* text) {
    return to_toml(std::string_view(text));
}
[[nodiscard]] std::string to_toml(const UtcDateTime& utc);
[[nodiscard]] std::string to_toml(std::span<const double> list);
[[nodiscard]] std::string to_toml(std::span<const std::string> texts);
[[nodiscard]] std::string to_toml(const UdpAddress& address);

}  // namespace skyig::config
